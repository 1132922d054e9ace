"""`./dev vscode` makes an archive that VS Code can install: whole, without what nobody needs, and always the same."""
import json
import re
import shutil
import subprocess
import sys
import unittest
import zipfile

from harness import EXTENSION, ORACLES, ROOT, SKIPPED


def packaged():
    """The name and the bytes of the archive."""
    told = subprocess.run(["npm", "run", "package"], cwd=EXTENSION, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    text = told.stdout.decode()
    if told.returncode != 0:
        raise AssertionError(text)
    path = ROOT / "build" / re.search(r"/(feedhold-[0-9.]+\.vsix)", text)[1]
    return path, path.read_bytes()


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.path, cls.content = packaged()
        cls.archive = zipfile.ZipFile(cls.path)
        cls.addClassCleanup(cls.archive.close)
        cls.manifest = json.loads(cls.archive.read("extension/package.json"))

    def test_files(self):
        self.assertIsNone(self.archive.testzip())
        self.assertEqual(sorted(self.archive.namelist()), [
            "[Content_Types].xml", "extension.vsixmanifest", "extension/LICENSE.txt", "extension/THIRD-PARTY.txt",
            "extension/contract-configuration.json", "extension/dist/extension.js",
            "extension/language-configuration.json", "extension/package.json", "extension/readme.md",
            "extension/syntaxes/contract.tmLanguage.json", "extension/syntaxes/macrob.tmLanguage.json"])

    def test_what_the_manifest_names_is_there(self):
        contributes = self.manifest["contributes"]
        named = [self.manifest["main"], *(grammar["path"] for grammar in contributes["grammars"]),
                 *(language["configuration"] for language in contributes["languages"])]
        for path in named:
            self.assertGreater(len(self.archive.read(f"extension/{path.removeprefix('./')}")), 100)

    def test_the_version_is_that_of_the_program(self):
        version = re.search(r"^project\(feedhold VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
        self.assertEqual(self.manifest["version"], version)

    def test_licences_of_all_that_is_bundled(self):
        notices = self.archive.read("extension/THIRD-PARTY.txt").decode()
        for name in ("vscode-languageclient", "vscode-jsonrpc", "semver", "minimatch"):
            self.assertRegex(notices, rf"(?m)^{name} [0-9.]+ \((MIT|ISC)\)$")

    def test_the_bundle_needs_nothing_but_the_editor(self):
        bundle = self.archive.read("extension/dist/extension.js").decode()
        needed = set(re.findall(r'require\("([^")]+)"\)', bundle))
        self.assertIn("vscode", needed)
        self.assertLessEqual({name.removeprefix("node:") for name in needed},
                             {"vscode", "child_process", "crypto", "fs", "net", "os", "path", "url", "util"})

    def test_same_tree_same_bytes(self):
        shutil.rmtree(EXTENSION / "dist")
        _, again = packaged()
        self.assertEqual(again, self.content)


if __name__ == "__main__":
    if not ORACLES:
        print("skipped: needs the packages of editors/vscode; run `./dev test --oracles`")
        sys.exit(SKIPPED)
    unittest.main()
