#!/usr/bin/env python3
"""Makes all packages into a folder: `package.py [--release] BUILDS OUT`; BUILDS has a folder for the preset of each platform.
The same builds and commit give the same bytes.  With --release they are to be published, and what
is needed for that is asked for; without folders nothing else is done."""
import hashlib
import shutil
import sys
import tempfile
from pathlib import Path

import archive
import debian
import npm
import sbom
import vscode
import wheel
from release import PLATFORMS, Release, epoch, install, install_wasm, missing_for_release

OF_RELEASE = [archive.make_tar, archive.make_zip, debian.make, npm.make_starter, sbom.make, vscode.make_universal]
OF_PLATFORM = [wheel.make, npm.make_program, vscode.make]


def checksums(paths):
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"
                   for path in sorted(paths, key=lambda path: path.name))


def make_all(release):
    made = [make(release) for make in OF_RELEASE]
    return made + [make(release, built) for make in OF_PLATFORM for built in release.built.values()]


def main():
    words = sys.argv[1:]
    if "--release" in words:
        words.remove("--release")
        if missing := missing_for_release():
            print("\n  ".join(["package: a release needs, in the environment (docs/releasing.md):", *missing]), file=sys.stderr)
            return 2
    if not words:
        return 0
    builds, out = (Path(name).resolve() for name in words)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as trees:
        built = {platform: install(platform, builds, Path(trees)) for platform in PLATFORMS}
        made = make_all(Release(built, install_wasm(builds, Path(trees)), out, epoch()))
    (out / "SHA256SUMS").write_text(checksums(made))
    for path in made:
        print(f"{path.stat().st_size / 1e6:6.1f} MB  {path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
