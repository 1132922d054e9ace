"""`feedhold prove`: exit codes, the text, JSON against its schema, witnesses that the machine replays."""
import json
import shlex
import shutil
import unittest

import jsonschema

from harness import ROOT, Scratch

SCHEMA = json.loads((ROOT / "docs" / "schemas" / "prove.schema.json").read_text())

COUNTS = """O1
#1=3
N20 WHILE[#1GT0]DO1
#1=#1-1
END1
M30
"""
DIVIDES = """O9100(PECK)
N10 #10=#21/#22
M99
"""
UNKNOWN = """O3
#1=SIN[#2]
IF[#1EQ.7]GOTO90
M30
N90#3000=1(EXACT)
"""
WAITS = """O3
N10 WHILE[#1000EQ0]DO1
END1
M30
"""
MISSING = """O5
G65P9832X10.
#10=#21/#22
M30
"""
ENDLESS = """O4
N10 #2=1
IF[#500GT3]GOTO10
M30
"""

COMPENSATED = """O7
(@PARAM #18 TOOL 1..8. MM)
(@MODAL G17 G21 G90 G40)
(@START X0 Y0 Z0)
(@TOOL FLAT RADIUS #18)
(@KEEPOUT CLAMP BOX X20..40 Y9..20 Z-10..10)
(@TRAVEL X0..60 Y0..6)
(@ALARM 7 IFF #18 GT 4)
N10 G01 G41 D1 X10. F100.
N20 X60.
N30 Y6.
N40 X30.
N50 G40 Y0
IF[#18GT4]THEN#3000=7(BIG)
M99
"""


class Prove(Scratch):
    def prove(self, *arguments):
        return self.feedhold("prove", "--dialect", "fanuc-30i", "--isolated", *arguments)

    def report(self, *arguments):
        result = self.prove("--format", "json", *arguments)
        report = json.loads(result.stdout)
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        jsonschema.validate(report, SCHEMA)
        return report

    def obligations(self, *arguments):
        return [row for file in self.report(*arguments)["files"] for row in file["obligations"]]

    def one(self, identity, *arguments):
        [row] = [row for row in self.obligations(*arguments) if row["id"] == identity]
        return row

    def test_statistics(self):
        self.write("O1.nc", COUNTS)
        self.write("O3.nc", UNKNOWN)
        self.write("O9100.nc", DIVIDES)
        rows = self.obligations()
        result = self.prove("--statistics")
        self.assertExit(result, 1)
        kinds, methods = ([line.split() for line in part.splitlines()[1:]] for part in result.stdout.split("\n\n"))
        verdicts = ("proved", "refuted", "unknown", "unreachable")
        self.assertEqual({words[0]: tuple(map(int, words[1:5])) for words in kinds},
                         {kind: tuple(sum(row["kind"] == kind and row["verdict"] == verdict for row in rows)
                                      for verdict in verdicts) for kind in {row["kind"] for row in rows}})
        methods = [words for words in methods if words and words[-1].isdigit() and words[-2].isdigit()]
        self.assertEqual(sum(int(words[-2]) for words in methods), len(rows))
        self.assertEqual(sum(int(words[-1]) for words in methods), sum(int(words[5]) for words in kinds))

    # ---- exit codes ----

    def test_all_proved(self):
        self.write("O1.nc", COUNTS)
        self.assertExit(self.prove("O1.nc"), 0)

    def test_something_refuted(self):
        self.write("O1.nc", COUNTS)
        self.write("O3.nc", UNKNOWN)
        self.write("O9100.nc", DIVIDES)
        self.assertExit(self.prove(), 1)

    def test_something_unknown(self):
        self.write("O1.nc", COUNTS)
        self.write("O3.nc", UNKNOWN)
        self.assertExit(self.prove(), 3)

    def test_could_not_run(self):
        self.write("O1.nc", COUNTS)
        for words in (["missing.nc"], ["--only", "nothing", "O1.nc"], ["--dialect", "abacus"], ["--format", "xml"],
                      ["--config", "missing.toml", "O1.nc"]):
            with self.subTest(words=words):
                self.assertExit(self.feedhold("prove", *words), 2)
        self.write("picture.nc", bytes(range(256)))
        self.assertExit(self.prove("picture.nc"), 2)

    def test_contract_with_a_mistake_is_not_passed_over(self):
        self.write("O1.nc", COUNTS.replace("O1\n", "O1\n(@PARM #1 DEPTH 1..2)\n"))
        result = self.prove("O1.nc")
        self.assertExit(result, 2)
        self.assertIn("the contract of O1 has errors", result.stderr)

    # ---- which programs ----

    def test_every_program_of_every_file(self):
        self.write("both.nc", COUNTS + DIVIDES)
        self.write("below/O4.nc", ENDLESS)
        files = self.report()["files"]
        self.assertEqual([file["path"] for file in files], ["below/O4.nc", "both.nc"])
        self.assertEqual([program["name"] for program in files[1]["programs"]], ["O1", "O9100"])

    def test_only(self):
        self.write("both.nc", COUNTS + DIVIDES)
        kinds = {row["kind"] for row in self.obligations("--only", "loop-ends", "--only", "no-control-alarm")}
        self.assertEqual(kinds, {"loop-ends", "no-control-alarm"})

    def test_threads_change_nothing(self):
        for name, text in (("O1", COUNTS), ("O3", UNKNOWN), ("O4", ENDLESS), ("O9100", DIVIDES)):
            self.write(f"{name}.nc", text)
        self.assertEqual(self.prove("--no-cache", "--jobs", "1").stdout,
                         self.prove("--no-cache", "--jobs", "4").stdout)

    # ---- verdicts ----

    def test_loop_that_ends(self):
        self.write("O1.nc", COUNTS)
        row = self.one("O1.loop-ends.N20", "O1.nc")
        self.assertEqual((row["verdict"], row["grade"], row["line"], row["column"]), ("proved", "certified", 3, 1))

    def test_passes_at_most(self):
        loops = {
            "#10=FUP[ABS[#21/#22]]\nN20 WHILE[#10GT0]DO1\n#10=#10-1\nEND1": "FUP[ABS[#21/#22]]",
            "#1=0\nN20 WHILE[#1LE#21]DO1\n#1=#1+#22\nEND1": "FIX[#21/#22+1]",
            "#1=0\nN20 #1=#1+#22\nIF[#1LT#21]GOTO20": "FUP[#21/#22]",
            "#5=10\nN20 #5=#5-0.25\nIF[#5NE0]GOTO20": "40",
        }
        for loop, bound in loops.items():
            with self.subTest(loop=loop):
                clauses = "".join(f"(@PARAM #{number} {span})\n" for number, span in ((21, "1..9."), (22, "0.1..2."))
                                  if f"#{number}" in loop)
                self.write("O9.nc", f"O9\n{clauses}{loop}\nM99\n")
                self.assertEqual(self.one("O9.loop-ends.N20", "--arithmetic", "exact", "O9.nc")["bound"], bound)

    def test_why_a_loop_ends(self):
        self.write("O1.nc", COUNTS)
        self.assertIn("at most `3` iterations: `#1` falls by `1` at every iteration, and the loop stops at `0`\n",
                      self.prove("O1.nc").stdout)

    def test_loop_that_may_wait_for_ever(self):
        self.write("O3.nc", WAITS)
        row = self.one("O3.loop-ends.N10", "O3.nc")
        self.assertEqual((row["verdict"], row["witness"]["call"]), ("refuted", "G65 P3"))

    def test_contract_makes_the_proof(self):
        self.write("O9100.nc", DIVIDES.replace("(PECK)\n", "(PECK)\n(@PARAM #22 STEP 0.5..20. MM)\n"))
        self.assertEqual(self.one("O9100.no-control-alarm.N10", "O9100.nc")["verdict"], "proved")
        self.write("O9100.nc", DIVIDES)
        self.write("O9100.contract", "@PARAM #22 STEP 0.5..20. MM\n")
        self.assertEqual(self.one("O9100.no-control-alarm.N10", "O9100.nc")["verdict"], "proved")

    def test_call_breaks_the_contract_of_what_it_calls(self):
        self.write("C.nc", "O1\n(@PARAM #1 0..20)\nG65P2A[#1/2]\nG65P2A#1\nM99\nO2\n(@PARAM #1 0..10)\nM99\n")
        rows = [row for row in self.obligations("C.nc") if row["kind"] == "call-meets-contract"]
        self.assertEqual([(row["line"], row["verdict"]) for row in rows], [(3, "proved"), (4, "refuted")])
        self.assertGreater(float(rows[1]["witness"]["call"].rpartition("A")[2]), 10)

    def test_promise_that_is_not_kept(self):
        self.write("P.nc", "O1\n(@PARAM #1 0..10)\n(@ENSURE #100 EQ #1*2)\n#100=#1*2+1\nM99\n")
        row = self.one("O1.ensures.L1", "P.nc")
        self.assertEqual(row["verdict"], "refuted")

    def test_witness_starts_as_the_contract_says(self):
        program = "O1\n%sIF[#4003EQ91]GOTO90\nM99\nN90#3000=1(INCREMENTAL)\n"
        self.write("A.nc", program % "(@MODAL G90)\n")
        self.write("I.nc", program % "(@MODAL G91)\n")
        self.assertIn(self.one("O1.alarm-unreachable.N90", "A.nc")["verdict"], ("proved", "unreachable"))
        self.assertEqual(self.one("O1.alarm-unreachable.N90", "I.nc")["verdict"], "refuted")

    # ---- few passes ----

    def test_count_without_bound(self):
        self.write("W.nc", "O1\n#1=0\n#2=0\nN10 IF[#1000EQ1]GOTO20\n#1=#1+1\n#2=#2+3\nGOTO10\n"
                           "N20 IF[#2NE#1*3]GOTO90\nM30\nN90#3000=1(NOT THE SAME)\n"
                           "O2\n#1=0\nN10 #1=#1+1\nIF[#1GT0]GOTO10\nM30\n")
        alarm = self.one("O1.alarm-unreachable.N90", "W.nc")
        self.assertEqual((alarm["verdict"], alarm["ifPassesAtMost"]), ("unreachable", 10 ** 12))
        ends = self.one("O1.program-ends", "W.nc")
        self.assertEqual((ends["verdict"], ends["ifPassesAtMost"]), ("refuted", None))
        self.assertNotEqual(self.one("O2.program-ends", "W.nc")["verdict"], "proved")

    # ---- hints ----

    def test_false_invariant_is_not_believed(self):
        self.write("H.nc", "O1\n(@PARAM #1 1..100 INT)\n#3=#1\n#4=1\n"
                           "N10 WHILE[#3GT0]DO1 (@INVARIANT #4 LE 9)(@VARIANT #4)\n#4=#4*2\n#3=#3-1\nEND1\n"
                           "IF[#4GT9]GOTO90\nM99\nN90#3000=1(LARGE)\n")
        self.assertEqual(self.one("O1.alarm-unreachable.N90", "H.nc")["verdict"], "refuted")
        self.assertEqual(self.one("O1.loop-ends.N10", "H.nc")["verdict"], "proved")

    def test_cyclic_program_need_not_end(self):
        self.write("B.nc", "O1\n(@CYCLIC)\nN10 #2=3\nN20 WHILE[#2GT0]DO1\n#2=#2-1\nEND1\nGOTO10\n")
        rows = [row["id"] for row in self.obligations("B.nc")]
        self.assertNotIn("O1.program-ends", rows)
        self.assertNotIn("O1.loop-ends.N10", rows)
        self.assertEqual(self.one("O1.loop-ends.N20", "B.nc")["verdict"], "proved")

    # ---- witnesses ----

    def test_witness_is_a_call_that_can_be_typed(self):
        self.write("O9100.nc", DIVIDES.replace("N10", "IF[#21LT12]GOTO99\nN10").replace("M99", "N99M99"))
        witness = self.one("O9100.no-control-alarm.N10", "O9100.nc")["witness"]
        self.assertRegex(witness["call"], r"^G65 P9100 U[0-9]+\.[0-9]*")
        self.assertEqual(witness["happened"], "stops with PS0112 (divided by zero)")
        self.assertReplays(witness)

    def test_witness_is_near_to_the_calls_that_are_known(self):
        self.write("O9100.nc", "O9100\nIF[#9EQ#0]THEN#9=120\nIF[#9LT50]GOTO90\n#10=#21/[#22-4]\nG1Z-#21F#9\nM99\n"
                               "N90#3000=1(F)\nO10\nG65P9100U12.V2.\nG65P9100U12.V3.F200.\nM30\n")
        rows = {row["id"]: row for row in self.obligations("O9100.nc")}
        self.assertEqual(rows["O9100.no-control-alarm.L4"]["witness"]["call"], "G65 P9100 U12. V4.")
        self.assertEqual(rows["O9100.alarm-unreachable.N90"]["witness"]["call"], "G65 P9100 F1. U12. V2.")

    def test_witness_with_a_common_variable(self):
        self.write("O4.nc", ENDLESS)
        witness = self.one("O4.loop-ends.N10", "O4.nc")["witness"]
        self.assertGreater(witness["variables"]["500"], 3)
        self.assertEqual((witness["call"], witness["end"]), ("G65 P4", "endless"))
        self.assertReplays(witness)

    # ---- missing programs ----

    def test_missing_program_returns_or_stops_or_does_anything(self):
        self.write("O5.nc", MISSING)
        ends = {missing: self.one("O5.program-ends", "--missing", missing, "O5.nc")
                for missing in ("return", "stop", "havoc")}
        self.assertEqual({missing: (row["verdict"], row["ifReturning"]) for missing, row in ends.items()},
                         {"return": ("proved", ["O9832"]), "stop": ("proved", []), "havoc": ("unknown", [])})
        self.assertEqual(self.one("O5.program-ends", "O5.nc"), ends["return"])
        self.assertIn("if O9832 returns, which is not in the files", self.prove("O5.nc").stdout)
        called = [row["verdict"] for row in self.obligations("--missing", "stop", "O5.nc") if row["line"] == 2]
        self.assertIn("refuted", called)
        self.assertFalse([row for row in self.obligations("O5.nc") if row["line"] == 2])

    def test_missing_program_that_may_not_be_called_at_all(self):
        self.write("O5.nc", MISSING.replace("X10.", "L#1"))
        divides = self.one("O5.no-control-alarm.L3", "--missing", "stop", "O5.nc")
        self.assertIn(divides["verdict"], {"unknown", "refuted"})

    def test_witness_behind_a_missing_program(self):
        self.write("O5.nc", MISSING)
        witness = self.one("O5.no-control-alarm.L3", "O5.nc")["witness"]
        self.assertEqual(witness["ifReturning"], ["O9832"])
        self.assertIn("if O9832 returns and changes nothing", witness["happened"])
        self.assertIn("--missing return", witness["run"])
        self.assertReplays(witness)

    def assertReplays(self, witness):
        words = shlex.split(witness["run"])[1:]
        run = json.loads(self.feedhold(*words, "--format", "json").stdout)
        self.assertEqual(run["end"], witness["end"])

    def test_no_margin(self):
        """The tool rides on the cylinders: rounded words lead it into them by a last digit."""
        shutil.copy(ROOT / "corpus/packages/intersecting-line/O9211.nc", self.folder)
        rows = self.obligations("--arithmetic", "exact", "O9211.nc")
        exact = [row for row in rows if row["exactOnly"]]
        self.assertEqual({row["kind"] for row in exact}, {"keep-out"})
        self.assertEqual({row["verdict"] for row in exact}, {"proved"})
        self.assertIn("            holds in exact arithmetic only: ", self.prove("--arithmetic", "exact", "O9211.nc").stdout)
        run = json.loads(self.prove("--arithmetic", "exact", "--format", "sarif", "O9211.nc").stdout)["runs"][0]
        self.assertEqual({row["level"] for row in run["results"]}, {"note"})

    # ---- what would make it hold ----

    def test_clause_that_would_do(self):
        self.write("O9100.nc", DIVIDES)
        guard = self.one("O9100.no-control-alarm.N10", "O9100.nc")["guard"]
        self.assertEqual(guard["clause"], "@REQUIRE " + guard["conditions"][0])
        self.write("O9100.contract", guard["clause"] + "\n")
        row = self.one("O9100.no-control-alarm.N10", "O9100.nc")
        self.assertEqual((row["verdict"], row["guard"]), ("proved", None))

    def test_blocks_that_would_do(self):
        self.write("O9100.nc", DIVIDES)
        fix = self.one("O9100.no-control-alarm.N10", "O9100.nc")["guard"]["fix"]
        self.assertEqual(fix["safety"], "needs-review")
        lines = DIVIDES.splitlines(keepends=True)
        for edit in reversed(fix["edits"]):
            self.assertEqual((edit["line"], edit["column"]), (edit["endLine"], edit["endColumn"]))
            line, column = edit["line"] - 1, edit["column"] - 1
            lines[line] = lines[line][:column] + edit["replacement"] + lines[line][column:]
        self.write("O9100.nc", "".join(lines))
        self.assertEqual(self.one("O9100.no-control-alarm.N10", "O9100.nc")["verdict"], "proved")

    def test_both_are_shown(self):
        self.write("O9100.nc", DIVIDES)
        text = self.prove("O9100.nc").stdout
        self.assertRegex(text, r"= note: with the clause `@REQUIRE #22 [A-Z]+ 0` in the contract, this is proved in exact arithmetic\n")
        self.assertRegex(text, r"= fix \(needs review\): raise an alarm .*\n +before line 2:\n +IF\[#22[A-Z]+0\]GOTO")
        run = json.loads(self.prove("--format", "sarif", "O9100.nc").stdout)["runs"][0]
        [result] = [row for row in run["results"] if row["ruleId"] == "no-control-alarm"]
        self.assertIn("in the contract, this is proved", result["message"]["text"])
        [change] = result["fixes"][0]["artifactChanges"]
        self.assertEqual(change["artifactLocation"]["uri"], "O9100.nc")
        self.assertIn("GOTO", change["replacements"][0]["insertedContent"]["text"])

    # ---- the text ----

    def test_text(self):
        self.write("O9100.nc", "O9100(PECK)\nN10 #10=#21/#22\nN20 #11=1/2\nM99\n")
        text = self.prove("O9100.nc").stdout
        self.assertIn("O9100.nc: O9100: ", text)
        self.assertIn("refuted: the control can stop here with PS0112 (divided by zero) [O9100.no-control-alarm.N10]\n"
                      " --> O9100.nc:2:", text)
        self.assertIn("G65 P9100 U1. V0.: stops with PS0112 (divided by zero)\n", text)
        self.assertIn("replay it: feedhold run O9100.nc --arg U=1 --arg V=0 --dialect fanuc-30i --isolated\n", text)
        self.assertLess(text.index("refuted: "), text.index("the program comes to an end"))

    def test_unknown_says_why(self):
        self.write("O3.nc", UNKNOWN)
        text = self.prove("--arithmetic", "exact", "O3.nc").stdout
        self.assertIn("unknown: it is not known whether this alarm can be raised [O3.alarm-unreachable.N90]", text)
        self.assertIn("= note: the solver's counterexample did not reproduce on the machine: ", text)

    def test_a_start_that_breaks_the_claim(self):
        self.write("O7.nc", "O7\nG91\nG03 X-10. Y10. I-10. J0 F100\nM99\n")
        [row] = [row for row in self.obligations("O7.nc") if "radius differs" in row["claim"]]
        self.assertEqual(row["witness"]["start"], {"modal": ["G18"], "position": {}, "switches": {}})
        self.assertIn("--modal G18", row["witness"]["run"])
        self.assertEqual((row["guard"]["clause"], row["guard"]["conditions"]), ("@MODAL G17", ["G17 at the start"]))
        replay = self.feedhold(*row["witness"]["run"].split()[1:])
        self.assertIn("alarm PS0020", replay.stdout)
        self.write("O7.nc", "O7\n(@MODAL G17)\n(@START X0 Y0)\nG91\nG03 X-10. Y10. I-10. J0 F100\nM99\n")
        rows = self.obligations("O7.nc")  # of the arc nothing is left to be asked
        self.assertEqual([(row["kind"], row["verdict"]) for row in rows], [("program-ends", "proved")])

    def test_a_setting_that_breaks_the_claim(self):
        self.write("O8.nc", "O8\nG17 G21 G90 G94\nG98 G81 Z-5. F100\nG80\nM99\n")
        [row] = [row for row in self.obligations("O8.nc") if "without depth" in row["claim"]]
        self.assertEqual(row["witness"]["start"]["switches"], {"bare_cycle_stops": True})
        replay = self.feedhold(*row["witness"]["run"].split()[1:])
        self.assertIn("without depth", replay.stdout + replay.stderr)
        self.assertIn("where `bare_cycle_stops` is on", self.prove("O8.nc").stdout)
        usual = self.feedhold("run", "O8.nc", "--isolated", "--switch", "bare_cycle_stops=off")
        self.assertEqual(usual.returncode, 0, usual.stderr)
        wrong = self.feedhold("run", "O8.nc", "--isolated", "--switch", "bare_cycle_stops=yes")
        self.assertIn("is not a setting and its value", wrong.stderr)

    def test_a_subroutine_of_o_words_replays(self):
        self.write("probe.ngc", "o<half-way> sub\n#1=[1/#2]\no<half-way> endsub\nm2\n")
        report = json.loads(self.feedhold("prove", "--format", "json", "--dialect", "linuxcnc", "probe.ngc").stdout)
        [row] = [row for file in report["files"] for row in file["obligations"] if "divided" in row["claim"]]
        replay = self.feedhold(*shlex.split(row["witness"]["run"])[1:])
        self.assertIn("alarm divided by zero", replay.stdout + replay.stderr)

    def test_cutter_compensation_replays(self):
        self.write("O7.nc", COMPENSATED)
        rows = {row["id"]: row for row in self.obligations("O7.nc")}
        for name, command, shown in (("O7.compensation.N10", "run", "alarm PS0041"),
                                     ("O7.keep-out.CLAMP.N20", "plot", "inside CLAMP at N20")):
            row = rows[name]
            self.assertEqual(row["verdict"], "refuted", name)
            self.assertIn("the offset of D is taken to be the radius of `@TOOL`", row["witness"]["happened"])
            replay = self.feedhold(command, *row["witness"]["run"].split()[2:])
            self.assertIn(shown, replay.stdout + replay.stderr)
        self.assertEqual(rows["O7.travel.N20"]["verdict"], "proved")  # of programmed points
        self.assertNotIn(rows["O7.alarm-iff.7"]["verdict"], ("proved", "refuted"))  # the control may stop before

    def test_the_work_offset_is_one_of_the_table(self):
        self.write("O9.nc", "O9\n#1=#[5201+[#4014-53]*20]\nM99\n")
        self.assertEqual({row["verdict"] for row in self.obligations("O9.nc")}, {"proved"})

    def test_quiet_and_verbose(self):
        self.write("O1.nc", COUNTS)
        self.assertIn("effort", self.prove("-v", "O1.nc").stdout)
        self.assertNotIn("in 1 program", self.prove("-q", "O1.nc").stdout)

    def test_a_mapping_of_the_caller_ends_with_the_position(self):
        for begins, ends in (("G68", "G69"), ("G51", "G50"), ("G51.1", "G50.1 X0")):
            self.write("O7.nc", f"O7\n(@MODAL G90 G17 G21 G80 {begins})\n(@START X0 Y0)\n(@ENSURE POS[X] EQ 10)\n"
                                f"(@ENSURE #100 EQ 10)\nG01 X10. F100.\n#100=#5001\n{ends}\nM99\n")
            verdicts = {row["claim"]: row["verdict"] for row in self.obligations("--only", "ensures", "O7.nc")}
            self.assertEqual(verdicts, {"@ENSURE POS[X] EQ 10": "unknown", "@ENSURE #100 EQ 10": "proved"}, begins)

    # ---- other formats ----

    def test_schema_refuses_what_is_no_verdict(self):
        self.write("O1.nc", COUNTS)
        report = self.report("O1.nc")
        for key, value in (("verdict", "maybe"), ("grade", None), ("kind", "style"), ("line", 0)):
            changed = json.loads(json.dumps(report))
            changed["files"][0]["obligations"][0][key] = value
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(changed, SCHEMA)

    def test_sarif(self):
        self.write("O1.nc", COUNTS)
        self.write("O3.nc", UNKNOWN)
        self.write("O9100.nc", DIVIDES)
        run = json.loads(self.prove("--format", "sarif").stdout)["runs"][0]
        results = {result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"]: result["level"]
                   for result in run["results"]}
        self.assertEqual(results["O9100.no-control-alarm.N10"], "error")
        self.assertEqual(results["O3.alarm-unreachable.N90"], "warning")
        self.assertFalse(any(identity.startswith("O1.") for identity in results))
        rules = run["tool"]["driver"]["rules"]
        self.assertTrue(all(rules[row["ruleIndex"]]["id"] == row["ruleId"] for row in run["results"]))


if __name__ == "__main__":
    unittest.main()
