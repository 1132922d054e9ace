"""The bill of materials (CycloneDX 1.5): the programs, the libraries inside each, and what they were built with."""
import hashlib
import json
import time

from libraries import LICENCES, inside, installed
from release import HOMEPAGE, LICENCE, ROOT

TOOLS = ["build", "packages"]  # sections of .ci/packages.txt


def component(library, **more):
    return {"type": "library", "bom-ref": library.url, "name": library.package, "version": library.version,
            "purl": library.url, **more}


def tools():
    sections = (ROOT / ".ci/packages.txt").read_text().split("\n[")
    for section in sections:
        name, _, packages = section.partition("]\n")
        if name in TOOLS:
            yield from (installed(line.split()[0]) for line in packages.splitlines() if line and not line.startswith("#"))


def program(release, built):
    return {"type": "application", "bom-ref": f"pkg:generic/feedhold@{release.version}?platform={built.platform.name}",
            "name": built.platform.program, "version": release.version, "licenses": [{"license": {"id": LICENCE}}],
            "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(built.program).hexdigest()}]}


def document(release):
    linked = {built: inside(built) for built in (*release.built.values(), release.wasm)}
    libraries = sorted({each.url: each for found in linked.values() for each in found}.values())
    packages = {each.package for each in libraries}
    used = sorted({each for each in tools() if each.package not in packages})
    programs = {built: program(release, built) for built in linked}
    subject = {"type": "application", "bom-ref": f"pkg:generic/feedhold@{release.version}", "name": "feedhold",
               "version": release.version, "licenses": [{"license": {"id": LICENCE}}],
               "externalReferences": [{"type": "website", "url": HOMEPAGE}], "components": list(programs.values())}
    when = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(release.epoch))
    return {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
            "metadata": {"timestamp": when, "component": subject},
            "components": [component(each, scope="required", licenses=[{"expression": LICENCES[each.source]}])
                           for each in libraries] + [component(each, scope="excluded") for each in used],
            "dependencies": [{"ref": programs[built]["bom-ref"], "dependsOn": [each.url for each in found]}
                             for built, found in linked.items()]}


def make(release):
    path = release.out / f"feedhold-{release.version}.cdx.json"
    path.write_text(json.dumps(document(release), indent=2) + "\n")
    return path
