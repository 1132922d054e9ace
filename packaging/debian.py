"""A package for Debian and its descendants.  The program is static: it installs on any release of them."""
import hashlib
import os
import subprocess
import tempfile
import time
from pathlib import Path

from libraries import LICENCES, inside
from release import DESCRIPTION, HOMEPAGE, LINUX, MAINTAINER, gzipped
from texts import texts

COPYRIGHT = """Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: feedhold
Source: {homepage}

Files: *
Copyright: {year} Feedhold maintainers
License: Apache-2.0
 On Debian systems the text is in /usr/share/common-licenses/Apache-2.0.
Comment: Inside the program are {libraries}.
 Their notices are in THIRD-PARTY-NOTICES.gz beside this file.
"""
# Why lintian may complain of it.
OVERRIDES = """# One file that runs on every release: what is inside is listed in the bill of materials.
feedhold: statically-linked-binary [usr/bin/feedhold]
feedhold: embedded-library gmp [usr/bin/feedhold]
"""


def control(release, size):
    lines = "\n".join(f" {line}" for line in DESCRIPTION.splitlines())
    return (f"Package: feedhold\nVersion: {release.version}\nSection: devel\nPriority: optional\nArchitecture: amd64\n"
            f"Maintainer: {MAINTAINER}\nInstalled-Size: {size}\nSuggests: z3, cvc5\nHomepage: {HOMEPAGE}\n"
            f"Description: static analyser and prover for CNC macro programs\n{lines}\n")


def changelog(release):
    when = time.strftime("%a, %d %b %Y %H:%M:%S +0000", time.gmtime(release.epoch))
    return (f"feedhold ({release.version}) stable; urgency=medium\n\n  * Changes are listed in CHANGELOG.md.gz.\n\n"
            f" -- {MAINTAINER}  {when}\n")


def copyright_text(release):
    names = {f"{each.source} ({LICENCES[each.source]})" for each in inside(release.built[LINUX])}
    return COPYRIGHT.format(homepage=HOMEPAGE, year=time.gmtime(release.epoch).tm_year, libraries=",\n ".join(sorted(names)))


def files(release):
    """Bytes by path, as the packages of Debian are laid out."""
    linux = release.built[LINUX]

    def installed(name):
        return (linux.tree / name).read_bytes()
    doc = "usr/share/doc/feedhold"
    written = texts(linux)
    return {
        "usr/bin/feedhold": linux.program,
        "usr/share/man/man1/feedhold.1.gz": gzipped(installed("share/man/man1/feedhold.1")),
        "usr/share/bash-completion/completions/feedhold": installed("share/bash-completion/completions/feedhold"),
        "usr/share/zsh/vendor-completions/_feedhold": installed("share/zsh/site-functions/_feedhold"),
        "usr/share/fish/vendor_completions.d/feedhold.fish": installed("share/fish/vendor_completions.d/feedhold.fish"),
        "usr/share/lintian/overrides/feedhold": OVERRIDES.encode(),
        f"{doc}/copyright": copyright_text(release).encode(),
        f"{doc}/changelog.gz": gzipped(changelog(release).encode()),
        f"{doc}/CHANGELOG.md.gz": gzipped(written["CHANGELOG.md"]),
        f"{doc}/THIRD-PARTY-NOTICES.gz": gzipped(written["THIRD-PARTY-NOTICES"]),
    }


def make(release):
    path = release.out / f"feedhold_{release.version}_amd64.deb"
    data = files(release)
    size = sum(len(each) for each in data.values()) // 1024 + 1
    sums = "".join(f"{hashlib.md5(each).hexdigest()}  {name}\n" for name, each in sorted(data.items()))
    data |= {"DEBIAN/control": control(release, size).encode(), "DEBIAN/md5sums": sums.encode()}
    with tempfile.TemporaryDirectory() as holder:
        folder = Path(holder) / "feedhold"
        for name, each in data.items():
            place = folder / name
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(each)
            place.chmod(0o755 if name.startswith("usr/bin/") else 0o644)
        for place in [folder, *folder.rglob("*")]:
            if place.is_dir():
                place.chmod(0o755)
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Zxz", "--build", folder, path], check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "SOURCE_DATE_EPOCH": str(release.epoch)})
    return path
