"""`feedhold plot`: pictures are XML without script, the same each time, and show where the tool gouges."""
import re
import unittest
import xml.etree.ElementTree as ElementTree

from harness import Scratch

SVG = "{http://www.w3.org/2000/svg}"
SLOT = """O1(A SLOT <1 & 2>)
(@PARAM #1 LENGTH 10..100 MM)
(@PARAM #18 RADIUS 1..10 MM)
(@MODAL G17 G21 G90)
(@START X0 Y0 Z5.)
(@TOOL FLAT RADIUS #18)
(@KEEPIN CAVITY BOX X-#1..#1 Y-10..10 Z-5..5)
(@KEEPOUT CLAMP CYLINDER AT X60 Y40 RADIUS 8 Z-20..20)
(@CLEARANCE Z2.)
G00 Z2.
N20 G01 Z-5. F100. (DOWN <HERE>)
N30 X-[#1-#18]
N40 X[#1-#18+#2]
N50 G00 Z5.
M99
"""
ARCS = """O2
G17 G90 G00 X10. Y0. Z0.
G03 I-10. F100.
G02 X-10. Y0. Z-4. I-10. J0.
G18 G03 X10. Z-4. I10. K0.
M30
"""
COMPENSATED = """O4
G21 G17 G90 G40 G00 X0 Y-20.
G01 G41 D1 Y0 F200.
Y40.
X40.
X0 Y10.
G40 X-40.
M30
"""


class Plot(Scratch):
    def plot(self, *arguments):
        return self.feedhold("plot", "--dialect", "fanuc-30i", "--isolated", *arguments)

    def picture(self, *arguments, code=0):
        """The root of the picture that comes out."""
        result = self.plot(*arguments)
        self.assertExit(result, code)
        return ElementTree.fromstring(result.stdout)

    def slot(self, *arguments, text=SLOT, code=0):
        self.write("O1.nc", text)
        return self.picture("O1.nc", "--arg", "A=50", "--arg", "R=6", *arguments, code=code)

    def texts(self, picture):
        return [element.text for element in picture.iter(f"{SVG}text")]

    def titles(self, picture):
        return [element.text for element in picture.iter(f"{SVG}title")]

    def paths(self, view, style="path"):
        return [path.get("d") for path in view.iter(f"{SVG}path") if path.get("class") == style]

    def views(self, picture):
        return picture.findall(f"{SVG}svg")

    # ---- the picture ----

    def test_what_is_drawn(self):
        picture = self.slot()
        self.assertEqual(len(self.views(picture)), 2)
        self.assertIn("O1 with A=50 R=6", self.texts(picture))
        for text in ("X (mm)", "Y (mm)", "Z (mm)", "keep in CAVITY", "keep out of CLAMP", "clearance Z2", "cutting"):
            self.assertIn(text, self.texts(picture))
        for title in ("O1 line 11: N20 G01 Z-5. F100. (DOWN <HERE>)", "start", "end", "CAVITY", "CLAMP"):
            self.assertIn(title, self.titles(picture))

    def test_nothing_from_outside(self):
        text = self.plot(self.write("O2.nc", ARCS)).stdout
        self.assertNotIn("script", text)
        self.assertEqual(re.findall(r"(?:href|src|url|@import)", text), [])
        self.assertEqual(re.findall(r"https?://[^\"]*", text), ["http://www.w3.org/2000/svg"])
        self.assertIn("prefers-color-scheme: dark", text)

    def test_same_bytes(self):
        self.write("O1.nc", SLOT)
        arguments = ("O1.nc", "--arg", "A=50", "--arg", "R=6")
        self.assertEqual(self.plot(*arguments).stdout, self.plot(*arguments).stdout)
        self.assertExit(self.plot(*arguments, "-o", "out.svg"), 0)
        self.assertEqual((self.folder / "out.svg").read_text(), self.plot(*arguments).stdout)

    def test_arcs(self):
        plan, side = self.views(self.picture(self.write("O2.nc", ARCS)))
        circle, half, upright = self.paths(plan)
        self.assertEqual(circle.count("A"), 3)  # one arc back to its start would be nothing
        self.assertEqual(half.count("A"), 2)
        self.assertNotIn("A", upright)
        self.assertEqual([path.count("A") for path in self.paths(side)], [0, 0, 2])
        # Counterclockwise goes up from the right end: above is a smaller number.
        start = [float(number) for number in re.findall(r"[-0-9.]+", circle.split("A")[0])]
        first = [float(number) for number in re.findall(r"[-0-9.]+", circle.split("A")[1])]
        self.assertLess(first[-1], start[1])
        self.assertEqual(first[4], 0)

    def test_inches(self):
        picture = self.picture(self.write("O3.nc", "O3\nG20 G90 G01 X1. Y2. F10.\nM30\n"))
        self.assertIn("X (in)", self.texts(picture))

    def test_no_movement(self):
        self.assertEqual(len(self.views(self.picture(self.write("O3.nc", "O3\n#1=1\nM30\n")))), 2)

    def test_cutter_compensation(self):
        self.write("O4.nc", COMPENSATED)
        picture = self.picture("O4.nc", "--offset", "D1=5")
        plan, _ = self.views(picture)
        programmed, centre = self.paths(plan, "path contour"), self.paths(plan)
        self.assertEqual(len(programmed), 5)
        self.assertEqual([path.count("L") for path in centre], [1, 1, 2, 1, 1])  # two about the sharp corner
        self.assertFalse(set(programmed) & set(centre))
        self.assertIn("programmed, with cutter compensation", self.texts(picture))
        other = self.picture("O4.nc")  # without an offset
        self.assertEqual(len(self.paths(self.views(other)[0], "path other")), 5)

    # ---- gouges ----

    def test_gouge_of_the_compensated_tool(self):
        clauses = "(@TOOL FLAT RADIUS 5.)\n(@KEEPOUT CLAMP BOX X10..20 Y48..60)\n"
        self.write("O4.nc", COMPENSATED.replace("O4\n", "O4\n" + clauses))
        for arguments in ((), ("--offset", "D1=5")):  # the tool's own radius is taken for an offset that nothing gives
            result = self.plot("O4.nc", *arguments)
            self.assertExit(result, 1)
            self.assertEqual(result.stderr, "2 mm inside CLAMP at line 7\n")
        self.assertExit(self.plot("O4.nc", "--offset", "D1=2.5"), 0)

    def test_gouge(self):
        self.write("O1.nc", SLOT)
        result = self.plot("O1.nc", "--arg", "A=50", "--arg", "R=6", "--arg", "B=0.25")
        self.assertExit(result, 1)
        said = "0.25 mm outside CAVITY at N40"
        self.assertEqual(result.stderr, said + "\n")
        picture = ElementTree.fromstring(result.stdout)
        self.assertIn(said, self.texts(picture))
        self.assertEqual(self.titles(picture).count(said), 4)  # in both views, and near by in both
        self.assertIn("tool at the gouge", self.texts(picture))

    def test_gouges_of_all_kinds(self):
        text = SLOT.replace("N50 G00 Z5.", "N50 G00 X60. Y40.\nN60 Z900.").replace(
            "(@CLEARANCE", "(@TRAVEL Z-400..400)\n(@CLEARANCE")
        self.write("O1.nc", text)
        result = self.plot("O1.nc", "--arg", "A=50", "--arg", "R=6")
        self.assertExit(result, 1)
        self.assertEqual(sorted(result.stderr.splitlines()),
                         ["14 mm inside CLAMP at N50", "500 mm outside the travel limits at N60",
                          "7 mm below the clearance height in a rapid move at N50"])
        self.assertLessEqual(set(result.stderr.splitlines()), set(self.texts(ElementTree.fromstring(result.stdout))))

    def test_gouge_of_rounding(self):
        self.write("O1.nc", SLOT)
        result = self.plot("O1.nc", "--arg", "A=50.0004", "--arg", "R=6.0008")
        self.assertExit(result, 0)
        self.assertEqual(result.stderr, "0.0004 mm outside CAVITY at N30, only because words are rounded to the least "
                                        "increment\n")

    def test_starts_as_the_contract_says(self):
        plan, side = self.views(self.slot())
        self.assertEqual(len(self.paths(side, "path rapid")), 2)
        self.slot("--start", "Z-30", code=0)
        self.slot("--start", "Y8", code=1)
        self.slot(text=SLOT.replace("G17 G21 G90", "G17 G21 G91"), code=1)

    def test_without_what_the_contract_asks_for(self):
        self.write("O1.nc", SLOT)
        picture = self.picture("O1.nc", "--arg", "A=50")
        self.assertIn("regions of the contract are not drawn: they need #18", self.texts(picture))
        self.assertNotIn("keep in CAVITY", self.texts(picture))

    def test_region_without_a_shape(self):
        picture = self.slot(text=SLOT.replace("BOX X-#1..#1 Y-10..10 Z-5..5", "WHERE [ABS[Y] LE 10] AND [Z GE -5]"))
        self.assertIn("CAVITY is a WHERE region, which is not drawn", self.texts(picture))

    # ---- runs that do not end well ----

    def test_alarm(self):
        picture = self.picture(self.write("O3.nc", "O3\nG01 X10. F100.\nN7 #3000=5(STOP)\nM30\n"), code=1)
        self.assertIn("O3: the run does not finish (alarm); it stops at N7", self.texts(picture))

    def test_what_is_refused(self):
        self.write("O2.nc", ARCS)
        for words in (["gone.nc"], ["O2.nc", "--arg", "A"], ["O2.nc", "--compare", "gone.nc"],
                      ["O2.nc", "-o", "no/such/folder.svg"]):
            with self.subTest(words=words):
                self.assertExit(self.plot(*words), 2)

    # ---- two runs ----

    def test_compare_arguments(self):
        picture = self.slot("--compare-arg", "A=40")
        for text in ("O1, two runs", "O1 with A=50 R=6", "O1 with A=40 R=6"):
            self.assertIn(text, self.texts(picture))
        side = self.views(picture)[1]
        self.assertEqual(len(self.paths(side, "path both")), 3)
        self.assertEqual(len(self.paths(side, "path second")), 3)
        self.assertNotEqual(self.paths(side, "path both"), self.paths(side, "path second"))

    def test_compare_files(self):
        self.write("O2.nc", ARCS)
        picture = self.slot("--compare", "O2.nc")
        for text in ("O1 and O2", "O1 with A=50 R=6", "O2 with A=50 R=6"):
            self.assertIn(text, self.texts(picture))


if __name__ == "__main__":
    unittest.main()
