"""The program for Windows on the files of Windows: drives, long names, letters of every kind, line ends, and what happens
to a file that is rewritten."""
import hashlib
import json
import subprocess
import time
import zipfile

from packaged import BAD, DIST, PROVED, VERSION
from wine import WINE, Windows, main, on_windows

ESCAPE = b"\x1b"
FIX = ("check", "--fix", "--unsafe-fixes", "--quiet")
CLAIM, FORGED = b"the program comes to an end", b"the program COMES to an end"  # as records and reports say it


class Use(Windows):
    def test_use(self):
        environment = self.environment()
        self.use(WINE, self.program, **{name: environment[name] for name in environment if name not in ("PATH", "HOME")})

    def test_words_in_any_letters(self):
        for name in ("Bohrer ä ö ü.nc", "工具交換.nc", "name with 'quotes' & %signs%.nc"):
            with self.subTest(name):
                self.write(name, BAD)
                self.assertIn(name, self.assertSame("check", name, code=1))

    def test_letters_of_programs(self):
        self.write("O1.nc", "O1(工具交換)\n#1-5(ｷﾘ)\nM30\n".encode("cp932"))
        self.assertIn("ｷﾘ", self.assertSame("check", "O1.nc", code=1))

    def test_drive_letters_and_backslashes(self):
        path = self.write("nc/O1001.nc", BAD)
        shown = on_windows(path)
        for given in (shown, shown.replace("/", "\\"), shown.replace("Z:", "z:"), r"nc\O1001.nc", r".\nc"):
            with self.subTest(given):
                told = self.feedhold("check", "--format", "concise", given, code=1).stdout.decode()
                self.assertIn("O1001.nc:3:1: ", told)
                self.assertNotIn("\\", told.split(": ")[0])

    def test_names_that_differ_in_case(self):
        """Here the folders of drive Z: know them as two."""
        self.write("nc/O1001.nc", BAD)
        self.write("nc/o1001.NC", BAD.replace("1001", "1002"))
        self.assertIn("in 2 files", self.assertSame("check", "nc", "nc/o1001.NC", code=1))

    def test_shares(self):
        """Wine looks for servers below unc/ beside its drives."""
        self.write("O1001.nc", BAD)
        server = self.prefix / "dosdevices/unc/server"
        server.mkdir(parents=True)
        (server / "Programme").symlink_to(self.folder)
        for given in (r"\\server\Programme", r"\\server\Programme\O1001.nc", "//server/Programme/O1001.nc"):
            with self.subTest(given):
                told = self.feedhold("check", "--format", "concise", given, code=1).stdout.decode()
                self.assertIn("//server/Programme/O1001.nc:3:1: ", told)
        told = json.loads(self.feedhold("check", "--format", "sarif", r"\\server\Programme", code=1).stdout)
        location = told["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]
        self.assertEqual(location["uri"], "file://server/Programme/O1001.nc")
        self.feedhold(*FIX, r"\\server\Programme\O1001.nc", code=None)
        self.assertNotEqual((self.folder / "O1001.nc").read_bytes(), BAD.encode())

    def test_paths_longer_than_260_characters(self):
        place = "/".join(["Auftrag " + "x" * 60] * 6)
        self.write(f"{place}/O1001.nc", BAD)
        self.write(f"{place}/O9101.nc", PROVED)
        self.write(f"{place}/feedhold.toml", 'dialect = "fanuc-0i"\n')
        self.assertIn("in 2 files", self.assertSame("check", place, code=1))
        self.assertIn("Z:/", self.feedhold("check", "--format", "json", on_windows(self.folder / place), code=1).stdout.decode())
        self.assertSame("prove", f"{place}/O9101.nc")
        self.feedhold("certify", f"{place}/O9101.nc", "-o", f"{place}/evidence")
        self.assertTrue((self.folder / place / "evidence/certificate.json").exists())
        self.assertSame("recheck", f"{place}/evidence")
        self.feedhold(*FIX, f"{place}/O1001.nc", code=None)
        self.assertNotEqual((self.folder / place / "O1001.nc").read_bytes(), BAD.encode())

    def test_one_file_by_two_names(self):
        self.write("O1001.nc", BAD)
        told = json.loads(self.feedhold("check", "--format", "json", "O1001.nc", on_windows(self.folder / "O1001.nc"),
                                        "o1001.NC", code=1).stdout)
        self.assertEqual(len(told["files"]), 1, told["files"])

    def test_no_colours_in_pipes(self):
        self.write("O1001.nc", BAD)
        result = self.feedhold("check", "O1001.nc", code=1)
        self.assertNotIn(ESCAPE, result.stdout + result.stderr)
        self.assertIn(ESCAPE, self.feedhold("check", "--color", "always", "O1001.nc", code=1).stdout)

    def test_wildcards(self):
        """No shell of Windows replaces them."""
        for name in ("nc/O1001.nc", "nc/O1002 ä.nc", "nc/notes.txt"):
            self.write(name, BAD)
        told = json.loads(self.feedhold("check", "--format", "json", r"nc\*.nc", code=1).stdout)
        self.assertEqual([file["path"] for file in told["files"]], ["nc/O1001.nc", "nc/O1002 ä.nc"])

    def test_standard_input(self):
        result = subprocess.run([WINE, self.program, "check", "--format", "json", "-"], input=BAD.encode(),
                                cwd=self.folder, env=self.environment(), capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (1, b""))
        self.assertNotIn(b"\r", result.stdout)


class Rewriting(Windows):
    def test_line_ends_are_kept(self):
        for number, text in enumerate((BAD, BAD.replace("\n", "\r\n"))):
            for program, name in ((self.on_linux, "ours"), (self.feedhold, "theirs")):
                self.write(f"{name}/{number}/O1001.nc", text)
                program(*FIX, f"{name}/{number}", code=None)
            theirs, ours = ((self.folder / name / str(number) / "O1001.nc").read_bytes() for name in ("theirs", "ours"))
            self.assertNotEqual(ours, text.encode())
            self.assertEqual(theirs, ours)

    def test_read_only_files_stay(self):
        path = self.write("O1001.nc", BAD)
        path.chmod(0o444)
        told = self.feedhold(*FIX, "O1001.nc", code=None)
        self.assertIn(b"cannot be written: Permission denied", told.stdout + told.stderr)
        self.assertEqual(path.read_bytes(), BAD.encode())
        self.assertEqual([each.name for each in self.folder.iterdir()], ["O1001.nc"])

    def test_killed_while_it_fixes(self):
        """Whenever it ends, there is the old file or the new one."""
        old = ("%\nO1001(SLIP)\n" + "#510-[0-1.5]\n" * 20000 + "M30\n%\n").encode()
        path = self.write("O1001.nc", old)
        begun = time.monotonic()
        self.feedhold(*FIX, "O1001.nc", code=None)
        whole, new = time.monotonic() - begun, path.read_bytes()
        self.assertNotEqual(new, old)
        seen = set()
        for step in range(25):
            path.write_bytes(old)
            process = self.start(*FIX, "O1001.nc")
            time.sleep(whole * step / 20)
            process.kill()
            process.communicate()
            seen.add(path.read_bytes())
            self.assertLessEqual(seen, {old, new})
        self.assertEqual(seen, {old, new}, "some runs were killed too early, some came to their end")


class Cache(Windows):
    def entries(self):
        return [path for path in self.prefix.glob("drive_c/users/*/AppData/Local/feedhold/cache/**/*") if path.is_file()]

    def test_forged_entries_are_found(self):
        self.write("O9101.nc", PROVED)
        before = set(self.entries())
        first = self.feedhold("prove", "O9101.nc").stdout
        made = [path for path in self.entries() if path not in before]
        self.assertEqual(len(made), 1)
        head, key, digest, record = made[0].read_bytes().split(b"\n", 3)
        self.assertIn(CLAIM, record)
        forged = record.replace(CLAIM, FORGED)
        # A record that fits its sum is believed: entries are read.  Any other is not.
        made[0].write_bytes(b"\n".join([head, key, hashlib.sha256(forged).hexdigest().encode(), forged]))
        self.assertIn(FORGED, self.feedhold("prove", "O9101.nc").stdout)
        made[0].write_bytes(b"\n".join([head, key, digest, forged]))
        self.assertEqual(self.feedhold("prove", "O9101.nc").stdout, first)


class Packages(Windows):
    def test_archive(self):
        with zipfile.ZipFile(self.artifact("*.zip")) as archive:
            names = {name.split("/", 1)[1] for name in archive.namelist()}
            self.assertEqual(names, {"feedhold.exe", "LICENSE.txt", "README.txt", "CHANGELOG.txt",
                                     "THIRD-PARTY-NOTICES.txt"})
            notices = archive.read(f"feedhold-{VERSION}-windows-x86_64/THIRD-PARTY-NOTICES.txt").decode()
        for library in ("gmp", "gcc-mingw-w64", "mingw-w64", "fmtlib", "cli11", "tomlplusplus", "nlohmann-json3"):
            self.assertRegex(notices, rf"(?m)^{library} \S+: ")

    def test_no_library_beside_it(self):
        """All that it imports is part of Windows."""
        told = self.run_clean("x86_64-w64-mingw32-objdump", "-p", self.program).stdout
        imported = {line.split()[-1].lower() for line in told.splitlines() if "DLL Name:" in line}
        self.assertLessEqual(imported, {"kernel32.dll", "msvcrt.dll", "shell32.dll", "advapi32.dll"})
        self.assertIn("kernel32.dll", imported)

    def test_wheel(self):
        self.run_clean("python3", "-m", "venv", self.folder / "venv")
        self.run_clean(self.folder / "venv/bin/pip", "download", "--no-index", "--find-links", DIST, "--only-binary", ":all:",
                       "--platform", "win_amd64", "feedhold")
        wheel, = self.folder.glob("*.whl")
        self.assertEqual(wheel.name, f"feedhold-{VERSION}-py3-none-win_amd64.whl")
        self.run_clean(self.folder / "venv/bin/pip", "install", "--no-index", "--no-deps", "--only-binary", ":all:",
                       "--platform", "win_amd64", "--target", self.folder / "installed", wheel)
        self.assertEqual((self.folder / "installed/bin/feedhold.exe").read_bytes(), self.program.read_bytes())

    def test_npm(self):
        (self.folder / "package.json").write_text('{"name": "shop", "private": true}\n')
        package = self.artifact("feedhold-win32-x64-*.tgz")
        refused = self.run_clean("npm", "install", "--offline", "--no-audit", "--no-fund", package, code=None)
        self.assertIn("EBADPLATFORM", refused.stderr)
        self.run_clean("npm", "install", "--offline", "--no-audit", "--no-fund", "--force", package)
        installed = self.folder / "node_modules/@feedhold/win32-x64"
        self.assertEqual((installed / "bin/feedhold.exe").read_bytes(), self.program.read_bytes())
        about = json.loads((installed / "package.json").read_text())
        self.assertEqual((about["os"], about["cpu"], about["version"]), (["win32"], ["x64"], VERSION))


if __name__ == "__main__":
    main()
