"""The program that is judged: `feedhold prove`, `ranges`, `check` and `run`, and what they answer."""
import json
import os
import re
import subprocess
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Optional

import controls
import syntax
from machine import Inputs


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

    @property
    def holds(self) -> bool:
        return self.verdict in ("proved", "unreachable")


@dataclass
class Proofs:
    """What is claimed of the programs of one folder."""

    claims: dict  # program number to claims
    incomplete: dict  # program number to why
    errors: list

    def of(self, program: int, kind: str):
        return [c for c in self.claims.get(program, []) if c.kind == kind]

    def is_complete(self, program: int) -> bool:
        return program in self.claims and not self.incomplete.get(program)


class Engine:
    def __init__(self, path: str, timeout: float = 300):
        self.path = path
        self.timeout = timeout
        self.environment = {**os.environ, "XDG_CACHE_HOME": "/nonexistent"}

    def call(self, *arguments: str):
        done = subprocess.run([self.path, *arguments], capture_output=True, text=True, timeout=self.timeout,
                              env=self.environment)
        if done.returncode < 0 or done.returncode == 4 or not done.stdout:
            raise EngineFailed(arguments, done)
        return done

    def prove(self, folder: Path, dialect: str, only: Optional[str] = None) -> dict:
        """By the folder of each file, what is claimed."""
        kind = ["--only", only] if only else []
        done = self.call("prove", "--isolated", "--no-cache", "--jobs", "1", *kind, "--format", "json", "--dialect",
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
                              each["verdict"], each["witness"], each["id"], each["reason"] or "")
                found.claims.setdefault(claim.program, []).append(claim)
        return proofs

    def check(self, folder: Path, dialect: str) -> dict:
        done = self.call("check", "--isolated", "--format", "json", "--dialect", dialect, str(folder))
        return json.loads(done.stdout)

    def ranges(self, file: Path, program: int, dialect: str) -> dict:
        done = self.call("ranges", "--isolated", "--calls", "--format", "json", "--dialect", dialect, "--program",
                         f"O{program}", str(file))
        return json.loads(done.stdout)

    def run(self, arguments: list) -> dict:
        done = self.call("run", "--isolated", "--format", "json", *arguments)
        return json.loads(done.stdout)


class EngineFailed(Exception):
    def __init__(self, arguments, done):
        super().__init__(f"{' '.join(arguments)}: exit code {done.returncode}\n{done.stderr[-2000:]}")


def of_folder(proofs: dict, path: str) -> Proofs:
    return proofs.setdefault(str(Path(path).parent), Proofs({}, {}, []))


def number_of_name(name: str) -> int:
    digits = re.sub(r"\D", "", name)
    return int(digits) if digits else 0


def write_project(project: syntax.Project, folder: Path):
    folder.mkdir(parents=True, exist_ok=True)
    for file in project.files:
        (folder / file.name).write_text(file.text())


def file_of(project: syntax.Project, program: int) -> syntax.SourceFile:
    return next(file for file in project.files for each in file.programs if each.number == program)


def line_of(project: syntax.Project, program: int, block: int) -> int:
    line = 1
    for each in file_of(project, program).programs:
        if each.number == program:
            return line + each.first_block_line + block
        line += len(each.lines())
    raise ValueError(program)


def run_arguments(project: syntax.Project, folder: Path, program: int, inputs: Inputs) -> list:
    arguments = [str(folder / file_of(project, program).name), "--program", f"O{program}", "--dialect", project.dialect]
    for number, value in sorted(inputs.locals.items()):
        letter = controls.LOCAL_TO_LETTER.get(number)
        if value is not None and letter:
            arguments += ["--arg", f"{letter}={written(value)}"]
        elif value is not None:
            arguments += ["--var", f"{number}={written(value)}"]
    for number, value in sorted(inputs.cells.items()):
        if value is not None:
            arguments += ["--var", f"{number}={written(value)}"]
    if inputs.place:
        arguments += ["--start", *(f"{axis}{written(value)}" for axis, value in inputs.place.items())]
    if inputs.skip:
        arguments.append("--block-skip")
    return arguments


def written(value: Fraction) -> str:
    if value.denominator == 1:
        return str(int(value))
    try:
        return syntax.decimal(value)
    except ValueError:
        return repr(float(value))


ARGUMENT = re.compile(r"([A-Z])(-?[0-9.]+)")


def witness_inputs(witness: dict) -> Optional[Inputs]:
    """From the call and the command that shows it."""
    inputs = Inputs(skip="--block-skip" in witness["run"])
    words = witness["run"].split()
    for option, word in zip(words, words[1:]):
        if option == "--arg":
            letter, value = word.split("=")
            inputs.locals[controls.LETTER_TO_LOCAL[letter]] = Fraction(value)
        elif option == "--var":
            name, value = word.strip('"').split("=")
            if not name.isdigit():
                return None
            cells = inputs.locals if controls.is_local(int(name)) else inputs.cells
            number = int(name)
            if controls.is_bit_of_outputs(number):
                return None
            cells[number if controls.is_local(number) else cell_of(number)] = Fraction(value)
    if "--start" in words:
        for word in words[words.index("--start") + 1:]:
            match = ARGUMENT.fullmatch(word)
            if not match:
                break
            inputs.place[match[1]] = Fraction(match[2])
    return inputs


def cell_of(number: int) -> int:
    return number if controls.is_common(number) else controls.canonical(number)
