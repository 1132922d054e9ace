"""What a report of `certify` makes plain: who calls whom, which alarms are meant, which files it was made of."""
import html.parser
import itertools
import json
import re
import unittest
import xml.etree.ElementTree as ElementTree

from harness import Scratch

MAIN = "O1(MAIN)\nN10G65P2A1.\nN20G65P3A2.\nN30G65P2A3.\nM30\n"
RING = {"O1": MAIN, "O2": "O2(GOES <ON>)\nIF[#1EQ0]GOTO90\nG65P3A#1\nN90M99\n",
        "O3": "O3\nIF[#1EQ0]GOTO90\nG65P2A0\nG65P9999\nN90M99\n", "O4": "O4\nM99\n",
        "O5": "O5\nIF[#1EQ1]GOTO9\nG65P5A1\nN9M99\n"}
CHECKED = """O7(CHECKS ITS ARGUMENT)
(@PARAM #1 SIDE 0..50 MM)
{clauses}IF[#1LT2]GOTO90
M99
N90#3000={number}(SIDE TOO SHORT)
"""


class Drawings(html.parser.HTMLParser):
    """The drawings of calls in a page, each as its XML."""

    def __init__(self, text):
        super().__init__()
        self.found = [ElementTree.fromstring(each)
                      for each in re.findall(r'<svg class="call-graph".*?</svg>', text, re.DOTALL)]


def boxes_of(drawing):
    """Left, top, right, bottom of each box by the words in it."""
    boxes = {}
    for node in drawing.iter():
        if not node.get("class", "").startswith("node "):
            continue
        name, word = (each.text for each in node.findall("text"))
        rect = node.find("rect")
        if rect is not None:
            left, top, width, height = (float(rect.get(each)) for each in ("x", "y", "width", "height"))
            box = left, top, left + width, top + height
        else:  # pointed
            numbers = [float(each) for each in re.findall(r"-?[0-9.]+", node.find("path").get("d"))]
            box = numbers[0] - 8, numbers[1], numbers[0] + numbers[2] + 8, numbers[1] + 40
        boxes[name] = (box, word, node.get("href"))
    return boxes


class Page(Scratch):
    def certify(self, *paths, output="report"):
        result = self.feedhold("certify", *paths, "-o", output, "--dialect", "fanuc-30i")
        self.page = (self.folder / output / "index.html").read_text()
        self.document = json.loads((self.folder / output / "certificate.json").read_text())
        return result

    def program(self, name):
        return next(program for file in self.document["files"] for program in file["programs"]
                    if program["name"] == name)


class Calls(Page):
    def ring(self):
        for name, text in RING.items():
            self.write(f"nc/{name}.nc", text)
        self.certify("nc")
        return Drawings(self.page).found

    def test_drawing_has_all_programs_and_no_two_in_one_place(self):
        ring, alone = self.ring()
        boxes = boxes_of(ring)
        self.assertEqual(set(boxes), {"O1", "O2", "O3", "O9999"})
        self.assertEqual(set(boxes_of(alone)), {"O5"})
        width, height = (float(each) for each in ring.get("viewBox").split()[2:])
        for box, _, _ in boxes.values():
            self.assertTrue(0 <= box[0] < box[2] <= width and 0 <= box[1] < box[3] <= height, box)
        for (a, _, _), (b, _, _) in itertools.combinations(boxes.values(), 2):
            self.assertTrue(a[2] < b[0] or b[2] < a[0] or a[3] < b[1] or b[3] < a[1], (a, b))
        self.assertIn("No calls from or to: <a", self.page)

    def test_state_is_told_in_words_and_nodes_lead_to_sections(self):
        boxes = boxes_of(self.ring()[0])
        words = {"ready": "✓ proved", "open": "? not all proved", "alarms": "! alarm to decide on",
                 "refuted": "✗ refuted"}
        for name in ("O1", "O2", "O3"):
            _, word, link = boxes[name]
            self.assertTrue(word.startswith(words[self.program(name)["status"]]), (name, word))
            self.assertEqual(word.endswith("in a cycle"), name != "O1")
            self.assertIn(f'<section class="program" id="{link[1:]}"', self.page)
        self.assertEqual(boxes["O9999"][1:], ("∅ not supplied", None))

    def test_lines_lead_from_callers_to_callees(self):
        ring, alone = self.ring()
        boxes, told = boxes_of(ring), {}
        for line in ring.iter("g"):
            if not line.get("class").startswith("call"):
                continue
            caller, callee, lines = re.match(r"(\w+) calls (\w+), lines? (.*)$", line.find("title").text).groups()
            way, head = (path.get("d") for path in line.findall("path"))
            x1, y1 = (float(each) for each in re.match(r"M([0-9.]+) ([0-9.]+)", way).groups())
            x2, y2 = (float(each) for each in re.match(r"M([0-9.]+) ([0-9.]+)", head).groups())
            left, top, right, bottom = boxes[callee][0]
            isBack = line.get("class") == "call back"
            self.assertBeside((x2, y2), (left, bottom), isBack)
            self.assertTrue(left - 1 < x2 < right and top < y2 < bottom + 1)
            left, top, right, bottom = boxes[caller][0]
            self.assertBeside((x1, y1), (right, bottom), isBack)
            self.assertTrue(left < x1 < right + 1 and top < y1 < bottom + 1)
            told[caller, callee] = lines, isBack
        self.assertEqual(told, {("O1", "O2"): ("2, 4", False), ("O1", "O3"): ("3", False), ("O2", "O3"): ("3", False),
                                ("O3", "O2"): ("3", True), ("O3", "O9999"): ("4", False)})
        self.assertEqual([line.get("class") for line in alone.iter("g")], ["call back"])

    def assertBeside(self, end, corner, isBack):
        """A line that closes a ring ends under its boxes, others beside them; numbers have one digit behind the point."""
        self.assertAlmostEqual(end[isBack], corner[isBack], delta=0.11)

    def test_the_same_in_words(self):
        drawing = self.ring()[0]
        words = re.search(rf'<ul class="calls" id="{drawing.get("aria-describedby")}">(.*?)</ul>', self.page, re.DOTALL)
        plain = re.sub(r"<[^>]*>", "", words.group(1)).strip().splitlines()
        self.assertEqual(plain, ["O1 calls O2 lines 2, 4, O3 line 3", "O2 calls O3 line 3",
                                 "O3 calls O2 line 3, O9999 (not supplied: it may do anything) line 4"])

    def test_too_many_for_a_drawing(self):
        names = [f"O{number}" for number in range(100, 190)]
        for name in names:
            self.write(f"nc/{name}.nc", f"{name}\nG65P99\nM99\n")
        self.write("nc/O99.nc", "O99\nM99\n")
        self.certify("nc")
        self.assertEqual(Drawings(self.page).found, [])
        self.assertIn("91 programs are connected by calls: too many to draw", self.page)
        for name in names:
            self.assertRegex(self.page, rf">{name}</a> calls <a[^>]*>O99</a>")

    def test_one_program_has_no_drawing(self):
        self.write("O4.nc", RING["O4"])
        self.certify("O4.nc")
        self.assertNotIn('id="calls"', self.page)


class Alarms(Page):
    """An alarm that the contract foresees, one that it does not, and one that comes for other calls than it says."""

    def with_clauses(self, clauses, number="7"):
        self.write("O7.nc", CHECKED.format(clauses=clauses, number=number))
        result = self.certify("O7.nc")
        [self.alarm] = [row["alarm"] for row in self.program("O7")["obligations"] if row["kind"] == "alarm-unreachable"]
        self.assertExit(self.feedhold("recheck", "report", "-q"), 0)
        return result

    def test_alarm_that_nobody_speaks_of(self):
        self.assertExit(self.with_clauses(""), 1)
        self.assertEqual(self.alarm, {"number": 7, "message": "SIDE TOO SHORT"})
        self.assertEqual((self.document["status"], self.program("O7")["status"]), ("alarms", "alarms"))
        self.assertIn("Decide before release", self.page)
        self.assertNotIn("Not fit for release", self.page)
        self.assertIn("Alarm 7 (SIDE TOO SHORT) can be raised", self.page)
        self.assertIn("<code>@ALARM 7 IFF ...</code>", self.page)
        self.assertTrue(self.program("O7")["summary"].startswith("Decide first: alarm 7 can be raised"))

    def test_clause_that_is_shown_settles_it(self):
        self.with_clauses("")
        clause = re.search(r"<code>(@REQUIRE [^.]*?)</code>", self.page).group(1)
        self.write("O7.nc", CHECKED.format(clauses=f"({clause})\n", number="7"))
        self.assertExit(self.certify("O7.nc"), 0)

    def test_alarm_that_is_meant(self):
        result = self.with_clauses("(@ALARM 7 IFF #1 LT 2)\n")
        self.assertExit(result, 0)
        self.assertIsNone(self.alarm)
        self.assertEqual(self.document["status"], "ready")
        self.assertIn("Ready for release: every claim is proved", self.page)
        self.assertExit(self.feedhold("prove", "O7.nc", "--dialect", "fanuc-30i"), 0)

    def test_alarm_that_comes_for_other_calls(self):
        self.assertExit(self.with_clauses("(@ALARM 7 IFF #1 LT 3)\n"), 1)
        self.assertEqual(self.document["status"], "refuted")
        self.assertIn("Not fit for release", self.page)
        self.assertIn("O7.alarm-iff.7", self.page)

    def test_number_that_is_computed(self):
        self.assertExit(self.with_clauses("(@ALARM 7 IF #1 LT 2)\n", number="[7+0]"), 0)
        self.assertIsNone(self.alarm)
        self.assertExit(self.with_clauses("(@ALARM 7 IF #1 LT 2)\n", number="[7+#2]"), 1)
        self.assertIsNone(self.alarm["number"])
        self.assertEqual(self.document["status"], "refuted", "the clause says which alarm comes")

    def test_clause_for_another_alarm_says_nothing(self):
        self.with_clauses("(@ALARM 8 IFF #1 LT 0)\n")
        self.assertEqual(self.alarm, {"number": 7, "message": "SIDE TOO SHORT"})


class Unreadable(Page):
    def test_text_that_cannot_be_read_is_not_fit_for_release(self):
        self.write("O5.nc", "O5\n#1=1\n#2=[#1\nM99\n")
        self.assertExit(self.certify("O5.nc"), 3)
        self.assertEqual((self.document["status"], self.document["counts"]["unknown"]), ("open", 0))
        self.assertEqual(self.program("O5")["summary"], "Do not release yet: line 3 has text that cannot be read.")
        self.assertNotIn("Ready for release: every claim is proved", self.page)


class NothingClaimed(Page):
    def test_report_without_claims_is_not_fit_for_release(self):
        self.write("O5.nc", "O5\nM99\n")
        self.assertExit(self.certify("O5.nc", "--only", "ensures"), 3)
        self.assertEqual(self.document["status"], "open")
        self.assertNotIn("Ready for release: every claim is proved", self.page)


class Against(Page):
    """Programs that lie elsewhere: files of one name are told apart by their folders."""

    def setUp(self):
        super().setUp()
        for folder, feed in (("left", 1), ("right", 2)):
            self.write(f"nc/{folder}/O1.nc", f"O1\nG94\nG01X1.F{feed}.\nM30\n")
        self.certify("nc")

    def against(self, *files):
        for name, feed in files:
            self.write(f"copy/{name}", f"O1\nG94\nG01X1.F{feed}.\nM30\n")
        return self.feedhold("recheck", "report", "--against", "copy")

    def test_same_folders(self):
        self.assertExit(self.against(("left/O1.nc", 1), ("right/O1.nc", 2)), 3)

    def test_same_folders_further_down(self):
        self.assertExit(self.against(("shop/nc/left/O1.nc", 1), ("shop/nc/right/O1.nc", 2)), 3)

    def test_exchanged(self):
        result = self.against(("left/O1.nc", 2), ("right/O1.nc", 1))
        self.assertExit(result, 1)
        for name in ("left", "right"):
            self.assertIn(f"`../nc/{name}/O1.nc` has changed", result.stdout)

    def test_one_of_two(self):
        result = self.against(("right/O1.nc", 2))
        self.assertExit(result, 3)
        self.assertIn("1 source unchanged", result.stdout)
        self.assertIn("`../nc/left/O1.nc` is missing", result.stderr)

    def test_one_that_may_be_either(self):
        result = self.against(("O1.nc", 1))
        self.assertExit(result, 1)
        self.assertIn("`O1.nc` below `copy` may be this one or `../nc/right/O1.nc`: name a folder", result.stdout)

    def test_two_that_may_be_one(self):
        self.write("nc/O2.nc", "O2\nM30\n")
        self.certify("nc/O2.nc")
        for folder in ("a", "b"):
            self.write(f"copy/{folder}/O2.nc", "O2\nM30\n")
        result = self.feedhold("recheck", "report", "--against", "copy")
        self.assertExit(result, 1)
        self.assertIn("it may be any of `a/O2.nc`, `b/O2.nc` below `copy`: name a folder", result.stdout)
        self.write("copy/O2.nc", "O2\nM30\n")  # that one lies as it was named
        self.assertExit(self.feedhold("recheck", "report", "--against", "copy"), 3)


if __name__ == "__main__":
    unittest.main()
