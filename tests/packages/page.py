"""What the tests of the page share: where it is, and when it cannot be tested."""
import os
import shutil
import sys

import packaged
from packaged import DIST, ROOT, SKIPPED

WEB = ROOT / "web"
PROGRAM = ROOT / "build/wasm"
PAGE = DIST / "web/index.html"
NODE = shutil.which("node")


def main():
    missing = [text for text, is_there in (
        ("Node.js", NODE), ("the program in WebAssembly (./dev web)", (PROGRAM / "feedhold.wasm").is_file()),
        ("the page (./dev web)", PAGE.is_file()), ("Chromium", shutil.which("chromium"))) if not is_there]
    if missing and os.environ.get("FEEDHOLD_PACKAGES") == "1":
        print(f"skipped: needs {', '.join(missing)}")
        sys.exit(SKIPPED)
    packaged.main()
