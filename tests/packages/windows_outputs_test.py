"""What the program for Windows says, compared with the one for Linux byte for byte; certificates go both ways."""
import json
import re
import shutil
import sys

from packaged import PROVED, ROOT
from wine import WINE, Windows, main, on_windows

sys.path.insert(0, str(ROOT / "tests/lsp"))
import golden_test  # noqa: E402

FENCE = re.compile(r"^```nc \S+(?: (?!escaped)(\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"\bO(\d+)", re.IGNORECASE)
PACKAGES = ROOT / "corpus/packages"
SLOT = """O1(A SLOT <1 & 2>)
(@PARAM #1 LENGTH 10..100 MM)
(@PARAM #18 RADIUS 1..10 MM)
(@MODAL G17 G21 G90)
(@START X0 Y0 Z5.)
(@TOOL FLAT RADIUS #18)
(@KEEPIN CAVITY BOX X-#1..#1 Y-10..10 Z-5..5)
(@CLEARANCE Z2.)
G00 Z2.
N20 G01 Z-5. F100.
#2=SIN[#1]+COS[#18]*ATAN[#1]/[#18]
N30 X-[#1-#18]
N40 G03 X[#1-#18] I[#1-#18] J#2
N50 G00 Z5.
M99
"""


class Outputs(Windows):
    def golden_programs(self, folder):
        """The programs of golden pages, a folder for each page."""
        count = 0
        for page in sorted((ROOT / folder).rglob("*.md")):
            for number, (name, text) in enumerate(FENCE.findall(page.read_text())):
                program = NUMBER.search(text)
                file = name or (f"O{program[1]}.nc" if program else "part.nc")
                self.write(f"{page.parent.name}/{page.stem}/{number}/{file}", text)
                count += 1
        return count

    # ---- check ----

    def test_check(self):
        self.assertGreater(self.golden_programs("rules"), 500)
        for form in ("text", "concise", "json", "sarif", "junit", "github"):
            with self.subTest(form):
                said = self.assertSame("check", "--format", form, ".", code=1)
                self.assertGreater(len(said), 10000)

    def test_uris_name_the_drive(self):
        self.write("a b/O1000.nc", "%\nO1000\n#1-1\nM30\n%\n")
        told = json.loads(self.feedhold("check", "--format", "sarif", ".", code=1).stdout)
        self.assertEqual(told["runs"][0]["originalUriBaseIds"]["%SRCROOT%"]["uri"],
                         f"file:///{on_windows(self.folder)}/")
        other = self.prefix / "drive_c/shop"
        other.mkdir()
        shutil.copy(self.folder / "a b/O1000.nc", other)
        told = json.loads(self.feedhold("check", "--format", "sarif", r"c:\shop", code=1).stdout)
        result = told["runs"][0]["results"][0]
        self.assertEqual(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
                         "file:///c:/shop/O1000.nc")

    # ---- runs ----

    def test_run_and_plot(self):
        self.write("O1.nc", SLOT)
        slot = ("--dialect", "fanuc-30i", "O1.nc", "--arg", "A=50.3", "--arg", "R=6.1")
        self.assertIn("ends with M99", self.assertSame("run", *slot))
        self.assertIn("feed", self.assertSame("run", "--trace", "--format", "json", *slot))
        self.assertIn("<svg", self.assertSame("plot", *slot, code=1))
        self.assertIn("#2", self.assertSame("ranges", *slot[:3]))

    def test_packages_run(self):
        shutil.copytree(PACKAGES / "slope", self.folder / "slope")
        for name in ("slope/O9411.nc", "slope/O9415.nc"):
            with self.subTest(name):
                self.assertSame("run", "--format", "json", name, code=None)
                self.assertIn("#", self.assertSame("ranges", name, code=None))

    # ---- proofs ----

    def test_prove(self):
        self.write("O9115.nc", (PACKAGES / "mould-entry/O9115.nc").read_bytes())
        for form in ("json", "text", "sarif"):  # each proves once and then remembers
            with self.subTest(form):
                said = self.assertSame("prove", "--format", form, ".", code=None)
                self.assertGreater(len(said), 1000)

    def bundle(self, program, name):
        self.write("nc/O9101.nc", PROVED)
        program("prove", "--no-cache", "nc", "--certificate", name)
        return {path.relative_to(self.folder / name).as_posix(): path.read_bytes()
                for path in (self.folder / name).rglob("*") if path.is_file()}

    def test_certificates(self):
        ours, theirs = self.bundle(self.on_linux, "ours"), self.bundle(self.feedhold, "theirs")
        self.assertGreater(len(ours), 2)
        self.assertEqual(theirs, ours)

    def test_each_rechecks_what_the_other_has_proved(self):
        self.bundle(self.on_linux, "ours")
        self.bundle(self.feedhold, "theirs")
        for recheck, name in ((self.on_linux, "theirs"), (self.feedhold, "ours")):
            told = recheck("recheck", name).stdout.decode()
            self.assertIn("verified", told)
        self.write("nc/O9101.nc", PROVED.replace("5/#1", "6/#1"))
        for recheck, name in ((self.on_linux, "theirs"), (self.feedhold, "ours")):
            recheck("recheck", name, code=1)

    def test_certify(self):
        self.write("nc/O1.nc", SLOT)
        self.write("nc/O9101.nc", PROVED)
        for program, name in ((self.on_linux, "ours"), (self.feedhold, "theirs")):
            program("certify", "nc", "-o", name, code=None)
        files = sorted(path.name for path in (self.folder / "ours").iterdir())
        self.assertIn("index.html", files)
        self.assertEqual(sorted(path.name for path in (self.folder / "theirs").iterdir()), files)
        for name in files:
            path = self.folder / "theirs" / name
            if path.is_file():
                self.assertEqual(path.read_bytes(), (self.folder / "ours" / name).read_bytes(), name)

    def test_self_check(self):
        said = self.assertSame("self-check")
        self.assertIn("the self-check passed", said)
        self.assertRegex(said, r"(?m)^skipped +z3")


class Server(Windows, golden_test.Recorded):
    """The recorded sessions of the language server: the same expectations."""

    def client(self, **options):
        client = golden_test.Client(self.folder, program=(WINE, self.program), environment=self.environment(), **options)
        self.addCleanup(client.end)
        return client

    def place(self):
        return on_windows(self.folder), "file:///" + on_windows(self.folder)


if __name__ == "__main__":
    main()
