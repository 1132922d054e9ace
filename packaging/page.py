#!/usr/bin/env python3
"""Makes the page to try a macro: `page.py BUILDS OUT`; BUILDS has the folder of the preset `wasm`."""
import shutil
import subprocess
import sys
from pathlib import Path

from libraries import notices
from release import ROOT, WASM, Built


def main():
    builds, out = (Path(name).resolve() for name in sys.argv[1:3])
    build = builds / WASM.preset
    shutil.rmtree(out, ignore_errors=True)
    subprocess.run(["npm", "run", "--silent", "build", "--", build, out], check=True, cwd=ROOT / "web")
    (out / "THIRD-PARTY-NOTICES.txt").write_text(notices(Built(WASM, build, build)))
    shutil.copy(ROOT / "LICENSE", out / "LICENSE.txt")
    print(f"{(out / 'index.html').stat().st_size / 1e6:6.1f} MB  {out.name}/index.html")


if __name__ == "__main__":
    main()
