"""Macro programs in a real Neovim, with the plugin of editors/neovim."""
import sys
import unittest

from editor_session import EditorSession
from harness import ORACLES, ROOT, SKIPPED

PLUGIN = ROOT / "editors" / "neovim"
SESSION = ROOT / "tests" / "editors" / "neovim_session.lua"


class Neovim(EditorSession, unittest.TestCase):
    command = ["nvim", "--headless", "-u", "NONE", "-i", "NONE", "--cmd", f"set noswapfile runtimepath^={PLUGIN}",
               "-c", f"luafile {SESSION}"]


if __name__ == "__main__":
    if not ORACLES:
        print("skipped: needs Neovim; run `./dev test --oracles`")
        sys.exit(SKIPPED)
    unittest.main()
