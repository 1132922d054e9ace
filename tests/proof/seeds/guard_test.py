"""Guards: the condition that is offered for a claim that does not hold; with it, as a clause or in the program, it does."""
import json
import os
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

FEEDHOLD = os.environ["FEEDHOLD"]

# name, obligation, conditions, program
CASES = [
    ("step of an entry", "O1.no-control-alarm.N10", ["#22 GT 0"],
     "N10#10=FUP[ABS[#21/#22]]\nN20WHILE[#10GT0]DO1\n#10=#10-1\nG91G01Z-[#21/FUP[ABS[#21/#22]]]F100\nEND1\nM99"),
    ("division", "O1.no-control-alarm.N10", ["#7 GT 0"], "N10#3=360/#7\nM99"),
    ("division by what is given", "O1.no-control-alarm.N10", ["#7 NE 0"], "(@PARAM #7 HOLES)\nN10#3=360/#7\nM99"),
    ("division by a difference", "O1.no-control-alarm.N10", ["[#7-2*#8] NE 0"], "N10#3=5/[#7-2*#8]\nM99"),
    ("root", "O1.no-control-alarm.N10", ["#4 GE 3"], "N10#3=SQRT[#4-3]\nM99"),
    ("root of a later value", "O1.no-control-alarm.N10", ["#2 GE [#1+2*#7]"],
     "#10=#2-#1\nN10#11=SQRT[#10-2*#7]\nM99"),
    ("root in a loop", "O1.no-control-alarm.N10", ["#4 GE [2*#2]"],
     "#10=#1\nWHILE[#10LE#2]DO1\nN10#11=SQRT[#4-2*#10]\n#10=#10+1\nEND1\nM99"),
    ("logarithm", "O1.no-control-alarm.N10", ["#6 GT 0"], "N10#5=LN[#6]\nM99"),
    ("step of a loop up", "O1.loop-ends.N20", ["#8 GT 0"], "#1=0\nN20WHILE[#1LE#6]DO1\n#1=#1+#8\nEND1\nM99"),
    ("step of a loop down", "O1.loop-ends.N20", ["#3 GT 0"], "#1=#4\nN20WHILE[#1GT#2]DO1\n#1=#1-#3\nEND1\nM99"),
    ("step of a loop by GOTO", "O1.loop-ends.N20", ["#22 GT 0"],
     "#10=0\nN20#10=#10+#22\nIF[#10LT#21]GOTO20\nM99"),
    ("the whole program", "O1.program-ends", ["#8 GT 0"], "#1=0\nN20WHILE[#1LE#6]DO1\n#1=#1+#8\nEND1\nM99"),
    ("two arguments", "O1.no-control-alarm.N10", ["#5 GE #6"],
     "(@PARAM #6 INNER 1..100)\n(@PARAM #5 OUTER 1..200)\n#1=-#6\nWHILE[#1LE#6]DO1\nN10#2=SQRT[#5*#5-#1*#1]\n"
     "#1=#1+1\nEND1\nM99"),
    ("a number left in a condition", "O1.no-control-alarm.N10", ["#6 GE 17"],
     "(@PARAM #6 RADIUS 5..100)\n(@PARAM #8 STEP 0.01..1.)\n#10=0\n#1=-#6\nWHILE[#1LE17]DO1\n#9=#6-#10\n"
     "N10#2=SQRT[#6*#6-#9*#9]\n#1=#1+#8\n#10=#10+#8\nEND1\nM99"),
    ("common variable", "O1.no-control-alarm.N10", ["#500 GT 0"], "N10#3=100/#500\nM30"),
    ("a loop in a loop", "O1.loop-ends.N20", ["#18 GT 0"],
     "#1=0\nN10#2=0\nN20#2=#2+#18\nIF[#2LT10]GOTO20\n#1=#1+#19\nIF[#1LT#20]GOTO10\nM99"),
    ("the loop around it", "O1.loop-ends.N10", ["#18 GT 0", "#19 GT 0"],
     "#1=0\nN10#2=0\nN20#2=#2+#18\nIF[#2LT10]GOTO20\n#1=#1+#19\nIF[#1LT#20]GOTO10\nM99"),
    ("a negative number", "O1.no-control-alarm.N10", ["#501 NE -1"], "N10#3=100/[#501+1]\nM30"),
    ("a promise", "O1.no-control-alarm.N10", ["#1 GE #2"], "#500=#1-#2\nN10#3=SQRT[#500]\nM99"),
]


class Guards(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.file = Path(holder.name) / "O1.nc"

    def feedhold(self, *arguments):
        return subprocess.run([FEEDHOLD, *arguments], cwd=self.file.parent, capture_output=True, text=True, timeout=300)

    def obligations(self, text):
        self.file.write_bytes(text.encode())
        result = self.feedhold("prove", "--no-cache", "--isolated", "--dialect", "fanuc-30i", "--arithmetic", "exact",
                               "--format", "json", "O1.nc")
        report = json.loads(result.stdout)
        self.assertEqual(report["errors"], [])
        return {row["id"]: row for row in report["files"][0]["obligations"]}

    def guard(self, text, identity="O1.no-control-alarm.N10"):
        return self.obligations(text)[identity]["guard"]

    @staticmethod
    def applied(text, fix):
        lines = text.splitlines(keepends=True)
        for edit in reversed(fix["edits"]):
            line, column = edit["line"] - 1, edit["column"] - 1
            lines[line] = lines[line][:column] + edit["replacement"] + lines[line][column:]
        return "".join(lines)

    def same_claim(self, rows, row):
        """Lines move, and an id may count them."""
        found = rows.get(row["id"])
        return found["verdict"] if found else "unreachable"

    def test_with_the_guard_the_claim_is_proved(self):
        for name, identity, conditions, body in CASES:
            with self.subTest(name):
                text = f"O1\n{body}\n"
                row = self.obligations(text)[identity]
                self.assertEqual(row["verdict"], "refuted")
                guard = row["guard"]
                self.assertEqual(guard["conditions"], conditions)
                with_clause = text.replace("O1\n", f"O1\n({guard['clause']})\n", 1)
                self.assertIn(self.same_claim(self.obligations(with_clause), row), ("proved", "unreachable"))
                fixed = self.applied(text, guard["fix"])
                self.assertIn(self.same_claim(self.obligations(fixed), row), ("proved", "unreachable"), fixed)
                alarm = self.feedhold(*shlex.split(row["witness"]["run"])[1:])
                self.assertIn("#3000", fixed)
                self.assertIn("MUST", alarm.stdout, fixed)

    def test_blocks(self):
        text = "O1(DRILL)\n(@PARAM #7 HOLES OPTIONAL)\nN10#3=360/#7\nM99\n"
        self.assertEqual(self.applied(text, self.guard(text)["fix"]),
                         "O1(DRILL)\n(@PARAM #7 HOLES OPTIONAL)\nIF[#7LE0]GOTO9001\nN10#3=360/#7\nM99\n"
                         "N9001#3000=101(HOLES MUST BE ABOVE 0)\n")

    def test_numbers_that_are_taken(self):
        text = "O1\nN10#3=360/#7\nIF[#3GT9]GOTO9001\nM99\nN9001#3000=101(NO)\n"
        fixed = self.applied(text, self.guard(text)["fix"])
        self.assertIn("IF[#7LE0]GOTO9002\n", fixed)
        self.assertTrue(fixed.endswith("N9001#3000=101(NO)\nN9002#3000=102(#7 MUST BE ABOVE 0)\n"), fixed)

    def test_a_text_without_end(self):
        text = "O1\nN10#3=360/#7\n#4=1\n"
        self.assertEqual(self.applied(text, self.guard(text)["fix"]),
                         "O1\nIF[#7GT0]GOTO9001\n#3000=101(#7 MUST BE ABOVE 0)\nN9001\nN10#3=360/#7\n#4=1\n")

    def test_line_ends_stay(self):
        text = "O1\r\nN10#3=360/#7\r\nM99\r\n"
        fix = self.guard(text)["fix"]
        self.assertEqual([edit["replacement"] for edit in fix["edits"]],
                         ["IF[#7LE0]GOTO9001\r\n", "\r\nN9001#3000=101(#7 MUST BE ABOVE 0)"])

    def test_what_contradicts_the_contract_is_not_offered(self):
        text = "O1\n(@PARAM #7 DEPTH -50..0)\nN10#3=360/#7\nM99\n"
        self.assertIn(self.guard(text)["conditions"], (["#7 NE 0"], ["#7 LT 0"]))

    def test_no_condition_on_inputs_helps(self):
        for body in ("N10#3=1/0\nM99", "N10#3=1/[#1000-1]\nM99"):
            with self.subTest(body):
                self.assertIsNone(self.guard(f"O1\n{body}\n"))

    def test_an_alarm_that_cuts_a_loop_short_is_no_end(self):
        text = "O1\nN20#1=1/#3\nGOTO20\n"
        self.assertIsNone(self.guard(text, "O1.loop-ends.N20"))
        self.assertIsNone(self.guard(text, "O1.program-ends"))

    def test_an_alarm_of_the_program_needs_no_other_alarm(self):
        guard = self.guard("O1\nIF[#1EQ#0]GOTO10\nM99\nN10#3000=1(MISSING)\n", "O1.alarm-unreachable.N10")
        self.assertEqual((guard["clause"], guard["fix"]), ("@REQUIRE #1 NE #0", None))


if __name__ == "__main__":
    unittest.main()
