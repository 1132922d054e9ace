"""The bill of materials (CycloneDX 1.5): the libraries inside the program, and what it was built with."""
import hashlib
import json
import time

from libraries import LICENCES, inside, told
from release import HOMEPAGE, LICENCE, ROOT


def component(package, version, **more):
    url = f"pkg:deb/debian/{package}@{version.replace(':', '%3A').replace('+', '%2B')}?arch=amd64&distro=debian-12"
    return {"type": "library", "bom-ref": url, "name": package, "version": version, "purl": url, **more}


def tools():
    """The section `build` of .ci/packages.txt."""
    section = (ROOT / ".ci/packages.txt").read_text().split("[build]\n")[1].split("\n\n")[0]
    for line in section.splitlines():
        package = line.split()[0]
        version = told("dpkg-query", "-W", "-f=${Version}", package)
        yield package, version


def document(release):
    linked = [component(package, version, scope="required",
                        licenses=[{"expression": LICENCES[source]}])
              for package, source, version in inside(release.build)]
    names = {each["name"] for each in linked}
    used = [component(package, version, scope="excluded") for package, version in tools() if package not in names]
    subject = {"type": "application", "bom-ref": f"pkg:generic/feedhold@{release.version}", "name": "feedhold",
               "version": release.version, "licenses": [{"license": {"id": LICENCE}}],
               "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(release.program).hexdigest()}],
               "externalReferences": [{"type": "website", "url": HOMEPAGE}]}
    when = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(release.epoch))
    return {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
            "metadata": {"timestamp": when, "component": subject}, "components": linked + used,
            "dependencies": [{"ref": subject["bom-ref"], "dependsOn": [each["bom-ref"] for each in linked]}]}


def make(release):
    path = release.out / f"feedhold-{release.version}.cdx.json"
    path.write_text(json.dumps(document(release), indent=2) + "\n")
    return path
