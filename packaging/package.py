#!/usr/bin/env python3
"""Makes all packages of a build into a folder: `package.py BUILD OUT`.  The same build and commit give the same bytes."""
import hashlib
import shutil
import sys
import tempfile
from pathlib import Path

import debian
import npm
import sbom
import tarball
import wheel
from release import Release, epoch, install

MAKERS = [tarball.make, debian.make, wheel.make, npm.make_starter, npm.make_program, sbom.make]


def checksums(paths):
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"
                   for path in sorted(paths, key=lambda path: path.name))


def main():
    build, out = (Path(name).resolve() for name in sys.argv[1:3])
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as holder:
        release = Release(build, Path(holder), out, epoch())
        install(build, release.tree)
        made = [make(release) for make in MAKERS]
    (out / "SHA256SUMS").write_text(checksums(made))
    for path in made:
        print(f"{path.stat().st_size / 1e6:6.1f} MB  {path.name}")


if __name__ == "__main__":
    main()
