"""`feedhold prove` in the arithmetic of the control: what rounding breaks is not proved, and what is sturdy stays proved."""
import json
import unittest

from harness import Scratch

ELEVEN_HOLES = """O5
#1=0
#2=0
N10WHILE[#1LT1]DO1
#2=#2+1
#1=#1+.1
END1
IF[#2LE10]GOTO20
#3000=1(ELEVEN HOLES)
N20M30
"""
NEVER_EQUAL = """O1
#1=0
N10WHILE[#1NE1]DO1
#1=#1+.1
END1
M30
"""
ROOT_OF_A_DIFFERENCE = """O1
(@PARAM #1 0..10)
(@PARAM #2 1..3)
#3=#1/#2
N10#4=SQRT[#3*#2-#1]
M99
"""
BOLT_CIRCLE = """O1
(@PARAM #1 2..60 INT)
#3=360/#1
#10=0
#11=0
N10WHILE[#10LT360]DO1
#10=#10+#3
#11=#11+1
END1
IF[#11NE#1]THEN#3000=1(HOLES)
M99
"""
WHOLE_COUNTER = """O1
(@PARAM #1 1..60 INT)
#11=0
N10WHILE[#11LT#1]DO1
#11=#11+1
END1
IF[#11NE#1]THEN#3000=1(HOLES)
M99
"""
QUARTERS = """O1
#1=0
#2=0
N10WHILE[#1NE1]DO1
#2=#2+1
#1=#1+.25
END1
IF[#2NE4]THEN#3000=1(HOLES)
M30
"""
CLAMPED_PECKS = """O1
(@PARAM #6 DEPTH 0.5..100)
(@PARAM #22 PECK 0.1..10)
#10=0
N10WHILE[#10LT#6]DO1
#11=#6-#10
IF[#11GT#22]THEN#11=#22
#10=#10+#11
END1
IF[#10GT[#6+.001]]THEN#3000=1(TOO DEEP)
M99
"""
LEVELS = """O1
(@PARAM #21 DEPTH 0.5..100)
(@PARAM #22 LARGEST_STEP 0.1..10)
#10=FUP[#21/#22]
#11=0
N10WHILE[#11LT#10]DO1
#11=#11+1
END1
M99
"""
ROOT_OF_SQUARES = """O1
(@PARAM #2 0..10)
(@PARAM #1 #2..20)
N10#4=SQRT[#1*#1-#2*#2]
M99
"""
# A power is not rounded to the nearest: for #1=893.66143 the two differ in the last digit.
SQUARE_AS_POWER = """O1
(@PARAM #1 0..1000)
IF[POW[#1,2]EQ#1*#1]GOTO20
#3000=1(DIFFERENT)
N20M99
"""
# #1=88198625.0005 is rounded to 88198625.001, which is a little more than half an increment away.
LARGE_WORD = """O1
(@PARAM #1 0..90000000)
G90
#2=88198620.0005+5
IF[#1GT#2]GOTO20
G0X#1
IF[#5041LT88198625.001]GOTO20
#3000=1(OTHER PLACE)
N20M99
"""
# #1=4.11522 breaks the contract, and is not stopped.
GUARD_OF_WHOLE_NUMBERS = """O1
(@PARAM #1 0..10 INT)
(@GUARDED)
IF[#1EQ#0]GOTO90
IF[#1LT0]GOTO90
IF[#1GT10]GOTO90
#2=1234.5678/3
IF[ABS[#1-#2/100]GT.0001]GOTO15
IF[ROUND[#1]NE#1]GOTO30
N15IF[FIX[#1]NE#1]GOTO90
GOTO31
N30G0X#1
N31M99
N90#3000=1(NOT ALLOWED)
"""
# Both are 1/2, and either may be off in the last digit.
SINE_AND_COSINE = """O1
IF[SIN[30]EQCOS[60]]GOTO20
#3000=1(DIFFERENT)
N20M99
"""
# Each word is up to half an increment off.
INCREMENTAL_STEPS = """O1
(@PARAM #1 0.1..10)
(@MODAL G21 G90)
(@START X0 Y0 Z0)
{}
#2=0
G91
N10WHILE[#2LT10]DO1
G01X#1F100
#2=#2+1
END1
G90
M99
"""
QUARTER_BEYOND = """O1
(@PARAM #24 0..100)
(@MODAL {} G90)
{}
G00X[#24+{}]
M99
"""
PASSES_A_PRODUCT = """O1
(@PARAM #1 0..5)
G65P2A[#1*{}]B0.5C#2
M30
O2
N10#4=SQRT[ABS[#1]+#2+ABS[#3]]
M99
"""
# Words are rounded to the least increment, and the errors add up.
DRIFT = """O1
(@START Z0)
(@PARAM #21 1..100.)
(@PARAM #22 0.5..5.)
(@ENSURE POS[Z] EQ ENTRY[Z]-#21)
#10=FUP[#21/#22]
#11=0
N20WHILE[#11LT#10]DO1
#11=#11+1
G91G01Z-[#21/#10]F100
END1
M99
"""
# A round pocket in turns: the depth of a turn is computed, so that its word is rounded.
POCKET = """O1
(@PARAM #18 1..10. MM)
(@PARAM #4 20.5..100. MM)
(@PARAM #6 1..20. MM)
(@PARAM #22 1..5. MM)
(@MODAL G17 G21 G40 G49 G80 G90)
(@START X0 Y0 Z5.)
(@TOOL FLAT RADIUS #18)
{}
(@KEEPIN WALL CYLINDER AXIS Z AT X0 Y0 RADIUS #4 Z-#6..5.)
(@KEEPOUT FLOOR BOX Z..-#6)
(@CLEARANCE Z5.)
#1=FUP[#6/#22]
#2=#4/2-#18/2
#10=0
G0X-#2Y0
G1Z0F100
WHILE[#10LT#1]DO1
#10=#10+1
{}
G2I#2
END1
G90G0Z5.
M99
"""
DOWN_IN_G90 = "G1Z-[#10*#6/#1]"
DOWN_IN_G91 = "G91G1Z-[#6/#1]\nG90"
SPACE = ("keep-in", "keep-out", "clearance")


class ArithmeticOfTheControl(Scratch):
    def verdicts(self, text, arithmetic, dialect="fanuc-30i", *options):
        self.write("O1.nc", text)
        result = self.feedhold("prove", "--no-cache", "--dialect", dialect, "--isolated", "--format", "json",
                               *({"exact": ["--arithmetic", "exact"], "control": []}[arithmetic]), *options, "O1.nc")
        document = json.loads(result.stdout)
        self.assertEqual(document["arithmetic"], arithmetic)
        return {row["kind"]: row for row in document["files"][0]["obligations"]}

    def in_control(self, text, dialect="fanuc-30i", *options):
        return self.verdicts(text, "control", dialect, *options)

    def in_exact(self, text):
        return self.verdicts(text, "exact")

    def test_eleven_holes_are_drilled(self):
        row = self.in_control(ELEVEN_HOLES)["alarm-unreachable"]
        self.assertEqual(row["verdict"], "refuted")
        self.assertIn("because the control rounds", row["witness"]["happened"])
        # In exact numbers there are ten; a run of the machine says otherwise there, too.
        row = self.in_exact(ELEVEN_HOLES)["alarm-unreachable"]
        self.assertEqual(row["verdict"], "refuted")
        self.assertIn("because the control rounds", row["witness"]["happened"])

    def test_a_loop_that_waits_for_a_sum_never_ends(self):
        self.assertEqual(self.in_exact(NEVER_EQUAL)["loop-ends"]["verdict"], "proved")
        self.assertEqual(self.in_control(NEVER_EQUAL)["loop-ends"]["verdict"], "refuted")

    def test_what_only_exact_numbers_promise_is_unknown(self):
        for text, kind in ((ROOT_OF_A_DIFFERENCE, "no-control-alarm"), (BOLT_CIRCLE, "alarm-unreachable")):
            with self.subTest(text):
                row = self.in_control(text)[kind]
                if row["verdict"] != "refuted":
                    self.assertEqual(row["verdict"], "unknown")
                    self.assertIn("rounding on the control may break it", row["reason"])

    def test_what_a_control_may_break_is_not_proved(self):
        for text, kind in ((SQUARE_AS_POWER, "alarm-unreachable"), (LARGE_WORD, "alarm-unreachable"),
                           (SINE_AND_COSINE, "alarm-unreachable"), (GUARD_OF_WHOLE_NUMBERS, "guarded")):
            with self.subTest(text):
                self.assertIn(self.in_control(text)[kind]["verdict"], ("unknown", "refuted"))

    def test_claims_hold_in_the_number_model_of_the_dialect(self):
        """A sum of decimals is off by more, or by less, in mantissas of 32 bits."""
        for dialect in ("fanuc-0i", "haas-ngc"):
            for text in (ELEVEN_HOLES, BOLT_CIRCLE, SQUARE_AS_POWER):
                with self.subTest(dialect=dialect, text=text):
                    self.assertIn(self.in_control(text, dialect)["alarm-unreachable"]["verdict"], ("unknown", "refuted"))
            with self.subTest(dialect=dialect):
                rows = self.in_control(WHOLE_COUNTER, dialect)
                self.assertEqual({row["verdict"] for row in rows.values()} - {"unreachable"}, {"proved"})

    def test_a_drift_of_incremental_words_is_refuted(self):
        row = self.in_control(DRIFT)["ensures"]
        self.assertEqual(row["verdict"], "refuted")
        self.assertEqual(self.in_exact(DRIFT)["ensures"]["verdict"], "proved")

    def test_a_call_passes_numbers_that_can_be_typed(self):
        claim = "this call passes numbers of at most 8 digits to O2"
        row = self.in_control(PASSES_A_PRODUCT.format("1000000000."))["call-meets-contract"]
        self.assertEqual((row["claim"], row["verdict"]), (claim, "refuted"))
        self.assertIn("#1 is 1000000000 at the call, which nobody can type", row["witness"]["happened"])
        row = self.in_control(PASSES_A_PRODUCT.format("1000."))["call-meets-contract"]
        self.assertEqual((row["claim"], row["verdict"]), (claim, "proved"))
        # Literals need no proof, and exact arithmetic assumes nothing.
        self.assertNotIn("call-meets-contract", self.in_control("O1\nG65P2A1.5B2.\nM30\nO2\n#4=#1+#2\nM99\n"))
        self.assertNotIn("call-meets-contract", self.in_exact(PASSES_A_PRODUCT.format("1000000000.")))

    def test_without_a_contract_only_ordinary_numbers_show_one_that_cannot_be_typed(self):
        row = self.in_control("O1\nG65P2A[#2*1000000000.]\nM99\nO2\nG0X#1\nM99\n")["call-meets-contract"]
        self.assertEqual(row["verdict"], "refuted")
        # 99999999 and more, or the difference of two numbers that are nearly the same.
        self.assertNotIn("call-meets-contract", self.in_control("O1\nG65P2A[#2+1]B[#3*#4]\nM99\nO2\nG0X#1Y#2\nM99\n"))

    def test_sturdy_programs_stay_proved(self):
        for text in (WHOLE_COUNTER, QUARTERS, CLAMPED_PECKS, LEVELS, ROOT_OF_SQUARES):
            with self.subTest(text):
                rows = self.in_control(text)
                self.assertEqual({kind: row["verdict"] for kind, row in rows.items()
                                  if row["verdict"] not in ("proved", "unreachable")}, {})

    def test_drift_is_within_the_tolerance_of_the_contract(self):
        promise = "(@ENSURE POS[X] EQ 10*#1{})"
        for clauses, expected in ((promise.format(""), ("unknown", "refuted")),
                                  ("(@TOLERANCE 0.5)\n" + promise.format(""), ("proved",)),
                                  ("(@TOLERANCE 0.5)\n" + promise.format(" WITHIN 0.002"), ("unknown", "refuted")),
                                  (promise.format(" WITHIN 0.006"), ("proved",))):
            with self.subTest(clauses):
                text = INCREMENTAL_STEPS.format(clauses)
                self.assertIn(self.in_control(text)["ensures"]["verdict"], expected)
                self.assertEqual(self.in_exact(text)["ensures"]["verdict"], "proved")

    def test_drift_depends_on_the_increment_system(self):
        text = INCREMENTAL_STEPS.format("(@ENSURE POS[X] EQ 10*#1 WITHIN 0.002)")
        for system, expected in (("IS-A", ("unknown", "refuted")), ("IS-B", ("unknown", "refuted")),
                                 ("IS-C", ("proved",))):
            with self.subTest(system):
                row = self.in_control(text, "fanuc-30i", "--increment-system", system)["ensures"]
                self.assertIn(row["verdict"], expected)
        text = QUARTER_BEYOND.format("G21", "(@ENSURE POS[X] EQ #24)", .0002)
        for system, expected in (("IS-B", "proved"), ("IS-C", "refuted")):
            with self.subTest(system):
                row = self.in_control(text, "fanuc-30i", "--increment-system", system)["ensures"]
                self.assertEqual(row["verdict"], expected)
        self.assertIn(" --increment-system IS-C", row["witness"]["run"])

    def test_a_stated_tolerance_holds_in_either_arithmetic(self):
        for units, clauses, beyond, exact, control in (
                ("G21", "(@ENSURE POS[X] EQ #24 WITHIN 0.3)", .25, "proved", "proved"),
                ("G21", "(@ENSURE POS[X] EQ #24 WITHIN 0.2)", .25, "refuted", "refuted"),
                ("G21", "(@ENSURE POS[X] NE #24 WITHIN 0.2)", .25, "proved", "proved"),
                ("G21", "(@TOLERANCE 0.3)\n(@ENSURE POS[X] EQ #24)", .25, "proved", "proved"),
                ("G21", "(@TOLERANCE 0.3)\n(@ENSURE POS[X] EQ #24 WITHIN .2)", .25, "refuted", "refuted"),
                # Without one: in exact numbers none, else one least increment of the units.
                ("G21", "(@ENSURE POS[X] EQ #24)", .0002, "refuted", "proved"),
                ("G20", "(@ENSURE POS[X] EQ #24)", .0002, "refuted", "refuted")):
            with self.subTest((units, clauses)):
                text = QUARTER_BEYOND.format(units, clauses, beyond)
                self.assertEqual(self.in_exact(text)["ensures"]["verdict"], exact)
                self.assertEqual(self.in_control(text)["ensures"]["verdict"], control)

    def test_whole_numbers_are_equal_or_not_whatever_the_tolerance(self):
        text = "O1\n(@GLOBAL #510 0..100 INT)\n(@TOLERANCE 0.99)\n(@ENSURE #510 EQ OLD[#510]+{})\n#510=#510+1\nM99\n"
        for rows in (self.in_control, self.in_exact):
            self.assertEqual(rows(text.format(1))["ensures"]["verdict"], "proved")
            self.assertEqual(rows(text.format(2))["ensures"]["verdict"], "refuted")

    def test_a_requirement_within_a_tolerance(self):
        text = "O1\n(@PARAM #1 0..9)\n(@PARAM #2 0..9)\n(@REQUIRE #1 EQ #2 WITHIN 0.5)\n" \
               "IF[#1LE[#2+{}]]GOTO10\n#3000=1(FAR)\nN10M99\n"
        for rows in (self.in_control, self.in_exact):
            self.assertEqual(rows(text.format(.6))["alarm-unreachable"]["verdict"], "unreachable")
            self.assertEqual(rows(text.format(.4))["alarm-unreachable"]["verdict"], "refuted")

    def space_of(self, text, arithmetic="control"):
        self.write("O1.nc", text)
        result = self.feedhold("prove", "--no-cache", "--dialect", "fanuc-30i", "--isolated", "--format", "json",
                               "--arithmetic", arithmetic, "O1.nc")
        return [row for row in json.loads(result.stdout)["files"][0]["obligations"] if row["kind"] in SPACE]

    def test_absolute_movements_keep_to_the_space_within_the_tolerance(self):
        rows = self.space_of(POCKET.format("(@TOLERANCE 0.005)", DOWN_IN_G90))
        self.assertEqual({row["kind"] for row in rows}, set(SPACE))
        self.assertEqual({(row["verdict"], row["exactOnly"], row["tolerance"]) for row in rows}, {("proved", False, 0.005)})

    def test_steps_that_drift_leave_the_space(self):
        text = POCKET.format("", DOWN_IN_G91)
        self.assertEqual({row["verdict"] for row in self.space_of(text, "exact")}, {"proved"})
        for kind, how in (("keep-out", "inside FLOOR"), ("keep-in", "outside WALL")):
            refuted = [row for row in self.space_of(text) if (row["kind"], row["verdict"]) == (kind, "refuted")]
            self.assertTrue(refuted, kind)
            for row in refuted:
                self.assertEqual(row["tolerance"], 0.001)
                self.assertGreater(row["witness"]["gouge"]["depth"], 0.001)
                self.assertIn(how, row["witness"]["happened"])
                self.assertIn("because the control rounds", row["witness"]["happened"])

    def test_a_gouge_within_the_tolerance_is_none(self):
        text = "O1\n(@PARAM #1 0..5.)\n(@MODAL G21 G40 G49 G90)\n(@START Z5.)\n(@TOOL FLAT RADIUS 1)\n{}" \
               "(@KEEPOUT FLOOR BOX Z..-#1)\nG1Z-[#1+.004]F100\nM99\n"
        for clause, expected in (("", "refuted"), ("(@TOLERANCE 0.003)\n", "refuted"), ("(@TOLERANCE 0.006)\n", "proved")):
            with self.subTest(clause):
                self.assertEqual([row["verdict"] for row in self.space_of(text.format(clause))], [expected])
                self.assertEqual([row["verdict"] for row in self.space_of(text.format(clause), "exact")], ["refuted"])

    def test_the_evidence_is_of_exact_proofs(self):
        self.write("O1.nc", WHOLE_COUNTER)
        result = self.feedhold("prove", "--arithmetic", "control", "--certificate", "out", "O1.nc")
        self.assertExit(result, 2)


if __name__ == "__main__":
    unittest.main()
