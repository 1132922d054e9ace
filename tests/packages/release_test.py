"""What is said of all packages together: checksums, the bill of materials, one version, and the same bytes twice."""
import hashlib
import json
import os
import re
import subprocess
import zipfile

from packaged import DIST, ROOT, VERSION, Packaged, main


def members(path):
    with zipfile.ZipFile(path) as archive:
        return [(name, archive.read(name).decode(errors="replace")) for name in archive.namelist()]


def packages():
    """The folder of the page stands beside them."""
    return [path for path in DIST.iterdir() if path.is_file()]


class Release(Packaged):
    def test_checksums(self):
        self.run_clean("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=DIST)
        listed = {line.split()[1] for line in (DIST / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(listed | {"SHA256SUMS"}, {path.name for path in packages()})

    def test_one_version(self):
        for path in packages():
            if path.name != "SHA256SUMS":
                self.assertIn(VERSION, path.name)

    def test_same_bytes_twice(self):
        again = self.folder / "again"
        subprocess.run(["python3", ROOT / "packaging/package.py", ROOT / "build", again], check=True,
                       stdout=subprocess.DEVNULL, timeout=500)
        self.assertEqual((again / "SHA256SUMS").read_text(), (DIST / "SHA256SUMS").read_text())

    def test_a_release_says_whose_it_is(self):
        """Packages to try name nobody; those that are published name a place and a person, or are not made."""
        def make(**variables):
            named = {name: value for name, value in os.environ.items() if not name.startswith("FEEDHOLD_")}
            return subprocess.run(["python3", ROOT / "packaging/package.py", "--release", ROOT / "build", self.folder / "out"],
                                  env=named | variables, capture_output=True, text=True, timeout=500)
        place, person = "https://shop.test/feedhold", "Jo Doe <jo@shop.test>"
        for given, missing in (({}, ["FEEDHOLD_HOMEPAGE", "FEEDHOLD_MAINTAINER"]),
                               ({"FEEDHOLD_HOMEPAGE": place}, ["FEEDHOLD_MAINTAINER"]),
                               ({"FEEDHOLD_HOMEPAGE": "https://example.com/x", "FEEDHOLD_MAINTAINER": person},
                                ["FEEDHOLD_HOMEPAGE"]),
                               ({"FEEDHOLD_HOMEPAGE": place, "FEEDHOLD_MAINTAINER": "Jo Doe"}, ["FEEDHOLD_MAINTAINER"])):
            result = make(**given)
            self.assertEqual((result.returncode, re.findall(r"(?m)^  (\w+): ", result.stderr)), (2, missing))
            self.assertFalse((self.folder / "out").exists())
        result = make(FEEDHOLD_HOMEPAGE=place, FEEDHOLD_MAINTAINER=person)
        self.assertEqual(result.returncode, 0, result.stderr)
        out = self.folder / "out"
        told = self.run_clean("dpkg-deb", "--field", next(out.glob("*.deb")), "Homepage", "Maintainer").stdout
        self.assertEqual(told, f"Homepage: {place}\nMaintainer: {person}\n")
        for path in out.iterdir():
            if path.suffix == ".whl":
                texts = [data for name, data in members(path) if name.endswith("METADATA")]
            elif path.suffix == ".tgz":
                texts = [self.run_clean("tar", "-xzOf", path, "package/package.json").stdout]
            elif path.suffix == ".json":
                texts = [path.read_text()]
            else:
                continue
            self.assertIn(place, texts[0], path.name)

    def inside(self, bill, program):
        """The names of the libraries in it, each of which is described."""
        subject = next(each for each in bill["metadata"]["component"]["components"] if each["name"] == program)
        needed = next(each["dependsOn"] for each in bill["dependencies"] if each["ref"] == subject["bom-ref"])
        names = {each["bom-ref"]: each["name"] for each in bill["components"] if each["scope"] == "required"}
        return {names[reference] for reference in needed}

    def test_bill_of_materials(self):
        bill = json.loads(self.artifact("*.cdx.json").read_text())
        self.assertEqual((bill["bomFormat"], bill["specVersion"]), ("CycloneDX", "1.5"))
        self.run_clean("tar", "-xzf", self.artifact("*.tar.gz"))
        with zipfile.ZipFile(self.artifact("*.zip")) as archive:
            archive.extractall(self.folder)
        programs = {each["name"]: each for each in bill["metadata"]["component"]["components"]}
        self.assertEqual(set(programs), {"feedhold", "feedhold.exe", "feedhold-node.wasm"})
        self.run_clean("unzip", "-q", self.artifact(f"feedhold-{VERSION}.vsix"), "extension/bin/feedhold.wasm")
        (self.folder / "extension/bin/feedhold.wasm").rename(self.folder / "feedhold-node.wasm")
        for path in (*self.folder.glob("*/bin/feedhold"), *self.folder.glob("*/feedhold.exe"),
                     self.folder / "feedhold-node.wasm"):
            self.assertEqual(programs.pop(path.name)["hashes"][0]["content"], hashlib.sha256(path.read_bytes()).hexdigest())
        self.assertFalse(programs)
        headers = {"libfmt-dev", "libcli11-dev", "libtomlplusplus-dev", "nlohmann-json3-dev"}
        self.assertLessEqual(headers | {"libgmp-dev", "libc6-dev"}, self.inside(bill, "feedhold"))
        windows = self.inside(bill, "feedhold.exe")
        self.assertLessEqual(headers | {"gmp", "g++-mingw-w64-x86-64-posix", "mingw-w64-x86-64-dev"}, windows)
        self.assertFalse({"libgmp-dev", "libc6-dev"} & windows, "what is for Linux alone")
        self.assertLessEqual(headers | {"gmp", "emscripten"}, self.inside(bill, "feedhold-node.wasm"))
        self.assertFalse([name for name in windows if "z3" in name], "no solver is inside")
        references = [each["bom-ref"] for each in bill["components"]]
        self.assertEqual(len(references), len(set(references)))
        self.assertTrue(all(each["licenses"] for each in bill["components"] if each["scope"] == "required"))


if __name__ == "__main__":
    main()
