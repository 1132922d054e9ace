"""Two packages for npm: `feedhold` starts the program of the package for the platform, which npm chooses by itself."""
import json

from release import HOMEPAGE, LICENCE, ROOT, SUMMARY, write_tar_gz
from texts import texts

PLATFORM = "linux-x64"


def described(release, name, more):
    about = {"name": name, "version": release.version, "description": SUMMARY, "license": LICENCE, "homepage": HOMEPAGE}
    return json.dumps(about | more, indent=2).encode() + b"\n"


def make_starter(release):
    manifest = described(release, "feedhold", {
        "bin": {"feedhold": "bin/feedhold.js"}, "engines": {"node": ">=16"},
        "optionalDependencies": {f"@feedhold/{PLATFORM}": release.version}})
    files = {"package/package.json": manifest, "package/bin/feedhold.js": (ROOT / "packaging/npm/feedhold.js").read_bytes(),
             "package/LICENSE": texts(release)["LICENSE"]}
    return write_tar_gz(release.out / f"feedhold-{release.version}.tgz", files, release.epoch)


def make_program(release):
    manifest = described(release, f"@feedhold/{PLATFORM}", {"os": ["linux"], "cpu": ["x64"]})
    files = {"package/package.json": manifest, "package/bin/feedhold": release.program}
    files |= {f"package/{name}": text for name, text in texts(release).items()}
    return write_tar_gz(release.out / f"feedhold-{PLATFORM}-{release.version}.tgz", files, release.epoch)
