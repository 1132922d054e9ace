"""What all packages are made from: the version, the time, and the program of each platform as it is installed."""
import gzip
import io
import os
import re
import shutil
import subprocess
import tarfile
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUMMARY = "Static analyser, linter and prover for CNC macro programs"
DESCRIPTION = """Feedhold reads macro programs of CNC controls (FANUC Custom Macro B,
Mitsubishi, Haas, LinuxCNC) as the control does. It reports mistakes before
the machine makes them, runs programs without a machine, and proves for all
inputs that loops end, that the control does not stop and that contracts are
kept."""
LICENCE = "Apache-2.0"
# What only the people who publish a release know: packages to try have what is said here instead.
TO_TRY = {"FEEDHOLD_HOMEPAGE": "https://feedhold.example/", "FEEDHOLD_MAINTAINER": "Nobody <nobody@feedhold.example>"}
SHAPES = {"FEEDHOLD_HOMEPAGE": (r"https://[^\s/]+\.[^\s/]+(/\S*)?", "an address as https://shop.org/feedhold"),
          "FEEDHOLD_MAINTAINER": (r"[^<>@\n]*[^<>@\s] <[^<>@\s]+@[^<>@\s]+\.[^<>@\s]+>",
                                  "a name and an address for mail as Jo Doe <jo@shop.org>")}
HOMEPAGE, MAINTAINER = (os.environ.get(name) or value for name, value in TO_TRY.items())


def missing_for_release():
    """What has to be set before packages are published."""
    return [f"{name}: {shape}" for name, (pattern, shape) in SHAPES.items()
            if not re.fullmatch(pattern, os.environ.get(name, "")) or re.search(r"\bexample\b", os.environ[name])]


@dataclass(frozen=True)
class Platform:
    preset: str   # that the program is built by
    name: str     # in the names of archives
    node: str     # as Node.js says it
    system: str   # as the wheel says it
    program: str  # the name of its file


LINUX = Platform("package", "linux-x86_64", "linux-x64", "POSIX :: Linux", "feedhold")
WINDOWS = Platform("windows", "windows-x86_64", "win32-x64", "Microsoft :: Windows", "feedhold.exe")
PLATFORMS = [LINUX, WINDOWS]
# In the page, and in the extension for VS Code where there is no other.
WASM = Platform("wasm", "wasm", "", "", "feedhold-node.wasm")
WASM_FILES = ["feedhold-node.js", WASM.program]  # for Node.js


@dataclass(frozen=True)
class Built:
    """The program of a platform."""
    platform: Platform
    build: Path  # the build folder of the preset
    tree: Path   # what `cmake --install` made of it

    @property
    def program(self):
        return (self.tree / "bin" / self.platform.program).read_bytes()


@dataclass(frozen=True)
class Release:
    built: dict  # by platform
    wasm: Built
    out: Path    # where packages go
    epoch: int   # the only time in any package

    version = re.search(r"^project\(feedhold VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def epoch():
    """That of the last commit, unless the environment says otherwise (reproducible-builds.org)."""
    if given := os.environ.get("SOURCE_DATE_EPOCH"):
        return int(given)
    told = subprocess.run(["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True, check=True)
    return int(told.stdout)


def install(platform, builds, trees):
    """From `builds` to `trees`, which have a folder for each preset."""
    built = Built(platform, builds / platform.preset, trees / platform.preset)
    shutil.rmtree(built.tree, ignore_errors=True)
    # The linker has stripped the program for Windows: `strip` would write the time into it.
    strip = ["--strip"] if platform == LINUX else []
    subprocess.run(["cmake", "--install", built.build, "--prefix", built.tree, *strip], check=True,
                   stdout=subprocess.DEVNULL)
    return built


def install_wasm(builds, trees):
    """Where install() would put it: the build has no rules for it, since no system runs it."""
    built = Built(WASM, builds / WASM.preset, trees / WASM.preset)
    (built.tree / "bin").mkdir(parents=True)
    for name in WASM_FILES:
        shutil.copy(built.build / name, built.tree / "bin")
    return built


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


def write_zip(path, files, when):
    """`files`: bytes by name.  Programs are those below `scripts/`, where wheels have them."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, time.gmtime(when)[:6])
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            entry.external_attr = (0o100755 if "/scripts/" in name else 0o100644) << 16
            archive.writestr(entry, data)
    return path
