"""Wheels for pip with the program inside.  A static program runs on every Linux for x86-64: both of its tags say the least
that pip knows of."""
import base64
import hashlib

from release import DESCRIPTION, HOMEPAGE, LICENCE, LINUX, SUMMARY, WINDOWS, write_zip
from texts import texts

TAGS = {LINUX: ["manylinux_2_17_x86_64", "musllinux_1_1_x86_64"], WINDOWS: ["win_amd64"]}


def metadata(release, platform):
    return (f"Metadata-Version: 2.1\nName: feedhold\nVersion: {release.version}\nSummary: {SUMMARY}\n"
            f"Home-page: {HOMEPAGE}\nLicense: {LICENCE}\nRequires-Python: >=3.7\n"
            "Classifier: Environment :: Console\nClassifier: Intended Audience :: Manufacturing\n"
            f"Classifier: Operating System :: {platform.system}\n"
            f"Description-Content-Type: text/plain\n\n{DESCRIPTION}\n").encode()


def wheel_file(platform):
    return ("Wheel-Version: 1.0\nGenerator: feedhold\nRoot-Is-Purelib: false\n"
            + "".join(f"Tag: py3-none-{tag}\n" for tag in TAGS[platform])).encode()


def record(files, info):
    rows = []
    for name, data in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    return "".join([*rows, f"{info}/RECORD,,\n"]).encode()


def make(release, built):
    name = f"feedhold-{release.version}"
    info = f"{name}.dist-info"
    files = {f"{name}.data/scripts/{built.platform.program}": built.program,
             f"{info}/METADATA": metadata(release, built.platform), f"{info}/WHEEL": wheel_file(built.platform)}
    files |= {f"{info}/licenses/{each}": text for each, text in texts(built).items() if each != "CHANGELOG.md"}
    files[f"{info}/RECORD"] = record(files, info)
    tag = f"py3-none-{'.'.join(TAGS[built.platform])}"
    return write_zip(release.out / f"{name}-{tag}.whl", files, release.epoch)
