"""Macro programs in a real Emacs, with Eglot and the mode of editors/emacs."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from editor_session import EditorSession
from harness import ORACLES, ROOT, SKIPPED

MODE = ROOT / "editors" / "emacs"
SESSION = ROOT / "tests" / "editors" / "emacs_session.el"
EGLOT = [f"--directory={path}" for path in Path("/usr/share/emacs/site-lisp/elpa").glob("eglot-*")]  # 29 has it within


class Emacs(EditorSession, unittest.TestCase):
    command = ["emacs", "--batch", "-Q", *EGLOT, "-L", MODE, "-l", SESSION]


class Mode(unittest.TestCase):
    def test_compiles_without_warnings(self):
        with tempfile.TemporaryDirectory() as folder:  # Emacs puts the result beside what it compiles
            copy = shutil.copy(MODE / "feedhold-mode.el", folder)
            told = subprocess.run(["emacs", "--batch", "-Q", "--eval", "(setq byte-compile-error-on-warn t)", "-f",
                                   "batch-byte-compile", copy], capture_output=True)
        self.assertEqual((told.returncode, told.stderr.decode()), (0, ""))


if __name__ == "__main__":
    if not ORACLES:
        print("skipped: needs Emacs with Eglot; run `./dev test --oracles`")
        sys.exit(SKIPPED)
    unittest.main()
