"""`@ALLOW` in files beside a program: as good as a comment, and the program keeps its bytes."""
import json
import unittest

from harness import Scratch

TWO = """O9100
N10 #510-#6
N20 #511-#6
N30 #512-#6
M99
O9101
#513-#6
M99
"""
RULE = "missing-equals"


class SidecarAllow(Scratch):
    def setUp(self):
        super().setUp()
        self.program = self.write("part.nc", TWO)

    def reported(self, *arguments):
        result = self.check("--format", "json", *arguments)
        return json.loads(result.stdout)["findings"]

    def lines(self, clause, file="O9100.contract"):
        """The lines of the program in which something is reported still."""
        self.write(file, clause + "\n")
        rows = self.reported("--select", f"{RULE},suppression,contract")
        self.assertEqual([row for row in rows if row["rule"] != RULE], [])
        return [row["line"] for row in rows]

    def complaints(self, clause):
        self.write("O9100.contract", clause + "\n")
        return [row for row in self.reported("--select", f"{RULE},suppression,contract") if row["rule"] != RULE]

    def test_for_the_program(self):
        self.assertEqual([row["line"] for row in self.reported("--select", RULE)], [2, 3, 4, 7])
        self.assertEqual(self.lines(f"@ALLOW {RULE} THE SHOP WRITES SO"), [7])
        self.assertEqual(self.lines(f"@allow {RULE.upper()} small letters  ; a remark"), [7])
        self.assertEqual(self.lines(f"(@ALLOW-PROGRAM {RULE} AS A COMMENT)"), [7])
        (self.folder / "O9100.contract").unlink()
        self.assertEqual(self.lines(f"@ALLOW {RULE} SO", "part.contract"), [7])
        self.assertEqual(self.program.read_text(), TWO)

    def test_for_a_place(self):
        self.assertEqual(self.lines(f"@ALLOW {RULE} N20 MEANT"), [2, 4, 7])
        self.assertEqual(self.lines(f"@ALLOW {RULE} N10..N20 MEANT"), [4, 7])
        self.assertEqual(self.lines(f"@ALLOW {RULE} N20.. MEANT"), [2, 7])
        self.assertEqual(self.lines(f"@ALLOW {RULE} O9101 MEANT"), [2, 3, 4])
        self.assertEqual(self.lines(f"@ALLOW {RULE} O9101 IN THE OTHER\n@ALLOW {RULE} N20 AND HERE"), [2, 4])
        self.assertEqual(self.lines(f"@ALLOW {RULE} NONE OF IT IS WRONG"), [7])

    def test_place_survives_edits(self):
        self.program.write_text("(NEW HEAD)\n" + TWO.replace("N20", "G04 X1.\nN20"))
        self.assertEqual(self.lines(f"@ALLOW {RULE} N20 MEANT"), [3, 6, 9])

    def test_reason_and_file_in_the_outputs(self):
        self.write("O9100.contract", f"@ALLOW {RULE} N20 LEGACY \u00b5 STYLE\n")
        self.program.write_text(TWO.replace("#510-#6", f"#510-#6(@ALLOW {RULE} IN A COMMENT)"))
        rows = self.reported("--select", RULE, "--show-suppressed")
        self.assertEqual([(row.get("suppressed"), row.get("reason"), row.get("allowedIn")) for row in rows],
                         [(True, "IN A COMMENT", "part.nc"), (True, "LEGACY \u00b5 STYLE", "O9100.contract"),
                          (None, None, None), (None, None, None)])
        sarif = json.loads(self.check("--select", RULE, "--show-suppressed", "--format", "sarif").stdout)
        self.assertEqual([row.get("suppressions") for row in sarif["runs"][0]["results"]],
                         [[{"kind": "inSource", "justification": "IN A COMMENT"}],
                          [{"kind": "external", "justification": "LEGACY \u00b5 STYLE"}], None, None])

    def test_what_is_wrong_with_it(self):
        for clause, rule, words in (
                (f"@ALLOW {RULE} N40 GONE", "unused-suppression", "no block N40 in O9100"),
                (f"@ALLOW {RULE} N30..N10 BACKWARDS", "unused-suppression", "no block N10 in O9100"),
                (f"@ALLOW {RULE} O9102 GONE", "unused-suppression", "no program O9102"),
                (f"@ALLOW {RULE} O9101 N10 GONE", "unused-suppression", "no block N10 in O9101"),
                (f"@ALLOW {RULE} N20", "suppression-without-reason", "without a reason"),
                ("@ALLOW missing-equal N20 TYPO", "unknown-suppressed-rule", "missing-equal"),
                ("@ALLOW", "unknown-suppressed-rule", "names no rule"),
                (f"@AT N20 ALLOW {RULE} OTHER ORDER", "malformed-contract-clause", "@AT")):
            with self.subTest(clause=clause):
                [row] = self.complaints("; head\n" + clause)
                self.assertEqual((row["path"], row["rule"], row["line"]), ("O9100.contract", rule, 2))
                self.assertIn(words, row["message"] + "".join(row["notes"]))
                self.assertEqual(row["fixes"], [])
        self.write("part.nc", TWO.replace("N20 #511-#6", "N20 #511=#6"))
        [row] = self.complaints(f"@ALLOW {RULE} N20 REPAIRED MEANWHILE")
        self.assertEqual((row["rule"], row["path"]), ("unused-suppression", "O9100.contract"))

    def test_file_that_two_programs_share(self):
        self.write("part.nc", "O9100\nN10 #510-#6\nN20 #511=#6\nM99\n")
        self.write("old.nc", "O9100\nN10 #510=#6\nN20 #511=#6\nM99\n")
        rows = self.complaints(f"@ALLOW {RULE} N10 IN ONE OF THEM\n@ALLOW {RULE} N20 IN NONE")
        self.assertEqual([(row["path"], row["line"]) for row in rows], [("O9100.contract", 2)])

    def test_exit_code_and_fix(self):
        self.write("part.nc", "O9100\n#510-[0]\nM30\n")
        self.assertExit(self.check("--select", RULE), 1)
        self.write("O9100.contract", f"@ALLOW {RULE} FROZEN\n")
        self.assertExit(self.check("--select", RULE), 0)
        self.check("--select", RULE, "--fix", "--unsafe-fixes")
        self.assertEqual((self.folder / "part.nc").read_text(), "O9100\n#510-[0]\nM30\n")

    def test_contract_is_proved_all_the_same(self):
        self.write("part.nc", "O9100\nN10 #10=#21/#22\nM99\n")
        self.write("O9100.contract", "@PARAM #21 0..5.\n@PARAM #22 0.1..20.\n@ALLOW dead-store N10 KEPT FOR THE SETTER\n")
        self.assertExit(self.feedhold("prove", "--dialect", "fanuc-30i", "part.nc"), 0)


if __name__ == "__main__":
    unittest.main()
