"""The libraries that are inside a program: which packages of Debian they come from, and their licences."""
import re
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from release import LINUX, ROOT, WASM, WINDOWS

# By the source package in Debian: the licence (SPDX) of the parts that end up in the program.
LICENCES = {
    "cli11": "BSD-3-Clause",
    "emscripten": "MIT AND NCSA AND Apache-2.0 WITH LLVM-exception",
    "fmtlib": "MIT",
    "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "gcc-mingw-w64": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "gmp": "LGPL-3.0-or-later OR GPL-2.0-or-later",
    "llvm-toolchain-14": "Apache-2.0 WITH LLVM-exception",
    "mingw-w64": "ZPL-2.1 AND MIT AND BSD-3-Clause AND LicenseRef-public-domain",
    "nlohmann-json3": "MIT",
    "tomlplusplus": "MIT",
}
COMPILERS = {LINUX: "g++", WINDOWS: "x86_64-w64-mingw32-g++-posix", WASM: "em++"}
ARCHIVES = {
    LINUX: ["libgmp.a", "libgmpxx.a", "libstdc++.a", "libgcc.a", "libgcc_eh.a", "libc.a", "libm.a"],
    WINDOWS: ["libstdc++.a", "libgcc.a", "libgcc_eh.a", "libmingw32.a", "libmingwex.a", "libmsvcrt.a", "libwinpthread.a"],
    WASM: [],  # emscripten builds the libraries of its package when they are needed
}
SYSTEM = "linux-libc-dev"  # headers of the kernel's interface: no code


@dataclass(frozen=True, order=True)
class Library:
    package: str
    source: str
    version: str
    architecture: str
    notice: Path

    @property
    def url(self):
        version = self.version.replace(":", "%3A").replace("+", "%2B")
        return f"pkg:deb/debian/{self.package}@{version}?arch={self.architecture}&distro=debian-12"


def told(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def headers(build):
    """Outside of this source tree, as the compiler has noted them; links lead to what they stand for."""
    lines = told("ninja", "-C", str(build), "-t", "deps").splitlines()
    files = {str((build / line.strip()).resolve()) for line in lines if line.startswith("    ")}
    return {file for file in files if not file.startswith(f"{ROOT}/")}


def installed(name):
    package, source, version, architecture = told(
        "dpkg-query", "-W", "-f=${Package}\t${source:Package}\t${Version}\t${Architecture}", name).split("\t")
    return Library(package, source, version, architecture, Path(f"/usr/share/doc/{package}/copyright"))


def cross_built(build):
    """GMP, by packaging/cross_libraries.sh."""
    sources = build.parent / f"{build.name}-libraries/source"
    description = next(sources.glob("gmp_*.dsc")).read_text()
    version = re.search(r"^Version: (\S+)$", description, re.MULTILINE)[1]
    return Library("gmp", "gmp", version, "source", next(sources.glob("gmp-*/debian/copyright")))


@cache
def inside(built):
    """By name."""
    linked = [told(COMPILERS[built.platform], f"-print-file-name={name}").strip() for name in ARCHIVES[built.platform]]
    files = headers(built.build) | {str(Path(path).resolve()) for path in linked if path.startswith("/")}
    owners = subprocess.run(["dpkg", "-S", *sorted(files)], capture_output=True, text=True).stdout
    names = {line.split(": ")[0].split(", ")[0] for line in owners.splitlines()}  # `libc6-dev:amd64`, `fmt`
    found = [installed(name) for name in names if name.split(":")[0] != SYSTEM]
    if built.platform in (WINDOWS, WASM):
        found.append(cross_built(built.build))
    unknown = {each.source for each in found if each.source not in LICENCES}
    if unknown:
        raise SystemExit(f"packaging/libraries.py has no licence for {', '.join(sorted(unknown))}")
    return tuple(sorted(found))


def notices(built):
    """The copyright files of Debian, one for each source package."""
    parts = []
    for library in {each.source: each for each in reversed(inside(built))}.values():
        text = library.notice.read_text(errors="replace")
        parts.append((library.source, f"{'=' * 100}\n{library.source} {library.version}: {LICENCES[library.source]}\n"
                                      f"{'=' * 100}\n{text}"))
    return ("Libraries inside the program, with the notices of the Debian packages that they come from.\n\n"
            + "\n".join(text for _, text in sorted(parts)))
