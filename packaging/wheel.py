"""A wheel for pip with the program inside.  A static program runs on every Linux for x86-64: both tags say the least that
pip knows of."""
import base64
import hashlib
import time
import zipfile

from release import DESCRIPTION, HOMEPAGE, LICENCE, SUMMARY
from texts import texts

TAGS = ["py3-none-manylinux_2_17_x86_64", "py3-none-musllinux_1_1_x86_64"]
TAG = "py3-none-manylinux_2_17_x86_64.musllinux_1_1_x86_64"


def metadata(release):
    return (f"Metadata-Version: 2.1\nName: feedhold\nVersion: {release.version}\nSummary: {SUMMARY}\n"
            f"Home-page: {HOMEPAGE}\nLicense: {LICENCE}\nRequires-Python: >=3.7\n"
            "Classifier: Environment :: Console\nClassifier: Intended Audience :: Manufacturing\n"
            "Classifier: Operating System :: POSIX :: Linux\n"
            f"Description-Content-Type: text/plain\n\n{DESCRIPTION}\n").encode()


def wheel_file():
    return ("Wheel-Version: 1.0\nGenerator: feedhold\nRoot-Is-Purelib: false\n"
            + "".join(f"Tag: {tag}\n" for tag in TAGS)).encode()


def record(files, info):
    rows = []
    for name, data in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    return "".join([*rows, f"{info}/RECORD,,\n"]).encode()


def write_zip(path, files, when):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, time.gmtime(when)[:6])
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            entry.external_attr = (0o100755 if "/scripts/" in name else 0o100644) << 16
            archive.writestr(entry, data)
    return path


def make(release):
    name = f"feedhold-{release.version}"
    info = f"{name}.dist-info"
    files = {f"{name}.data/scripts/feedhold": release.program, f"{info}/METADATA": metadata(release),
             f"{info}/WHEEL": wheel_file()}
    files |= {f"{info}/licenses/{each}": text for each, text in texts(release).items() if each != "CHANGELOG.md"}
    files[f"{info}/RECORD"] = record(files, info)
    return write_zip(release.out / f"{name}-{TAG}.whl", files, release.epoch)
