"""The libraries that are inside the program: which Debian packages they come from, and their licences."""
import subprocess
from functools import cache
from pathlib import Path

from release import ROOT

# By the source package in Debian: the licence (SPDX) of the parts that end up in the program.
LICENCES = {
    "cli11": "BSD-3-Clause",
    "fmtlib": "MIT",
    "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "gmp": "LGPL-3.0-or-later OR GPL-2.0-or-later",
    "nlohmann-json3": "MIT",
    "tomlplusplus": "MIT",
}
ARCHIVES = ["libgmp.a", "libgmpxx.a", "libstdc++.a", "libgcc.a", "libgcc_eh.a", "libc.a", "libm.a"]
SYSTEM = "linux-libc-dev"  # headers of the kernel's interface: no code


def told(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def headers(build):
    """Outside of this source tree, as the compiler has noted them."""
    lines = told("ninja", "-C", str(build), "-t", "deps").splitlines()
    return {line.strip() for line in lines if line.startswith("    /") and not line.strip().startswith(str(ROOT))}


@cache
def inside(build):
    """(binary package, source package, version), by name."""
    linked = [told("g++", f"-print-file-name={name}").strip() for name in ARCHIVES]
    files = headers(build) | {str(Path(path).resolve()) for path in linked if path.startswith("/")}
    found = set()
    owners = subprocess.run(["dpkg", "-S", *sorted(files)], capture_output=True, text=True).stdout
    for line in owners.splitlines():
        found.add(line.split(": ")[0].split(", ")[0])
    rows = [told("dpkg-query", "-W", "-f=${Package}\t${source:Package}\t${Version}", name).split("\t")
            for name in sorted(found)]
    unknown = {source for package, source, _ in rows if package != SYSTEM and source not in LICENCES}
    if unknown:
        raise SystemExit(f"packaging/libraries.py has no licence for {', '.join(sorted(unknown))}")
    return tuple(tuple(row) for row in rows if row[0] != SYSTEM)


def notices(build):
    """The copyright files of Debian, one for each source package."""
    parts, seen = [], set()
    for package, source, version in inside(build):
        if source in seen:
            continue
        seen.add(source)
        text = Path(f"/usr/share/doc/{package}/copyright").read_text(errors="replace")
        parts.append(f"{'=' * 100}\n{source} {version}: {LICENCES[source]}\n{'=' * 100}\n{text}")
    return "Libraries inside the program, with the notices of the Debian packages that they come from.\n\n" + "\n".join(parts)
