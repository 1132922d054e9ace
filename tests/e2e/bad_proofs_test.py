"""What cannot be proved for a reason of its own is told with that reason, and never proved."""
import json
import shutil
import unittest

from harness import ROOT, Scratch

NEEDS_TWO_SOLVERS = ROOT / "corpus/packages/mould-entry/O9115.nc"
LOOP = """#10=#1
N20 WHILE[#10GT0]DO1
#10=#10-1
END1
N30 #11=1/#1
IF[#1EQ7]GOTO90
M99
N90#3000=1(SEVEN)
"""


class BadProofs(Scratch):
    def prove(self, *arguments, **options):
        return self.feedhold("prove", "--dialect", "fanuc-30i", "--isolated", *arguments, **options)

    def obligations(self, *arguments, **options):
        report = json.loads(self.prove("--format", "json", *arguments, **options).stdout)
        return {row["id"]: row for file in report["files"] for row in file["obligations"]}

    def assertNothingProved(self, obligations):
        self.assertTrue(obligations)
        for row in obligations.values():
            self.assertIn(row["verdict"], ("unknown", "refuted"), row["id"])
            self.assertTrue(row["reason"] or row["witness"], row["id"])

    # ---- contracts ----

    def test_contract_that_no_call_satisfies(self):
        clauses = ("(@PARAM #1 COUNT 5..10)\n(@REQUIRE #1 LT 3)\n(@ENSURE POS[Z] EQ 1)\n(@ENSURE MODAL PRESERVED)\n"
                   "(@ASSIGNS NOTHING)\n(@ALARM 1 IFF #1 EQ 7)\n(@GUARDED)\n")
        self.write("O1.nc", "O1\n" + clauses + LOOP)
        result = self.prove("O1.nc")
        self.assertExit(result, 1)
        self.assertIn("refuted: no call satisfies this contract [O1.contract-satisfiable", result.stdout)
        self.assertIn("its clauses contradict each other", result.stdout)
        self.assertNothingProved(self.obligations("O1.nc"))
        for kind in ("loop-ends", "ensures", "assigns", "alarm-iff", "alarm-unreachable", "guarded"):
            with self.subTest(kind=kind):
                self.assertNothingProved(self.obligations("--only", kind, "O1.nc"))

    def test_empty_range(self):
        self.assertRefused("(@PARAM #1 COUNT 10..5)")

    def test_variable_that_is_never_read(self):
        self.assertRefused("(@PARAM #1 COUNT 1..9)\n(@PARAM #5 NOBODY 1..2)")

    def test_unit_that_does_not_fit(self):
        self.assertRefused("(@PARAM #1 COUNT 1..9)\n(@PARAM #9 FEED 1..5000 FURLONG)")

    def test_clause_that_is_none(self):
        self.assertRefused("(@PARAM #1 COUNT 1..9)\n(@REQUIER #1 GT 2)")

    def assertRefused(self, clauses):
        """Nothing is told of that program; of the others everything."""
        self.write("both.nc", f"O1\n{clauses}\n{LOOP}O2\n#1=1\nM30\n")
        result = self.prove("both.nc")
        self.assertExit(result, 2)
        self.assertIn("both.nc: the contract of O1 has errors, so nothing is proved", result.stderr)
        self.assertEqual(set(self.obligations("both.nc")), {"O2.program-ends"})
        self.assertRegex(self.check("both.nc").stdout, r"contract[a-z-]*\]\n --> both.nc:[23]:")

    def test_sidecar_that_is_no_text(self):
        self.write("O1.nc", "O1\n" + LOOP)
        self.write("O1.contract", bytes(range(256)))
        result = self.prove("O1.nc")
        self.assertExit(result, 2)
        self.assertEqual(self.obligations("O1.nc"), {})

    # ---- solvers ----

    def test_missing_solver(self):
        shutil.copy(NEEDS_TWO_SOLVERS, self.folder / "O9115.nc")
        nowhere = {"PATH": str(self.folder)}
        row = self.obligations("--arithmetic", "exact", "O9115.nc", environment=nowhere)["O9115.ensures.L2"]
        self.assertEqual((row["verdict"], row["grade"]), ("unknown", None))
        self.assertIn("Z3 found a proof that cvc5 did not confirm: the program `cvc5` is not installed", row["reason"])
        self.assertIn("`cvc5` is not installed",
                      self.prove("--arithmetic", "exact", "O9115.nc", environment=nowhere).stdout)

    def test_solver_that_lies(self):
        shutil.copy(NEEDS_TWO_SOLVERS, self.folder / "O9115.nc")
        for words in ("echo sat", "echo unsat; exit 1", "echo '(error \"no\")'", "kill -9 $$", "echo unsat; echo more"):
            with self.subTest(words=words):
                self.write("bin/cvc5", f"#!/bin/sh\n{words}\n").chmod(0o755)
                path = {"PATH": f"{self.folder / 'bin'}:/usr/bin:/bin"}
                row = self.obligations("--no-cache", "O9115.nc", environment=path)["O9115.ensures.L2"]
                self.assertEqual(row["verdict"], "unknown")

    # ---- programs ----

    def test_block_that_cannot_be_read(self):
        self.write("O1.nc", "O1\n#1=5\n#2=[[3+\nN30 #3=1/#1\nN40 IF[#1NE5]GOTO90\nM30\nN90#3000=1(CHANGED)\n")
        rows = self.obligations("O1.nc")
        for identity in ("O1.no-control-alarm.N30", "O1.alarm-unreachable.N90"):
            self.assertIn(rows[identity]["verdict"], ("unknown", "refuted"), identity)
        [program] = json.loads(self.prove("--format", "json", "O1.nc").stdout)["files"][0]["programs"]
        self.assertTrue(program["unmodelled"] or program["incomplete"])

    def test_model_that_does_not_replay(self):
        """In exact numbers the square of the root of 2 is 2; the machine computes in doubles and gets another number."""
        self.write("O1.nc", "O1\n#1=SQRT[2]\nIF[#1*#1EQ2]GOTO90\nM30\nN90#3000=1(EXACT)\n")
        row = self.obligations("--arithmetic", "exact", "O1.nc")["O1.alarm-unreachable.N90"]
        self.assertEqual((row["verdict"], row["witness"]), ("unknown", None))
        self.assertIn("the solver's counterexample did not reproduce on the machine", row["reason"])

    def test_too_many_ways(self):
        blocks = "".join(f"IF[#{100 + i}EQ1]GOTO{i + 1}\n#{200 + i}=SIN[#{100 + i}]\nN{i + 1}\n" for i in range(60))
        self.write("O1.nc", f"O1\n{blocks}N900 #1=1/#2\nM30\n")
        result = self.prove("O1.nc")
        self.assertIn(result.returncode, (1, 3))
        self.assertNotIn("proved      certified    line  182", result.stdout)

    def test_calls_without_end(self):
        self.write("O1.nc", "O1\nM98P2\nM30\n")
        self.write("O2.nc", "O2\nM98P1\nM99\n")
        result = self.prove()
        self.assertIn(result.returncode, (1, 3))

    def test_other_files_are_proved(self):
        self.write("O1.nc", "O1\n(@PARM #1)\nM30\n")
        self.write("O2.nc", "O2\nM30\n")
        self.write("O3.nc", bytes(range(256)))
        result = self.prove("O1.nc", "O2.nc", "O3.nc", "gone.nc")
        self.assertExit(result, 2)
        self.assertIn("O2.nc: O2: 1 proved", result.stdout)
        self.assertIn("gone.nc", result.stderr)


if __name__ == "__main__":
    unittest.main()
