"""`--fix` and `--diff`: safe fixes only, bytes elsewhere untouched, nothing to do the second time."""
import stat
import unittest

from harness import GOOD, Scratch



# `=` can only mean EQ in a condition (safe); the missing `=` needs a person.
BEFORE = b"%\r\nO1005(CAF\xc9)\r\n#1=1.\r\nIF[#1=1]GOTO10\r\n#2-3\r\nN10 M30\r\n%\r\n"
AFTER = BEFORE.replace(b"[#1=1]", b"[#1EQ1]")


class Fix(Scratch):
    def setUp(self):
        super().setUp()
        self.path = self.write("program.nc", BEFORE)

    def test_fix_writes_the_repaired_program(self):
        self.path.chmod(0o640)
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        self.assertEqual(self.path.read_bytes(), AFTER)
        self.assertEqual(stat.S_IMODE(self.path.stat().st_mode), 0o640)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["program.nc"])

    def test_second_fix_changes_nothing(self):
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        written = self.path.stat().st_mtime_ns
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        self.assertEqual(self.path.read_bytes(), AFTER)
        self.assertEqual(self.path.stat().st_mtime_ns, written)

    def test_diff_shows_and_does_not_write(self):
        result = self.check("--dialect", "fanuc-30i", "--diff", "program.nc")
        self.assertEqual(self.path.read_bytes(), BEFORE)
        self.assertIn("+++ b/program.nc", result.stdout)

    def test_diff_of_a_clean_program_is_empty(self):
        self.write("good.nc", GOOD)
        result = self.check("--diff", "good.nc")
        self.assertExit(result, 0)
        self.assertNotIn("+++", result.stdout)


if __name__ == "__main__":
    unittest.main()
