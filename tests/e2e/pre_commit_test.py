"""The real `pre-commit` with this project's hooks for a program on the PATH: a bad macro blocks the commit, a good one
passes."""
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from harness import BAD, FEEDHOLD, GOOD, ROOT, Scratch

CONFIG = """repos:
  - repo: {hooks}
    rev: {revision}
    hooks:
      - id: {hook}
"""
CALLEE = "O9101\nIF[#1LE0]GOTO90\n#100=5/#1\nN90 M99\n"
NEEDY = "O9101\n(@REQUIRE #1 GT 0)\n#100=5/#1\nM99\n"
CALLER = "O9100\nG65 P9101 A#1\nM99\n"
TOP = "O1\nG65 P9100 A1.\nM30\n"


class Hooked(Scratch):
    hook = "feedhold-system"

    def setUp(self):
        super().setUp()
        self.variables = {
            **os.environ, "XDG_CACHE_HOME": str(self.cache), "HOME": str(self.folder), "PRE_COMMIT_HOME": str(self.folder / "cache"),
            "PATH": f"{Path(FEEDHOLD).parent}:{os.environ['PATH']}",
            "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@localhost",
            "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@localhost",
        }
        hooks = self.repository("hooks")
        shutil.copy(ROOT / ".pre-commit-hooks.yaml", hooks)
        self.commit(hooks)
        revision = self.git(hooks, "rev-parse", "HEAD").stdout.strip()
        self.shop = self.repository("shop")
        (self.shop / ".pre-commit-config.yaml").write_text(CONFIG.format(hooks=hooks, revision=revision, hook=self.hook))
        self.commit(self.shop)
        self.assertEqual(self.run_in(self.shop, "pre-commit", "install").returncode, 0)

    def run_in(self, folder, *command):
        return subprocess.run(command, cwd=folder, env=self.variables, capture_output=True, text=True, timeout=300)

    def git(self, folder, *arguments):
        return self.run_in(folder, "git", *arguments)

    def repository(self, name):
        folder = self.folder / name
        folder.mkdir()
        self.git(folder, "init", "-q")
        return folder

    def commit(self, folder):
        self.git(folder, "add", "-A")
        return self.git(folder, "commit", "-m", "programs")


class Check(Hooked):
    def test_bad_macro_blocks_the_commit(self):
        (self.shop / "O1001.nc").write_text(BAD)
        result = self.commit(self.shop)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("missing-equals", result.stdout + result.stderr)
        self.assertNotIn("O1001.nc", self.git(self.shop, "ls-tree", "--name-only", "HEAD").stdout)

    def test_good_macro_passes(self):
        (self.shop / "O1000.nc").write_text(GOOD)
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("Passed", result.stdout + result.stderr)

    def test_other_files_do_not_matter(self):
        (self.shop / "notes.md").write_text("#510-[0-#6]\n")
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("Skipped", result.stdout + result.stderr)

    def test_programs_count_by_their_content(self):
        for name in ("PART.HOM", "ALL-PROG", "bore.macro"):
            (self.shop / name).write_text(BAD)
            result = self.commit(self.shop)
            self.assertNotEqual(result.returncode, 0, name)
            self.assertIn("missing-equals", result.stdout + result.stderr)
            (self.shop / name).write_text("all: programs\n\tcp a b\n")
            result = self.commit(self.shop)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn("Passed", result.stdout + result.stderr)

    def test_leader_of_nul_bytes(self):
        (self.shop / "O1001").write_bytes(bytes(200) + BAD.encode())
        result = self.commit(self.shop)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("missing-equals", result.stdout + result.stderr)


class Prove(Hooked):
    hook = "feedhold-prove-system"

    def setUp(self):
        super().setUp()
        (self.shop / "feedhold.toml").write_text('dialect = "fanuc-30i"\n')
        for name, text in (("O9101.nc", CALLEE), ("O9100.nc", CALLER), ("O1.nc", TOP), ("O2.nc", "O2\nG90\nM30\n")):
            (self.shop / name).write_text(text)
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_change_in_a_callee_breaks_the_proof_of_its_caller(self):
        (self.shop / "O9101.nc").write_text(NEEDY)
        result = self.commit(self.shop)
        said = result.stdout + result.stderr
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("O9100.call-meets-contract", said)
        self.assertIn("O1.nc: O1:", said)
        self.assertNotIn("O2.nc", said)
        (self.shop / "O9100.nc").write_text(CALLER.replace("O9100\n", "O9100\n(@REQUIRE #1 GT 0)\n"))
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_change_of_the_configuration(self):
        (self.shop / "feedhold.toml").write_text('dialect = "fanuc-30i"\n[switches]\nnat = true\n')
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("Passed", result.stdout + result.stderr)
        (self.shop / "feedhold.toml").write_text("dialekt = 5\n")
        self.assertNotEqual(self.commit(self.shop).returncode, 0)

    def test_change_of_a_contract_alone(self):
        (self.shop / "O9101.contract").write_text("@REQUIRE #1 GT 5\n")
        result = self.commit(self.shop)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("O9100.call-meets-contract", result.stdout + result.stderr)

    def test_files_without_a_program_do_not_matter(self):
        (self.shop / "feedhold.toml").unlink()
        (self.shop / "Makefile").write_text("all: programs\n\tcp a b\n")
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("Passed", result.stdout + result.stderr)

    def test_other_files_do_not_matter(self):
        (self.shop / "notes.txt").write_text("Dear all,\nthis is text.\n")
        result = self.commit(self.shop)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("Passed", result.stdout + result.stderr)


class Lists(unittest.TestCase):
    def test_hooks_leave_out_what_the_search_of_a_folder_leaves_out(self):
        source = (ROOT / "analyzer/language/dialect/text_signals.cpp").read_text()
        rows = re.search(r"kOtherExtensions\[\] = \{(.*?)\};", source, re.S).group(1)
        extensions = set(re.findall(r'"(\w+)"', rows))
        hooks = (ROOT / ".pre-commit-hooks.yaml").read_text()
        listed = [set(re.findall(r"\w+", names)) for names in re.findall(r"\\\.\(\n(.*?)\)\$", hooks, re.S)]
        self.assertEqual(listed, [extensions, extensions - {"contract"}])

    def test_hooks_that_install_themselves_do_what_those_on_the_path_do(self):
        hooks = (ROOT / ".pre-commit-hooks.yaml").read_text().split("- id: ")[1:]
        entries = {hook.split("\n")[0]: re.search(r"entry: (.*)", hook)[1] for hook in hooks}
        languages = {hook.split("\n")[0]: re.search(r"language: (.*)", hook)[1] for hook in hooks}
        for name in ("feedhold", "feedhold-fix", "feedhold-prove"):
            self.assertEqual(entries[name], entries[f"{name}-system"])
            self.assertEqual((languages[name], languages[f"{name}-system"]), ("python", "system"))


if __name__ == "__main__":
    unittest.main()
