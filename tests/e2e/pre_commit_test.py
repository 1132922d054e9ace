"""The real `pre-commit` with this project's hooks: a bad macro blocks the commit, a good one passes."""
import os
import shutil
import subprocess
import unittest
from pathlib import Path

from harness import BAD, FEEDHOLD, GOOD, ROOT, Scratch

CONFIG = """repos:
  - repo: {hooks}
    rev: {revision}
    hooks:
      - id: feedhold
"""


class PreCommit(Scratch):
    def setUp(self):
        super().setUp()
        self.environment = {
            **os.environ, "HOME": str(self.folder), "PRE_COMMIT_HOME": str(self.folder / "cache"),
            "PATH": f"{Path(FEEDHOLD).parent}:{os.environ['PATH']}",
            "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@localhost",
            "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@localhost",
        }
        hooks = self.repository("hooks")
        shutil.copy(ROOT / ".pre-commit-hooks.yaml", hooks)
        self.commit(hooks)
        revision = self.git(hooks, "rev-parse", "HEAD").stdout.strip()
        self.shop = self.repository("shop")
        (self.shop / ".pre-commit-config.yaml").write_text(CONFIG.format(hooks=hooks, revision=revision))
        self.commit(self.shop)
        self.assertEqual(self.run_in(self.shop, "pre-commit", "install").returncode, 0)

    def run_in(self, folder, *command):
        return subprocess.run(command, cwd=folder, env=self.environment, capture_output=True, text=True, timeout=300)

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


if __name__ == "__main__":
    unittest.main()
