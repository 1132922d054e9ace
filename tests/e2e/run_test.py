"""`feedhold run`: options, alarms with their calls, endless loops, JSON against its schema."""
import json
import unittest

import jsonschema

from harness import ROOT, Scratch

SCHEMA = json.loads((ROOT / "docs" / "schemas" / "run.schema.json").read_text())
MAIN = """O1
G90 G00 X#500 Y#1
/G01 X5. F100.
G65 P2 A1. B#2
M30
"""
CALLED = """O2
G04 P500
#100=#1/#2
M99
"""


class Run(Scratch):
    def setUp(self):
        super().setUp()
        self.write("O1.nc", MAIN)
        self.write("O2.nc", CALLED)

    def run_program(self, *arguments):
        return self.feedhold("run", "--dialect", "fanuc-30i", "--isolated", *arguments)

    def report(self, *arguments):
        report = json.loads(self.run_program("--format", "json", *arguments).stdout)
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        jsonschema.validate(report, SCHEMA)
        return report

    def lines_run(self, report):
        return [(block["file"], block["line"], block["depth"]) for block in report["trace"]]

    def loop(self, body):
        return self.write("O3.nc", f"O3\n{body}\n")

    # ---- what a run starts with ----

    def test_arguments_and_variables(self):
        report = self.report("O1.nc", "--arg", "A=10", "--arg", "B=4", "--var", "500=3")
        self.assertEqual(report["end"], "M30")
        self.assertEqual(report["variables"]["100"], 0.25)
        self.assertEqual(report["moves"][0]["to"], {"X": 3, "Y": 10, "Z": 0})

    def test_start_position(self):
        self.write("O4.nc", "O4\nG90 G00 X9.\nM30\n")
        for words in (["X1", "Y2", "Z5"], ["X1 Y2 Z5"], ["x1 y+2", "z5.0"]):
            move = self.report("O4.nc", "--start", *words)["moves"][0]
            self.assertEqual(move["from"], {"X": 1, "Y": 2, "Z": 5})

    def test_block_skip(self):
        arguments = ("O1.nc", "--arg", "A=1", "--arg", "B=1")
        self.assertEqual([move["kind"] for move in self.report(*arguments)["moves"]], ["rapid", "feed", "dwell"])
        self.assertEqual([move["kind"] for move in self.report(*arguments, "--block-skip")["moves"]], ["rapid", "dwell"])

    def test_program_of_the_file(self):
        self.write("both.nc", MAIN + CALLED)
        self.assertEqual(self.report("both.nc", "--program", "O2", "--arg", "B=2")["end"], "M99")
        self.assertExit(self.run_program("both.nc", "--program", "O9"), 2)

    def test_cutter_offsets(self):
        self.write("slot.nc", "O1\nG21 G17 G90 G00 X0 Y0\nG01 G41 D2 X10. F100.\nX60.\nG40 Y30.\nM30\n")
        for option in (("--offset", "D2=5"), ("--offset", "d2=+5."), ("--var", "13002=5")):
            moves = self.report("slot.nc", *option)["moves"]
            self.assertEqual([step["to"]["Y"] for move in moves for step in move.get("toolPath", [])], [5, 5, 30])
        self.assertNotIn("toolPath", self.report("slot.nc")["moves"][1])
        self.write("tool.nc", "O1\n(@MODAL G21 G17 G90)\n(@TOOL FLAT RADIUS 5.)\nG20\nG01 G41 D2 X1. F9.\nX6.\nG40 Y3.\nM30\n")
        inches = self.report("tool.nc")  # the contract counts in the units of the start
        self.assertNotIn("offsetFromTool", inches)
        self.write("tool.nc", "O1\n(@MODAL G21 G17 G90)\n(@TOOL FLAT RADIUS 5.)\nG01 G41 D2 X10. F9.\nX60.\nG40 Y30.\nM30\n")
        self.assertTrue(self.report("tool.nc")["offsetFromTool"])
        for bad, why in (("5", "not of the form D1=5"), ("H1=5", "not of the form D1=5"), ("D1=", "not of the form D1=5"),
                         ("D1=five", "not of the form D1=5"), ("D0=5", "the offsets D1 to D999"),
                         ("D1.5=5", "the offsets D1 to D999"), ("D1000=5", "the offsets D1 to D999")):
            result = self.run_program("slot.nc", "--offset", bad)
            self.assertExit(result, 2)
            self.assertIn(why, result.stderr)

    def test_cutter_offsets_that_are_no_variables(self):
        self.write("slot.ngc", "g1 x10 f100\nm2\n")
        result = self.feedhold("run", "--dialect", "linuxcnc", "--isolated", "slot.ngc", "--offset", "D1=5")
        self.assertExit(result, 2)
        self.assertIn("no cutter offsets in variables", result.stderr)

    def test_inputs(self):
        self.write("wait.nc", "O7\n#1=0\nN10#1=#1+1\nIF[#1000EQ0]GOTO10\nM30\n")
        for given, passes in (("#1000=0,0,1", 3), ("1000=1", 1), ("#1000 = 0, 1", 2)):
            with self.subTest(given=given):
                self.assertEqual(self.report("wait.nc", "--input", given)["variables"], {"1": passes})
        self.assertEqual(self.report("wait.nc", "--input", "#1000=0", "--fuel", "100")["end"], "fuel")
        self.assertEqual(self.report("wait.nc", "--var", "1000=1")["variables"], {"1": 1, "1000": 1})
        for given in ("#100=1", "#1000", "#1000=", "#1000=0,,1", "#1000=x", "nothing=1"):
            with self.subTest(given=given):
                self.assertExit(self.run_program("wait.nc", "--input", given), 2)

    def test_inputs_with_names(self):
        """Pins, values of the control that are not followed, and what missing subroutines return."""
        self.write("pins.ngc", "#<a>=#<_hal[probe.in]>\n#<a>=[#<a>*10+#<_hal[probe.in]>]\n#<t>=#<_current_tool>\n"
                   "o<probe> call\n#<v>=#<_value>\no<probe> call\n#<w>=#<_value>\n#<r>=#<_value_returned>\nm2\n")
        run = ("run", "--dialect", "linuxcnc", "--isolated", "--missing", "return", "--format", "json", "pins.ngc")
        inputs = ("--input", "#<_hal[probe.in]>=1,2", "--input", "<_current_tool>=7")
        for values, expected in (((), {"v": 0, "w": 0, "r": 0}),
                                 (("--input", "#<_value>=-1,3"), {"v": -1, "w": 3, "r": 1})):
            result = self.feedhold(*run, *inputs, *values)
            self.assertExit(result, 0)
            variables = json.loads(result.stdout)["variables"]
            self.assertEqual({name: variables[f"<{name}>"] for name in ("a", "t", "v", "w", "r")},
                             {"a": 12, "t": 7} | expected)
        self.assertEqual(json.loads(self.feedhold(*run).stdout)["end"], "alarm")  # the pin is not there

    def test_start(self):
        self.write("arc.nc", "O8\n#1=#4002\n#2=#4120\n#3=#5041\nG3X10.Y0I5.J0F100\nM30\n")
        self.assertEqual(self.report("arc.nc")["end"], "M30")
        report = self.report("arc.nc", "--modal", "G19", "--modal", "T5", "--start", "X2", "--start", "Y1")
        self.assertEqual((report["end"], report["variables"]), ("alarm", {"1": 19, "2": 5, "3": 2}))
        self.assertEqual(self.report("arc.nc", "--modal", "G18 t5")["variables"]["2"], 5)

    def test_what_is_refused(self):
        for words in (["--arg", "G=1"], ["--arg", "A"], ["--arg", "A=x"], ["--var", "nothing=1"], ["--start", "Q1"],
                      ["--modal", "G68"], ["--modal", "G43"], ["--modal", "G4"], ["--modal", "G999"], ["--modal", "M3"],
                      ["--modal", "T"],
                      ["--start", "X"], ["--fuel", "-1"], ["--fuel", "many"], ["--format", "xml"]):
            with self.subTest(words=words):
                self.assertExit(self.run_program("O1.nc", *words), 2)

    # ---- the numbers it computes in ----

    def test_numbers(self):
        """Ten additions of .1 stay below 1 in doubles, and do not with 32 bits of mantissa."""
        self.loop("WHILE[#1LT1]DO1\n#2=#2+1\n#1=#1+.1\nEND1\nM30")
        models = {("fanuc-30i",): "binary64", ("fanuc-30i", "--numbers", "mantissa32"): "mantissa32",
                  ("fanuc-0i",): "mantissa32", ("fanuc-0i", "--numbers", "binary64"): "binary64",
                  ("haas-ngc",): "binary64", ("linuxcnc", "--numbers", "binary64"): "binary64"}
        for arguments, model in models.items():
            with self.subTest(arguments=arguments):
                text = self.feedhold("run", "O3.nc", "--dialect", *arguments).stdout
                self.assertEqual("numbers: " + model in text, "mantissa32" in (*arguments, model) or "fanuc-0i" in arguments)
                told = json.loads(self.feedhold("run", "O3.nc", "--format", "json", "--dialect", *arguments).stdout)
                self.assertEqual(told["numbers"], model)
                if arguments[0] != "linuxcnc":
                    self.assertEqual(told["variables"]["2"], 11 if model == "binary64" else 10)
        self.assertExit(self.run_program("O3.nc", "--numbers", "either"), 2)

    def test_numbers_of_a_switch(self):
        self.loop("#1=.1\nM30")
        for setting, model in (("true", "mantissa32"), ("false", "binary64"), ('"unknown"', "binary64")):
            self.write("feedhold.toml", f"[switches]\nf16 = {setting}\n")
            told = self.feedhold("run", "O3.nc", "--dialect", "fanuc-30i", "--format", "json")
            self.assertEqual(json.loads(told.stdout)["numbers"], model)

    # ---- the increment system ----

    def test_increment_system(self):
        self.loop("G20\nG90G0X[1/3]\n#1=#5041\nG21\nX[10/3]\n#2=#5041\nM30")
        for options, expected in (([], (.3333, 3.333)), (["IS-A"], (.333, 3.33)), (["IS-B"], (.3333, 3.333)),
                                  (["IS-C"], (.33333, 3.3333))):
            asked = ["--increment-system", *options] if options else []
            told = json.loads(self.feedhold("run", "O3.nc", "--dialect", "fanuc-30i", "--format", "json", *asked).stdout)
            self.assertEqual((told["variables"]["1"], told["variables"]["2"]), expected)

    def test_the_option_overrides_the_configuration(self):
        self.loop("G21G90G0X[10/3]\n#1=#5041\nM30")
        self.write("feedhold.toml", 'increment-system = "IS-C"\n')
        for options, expected in (([], 3.3333), (["--increment-system", "IS-A"], 3.33)):
            told = self.feedhold("run", "O3.nc", "--dialect", "fanuc-30i", "--format", "json", *options)
            self.assertEqual(json.loads(told.stdout)["variables"]["1"], expected)

    # ---- the G code system of a lathe ----

    def test_g_code_system(self):
        """71 is a unit in system C alone, and 90 a distance mode in B and C: the option, then the file, then the text."""
        self.loop("G90\nG71\n#1=#4003\n#2=#4006\nM30")
        self.write("feedhold.toml", 'g-code-system = "B"\n')
        for options, unit in (([], 21), (["--g-code-system", "C"], 71), (["--g-code-system", "A"], 21),
                              (["--isolated"], 71)):  # `G71` alone is no cycle: the text shows system C
            told = self.feedhold("run", "O3.nc", "--dialect", "fanuc-30i-lathe", "--format", "json", *options)
            variables = json.loads(told.stdout)["variables"]
            self.assertEqual((variables["1"] == 90, variables["2"]), ("A" not in options, unit), options)
        self.assertExit(self.run_program("O3.nc", "--g-code-system", "D"), 2)

    def test_an_unknown_increment_system_is_an_error(self):
        result = self.run_program("O1.nc", "--increment-system", "IS-D")
        self.assertExit(result, 2)
        self.assertIn("--increment-system: IS-D not in {IS-A,IS-B,IS-C}", result.stderr)

    # ---- what it does ----

    def test_trace(self):
        arguments = ("O1.nc", "--arg", "A=1", "--arg", "B=2", "--trace")
        self.assertEqual(self.lines_run(self.report(*arguments)),
                         [("O1.nc", 1, 0), ("O1.nc", 2, 0), ("O1.nc", 3, 0), ("O1.nc", 4, 0),
                          ("O2.nc", 1, 1), ("O2.nc", 2, 1), ("O2.nc", 3, 1), ("O2.nc", 4, 1), ("O1.nc", 5, 0)])
        text = self.run_program(*arguments).stdout
        self.assertIn("O2.nc:3   #100=#1/#2\n", text)
        self.assertIn("O1.nc:3 /G01 X5. F100.\nO1.nc:3 feed     X5 Y1 Z0 F100\n", text)

    def test_alarm_of_the_control_names_its_calls(self):
        result = self.run_program("O1.nc")
        self.assertExit(result, 1)
        self.assertTrue(result.stdout.endswith("alarm PS0112 (divided by zero), line 3 of O2.nc\n  O2 line 3: #100=#1/#2\n"
                                               "  called from O1 line 4: G65 P2 A1. B#2\n"), result.stdout)
        report = self.report("O1.nc")
        self.assertEqual((report["end"], report["alarm"]["by"], report["alarm"]["number"]), ("alarm", "control", "PS0112"))
        self.assertEqual(report["calls"], [{"file": "O1.nc", "program": "O1", "line": 4}])
        self.assertNotIn("100", report["variables"], "the block that raises an alarm assigns nothing")

    def test_alarm_of_the_program(self):
        self.write("O2.nc", "O2\n#3000=5(NO DEPTH)\nM99\n")
        alarm = self.report("O1.nc")["alarm"]
        self.assertEqual((alarm["by"], alarm["number"], alarm["message"], alarm["line"]), ("program", 5, "NO DEPTH", 2))
        self.assertIn("alarm #3000=5 (NO DEPTH), line 2 of O2.nc\n", self.run_program("O1.nc").stdout)

    def test_vacant_is_null(self):
        self.loop("#2=#1\nM30")
        self.assertEqual(self.report("O3.nc")["variables"], {"1": None, "2": None})

    def test_what_is_not_followed_is_noted(self):
        self.loop("G87 X1. Y1. Z-1. R1. Q.1 F10.\nM30")
        report = self.report("O3.nc")
        self.assertEqual((report["end"], len(report["notes"])), ("M30", 1))

    # ---- loops without end ----

    def test_state_that_comes_back(self):
        self.loop("N1 #1=1\nG00 X#1\nGOTO1")
        self.assertEqual(self.report("O3.nc")["end"], "endless")
        result = self.run_program("O3.nc")
        self.assertExit(result, 1)
        self.assertIn("runs for ever", result.stdout)

    def test_long_way_around(self):
        self.loop("N1 #1=[#1+1]MOD977\nGOTO1")
        self.assertEqual(self.report("O3.nc")["end"], "endless")

    def test_counting_without_end_uses_up_the_fuel(self):
        self.loop("N1 #1=#1+1\nGOTO1")
        report = self.report("O3.nc", "--fuel", "1000")
        self.assertEqual((report["end"], report["steps"]), ("fuel", 1000))
        self.assertIn("still running after 1000 instructions", self.run_program("O3.nc", "--fuel", "1000").stdout)

    def test_waiting_for_an_input_is_not_endless(self):
        self.loop("N1 IF[#1000EQ0]GOTO1\nM30")
        self.assertEqual(self.report("O3.nc", "--fuel", "5000")["end"], "fuel")

    def test_movements_without_end(self):
        self.loop("G91 G01 F100.\nN1 X1.\nGOTO1")
        report = self.report("O3.nc", "--fuel", "300")
        self.assertEqual((report["end"], report["steps"]), ("fuel", 300))

    # ---- the schema ----

    def test_every_kind_of_move_follows_the_schema(self):
        self.loop("G90 G17 G02 X10. Y0 R5. F100.\nG03 I-5.\nG31 Z-5.\nG04 X1.\nG00 A5.\nM30")
        kinds = {move["kind"] for move in self.report("O3.nc")["moves"]}
        self.assertEqual(kinds, {"arc-clockwise", "arc-counterclockwise", "probe", "dwell", "rapid"})

    def test_schema_refuses_what_is_no_run(self):
        report = self.report("O1.nc")
        for key, value in (("end", "crash"), ("alarm", {}), ("moves", [{"kind": "rapid", "file": "O1.nc", "line": 1}])):
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({**report, key: value}, SCHEMA)


if __name__ == "__main__":
    unittest.main()
