"""What the tests of packages share: where the packages are, clean places, and what an installed program must do."""
import atexit
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DIST = ROOT / "dist"
FEEDHOLD = os.environ["FEEDHOLD"]  # of this build
SKIPPED = 77
SYSTEM_PATH = "/usr/sbin:/usr/bin:/sbin:/bin"
VERSION = re.search(r"^project\(feedhold VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]

BAD = "%\nO1001(SLIP)\n#510-[0-1.5]\nM30\n%\n"
GOOD = "%\nO1000(FACING)\nG90 G54 G00 X0. Y0.\n#100=10.\nIF[#100GT5.]GOTO10\nG01 X#100 F200.\nN10 G00 Z50.\nM30\n%\n"
PROVED = "O9101\n(@REQUIRE #1 GT 0)\n#100=5/#1\nM99\n"
REFUTED = "O9102\n#100=5/#1\nM99\n"


@cache
def linux_program():
    """Out of its archive, once for all tests of a file, for those that compare another one with it."""
    holder = tempfile.TemporaryDirectory()
    atexit.register(holder.cleanup)
    subprocess.run(["tar", "-xzf", DIST / f"feedhold-{VERSION}-linux-x86_64.tar.gz", "-C", holder.name], check=True)
    return next(Path(holder.name).glob("*/bin/feedhold"))


class Packaged(unittest.TestCase):
    """A test in a folder of its own, which is empty."""
    maxDiff = None

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def artifact(self, pattern):
        found = list(DIST.glob(pattern))
        self.assertEqual(len(found), 1, f"{pattern} in {DIST}")
        return found[0]

    def run_clean(self, *command, cwd=None, code=0, **environment):
        """With nothing in the environment but what is said."""
        given = {"PATH": SYSTEM_PATH, "HOME": str(self.folder), **environment}
        result = subprocess.run([str(word) for word in command], cwd=cwd or self.folder, env=given, capture_output=True,
                                text=True, timeout=300, stdin=subprocess.DEVNULL)
        if code is not None:
            self.assertEqual(result.returncode, code, f"{command}\n{result.stdout}\n{result.stderr}")
        return result

    def use(self, *program, **environment):
        """Every installed program says its version and does the work."""
        work = self.folder / "work"
        work.mkdir()
        for name, text in (("O1000.nc", GOOD), ("O1001.nc", BAD), ("O9101.nc", PROVED), ("O9102.nc", REFUTED)):
            (work / name).write_text(text)

        def run(*words, code=0):
            return self.run_clean(*program, *words, cwd=work, code=code, **environment).stdout
        self.assertEqual(run("--version"), f"feedhold {VERSION}\n")
        self.assertIn("the self-check passed", run("self-check"))
        self.assertIn("no findings", run("check", "O1000.nc"))
        self.assertIn("missing-equals", run("check", "O1001.nc", code=1))
        self.assertIn("2 proved in 1 program", run("prove", "O9101.nc"))
        self.assertIn("G65 P9102 A0.", run("prove", "O9102.nc", code=1))
        shutil.rmtree(work)


def main():
    if os.environ.get("FEEDHOLD_PACKAGES") != "1":
        print("packages are made and used with `./dev test --packages` only")
        sys.exit(SKIPPED)
    unittest.main()
