"""The program that is judged: `feedhold prove`, `ranges`, `check` and `run`, and what they answer."""
import json
import os
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Optional


DEFECT = re.compile(r"bug in Feedhold: (.*)\n  replay it: feedhold run (\S+)")


@dataclass(frozen=True)
class Claim:
    kind: str
    program: int
    line: int  # of its file
    text: str
    verdict: str
    witness: Optional[dict]
    id: str
    reason: str = ""
    column: int = 0

    @property
    def holds(self) -> bool:
        return self.verdict in ("proved", "unreachable")


@dataclass
class Proofs:
    """What is claimed of the programs of one folder."""

    claims: dict  # program number to claims
    incomplete: dict  # program number to why
    errors: list
    withdrawn: list = field(default_factory=list)  # verdicts that a run of the engine's own contradicts

    def of(self, program: int, kind: str):
        return [c for c in self.claims.get(program, []) if c.kind == kind]

    def is_complete(self, program: int) -> bool:
        return program in self.claims and not self.incomplete.get(program)


class Engine:
    def __init__(self, path: str, timeout: float = 1500):
        self.path = path
        self.timeout = timeout
        self.arithmetic = "exact"  # or "control": the numbers in which claims are to hold
        self.environment = {**os.environ, "XDG_CACHE_HOME": "/nonexistent"}

    def call(self, *arguments: str):
        done = subprocess.run([self.path, *arguments], capture_output=True, text=True, timeout=self.timeout,
                              env=self.environment)
        if done.returncode < 0 or not done.stdout:
            raise EngineFailed(arguments, done)
        return done

    def prove(self, folder: Path, dialect: str, only: Optional[str] = None) -> dict:
        """By the folder of each file, what is claimed."""
        kind = ["--only", only] if only else []
        done = self.call("prove", "--isolated", "--no-cache", "--jobs", "1", "--arithmetic", self.arithmetic, *kind, "--format", "json", "--dialect",
                         dialect, str(folder))
        answer = json.loads(done.stdout)
        proofs: dict[str, Proofs] = {}
        for error in answer["errors"]:
            of_folder(proofs, error["path"]).errors.append(error["message"])
        for file in answer["files"]:
            found = of_folder(proofs, file["path"])
            for program in file["programs"]:
                found.incomplete[number_of_name(program["name"])] = program["incomplete"]
                found.claims.setdefault(number_of_name(program["name"]), [])
            for each in file["obligations"]:
                claim = Claim(each["kind"], number_of_name(each["program"]), each["line"], each["claim"],
                              each["verdict"], each["witness"], each["id"], each["reason"] or "", each["column"])
                found.claims.setdefault(claim.program, []).append(claim)
        for what, path in DEFECT.findall(done.stderr):
            of_folder(proofs, path).withdrawn.append(what)
        return proofs

    def messages(self, folder: Path, dialect: str) -> dict:
        """By the folder of each file, what `check` says: rule, message, name of the file, line."""
        done = self.call("check", "--severity", "info", "--isolated", "--format", "json", "--dialect", dialect,
                         str(folder))
        found: dict[str, list] = {}
        for each in json.loads(done.stdout)["findings"]:
            path = Path(each["path"])
            found.setdefault(str(path.parent), []).append((each["rule"], each["message"], path.name, each["line"]))
        return found

    def ranges(self, file: Path, program: int, dialect: str) -> dict:
        done = self.call("ranges", "--isolated", "--calls", "--format", "json", "--dialect", dialect, "--program",
                         f"O{program}", str(file))
        return json.loads(done.stdout)

    def run(self, arguments: list) -> dict:
        done = self.call("run", "--isolated", "--numbers", "binary64", "--format", "json", *arguments)
        return json.loads(done.stdout)

    def try_run(self, arguments: list):
        """None when the words are not accepted."""
        done = subprocess.run([self.path, "run", *arguments], capture_output=True, text=True, timeout=self.timeout,
                              env=self.environment)
        return json.loads(done.stdout) if done.returncode in (0, 1) and done.stdout else None


class EngineFailed(Exception):
    def __init__(self, arguments, done):
        super().__init__(f"{' '.join(arguments)}: exit code {done.returncode}\n{done.stderr[-2000:]}")


def of_folder(proofs: dict, path: str) -> Proofs:
    return proofs.setdefault(str(Path(path).parent), Proofs({}, {}, []))


def number_of_name(name: str) -> int:
    digits = re.sub(r"\D", "", name)
    return int(digits) if digits else 0


def rows_twice(proofs: Proofs):
    """Rows that are told more than once."""
    for claims in proofs.claims.values():
        seen = set()
        for claim in claims:
            row = claim.kind, claim.line, claim.column, claim.text
            if row in seen or claim.id in seen:
                yield claim
            seen |= {row, claim.id}
