"""Packages for npm: `feedhold` starts the program of the package for the platform, which npm chooses by itself."""
import json

from release import HOMEPAGE, LICENCE, LINUX, PLATFORMS, ROOT, SUMMARY, write_tar_gz
from texts import texts


def described(release, name, more):
    about = {"name": name, "version": release.version, "description": SUMMARY, "license": LICENCE, "homepage": HOMEPAGE}
    return json.dumps(about | more, indent=2).encode() + b"\n"


def make_starter(release):
    manifest = described(release, "feedhold", {
        "bin": {"feedhold": "bin/feedhold.js"}, "engines": {"node": ">=16"},
        "optionalDependencies": {f"@feedhold/{each.node}": release.version for each in PLATFORMS}})
    files = {"package/package.json": manifest, "package/bin/feedhold.js": (ROOT / "packaging/npm/feedhold.js").read_bytes(),
             "package/LICENSE": texts(release.built[LINUX])["LICENSE"]}
    return write_tar_gz(release.out / f"feedhold-{release.version}.tgz", files, release.epoch)


def make_program(release, built):
    system, processor = built.platform.node.split("-")
    manifest = described(release, f"@feedhold/{built.platform.node}", {"os": [system], "cpu": [processor]})
    files = {"package/package.json": manifest, f"package/bin/{built.platform.program}": built.program}
    files |= {f"package/{name}": text for name, text in texts(built).items()}
    return write_tar_gz(release.out / f"feedhold-{built.platform.node}-{release.version}.tgz", files, release.epoch)
