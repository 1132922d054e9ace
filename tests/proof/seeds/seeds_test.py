"""corpus/manifest.toml says what becomes of each obligation of corpus/packages/; witnesses are run again."""
import json
import os
import shlex
import subprocess
import time
import tomllib
import unittest
from pathlib import Path

CORPUS = Path(__file__).resolve().parents[3] / "corpus"
FEEDHOLD = os.environ["FEEDHOLD"]
VERDICTS = ("proved", "refuted", "unreachable", "unknown")
SPACE = ("keep-in", "keep-out", "clearance", "travel", "limit")
STOPS = ("no-control-alarm", "compensation", "alarm-unreachable", "loop-ends", "program-ends")


def feedhold(*arguments):
    return subprocess.run([FEEDHOLD, *arguments], cwd=CORPUS, capture_output=True, text=True, timeout=1800)


def programs():
    found = tomllib.loads((CORPUS / "manifest.toml").read_text())["program"]
    return [program for program in found if program["path"].startswith("packages/")]


def expected():
    """path -> the verdicts by id in exact arithmetic, and the most passes by id."""
    return {program["path"]: ({identity: verdict for verdict in VERDICTS for identity in program.get(verdict, [])},
                              program.get("passes", {}))
            for program in programs()}


def rounded():
    """path -> the verdicts by id in the arithmetic of the control; "": no such row."""
    return {program["path"]: {identity: verdict for identity, verdict in
                              {**expected()[program["path"]][0], **program.get("rounding", {})}.items() if verdict}
            for program in programs()}


def proofs(*options):
    """path -> obligations"""
    start = time.monotonic()
    folders = {}  # by dialect: a folder has programs of one
    for program in programs():
        folders.setdefault(program["dialect"], set()).add(str(Path(program["path"]).parent))
    found = {}
    for dialect, paths in folders.items():
        result = feedhold("prove", "--no-cache", "--format", "json", "--isolated", "--dialect", dialect, *options,
                          *sorted(paths))
        found.update((file["path"], file["obligations"]) for file in json.loads(result.stdout)["files"])
    print(f"all proofs: {time.monotonic() - start:.2f} s")
    return found


class Seeds(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.files = proofs("--arithmetic", "exact")
        cls.rounded = proofs()

    def test_verdict_of_every_obligation(self):
        self.assertEqual(sorted(self.files), sorted(expected()))
        for path, rows in self.files.items():
            verdicts, passes = expected()[path]
            with self.subTest(path=path):
                self.assertEqual({row["id"]: row["verdict"] for row in rows}, verdicts)
                self.assertEqual({row["id"]: row["bound"] for row in rows if row["bound"]}, passes)

    def test_verdicts_in_the_arithmetic_of_the_control(self):
        found = {path: {row["id"]: row["verdict"] for row in rows} for path, rows in self.rounded.items()}
        all_rounded = rounded()
        self.assertEqual(sorted(found), sorted(all_rounded))
        for path, verdicts in found.items():
            with self.subTest(path=path):
                self.assertEqual(verdicts, all_rounded[path])

    def test_every_refutation_has_a_run_that_shows_it(self):
        for path, rows in [*self.files.items(), *self.rounded.items()]:
            for row in rows:
                if row["verdict"] != "refuted":
                    continue
                with self.subTest(obligation=row["id"], path=path):
                    shown = feedhold(*shlex.split(row["witness"]["run"])[1:])
                    self.assertIn(shown.returncode, (1,) if row["kind"] in STOPS else (0, 1),
                                  shown.stdout + shown.stderr)
                    if row["kind"] in SPACE:
                        self.assertIsNotNone(row["witness"]["gouge"])

    def test_proofs_are_certified(self):
        """But those for which only solvers are known to find the proof: `solvers` in the manifest."""
        grades = {(path, row["id"], row["grade"]) for path, rows in self.files.items() for row in rows
                  if row["verdict"] in ("proved", "unreachable") and row["grade"] != "certified"}
        self.assertEqual(grades, {(program["path"], identity, "two-solvers") for program in programs()
                                  for identity in program.get("solvers", [])})


if __name__ == "__main__":
    unittest.main()
