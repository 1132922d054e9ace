"""The extension for VS Code with the program inside, for each platform and for all others."""
import json
import re
import zipfile
from xml.etree import ElementTree

from packaged import ROOT, VERSION, Packaged, main

PROGRAMS = {"linux-x64": ("feedhold", "*-linux-x86_64.tar.gz", "bin/feedhold"),
            "win32-x64": ("feedhold.exe", "*-windows-x86_64.zip", "feedhold.exe")}
MANIFEST = "{http://schemas.microsoft.com/developer/vsx-schema/2011}"
TRY = """
const { chosen, pathBefore, programInside, scriptInside } = require("./program.js");
const [folder, platform] = process.argv.slice(2);
const inside = programInside(folder, platform);
console.log(JSON.stringify([inside, chosen("feedhold", inside), chosen("/opt/feedhold", inside), chosen("feedhold", undefined),
                            pathBefore("/x/bin/feedhold", { Path: "/usr/bin" }), pathBefore("/x/bin/feedhold", {}),
                            scriptInside(folder) ?? null]));
"""


class Extension(Packaged):
    def extension(self, target):
        """Unpacked as VS Code does it: with the permissions of the archive."""
        place = self.folder / target
        self.run_clean("unzip", "-q", self.artifact(f"feedhold-{target}-{VERSION}.vsix"), "-d", place)
        return place

    def test_platform_and_program(self):
        for target, (name, archive, place) in PROGRAMS.items():
            with self.subTest(target):
                extension = self.extension(target)
                identity = ElementTree.parse(extension / "extension.vsixmanifest").find(f"{MANIFEST}Metadata/{MANIFEST}Identity")
                self.assertEqual((identity.get("TargetPlatform"), identity.get("Version")), (target, VERSION))
                self.assertEqual((extension / "extension/bin" / name).read_bytes(), self.packed(archive, place))
                self.assertTrue((extension / "extension/bin/THIRD-PARTY-NOTICES.txt").is_file())

    def universal(self):
        """That of all other platforms."""
        place = self.folder / "universal"
        self.run_clean("unzip", "-q", self.artifact(f"feedhold-{VERSION}.vsix"), "-d", place)
        return place / "extension"

    def test_all_other_platforms(self):
        extension = self.universal()
        identity = ElementTree.parse(extension.parent / "extension.vsixmanifest").find(f"{MANIFEST}Metadata/{MANIFEST}Identity")
        self.assertEqual((identity.get("TargetPlatform"), identity.get("Version")), (None, VERSION))
        self.assertEqual({path.name for path in (extension / "bin").iterdir()},
                         {"feedhold.js", "feedhold.wasm", "THIRD-PARTY-NOTICES.txt"})
        self.assertIn("emscripten", (extension / "bin/THIRD-PARTY-NOTICES.txt").read_text())
        needed = set(re.findall(r'require\("([^")]+)"\)', (extension / "bin/feedhold.js").read_text()))
        self.assertLessEqual({name.removeprefix("node:") for name in needed},
                             {"child_process", "crypto", "fs", "path", "worker_threads"})

    def packed(self, archive, place):
        path = self.artifact(archive)
        folder = self.folder / path.name.removesuffix(".gz").removesuffix(".tar").removesuffix(".zip")
        if path.suffix == ".zip":
            with zipfile.ZipFile(path) as held:
                held.extractall(self.folder)
        else:
            self.run_clean("tar", "-xzf", path)
        return (folder / place).read_bytes()

    def test_program_can_be_started(self):
        self.use(self.extension("linux-x64") / "extension/bin/feedhold")

    def test_extension_looks_for_it_inside(self):
        """The settings come first."""
        modules = ROOT / "editors/vscode/node_modules"
        self.run_clean(modules / ".bin/esbuild", ROOT / "editors/vscode/src/program.ts", "--format=cjs", "--platform=node",
                       f"--outfile={self.folder}/program.js")
        (self.folder / "try.js").write_text(TRY)
        for target, (name, _, _) in PROGRAMS.items():
            with self.subTest(target):
                folder = self.extension(target) / "extension"
                told = self.run_clean("node", "try.js", folder, target.split("-")[0]).stdout
                inside = str(folder / "bin" / name)
                self.assertEqual(json.loads(told), [
                    inside, inside, "/opt/feedhold", "feedhold", {"Path": "/x/bin:/usr/bin"}, {"PATH": "/x/bin"}, None])
        with self.subTest("all others"):
            folder = self.universal()
            told = json.loads(self.run_clean("node", "try.js", folder, "darwin").stdout)
            self.assertEqual((told[0], told[1], told[-1]), (None, "feedhold", str(folder / "bin/feedhold.js")))


if __name__ == "__main__":
    main()
