"""Slips at which LinuxCNC's interpreter stops (stops.toml): it says what the table has, and `feedhold check` has an error in
the line where it stops.  Beside them, blocks that the interpreter takes: there `check` has no error."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
FEEDHOLD = os.environ["FEEDHOLD"]
ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
INTERPRETER = shutil.which("rs274")
SKIPPED = 77  # ctest's word for a test that could not run here
LONGEST_RUN = 60
GROUPS = tomllib.loads((HERE / "stops.toml").read_text())


def text_of(group, blocks):
    return f"{group['head']}{blocks}\n{group['tail']}"


def cases():
    for name, group in GROUPS.items():
        for message, slips in group.get("stops", {}).items():
            for blocks in slips:
                yield f"{name}: {message}", message, text_of(group, blocks)
        for blocks in group.get("taken", []):
            yield f"{name}: taken: {blocks}", "", text_of(group, blocks)


def interpreted(path):
    """What the interpreter says, and the line at which; both empty when it comes to the end."""
    home = {**os.environ, "HOME": str(path.parent)}  # it keeps its tool table there
    result = subprocess.run([INTERPRETER, "-v", f"{path.stem}.var", "-g", path.name], cwd=path.parent, env=home, text=True,
                            errors="replace", stdin=subprocess.DEVNULL, capture_output=True, timeout=LONGEST_RUN)
    said = [line for line in result.stderr.splitlines() if line.strip() and line != "executing"]
    return [*said, "", ""][:2]


def checked(folder):
    result = subprocess.run([FEEDHOLD, "check", "--dialect", "linuxcnc", "--isolated", "--severity", "error", "--format", "json",
                             str(folder)], capture_output=True, text=True, timeout=LONGEST_RUN)
    errors = {}
    for finding in json.loads(result.stdout)["findings"]:
        if finding["severity"] != "error":
            continue
        errors.setdefault(Path(finding["path"]).name, []).append((finding["line"], finding["message"]))
    return errors


class Stops(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.cases = list(cases())

    def test_check_finds_what_the_interpreter_says(self):
        with tempfile.TemporaryDirectory() as folder:
            # A folder for each: programs of one folder call each other.
            paths = [Path(folder) / str(i) / f"{i}.ngc" for i in range(len(self.cases))]
            for path, (_, _, text) in zip(paths, self.cases):
                path.parent.mkdir()
                path.write_text(text)
                (path.parent / f"{path.stem}.var").touch()
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                said = list(pool.map(interpreted, paths))
            errors = checked(folder)
        wrong = []
        for path, (name, message, text), (says, stop) in zip(paths, self.cases, said):
            lines = [number for number, line in enumerate(text.splitlines(), 1) if line.strip() == stop.strip()]
            found = errors.get(path.name, [])
            if message not in says or bool(message) != bool(says):
                wrong.append(f"{name}: the interpreter says {says!r}")
            elif not message and found:
                wrong.append(f"{name}: errors at what the interpreter takes: {found}")
            elif message and not any(number in lines for number, _ in found):
                wrong.append(f"{name}: nothing in line {lines}: {stop}; but {found}")
        self.assertEqual(wrong, [])
        print(f"{sum(bool(message) for _, message, _ in self.cases)} stops, {sum(not message for _, message, _ in self.cases)} taken")


if __name__ == "__main__":
    if not INTERPRETER and not ORACLES:
        sys.exit(SKIPPED)
    unittest.main()
