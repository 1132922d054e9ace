"""What is no healthy program gets a clear message; nothing crashes or hangs, and the other files are still analysed."""
import os
import subprocess
import unittest

from harness import BAD, FEEDHOLD, GOOD, LONGEST_RUN, Scratch, small_stack

DEEP = 100_000


class BadInput(Scratch):
    def setUp(self):
        super().setUp()
        self.write("bad.nc", BAD)

    def check_beside_bad(self, *names):
        """Checks the files with bad.nc, whose finding must come out in any case."""
        result = self.check(*names, "bad.nc")
        self.assertIn("missing-equals", result.stdout)
        return result

    def test_missing_file(self):
        result = self.check_beside_bad("gone.nc")
        self.assertExit(result, 2)
        self.assertIn("gone.nc", result.stderr)

    def test_unreadable_file(self):
        os.symlink("loop.nc", self.folder / "loop.nc")
        result = self.check_beside_bad("loop.nc")
        self.assertExit(result, 2)
        self.assertIn("loop.nc", result.stderr)

    def test_file_without_permission(self):
        path = self.write("locked.nc", GOOD)
        path.chmod(0)
        if os.access(path, os.R_OK):
            self.skipTest("permissions do not bind this user")
        result = self.check_beside_bad("locked.nc")
        self.assertExit(result, 2)
        self.assertIn("locked.nc", result.stderr)

    def test_folder_without_programs(self):
        self.write("empty/readme.md", "no program here\n")
        result = self.check("empty")
        self.assertIn("empty", result.stdout + result.stderr)
        self.assertExit(result, 2)

    def test_contract_in_the_place_of_a_program(self):
        self.write("bad.contract", "@REQUIRE #21 GT 0\n")
        result = self.check_beside_bad("bad.contract")
        self.assertExit(result, 2)
        self.assertIn("bad.contract: is a contract file; name its program instead", result.stderr)
        self.assertNotIn("macro compiler", result.stdout)

    def test_binary_file(self):
        self.write("picture.nc", bytes(range(256)) * 64)
        self.assertIn("picture.nc", self.check("picture.nc", "bad.nc").stderr)
        self.assertExit(self.check_beside_bad("picture.nc"), 1)

    def test_file_of_one_word(self):
        """Nothing is read before its first sign or behind its last one."""
        for index, word in enumerate(("T0101", "N10", "O", "G", "%", "(", "#", "[", "P1", "M", "T", ";", "/", "X-", "-", ".")):
            self.write(f"word{index}.nc", word)
            self.assertExit(self.check_beside_bad(f"word{index}.nc"), 1)

    def test_empty_file(self):
        self.write("empty.nc", "")
        self.assertExit(self.check_beside_bad("empty.nc"), 1)

    def test_file_of_two_gigabytes(self):
        with open(self.folder / "huge.nc", "wb") as file:
            file.truncate(1 << 31)
        result = self.check_beside_bad("huge.nc")
        self.assertExit(result, 2)
        self.assertIn("huge.nc", result.stderr)

    def test_invalid_configuration(self):
        self.write("feedhold.toml", "[check\n")
        result = self.check("bad.nc")
        self.assertExit(result, 2)
        self.assertIn("feedhold.toml:1", result.stderr)

    def test_unknown_key_has_a_suggestion(self):
        self.write("feedhold.toml", 'dialct = "fanuc-30i"\n')
        result = self.check("bad.nc")
        self.assertExit(result, 2)
        self.assertIn("dialect", result.stderr)

    def test_one_line_of_ten_megabytes(self):
        self.write("long.nc", "O1002\n" + "X1.5Y2.5" * (10_000_000 // 8) + "\nM30\n")
        self.check_beside_bad("--dialect", "fanuc-30i", "long.nc")

    def test_call_cycle(self):
        self.write("cell/O1.nc", "O1\nM98 P2\nM99\n")
        self.write("cell/O2.nc", "O2\nM98 P1\nM99\n")
        result = self.check("cell")
        self.assertExit(result, 1)

    def test_program_that_calls_itself(self):
        self.write("self.nc", "O1003\nG65 P1003\nM99\n")
        self.assertExit(self.check("self.nc"), 1)

    def test_foreign_language_is_refused_once(self):
        blocks = "\n".join(f"{line} L X+{line} Y+0 R0 FMAX M3" for line in range(2, 300))
        self.write("program.h", f"0 BEGIN PGM TEST MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n{blocks}\n300 END PGM TEST MM\n")
        result = self.check_beside_bad("program.h")
        self.assertEqual((result.stdout + result.stderr).count("program.h"), 1)


class Deep(Scratch):
    """Nesting far beyond any control, with a small stack."""

    def check_deep(self, text):
        self.write("deep.nc", f"O1004\n{text}\nM30\n")
        result = subprocess.run([FEEDHOLD, "check", "--dialect", "fanuc-30i", "deep.nc"], cwd=self.folder,
                                capture_output=True, timeout=LONGEST_RUN, preexec_fn=small_stack)
        self.assertEqual(result.returncode, 1, result.stderr[-2000:])
        self.assertLess(len(result.stdout), 100_000)

    def test_brackets(self):
        self.check_deep("#1=" + "[" * DEEP + "1" + "]" * DEEP)

    def test_unclosed_brackets(self):
        self.check_deep("#1=" + "[" * DEEP)

    def test_parentheses(self):
        self.check_deep("(" * DEEP + ")" * DEEP)

    def test_functions(self):
        self.check_deep("#1=" + "SIN[" * DEEP + "1" + "]" * DEEP)

    def test_hashes(self):
        self.check_deep("#1=" + "#" * DEEP + "1")

    def test_signs(self):
        self.check_deep("#1=" + "-" * DEEP + "1")

    def test_long_sum(self):
        self.write("deep.nc", "O1004\n#1=1" + "+1" * DEEP + "\nM30\n")
        result = subprocess.run([FEEDHOLD, "check", "--dialect", "fanuc-30i", "deep.nc"], cwd=self.folder,
                                capture_output=True, timeout=LONGEST_RUN, preexec_fn=small_stack)
        self.assertIn(result.returncode, (0, 1), result.stderr[-2000:])

    def test_ifs(self):
        self.check_deep("IF[#1EQ1]THEN" * DEEP)


if __name__ == "__main__":
    unittest.main()
