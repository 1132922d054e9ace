"""corpus/manifest.toml says what must be found in each program of corpus/, and nothing else may be."""
import json
import os
import subprocess
import tomllib
import unittest
from collections import defaultdict
from pathlib import Path

CORPUS = Path(__file__).resolve().parents[2] / "corpus"
FEEDHOLD = os.environ["FEEDHOLD"]
NO_PROGRAM = {".md", ".toml", ".contract"}


def manifest():
    return tomllib.loads((CORPUS / "manifest.toml").read_text())["program"]


def findings(*arguments):
    """path -> sorted `rule:line` of one run in corpus/; notes about style do not count."""
    result = subprocess.run([FEEDHOLD, "check", "--severity", "info", "--format", "json", *arguments], cwd=CORPUS, capture_output=True,
                            text=True, timeout=300)
    if result.returncode not in (0, 1):
        raise AssertionError(f"{arguments} ended with {result.returncode}:\n{result.stderr}")
    report = json.loads(result.stdout)
    refused = [row for row in report["skipped"] if row["kind"] == "refused"]
    if refused:
        raise AssertionError(f"not analysed: {refused}")
    found = defaultdict(list)
    for finding in report["findings"]:
        found[finding["path"]].append((finding["line"], finding["rule"]))
    return {path: [f"{rule}:{line}" for line, rule in sorted(places)] for path, places in found.items()}


def expected(programs):
    places = {program["path"]: sorted((int(place.rpartition(":")[2]), place.rpartition(":")[0])
                                      for place in program["findings"]) for program in programs}
    return {path: [f"{rule}:{line}" for line, rule in lines] for path, lines in places.items() if lines}


class Corpus(unittest.TestCase):
    maxDiff = None

    def test_manifest_names_every_program(self):
        files = {path.relative_to(CORPUS).as_posix() for path in CORPUS.rglob("*")
                 if path.is_file() and path.suffix not in NO_PROGRAM}
        self.assertEqual({program["path"] for program in manifest()}, files)

    def test_findings_as_a_person_gets_them(self):
        self.assertEqual(findings("."), expected(manifest()))

    def test_findings_with_the_dialect_given(self):
        groups = defaultdict(list)
        for program in manifest():
            groups[program["dialect"]].append(program)
        for dialect, programs in groups.items():
            with self.subTest(dialect=dialect):
                paths = [program["path"] for program in programs]
                self.assertEqual(findings("--dialect", dialect, *paths), expected(programs))


if __name__ == "__main__":
    unittest.main()
