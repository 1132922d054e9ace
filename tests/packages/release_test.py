"""What is said of all packages together: checksums, the bill of materials, one version, and the same bytes twice."""
import hashlib
import json
import subprocess

from packaged import DIST, ROOT, VERSION, Packaged, main


class Release(Packaged):
    def test_checksums(self):
        self.run_clean("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=DIST)
        listed = {line.split()[1] for line in (DIST / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(listed | {"SHA256SUMS"}, {path.name for path in DIST.iterdir()})

    def test_one_version(self):
        for path in DIST.iterdir():
            if path.name != "SHA256SUMS":
                self.assertIn(VERSION, path.name)

    def test_same_bytes_twice(self):
        again = self.folder / "again"
        subprocess.run(["python3", ROOT / "packaging/package.py", ROOT / "build/package", again], check=True,
                       stdout=subprocess.DEVNULL, timeout=300)
        self.assertEqual((again / "SHA256SUMS").read_text(), (DIST / "SHA256SUMS").read_text())

    def test_bill_of_materials(self):
        bill = json.loads(self.artifact("*.cdx.json").read_text())
        self.assertEqual((bill["bomFormat"], bill["specVersion"]), ("CycloneDX", "1.5"))
        self.run_clean("tar", "-xzf", self.artifact("*.tar.gz"))
        program = next(self.folder.glob("*/bin/feedhold")).read_bytes()
        subject = bill["metadata"]["component"]
        self.assertEqual(subject["hashes"][0]["content"], hashlib.sha256(program).hexdigest())
        inside = {each["name"] for each in bill["components"] if each["scope"] == "required"}
        self.assertLessEqual({"libgmp-dev", "libc6-dev", "libfmt-dev", "libcli11-dev", "libtomlplusplus-dev",
                              "nlohmann-json3-dev"}, inside)
        self.assertFalse([name for name in inside if "z3" in name], "no solver is inside")
        references = [each["bom-ref"] for each in bill["components"]]
        self.assertEqual(len(references), len(set(references)))
        self.assertTrue(all(each["licenses"] for each in bill["components"] if each["scope"] == "required"))


if __name__ == "__main__":
    main()
