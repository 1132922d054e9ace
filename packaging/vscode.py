"""The extension for VS Code with the program inside: one for each platform, and one with WebAssembly for all others."""
import os
import subprocess
import tempfile
from pathlib import Path

from release import ROOT, WASM_FILES
from texts import texts

UNIVERSAL = "universal"  # as editors/vscode/package.mjs says it


def make(release, built):
    target = built.platform.node
    package(release, built, target, {built.platform.program: 0o755})
    return release.out / f"feedhold-{target}-{release.version}.vsix"


def make_universal(release):
    package(release, release.wasm, UNIVERSAL, {name: 0o644 for name in WASM_FILES})
    return release.out / f"feedhold-{release.version}.vsix"


def package(release, built, target, files):
    """`files`: the modes of those of the installed program, by name."""
    with tempfile.TemporaryDirectory() as holder:
        for name, mode in files.items():
            put(Path(holder) / name, (built.tree / "bin" / name).read_bytes(), mode)
        put(Path(holder) / "THIRD-PARTY-NOTICES.txt", texts(built)["THIRD-PARTY-NOTICES"], 0o644)
        subprocess.run(["npm", "run", "--silent", "package", "--", target, holder, release.out], check=True,
                       cwd=ROOT / "editors/vscode", stdout=subprocess.DEVNULL,
                       env={**os.environ, "SOURCE_DATE_EPOCH": str(release.epoch)})


def put(path, data, mode):
    path.write_bytes(data)
    path.chmod(mode)
