"""The inputs of LinuxCNC's own interpreter tests, in the machine of `feedhold run` and in the interpreter."""
import importlib.util
import json
import os
import subprocess
import sys
import tomllib
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

HERE = Path(__file__).resolve().parent
ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
# A folder with tests/ of LinuxCNC and a MANIFEST.tsv that says which of them the installed version passes.
SOURCES = Path(os.environ.get("FEEDHOLD_LINUXCNC", HERE.parents[2] / "shared" / "corpus" / "linuxcnc"))
SKIPPED = 77  # ctest's word for a test that could not run here
LONGEST_RUN = 60
# Paths of the inputs that cannot agree, by reason.
EXPECTED = tomllib.loads((HERE / "upstream_differences.toml").read_text())


def inputs():
    rows = [line.split("\t") for line in (SOURCES / "MANIFEST.tsv").read_text().splitlines()]
    folders = [SOURCES / row[2] for row in rows if row[0] == "PASS"]
    return sorted({path for folder in folders for path in folder.rglob("*.ngc")})


def interpreted(path):
    """In a process of its own: some inputs bring the module down."""
    result = subprocess.run([sys.executable, str(HERE / "interpreter.py"), path.name, "g21"], cwd=path.parent,
                            capture_output=True, text=True, errors="replace", timeout=LONGEST_RUN)
    if result.returncode:
        return None
    report = json.loads(result.stdout[result.stdout.index('{"moves"'):])  # behind what the program prints
    return SimpleNamespace(moves=[tuple(move) for move in report["moves"]], error=report["error"])


def difference(path):
    from comparison import Comparison
    theirs = interpreted(path)
    if not theirs:
        return "the interpreter crashes"
    try:
        return Comparison(path, theirs).difference
    except (AssertionError, subprocess.TimeoutExpired) as error:
        return str(error)


class Upstream(unittest.TestCase):
    maxDiff = None

    def test_inputs_agree(self):
        paths = inputs()
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            differences = dict(zip([path.relative_to(SOURCES).as_posix() for path in paths], pool.map(difference, paths)))
        reasons = {path: reason for reason, listed in EXPECTED.items() for path in listed}
        print(f"{sum(not each for each in differences.values())} of {len(paths)} inputs agree")
        unexplained = {path: each for path, each in differences.items() if each and path not in reasons}
        self.assertEqual(unexplained, {})
        self.assertEqual([path for path in reasons if not differences.get(path)], [], "agree now, or are not there")


if __name__ == "__main__":
    if not SOURCES.exists() or (importlib.util.find_spec("gcode") is None and not ORACLES):
        sys.exit(SKIPPED)
    unittest.main()
