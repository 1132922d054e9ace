"""Exit codes and the choice of rules: 0 clean, 1 findings, 2 could not run."""
import unittest

from harness import BAD, GOOD, Scratch


class ExitCodes(Scratch):
    def test_clean_program(self):
        self.write("good.nc", GOOD)
        self.assertExit(self.check("good.nc"), 0)

    def test_program_with_a_finding(self):
        self.write("bad.nc", BAD)
        result = self.check("bad.nc")
        self.assertExit(result, 1)
        self.assertIn("missing-equals", result.stdout)

    def test_quiet_prints_the_findings_only(self):
        self.write("cell/bad.nc", BAD)
        self.write("cell/notes.doc", "no program")
        loud = self.check("cell")
        for option in ("-q", "--quiet"):
            quiet = self.check(option, "cell")
            self.assertExit(quiet, 1)
            self.assertIn("missing-equals", quiet.stdout)
            self.assertTrue(loud.stdout.startswith(quiet.stdout.rstrip()), quiet.stdout)
            self.assertNotIn("1 file", quiet.stdout)
            self.assertEqual(quiet.stderr, "")

    def test_folder_is_walked(self):
        self.write("cell/one/bad.nc", BAD)
        self.write("cell/two/O1000", GOOD)
        result = self.check("cell")
        self.assertExit(result, 1)
        self.assertIn("cell/one/bad.nc:3", result.stdout)

    def test_ignored_rule(self):
        self.write("bad.nc", BAD)
        self.assertExit(self.check("--ignore", "missing-equals", "bad.nc"), 0)

    def test_selected_rule(self):
        self.write("bad.nc", BAD)
        self.assertExit(self.check("--select", "missing-equals", "bad.nc"), 1)

    def test_a_former_name_of_a_rule(self):
        self.write("good.nc", GOOD)
        self.assertExit(self.check("--select", "loop-counter-clobbered", "good.nc"), 0)
        page = self.feedhold("explain", "loop-counter-clobbered").stdout
        self.assertTrue(page.startswith("# shared-loop-counter"), page[:40])

    def test_unknown_rule_has_a_suggestion(self):
        self.write("good.nc", GOOD)
        result = self.check("--select", "mising-equals", "good.nc")
        self.assertExit(result, 2)
        self.assertIn("missing-equals", result.stderr)

    def test_unknown_dialect(self):
        self.write("good.nc", GOOD)
        result = self.check("--dialect", "fanuc-3oi", "good.nc")
        self.assertExit(result, 2)
        self.assertIn("fanuc-30i", result.stderr)

    def test_unknown_option(self):
        self.assertExit(self.check("--no-such-option"), 2)

    def test_suppressed_finding(self):
        self.write("bad.nc", BAD.replace("[0-1.5]", "[0-1.5](@ALLOW missing-equals the typing slip is wanted)"))
        self.assertExit(self.check("bad.nc"), 0)

    def test_same_output_with_any_number_of_threads(self):
        for number in range(40):
            self.write(f"cell/O{number + 1:04}.nc", BAD.replace("O1001", f"O{number + 1:04}"))
        one = self.check("--jobs", "1", "cell")
        many = self.check("--jobs", "8", "cell")
        self.assertEqual(one.stdout, many.stdout)
        self.assertExit(one, 1)


if __name__ == "__main__":
    unittest.main()
