"""`feedhold ranges`: lines, calls, JSON against its schema, and what it says when it cannot tell."""
import json
import unittest

import jsonschema

from harness import ROOT, Scratch

MAIN = """O1000
#1=0
WHILE[#1LT5]DO1
#1=#1+1
END1
G65 P2000 A#1
G90 G00 X#100
M30
"""
SUB = """O2000
#100=#1*2
M99
"""


class Ranges(Scratch):
    def setUp(self):
        super().setUp()
        self.write("O1000.nc", MAIN)
        self.write("O2000.nc", SUB)

    def ranges(self, *arguments):
        result = self.feedhold("ranges", *arguments)
        self.assertExit(result, 0)
        return result.stdout

    def report(self, *arguments):
        report = json.loads(self.ranges("--format", "json", *arguments))
        schema = json.loads((ROOT / "docs/schemas/ranges.schema.json").read_text())
        jsonschema.Draft7Validator.check_schema(schema)
        jsonschema.validate(report, schema)
        return report

    def test_all_lines(self):
        text = self.ranges("O1000.nc")
        self.assertIn("   4  #1=#1+1\n", text)
        self.assertIn("#1  5\n", text)
        self.assertNotIn("O2000, called", text)

    def test_counters_end_at_the_limit_of_their_loop(self):
        """Up, down, in steps that pass the limit, to what a variable holds, and tested at the end of the loop."""
        for loop, last in (("#1=0\nWHILE[#1LT96]DO1\n#1=#1+1\nEND1", "96"),
                           ("#1=0\nWHILE[#1LE96]DO1\n#1=#1+1\nEND1", "97"),
                           ("#1=90\nWHILE[#1GT-5]DO1\n#1=#1-1\nEND1", "-5"),
                           ("#2=50\n#1=0\nWHILE[#2GT#1]DO1\n#1=1+#1\nEND1", "50"),
                           ("#1=0\nN1#1=#1+1\nIF[#1LT40]GOTO1", "40"),
                           ("#1=0\nN1IF[#1EQ30]GOTO2\n#1=#1+1\nGOTO1\nN2", "30"),
                           ("#1=0\nWHILE[#1LT50]DO1\n#1=#1+20\nEND1", "60")):
            with self.subTest(loop):
                self.write("O4.nc", f"O4\n{loop}\nG0X#1\nM30\n")
                self.assertRegex(self.ranges(f"O4.nc:{loop.count(chr(10)) + 3}"), rf"#1 +{last}\n")

    def test_two_calls_that_come_to_find_the_same(self):
        """In the second iteration both calls find any position: each says so, also the one that is told second."""
        self.write("O3.nc", "O3\nWHILE[#11LT4]DO1\nG91\nM98P4\nM98P4\nEND1\nM30\nO4\nG1Y3.\nM99\n")
        contexts = [c for c in self.report("O3.nc")["contexts"] if c["calls"]]
        self.assertEqual([c["calls"][0]["line"] for c in contexts], [4, 5])
        for context in contexts:
            position = {p["name"]: p for p in context["blocks"][0]["positions"]}["Y"]
            self.assertNotIn("equals", position)

    def test_one_line(self):
        text = self.ranges("O1000.nc:7")
        self.assertIn("   7  G90 G00 X#100\n", text)
        self.assertRegex(text, r"#100 +10\n")
        self.assertNotIn("   4  ", text)

    def test_called_programs_of_the_folder(self):
        text = self.ranges("--calls", "O1000.nc")
        self.assertIn("O2000, called from O1000 line 6\n", text)
        self.assertNotRegex(self.ranges("O2000.nc"), "called from")  # by itself: with any argument

    def test_a_lone_number_in_a_loop_joins_the_jump_and_the_loop(self):
        self.write("O3000.nc", "O3000\n#2=0\nWHILE[#2LT3]DO1\n#2=#2+.5\nN10\nEND1\n#2=10\n"
                               "IF[#1GT0]GOTO10\nM30\n")
        self.assertRegex(self.ranges("O3000.nc:5"), r"#2 +0\.5, 1, .* or 10")

    def test_an_armed_interrupt_leaves_nothing_to_tell(self):
        self.write("O3001.nc", "O3001\n#100=1\nM96P2\n#101=1\nM30\nO2\n#100=0\nM99\n")
        self.assertIn("a macro interrupt is armed", self.ranges("O3001.nc"))

    def test_one_program_of_a_file(self):
        self.write("both.nc", MAIN + SUB)
        self.assertIn("O2000, called from O1000 line 6\n", self.ranges("both.nc"))
        self.assertTrue(self.ranges("both.nc", "--program", "O2000").startswith("O2000, for any start state\n"))

    def test_json_follows_its_schema(self):
        report = self.report("O1000.nc:7")
        self.assertEqual((report["line"], report["gaveUp"], report["complete"]), (7, None, True))
        block = report["contexts"][0]["blocks"][0]
        values = {value["name"]: value for value in block["variables"]}
        self.assertEqual(values["#1"], {"name": "#1", "text": "5", "vacant": "no",
                                        "number": {"min": 5.0, "max": 5.0, "values": [5.0]}})
        report = self.report("--calls", "O1000.nc")
        self.assertEqual([context["program"]["program"] for context in report["contexts"]], ["O1000", "O2000"])
        self.assertEqual(report["contexts"][1]["calls"], [{"file": "O1000.nc", "program": "O1000", "line": 6}])

    def test_json_of_every_example(self):
        for page in (ROOT / "tests/golden/invariants").glob("*.md"):
            for number, part in enumerate(page.read_text().split("\n```nc ")[1:]):
                name = f"{page.stem}_{number}.nc"
                self.write(name, part.split("\n", 1)[1].split("\n```")[0] + "\n")
                self.report("--dialect", "fanuc-30i", name)

    def test_what_is_not_followed(self):
        self.write("call.nc", "O1\nG65 P1234\nX#100\nM30\n")
        self.assertIn("not modelled: ", self.ranges("call.nc"))
        self.assertEqual(self.report("call.nc")["unmodelled"][0]["line"], 2)

    def test_giving_up_is_said(self):
        labels = 3000
        tangle = "".join(f"N{i} GOTO#{100 + i % 50}\n" for i in range(1, labels))
        self.write("tangle.nc", f"O1\n{tangle}M30\n")
        self.assertIn("no ranges: ", self.ranges("tangle.nc"))
        report = self.report("tangle.nc")
        self.assertTrue(report["gaveUp"])
        self.assertEqual(report["contexts"], [])

    def test_what_cannot_be_answered(self):
        self.assertExit(self.feedhold("ranges", "gone.nc"), 2)
        self.assertExit(self.feedhold("ranges", "O1000.nc:99"), 2)
        self.assertExit(self.feedhold("ranges", "O1000.nc", "--program", "O77"), 2)
        self.assertExit(self.feedhold("ranges", "O1000.nc", "--dialect", "abacus"), 2)


if __name__ == "__main__":
    unittest.main()
