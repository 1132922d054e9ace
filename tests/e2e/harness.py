"""What the end-to-end tests share: a scratch folder with programs, and runs of the real `feedhold`."""
import os
import resource
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FEEDHOLD = os.environ["FEEDHOLD"]
ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
SKIPPED = 77  # ctest's word for a test that could not run here
LONGEST_RUN = 120

GOOD = """%
O1000(FACING)
G90 G54 G00 X0. Y0.
#100=10.
IF[#100GT5.]GOTO10
G01 X#100 F200.
N10 G00 Z50.
M30
%
"""
BAD = """%
O1001(SLIP)
#510-[0-1.5]
M30
%
"""


class Scratch(unittest.TestCase):
    """A test with a folder of its own as working directory of every run."""

    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)
        self.folder = Path(self.holder.name)
        caches = tempfile.TemporaryDirectory()
        self.addCleanup(caches.cleanup)
        self.cache = Path(caches.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def environment(self, changes=None):
        """That of every run: what one test has proved is not remembered for the next."""
        return {**os.environ, "XDG_CACHE_HOME": str(self.cache), **(changes or {})}

    def feedhold(self, *arguments, cwd=None, environment=None):
        """One run.  A signal (a crash) is a failure of every test."""
        result = subprocess.run([FEEDHOLD, *map(str, arguments)], cwd=cwd or self.folder, capture_output=True,
                                timeout=LONGEST_RUN, stdin=subprocess.DEVNULL, env=self.environment(environment))
        self.assertIn(result.returncode, (0, 1, 2, 3), f"{arguments} ended with {result.returncode}:\n{result.stderr}")
        result.stdout = result.stdout.decode(errors="surrogateescape")  # a diff shows the bytes of the programs
        result.stderr = result.stderr.decode()
        return result

    def check(self, *arguments):
        return self.feedhold("check", *arguments)

    def assertExit(self, result, code):
        self.assertEqual(result.returncode, code, f"\nstdout:\n{result.stdout}\nstderr:\n{result.stderr}")


def small_stack():
    """Runs a child with a stack of 1 MiB, so that recursion over the program's text shows."""
    resource.setrlimit(resource.RLIMIT_STACK, (1 << 20, 1 << 20))
