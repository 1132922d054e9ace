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
STARTED = """O0001(MAIN)
IF[#501LE0]GOTO91
IF[#503EQ#0]GOTO92
IF[#501GT80]GOTO91
IF[#503GT9]GOTO92
G90G54G00X0Y0
M30
N91#3000=11(DIAMETER)
N92#3000=12(PASSES)
"""
SETTINGS = """O8000(SETTINGS)
#501=12.(CUTTER DIAMETER, MM)
#502=0.5(STEP)
M99
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

    def test_guarded_but_for_the_modes(self):
        self.write("O9105.nc", "O9105\nIF[#7LE0]GOTO9\nG01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n")
        self.write("O0001.nc", "O0001\nG90G54\nG65P9105D5.\nM30\n")
        self.draft("O9105.nc")
        clauses = self.clauses("O9105.contract")
        self.assertIn("@MODAL G90", clauses)
        self.assertIn("@GUARDED EXCEPT MODAL", clauses)

    def test_order_with_a_vacant_variable(self):
        self.write("O9106.nc", "O9106\nIF[#7LT#0]GOTO9\nG90G01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n")
        self.draft("O9106.nc")
        self.assertIn("@PARAM #7 0.. OPTIONAL", self.clauses("O9106.contract"))

    def test_every_clause_from_a_guard_is_needed(self):
        """Without it the contract allows a call that raises the alarm."""
        self.write("O9100.nc", MACRO)
        self.draft("O9100.nc")
        path = self.folder / "O9100.contract"
        lines = path.read_text().splitlines(keepends=True)
        guards = [line for line in lines if "otherwise alarm" in line]
        self.assertEqual(len(guards), 5)
        for guard in guards:
            path.write_text("".join(line for line in lines if line != guard))
            proved = self.feedhold("prove", "--dialect", "fanuc-30i", "--no-cache", "--only", "alarm-unreachable",
                                   "O9100.nc")
            with self.subTest(guard):
                self.assertExit(proved, 1)

    def test_a_limit_that_a_vacant_variable_fails(self):
        self.write("O9107.nc", "O9107\n(M - GROOVE POSITION)\nIF[#13LT#0]GOTO9\nIF[#13LE1]GOTO9\nIF[#660EQ#0]GOTO9\n"
                               "IF[#660LE10]GOTO9\nG90G01Z-#13F#660\nM99\nN9#3000=41\n")
        self.draft("O9107.nc")
        clauses = self.clauses("O9107.contract")
        for clause in ["@PARAM #13 GROOVE-POSITION", "@REQUIRE #13 GT 1", "@REQUIRE #660 GT 10"]:
            self.assertIn(clause, clauses)
        self.assertNotIn("@GLOBAL #660", clauses)

    def test_nothing_is_promised_where_no_call_returns(self):
        self.write("O9108.nc", "O9108\nIF[#7LE0]GOTO9\n#1=1/0\nG90G01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n")
        self.draft("O9108.nc")
        for clause in self.clauses("O9108.contract"):
            self.assertNotRegex(clause, "@ENSURE|@GUARDED")

    def test_names(self):
        self.write("O9109.nc", "O9109\n(A - TYPE: 0 FACE, 1 POCKET)\n(B - X WIDTH OF RAW STOCK)\n(C - A-SIDE WALL)\n"
                               "IF[#1LT1]GOTO9\nIF[#2LT2]GOTO9\nIF[#3LT3]GOTO9\nIF[#25LT4]GOTO9\nG90G01X#1Y#25F100\n"
                               "(Y: BACK TO THE ORIGIN)\nM99\nN9#3000=41\n")
        self.draft("O9109.nc")
        self.assertEqual([clause for clause in self.clauses("O9109.contract") if "@PARAM" in clause],
                         ["@PARAM #1 TYPE 1..", "@PARAM #2 X-WIDTH-RAW-STOCK 2..", "@PARAM #3 A-SIDE-WALL 3..",
                          "@PARAM #25 4.."])

    # ---- programs that are started ----

    def test_alarms_of_a_program_that_is_started(self):
        """The order of the guards decides which alarm is raised."""
        self.write("O0001.nc", STARTED)
        self.draft("O0001.nc")
        self.assertEqual(self.clauses("O0001.contract"),
                         ["@ALARM 11 IFF [#501 LE 0] OR [[#503 NE #0] AND [#501 GT 80]]",
                          "@ALARM 12 IFF [#501 GT 0] AND [[#503 EQ #0] OR [[#501 LE 80] AND [#503 GT 9]]]"])
        self.assertExit(self.feedhold("prove", "--dialect", "fanuc-30i", "--no-cache", "O0001.nc"), 0)

    def test_alarms_that_a_contract_excludes(self):
        self.write("O9100.nc", MACRO)
        self.write("O0002.nc", STARTED.replace("O0001", "O0002"))
        self.write("O0003.nc", "O3\nM98P0002\nM30\n")
        self.draft("O9100.nc", "O0002.nc")
        for name in ["O9100.contract", "O0002.contract"]:
            self.assertNotIn("@ALARM", (self.folder / name).read_text())

    # ---- settings and space ----

    def test_settings(self):
        """A value that a proof needs is a clause; others are suggested."""
        self.write("O8000.nc", SETTINGS)
        self.write("O9200.nc", "O9200\n#10=#24\nN1WHILE[#10GT0]DO1\n#10=#10-#502\nG90G01X#10Y#501F200\nEND1\nM99\n")
        self.draft("O9200.nc")
        self.assertIn("@GLOBAL #502 STEP IN 0.5", self.clauses("O9200.contract"))
        self.assertIn("; suggested: @GLOBAL #501 CUTTER-DIAMETER IN 12 MM ; O8000 sets it (line 2)",
                      (self.folder / "O9200.contract").read_text())

    def test_settings_that_change(self):
        self.write("O8000.nc", SETTINGS)
        self.write("O8001.nc", SETTINGS.replace("O8000", "O8001"))
        self.write("O9201.nc", "O9201\nG90G01X[#501+#502]F200\nM99\n")
        self.assertNotIn("IN 12", self.draft("--stdout", "O9201.nc").stdout)

    def test_tool_and_region(self):
        text = "O9300\n(D - CUTTER DIAMETER)\nIF[#7LE0]GOTO9\nG90G00X0Y0\nZ5.\nG01Z-2.F200\nX80.\nM99\nN9#3000=11\n"
        self.write("O9300.nc", text)
        drafted = self.draft("--stdout", "O9300.nc").stdout
        self.assertIn("; suggested: @TOOL FLAT RADIUS [#7/2]", drafted)
        self.assertIn("; suggested: @KEEPIN CUT BOX X[0-#7/2]..[80+#7/2] Y[0-#7/2]..[0+#7/2] Z-2..", drafted)
        for other in [text.replace("G01Z", "G01G41D1Z"), text.replace("X80.", "G02X80.R40."), text.replace("X80.", "X#24")]:
            self.write("O9300.nc", other)
            self.assertNotIn("@KEEPIN", self.draft("--stdout", "O9300.nc").stdout)
        self.write("O9300.nc", text.replace("CUTTER DIAMETER", "TOOL OFFSET NUMBER"))
        self.assertNotIn("@TOOL", self.draft("--stdout", "O9300.nc").stdout)

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
