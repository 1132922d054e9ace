"""`--fix` and `--diff`: safe fixes only, bytes elsewhere untouched, nothing to do the second time."""
import stat
import unittest

from harness import GOOD, ROOT, Scratch



def fixable_program():
    """A program that a rule page repairs: its `nc` fence before a `fixed` fence."""
    for page in sorted(ROOT.glob("rules/*/*.md")):
        parts = page.read_text().split("\n```")
        for before, after in zip(parts, parts[1:]):
            if before.startswith("nc fanuc-30i\n") and "escaped" not in before.split("\n")[0]:
                rest = parts[parts.index(after):]
                names = [part.split("\n")[0] for part in rest[:6]]
                fixed = next((part for part in rest[:6] if part.startswith("fixed\n")), None)
                if fixed and "nc fanuc-30i" not in names:
                    return before.partition("\n")[2] + "\n", fixed.partition("\n")[2] + "\n"
    raise AssertionError("no rule page shows a safe fix")


class Fix(Scratch):
    def setUp(self):
        super().setUp()
        before, self.fixed = fixable_program()
        self.before = before.replace("\n", "\r\n").encode()
        self.after = self.fixed.replace("\n", "\r\n").encode()
        self.path = self.write("program.nc", self.before)

    def test_fix_writes_the_repaired_program(self):
        self.path.chmod(0o640)
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        self.assertEqual(self.path.read_bytes(), self.after)
        self.assertEqual(stat.S_IMODE(self.path.stat().st_mode), 0o640)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["program.nc"])

    def test_second_fix_changes_nothing(self):
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        written = self.path.stat().st_mtime_ns
        self.check("--dialect", "fanuc-30i", "--fix", "program.nc")
        self.assertEqual(self.path.read_bytes(), self.after)
        self.assertEqual(self.path.stat().st_mtime_ns, written)

    def test_diff_shows_and_does_not_write(self):
        result = self.check("--dialect", "fanuc-30i", "--diff", "program.nc")
        self.assertEqual(self.path.read_bytes(), self.before)
        self.assertIn("+++ b/program.nc", result.stdout)

    def test_diff_of_a_clean_program_is_empty(self):
        self.write("good.nc", GOOD)
        result = self.check("--diff", "good.nc")
        self.assertExit(result, 0)
        self.assertNotIn("+++", result.stdout)


if __name__ == "__main__":
    unittest.main()
