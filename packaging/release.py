"""What all packages are made from: the version, the time, the installed tree and the texts of a release."""
import gzip
import io
import os
import re
import shutil
import subprocess
import tarfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUMMARY = "Static analyser, linter and prover for CNC macro programs"
DESCRIPTION = """Feedhold reads macro programs of CNC controls (FANUC Custom Macro B,
Mitsubishi, Haas, LinuxCNC) as the control does. It reports mistakes before
the machine makes them, runs programs without a machine, and proves for all
inputs that loops end, that the control does not stop and that contracts are
kept."""
HOMEPAGE = "https://example.com/feedhold"
MAINTAINER = "Feedhold maintainers <maintainers@users.noreply.h-seed-c282d966.example>"
LICENCE = "Apache-2.0"


@dataclass(frozen=True)
class Release:
    build: Path  # the build folder of the preset
    tree: Path   # what `cmake --install` made of it
    out: Path    # where packages go
    epoch: int   # the only time in any package

    version = re.search(r"^project\(feedhold VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]

    @property
    def program(self):
        return (self.tree / "bin/feedhold").read_bytes()


def epoch():
    """That of the last commit, unless the environment says otherwise (reproducible-builds.org)."""
    if given := os.environ.get("SOURCE_DATE_EPOCH"):
        return int(given)
    told = subprocess.run(["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True, check=True)
    return int(told.stdout)


def install(build, tree):
    shutil.rmtree(tree, ignore_errors=True)
    subprocess.run(["cmake", "--install", build, "--prefix", tree, "--strip"], check=True, stdout=subprocess.DEVNULL)


def gzipped(data):
    return gzip.compress(data, compresslevel=9, mtime=0)


def write_tar_gz(path, files, when):
    """`files`: bytes by name.  Programs are those below `bin/`."""
    holder = io.BytesIO()
    with tarfile.open(fileobj=holder, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for name, data in sorted(files.items()):
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime, entry.mode = len(data), when, 0o755 if "/bin/" in name else 0o644
            tar.addfile(entry, io.BytesIO(data))
    path.write_bytes(gzipped(holder.getvalue()))
    return path
