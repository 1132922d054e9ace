"""`feedhold draft`: what it writes, what it leaves alone, and that check and prove accept it."""
import unittest

from harness import Scratch

MACRO = """O9100(POCKET)
(X - LENGTH, MM)
IF[#24EQ#0]GOTO91
IF[#24LT10]GOTO91
IF[#24GT200]GOTO91
IF[#18GE#24]GOTO92
IF[[FIX[#11]]NE#11]GOTO92
IF[#9EQ#0]THEN#9=250
IF[#9LT1]GOTO92
IF[#2EQ0]GOTO5
IF[#2EQ1]GOTO5
GOTO92
N5G90G01Z-#18F#9
G01X#24
#130=#24*2
M99
N91#3000=21(LENGTH)
N92#3000=22(OTHERS)
"""
NO_GUARD = """O9101
#10=0
N1WHILE[#10LT#21]DO1
#10=#10+#22
END1
M99
"""
POLLING = """O9102
N1IF[#190EQ3]GOTO2
IF[#190EQ4]GOTO9
G04P500
GOTO1
N2M99
N9#3000=31(NO ANSWER)
"""


class Draft(Scratch):
    def draft(self, *arguments):
        return self.feedhold("draft", "--dialect", "fanuc-30i", *arguments)

    def clauses(self, name):
        lines = (self.folder / name).read_text().splitlines()
        return [line.split(";")[0].strip() for line in lines if line.split(";")[0].strip()]

    def test_guards(self):
        self.write("O9100.nc", MACRO)
        self.assertExit(self.draft("O9100.nc"), 0)
        clauses = self.clauses("O9100.contract")
        for clause in ["@PARAM #2 IN 0,1", "@PARAM #9 1.. OPTIONAL", "@PARAM #11 VALUE INT", "@PARAM #24 LENGTH 10..200 MM",
                       "@REQUIRE #18 LT #24", "@ENSURE #130 EQ [#24*2]", "@ASSIGNS #130"]:
            self.assertIn(clause, clauses)

    def test_accepted(self):
        self.write("O9100.nc", MACRO)
        self.draft("O9100.nc")
        self.assertNotIn("O9100.contract", self.check("--dialect", "fanuc-30i", "--select", "contract", ".").stdout)
        proved = self.feedhold("prove", "--dialect", "fanuc-30i", "--no-cache", "O9100.nc")
        self.assertExit(proved, 0)

    def test_conditions_that_a_proof_needs(self):
        self.write("O9101.nc", NO_GUARD)
        result = self.draft("O9101.nc")
        self.assertIn("@REQUIRE #22 GE 0.001", self.clauses("O9101.contract"))
        self.assertRegex(result.stdout, r"O9101 +0 of 2 +2 of 2")

    def test_guarded(self):
        self.write("O9105.nc", "O9105\nIF[#7LE0]GOTO9\nG90G01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n")
        self.draft("O9105.nc")
        self.assertIn("@GUARDED", self.clauses("O9105.contract"))

    def test_order_with_a_vacant_variable(self):
        self.write("O9106.nc", "O9106\nIF[#7LT#0]GOTO9\nG90G01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n")
        self.draft("O9106.nc")
        self.assertIn("@PARAM #7 0.. OPTIONAL", self.clauses("O9106.contract"))

    def test_polling_is_no_guard(self):
        self.write("O9102.nc", POLLING)
        self.draft("O9102.nc")
        path = self.folder / "O9102.contract"
        self.assertNotIn("#190", path.read_text() if path.exists() else "")

    def test_modes_of_callers(self):
        self.write("O9103.nc", "O9103\nG00X#24\nM99\n")
        self.write("O1.nc", "O1\nG90G54\nG65P9103X5.\nM30\n")
        self.draft("O9103.nc")
        self.assertIn("@MODAL G90", self.clauses("O9103.contract"))
        self.write("O2.nc", "O2\nG91G54\nG65P9103X5.\nM30\n")
        self.draft("--update", "O9103.nc")
        self.assertNotIn("@MODAL G90", self.clauses("O9103.contract"))
        self.assertIn("; suggested: @MODAL G90", (self.folder / "O9103.contract").read_text())

    # ---- what is there ----

    def test_contracts_are_left_alone(self):
        self.write("O9100.nc", MACRO)
        own = "@PARAM #24 LENGTH 20..100\n"
        path = self.write("O9100.contract", own)
        result = self.draft("O9100.nc")
        self.assertExit(result, 0)
        self.assertIn("`--update`", result.stdout)
        self.assertEqual(path.read_text(), own)
        self.write("O9101.nc", NO_GUARD.replace("#10=0", "(@PARAM #22 0.5..)\n#10=0"))
        self.draft("O9101.nc")
        self.assertFalse((self.folder / "O9101.contract").exists())

    def test_update(self):
        self.write("O9100.nc", MACRO)
        self.draft("O9100.nc")
        path = self.folder / "O9100.contract"
        drafted = path.read_text()
        self.draft("--update", "O9100.nc")
        self.assertEqual(path.read_text(), drafted)
        own = "@PARAM #24 LENGTH 20..100 ; ours\n"
        path.write_text(own + drafted)
        self.draft("--update", "O9100.nc")
        self.assertTrue(path.read_text().startswith(own))
        self.assertEqual([clause for clause in self.clauses("O9100.contract") if "#24 " in clause and "PARAM" in clause],
                         ["@PARAM #24 LENGTH 20..100"])

    def test_nothing_is_written(self):
        self.write("O9100.nc", MACRO)
        shown = self.draft("--stdout", "O9100.nc")
        self.assertExit(shown, 0)
        self.assertIn("@ASSIGNS #130", shown.stdout)
        self.assertExit(self.draft("--diff", "O9100.nc"), 1)
        self.assertFalse((self.folder / "O9100.contract").exists())

    def test_numbers_given_twice(self):
        self.write("a.nc", MACRO)
        self.write("b.nc", MACRO)
        self.draft("a.nc")
        self.assertTrue((self.folder / "a.nc.contract").exists())


if __name__ == "__main__":
    unittest.main()
