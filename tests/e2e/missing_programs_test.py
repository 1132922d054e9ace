"""What `feedhold prove` takes what is not in the files to do: computed numbers, and G codes that are macros."""
import json
import shlex
import unittest

from harness import Scratch

UNLISTED = """O1
#500=0
G229 Z-2.03 T910
IF[#500EQ0]GOTO10
#3000=1(CHANGED)
N10 G0X1.
M30
"""
ARGUMENTS = """O1
G229 M30
#3000=1(BEHIND)
M30
"""
CALLED = """O11
#500=1
M99
O12
#500=3
M99
"""
COMPUTED = """O1
#500=0
M98P#1
IF[#500EQ3]GOTO10
M30
N10#3000=3(THREE)
""" + CALLED
AROUND_CALL = """O1
#100=0
WHILE[#100LT5]DO1
M98P8000
#100=#100+1
END1
IF[#100EQ5]GOTO10
#3000=1(COUNT CHANGED)
N10 M30
"""
PROBED = """O1
G65P9800A5.
#1=1/#135
M30
"""
PROBE = """@PARAM #1 FEED 1..10
@ENSURE #135 GE 0.5
"""


class MissingPrograms(Scratch):
    def obligations(self, *words):
        files = json.loads(self.feedhold("prove", "--no-cache", "--dialect", "fanuc-30i", *words, "--format",
                                         "json").stdout)["files"]
        return {row["id"]: row for each in files for row in each["obligations"]}

    def assertReplays(self, witness):
        words = shlex.split(witness["run"])[1:]
        run = json.loads(self.feedhold(*words, "--format", "json").stdout)
        self.assertEqual(run["end"], witness["end"])

    def test_code_that_the_control_does_not_have_returns(self):
        self.write("O1.nc", UNLISTED)
        rows = self.obligations("O1.nc")
        self.assertEqual(rows["O1.program-ends"]["verdict"], "proved")
        self.assertEqual(rows["O1.program-ends"]["ifReturning"], ["G229"])
        changed = rows["O1.alarm-unreachable.L5"]
        self.assertEqual(changed["verdict"], "unknown")  # the macro may change #500, its passing over does not
        self.assertFalse([row for row in rows.values() if row["line"] == 3])

    def test_counter_that_a_missing_program_may_change(self):
        self.write("O1.nc", AROUND_CALL)
        rows = self.obligations("O1.nc")
        for row in ("O1.loop-ends.L3", "O1.program-ends"):
            self.assertEqual((rows[row]["verdict"], rows[row]["ifReturning"], rows[row]["ifUnchanged"]),
                             ("proved", ["O8000"], True), row)
        # whatever else is read behind the call may be its result
        self.assertEqual(rows["O1.alarm-unreachable.L8"]["verdict"], "unknown")
        self.assertIn("if O8000 returns and changes nothing, which is not in the files",
                      self.feedhold("prove", "--verbose", "O1.nc").stdout)
        for missing, verdict in (("stop", "proved"), ("havoc", "unknown")):
            row = self.obligations("--missing", missing, "O1.nc")["O1.program-ends"]
            self.assertEqual((row["verdict"], row["ifUnchanged"]), (verdict, False), missing)

    def test_code_that_the_control_does_not_have_stops(self):
        self.write("O1.nc", UNLISTED)
        rows = self.obligations("--missing", "stop", "O1.nc")
        self.assertIn("refuted", {row["verdict"] for row in rows.values() if row["line"] == 3})
        self.assertEqual(rows["O1.program-ends"]["verdict"], "unknown")

    def test_other_codes_of_the_block_may_be_arguments(self):
        self.write("O1.nc", ARGUMENTS)
        for missing in ("return", "stop", "havoc"):
            row = self.obligations("--missing", missing, "O1.nc")["O1.alarm-unreachable.L3"]
            self.assertEqual(row["verdict"], "unknown", missing)

    def test_computed_number_calls_what_it_names(self):
        self.write("O1.nc", COMPUTED.replace("O1\n", "O1\n(@PARAM #1 IN 11,12)\n", 1))
        rows = self.obligations("O1.nc")
        self.assertEqual(rows["O1.program-ends"]["verdict"], "proved")
        self.assertEqual(rows["O1.program-ends"]["ifReturning"], [])
        witness = rows["O1.alarm-unreachable.N10"]["witness"]
        self.assertEqual(witness["call"], "G65 P1 A12.")
        self.assertReplays(witness)

    def test_computed_number_may_name_no_program(self):
        self.write("O1.nc", COMPUTED)
        row = self.obligations("O1.nc")["O1.program-ends"]
        self.assertEqual((row["verdict"], row["ifReturning"]), ("proved", ["a program with a computed number"]))
        stops = self.obligations("--missing", "stop", "O1.nc")
        self.assertIn("refuted", {row["verdict"] for row in stops.values() if row["line"] == 3})

    def test_number_of_two_programs(self):
        self.write("O1.nc", COMPUTED.removesuffix(CALLED).replace("O1\n", "O1\n(@PARAM #1 IN 11)\n", 1))
        self.write("one.nc", CALLED)
        self.write("other.nc", CALLED.replace("#500=1", "#500=3"))
        rows = self.obligations("O1.nc")
        self.assertEqual({rows[row]["verdict"] for row in ("O1.program-ends", "O1.alarm-unreachable.N10")}, {"unknown"})

    def test_contract_of_missing_program(self):
        self.write("O1.nc", PROBED)
        self.write("O9800.contract", PROBE)
        rows = self.obligations("O1.nc")
        division = rows["O1.no-control-alarm.L3"]
        self.assertEqual((division["verdict"], division["ifReturning"], division["ifPromising"]),
                         ("proved", ["O9800"], ["O9800"]))
        self.assertEqual(rows["O1.call-meets-contract.L2"]["verdict"], "proved")
        self.assertIn("if O9800 keeps its contract", self.feedhold("prove", "--verbose", "O1.nc").stdout)
        rows = self.obligations("--missing", "havoc", "O1.nc")
        self.assertEqual(rows["O1.no-control-alarm.L3"]["verdict"], "unknown")
        self.assertFalse([row for row in rows.values() if row["ifPromising"]])

    def test_other_contract_is_another_question(self):
        self.write("O1.nc", PROBED)
        words = ("prove", "--cache-dir", "cache", "--dialect", "fanuc-30i", "--format", "json", "O1.nc")
        def division():
            files = json.loads(self.feedhold(*words).stdout)["files"]
            return {row["id"]: row["verdict"] for row in files[0]["obligations"]}["O1.no-control-alarm.L3"]
        self.assertEqual(division(), "refuted")  # a run that passes over the call
        self.write("O9800.contract", PROBE)
        self.assertEqual(division(), "proved")
        self.write("O9800.contract", PROBE.replace("GE 0.5", "GE 0"))
        self.assertEqual(division(), "unknown")

    def test_mistake_in_contract_of_missing_program(self):
        self.write("O1.nc", PROBED)
        self.write("O9800.contract", PROBE + "@ENSUR #136 EQ 1\n")
        result = self.feedhold("prove", "--no-cache", "--dialect", "fanuc-30i", "O1.nc")
        self.assertEqual(result.returncode, 2)
        self.assertIn("O9800.contract", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
