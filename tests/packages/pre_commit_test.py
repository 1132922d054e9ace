"""The real `pre-commit` installs the hooks by itself from a local index; nothing named `feedhold` is on the PATH."""
import shutil

from packaged import BAD, DIST, GOOD, PROVED, REFUTED, ROOT, Packaged, main

CONFIG = """repos:
  - repo: {hooks}
    rev: {revision}
    hooks:
      - id: feedhold
      - id: feedhold-prove
"""
PEOPLE = {f"GIT_{role}_{what}": "a@localhost" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


class PreCommit(Packaged):
    def git(self, folder, *words, code=0):
        return self.run_clean("git", *words, cwd=folder, code=code, PIP_NO_INDEX="1", PIP_FIND_LINKS=str(DIST), **PEOPLE)

    def repository(self, name, files):
        folder = self.folder / name
        folder.mkdir()
        self.git(folder, "init", "-q")
        for file, text in files.items():
            (folder / file).write_text(text)
        self.commit(folder)
        return folder

    def commit(self, folder, code=0):
        self.git(folder, "add", "-A")
        result = self.git(folder, "commit", "-m", "programs", code=code)
        return result.stdout + result.stderr

    def test_commits(self):
        self.assertIsNone(shutil.which("feedhold", path="/usr/sbin:/usr/bin:/sbin:/bin"))
        hooks = self.repository("hooks", {name: (ROOT / name).read_text()
                                          for name in (".pre-commit-hooks.yaml", "setup.py", "CMakeLists.txt")})
        revision = self.git(hooks, "rev-parse", "HEAD").stdout.strip()
        shop = self.repository("shop", {".pre-commit-config.yaml": CONFIG.format(hooks=hooks, revision=revision)})
        self.run_clean("pre-commit", "install", cwd=shop)
        (shop / "O1000.nc").write_text(GOOD)
        (shop / "O9101.nc").write_text(PROVED)
        self.assertEqual(self.commit(shop).count("Passed"), 2)
        (shop / "O1001.nc").write_text(BAD)
        self.assertIn("missing-equals", self.commit(shop, code=1))
        (shop / "O1001.nc").unlink()
        (shop / "O9102.nc").write_text(REFUTED)
        self.assertIn("O9102.no-control-alarm", self.commit(shop, code=1))


if __name__ == "__main__":
    main()
