"""What the programs of a folder say about the settings of their machine, and what `check` makes of it."""
import json
import unittest

from harness import Scratch

CALCULATOR = "%\nO{number}(TURNING)\nG90G54\n" + "".join(
    f"N{n}0G0X{n}Z1\nG1Z-{n}F200\n" for n in range(1, 9)) + "X2.5\nM30\n%\n"
ARC = "%\nO{number}(FACE)\nG90G54G17\nG1X0.Y0.F100\nG2X10.Y5.\nG3X0.Y0.\nM30\n%\n"
BUILDER = "%\nO{number}(PALLET)\n#3939=#1\n#101=#3939\nM99\n%\n"


TOUCH = "%\nO{number}(PROBE)\nG90G54G0X0.Y0.\nG229Z-2.{number}T910\nM30\n%\n"
FIVE_AXES = "%\nO{number}(TILT)\nG90G54\nG68.7X0.Y0.Z0.I{number}.\nG1X1.F100.\nM30\n%\n"
REMAPS = """[EMC]
REMAP=M410 modalgroup=10 ngc=not_here
[RS274NGC]
; REMAP=M411 modalgroup=10 ngc=remark
REMAP=G88.1 modalgroup=1  argspec=XYZp ngc=rg881
 REMAP = M6  modalgroup=6 prolog=change_prolog ngc=change
REMAP=T prolog=prepare_prolog ngc=prepare
"""
REMAPPED = "G21 G90\n#<x>=1\n#500=3\nT1 M6\nG0 X1\n#501=#500\nM2\n"


class MachineSettings(Scratch):
    def report(self, *arguments):
        result = self.check("--format", "json", "--severity", "info", "--exit-zero", *arguments)
        document = json.loads(result.stdout)
        return document["inferred"], [finding["rule"] for finding in document["findings"]]

    def shop(self, text, programs, folder="nc"):
        for number in range(1000, 1000 + programs):
            self.write(f"{folder}/O{number}.nc", text.format(number=number))

    def test_calculator_type_input(self):
        self.shop(CALCULATOR, 2)
        self.write("nc/O1002.nc", "%\nO1002\nG90G54\n" + "".join(f"G0X{n}.\n" for n in range(1, 12)) + "Z5\nM30\n%\n")
        inferred, rules = self.report("--dialect", "fanuc-30i", "nc")
        self.assertEqual([(row["folder"], row["table"], row["line"]) for row in inferred],
                         [("nc", "switches", "dpi = true")])
        self.assertNotIn("number-without-point", rules)
        _, alone = self.report("--dialect", "fanuc-30i", "nc/O1002.nc")
        self.assertIn("number-without-point", alone)

    def test_a_short_program_counts_as_its_writer_does(self):
        short = "%\nO1000\nG90G54\nG0X55Z5\nG1X-2.F0.2\nZ{depth}\nG0X60\nM30\n%\n"
        self.write("half/O1000.nc", short.format(depth="-40.0"))
        self.assertEqual([row["line"] for row in self.report("--dialect", "fanuc-30i-lathe", "half")[0]], ["dpi = true"])
        self.write("few/O1000.nc", short.format(depth="-40.\nX50.\nZ-60.\nX54."))
        self.assertEqual(self.report("--dialect", "fanuc-30i-lathe", "few")[0], [])

    def test_least_increments_are_no_calculator(self):
        self.shop(CALCULATOR.replace("X{n}", "X{n}000"), 1)
        text = "%\nO1000\nG90G54\n" + "".join(f"G0X{n}000Z-{n}500\n" for n in range(1, 20)) + "M30\n%\n"
        self.write("nc/O1000.nc", text)
        self.assertEqual(self.report("--dialect", "fanuc-30i", "nc")[0], [])

    def test_arcs_that_are_lines(self):
        self.shop(ARC, 2)
        inferred, rules = self.report("--dialect", "fanuc-0i", "nc")
        self.assertEqual([row["line"] for row in inferred], ["cir = false"])
        self.assertNotIn("arc-without-centre", rules)
        _, one = self.report("--dialect", "fanuc-0i", "nc/O1000.nc")
        self.assertIn("arc-without-centre", one)

    def test_variables_of_the_builder(self):
        self.shop(BUILDER, 2)
        inferred, rules = self.report("--dialect", "fanuc-0i", "nc")
        self.assertEqual([(row["table"], row["line"]) for row in inferred], [("", "builders-variables = [3939]")])
        self.assertNotIn("variable-not-available", rules)
        _, one = self.report("--dialect", "fanuc-0i", "nc/O1000.nc")
        self.assertIn("variable-not-available", one)

    def test_codes_of_the_builder(self):
        self.shop(TOUCH, 3)
        inferred, rules = self.report("--dialect", "fanuc-30i", "nc")
        self.assertEqual([(row["table"], row["line"]) for row in inferred], [("", 'builders-codes = ["G229"]')])
        self.assertNotIn("unknown-g-code", rules)
        _, one = self.report("--dialect", "fanuc-30i", "nc/O1000.nc")
        self.assertIn("unknown-g-code", one)
        self.shop(FIVE_AXES, 2)
        self.assertEqual(self.report("--dialect", "fanuc-30i", "nc")[0], [])  # two uses are no habit

    def test_slips_are_no_codes_of_the_builder(self):
        slips = {"a digit too many": "G90\nG900X0.\nG0X{number}.\n",
                 "no point": "G54.1P1\nG541P{number}\n",
                 "two codes": "G9054X{number}.\n",
                 "copies of one place": "G900X0.\n",
                 "once": ""}
        for kind, blocks in slips.items():
            with self.subTest(kind):
                self.shop("%\nO{number}(PART)\n" + blocks + "M30\n%\n", 4)
                self.write("nc/O1.nc", "%\nO1\nG777X0.\nM30\n%\n")
                inferred, rules = self.report("--dialect", "fanuc-30i", "nc")
                self.assertEqual(inferred, [])
                self.assertEqual(rules.count("unknown-g-code"), 5 if blocks else 1)

    def test_what_many_programs_run_is_no_slip(self):
        self.shop("%\nO{number}(PART)\nG330\nG30Z0.\nM30\n%\n", 9)
        self.assertEqual(self.report("--dialect", "fanuc-30i", "nc")[0], [])
        self.shop("%\nO{number}(PART)\nG330\nG30Z0.\nM30\n%\n", 10)
        self.assertEqual([row["line"] for row in self.report("--dialect", "fanuc-30i", "nc")[0]],
                         ['builders-codes = ["G330"]'])

    def test_listed_codes_of_the_builder_are_unmodelled(self):
        self.write("O1.nc", "%\nO1\nG90G54G0X0.\n#100=1\nG229Z1.T910\nM462\nM30\n%\n")
        arguments = ("ranges", "--dialect", "fanuc-30i", "--format", "json", "O1.nc")
        before = self.feedhold(*arguments).stdout
        self.assertIn("a G code that the control does not have", before)
        self.assertNotIn("a code of the machine builder", before)
        self.write("feedhold.toml", 'builders-codes = ["M462", "G229"]\n')
        after = self.feedhold(*arguments).stdout
        self.assertNotIn("a G code that the control does not have", after)
        self.assertIn("a code of the machine builder", after)
        self.assertNotIn("unknown-g-code", self.report("--dialect", "fanuc-30i", "O1.nc")[1])

    def test_runs_and_proofs_do_not_pass_over_a_code_of_the_builder(self):
        for code in ("M462", "G229"):
            self.write("O1.nc", f"O1\n(@ENSURE #100 EQ 1)\n#100=1\n{code}\nM99\n")
            self.write("feedhold.toml", f'builders-codes = ["{code}"]\n')
            run = self.feedhold("run", "--dialect", "fanuc-30i", "O1.nc").stdout
            self.assertIn("not modelled: a code of the machine builder, line 4", run)
            proof = self.feedhold("prove", "--dialect", "fanuc-30i", "O1.nc").stdout
            self.assertIn("unknown: it is not known whether `@ENSURE #100 EQ 1`", proof)
            self.assertNotIn("refuted", proof)

    def test_remaps_of_the_ini_file(self):
        self.write("mill/mill.ini", REMAPS)
        self.write("mill/nc/one.ngc", REMAPPED.replace("G0 X1", "G88.1 X1\nG88.2 X1"))
        inferred, rules = self.report("--dialect", "linuxcnc", "mill")
        self.assertEqual((inferred, rules.count("unknown-g-code")), ([], 1))
        _, alone = self.report("--dialect", "linuxcnc", "mill/nc")  # the folder of the .ini file is not looked at
        self.assertEqual(alone.count("unknown-g-code"), 2)
        self.assertEqual(self.report("--dialect", "linuxcnc", "--isolated", "mill")[1].count("unknown-g-code"), 2)

    def test_a_remapped_code_may_do_anything(self):
        self.write("one.ngc", REMAPPED)
        arguments = ("ranges", "--dialect", "linuxcnc", "--format", "json", "one.ngc")
        self.assertNotIn("machine builder", self.feedhold(*arguments).stdout)
        self.write("mill.INI", REMAPS)
        self.assertIn("a code of the machine builder", self.feedhold(*arguments).stdout)

    def test_folders_are_machines(self):
        self.shop(ARC, 2, "a")
        self.shop(ARC, 1, "b")
        inferred, rules = self.report("--dialect", "fanuc-0i", ".")
        self.assertEqual([row["folder"] for row in inferred], ["a"])
        self.assertEqual(rules.count("arc-without-centre"), 2)

    def test_the_configuration_settles_it(self):
        self.shop(ARC, 2)
        self.shop(BUILDER, 2, "b")
        self.write("feedhold.toml", "builders-variables = [3939]\n[switches]\ncir = true\n")
        inferred, rules = self.report("--dialect", "fanuc-0i", ".")
        self.assertEqual(inferred, [])
        self.assertEqual(rules.count("arc-without-centre"), 4)
        self.assertNotIn("variable-not-available", rules)

    def test_the_lines_that_are_told_can_be_copied(self):
        self.shop(ARC, 2, "nc")
        self.shop(BUILDER, 2, "nc/b")
        told = self.check("--dialect", "fanuc-0i", "--exit-zero", "nc").stdout
        self.assertIn("`cir = false` (4 arcs in 2 programs have neither R nor I J K)", told)
        self.assertIn("`builders-variables = [3939]`", told)
        self.write("nc/feedhold.toml", "builders-variables = [3939]\n[switches]\ncir = false\n")
        settled = self.check("--dialect", "fanuc-0i", "nc")
        self.assertExit(settled, 0)
        self.assertNotIn("cir", settled.stdout)

    def test_an_arc_that_is_a_line_moves_in_a_line(self):
        self.write("O1.nc", ARC.format(number=1))
        self.write("feedhold.toml", "[switches]\ncir = false\n")
        run = json.loads(self.feedhold("run", "--dialect", "fanuc-0i", "--format", "json", "O1.nc").stdout)
        self.assertEqual((run["end"], run["alarm"]), ("M30", None))
        self.assertEqual([move["kind"] for move in run["moves"]][-2:], ["feed", "feed"])
        self.write("feedhold.toml", "[switches]\ncir = 1\n")
        bad = self.check("O1.nc")
        self.assertExit(bad, 2)

    def test_wrong_lists_are_named(self):
        self.write("O1.nc", BUILDER.format(number=1))
        for line, message in (("builders-variables = 3939\n", "must be a list"),
                              ("builders-variables = [0]\n", "a whole number from 1"),
                              ('builders-codes = "G229"\n', "must be a list"),
                              ('builders-codes = ["T1"]\n', 'such as "G68.2"')):
            self.write("feedhold.toml", line)
            result = self.check("O1.nc")
            self.assertExit(result, 2)
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
