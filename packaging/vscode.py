"""The extension for VS Code with the program inside, one for each platform."""
import os
import subprocess
import tempfile
from pathlib import Path

from release import ROOT
from texts import texts


def make(release, built):
    target = built.platform.node
    with tempfile.TemporaryDirectory() as holder:
        program = Path(holder) / built.platform.program
        program.write_bytes(built.program)
        program.chmod(0o755)
        notices = Path(holder) / "THIRD-PARTY-NOTICES.txt"
        notices.write_bytes(texts(built)["THIRD-PARTY-NOTICES"])
        notices.chmod(0o644)
        subprocess.run(["npm", "run", "--silent", "package", "--", target, holder, release.out], check=True,
                       cwd=ROOT / "editors/vscode", stdout=subprocess.DEVNULL,
                       env={**os.environ, "SOURCE_DATE_EPOCH": str(release.epoch)})
    return release.out / f"feedhold-{target}-{release.version}.vsix"
