"""The real `pre-commit` installs the hooks by itself from a local index; nothing named `feedhold` is on the PATH."""
import shutil

from packaged import BAD, DIST, GOOD, ROOT, Packaged, main

CONFIG = """repos:
  - repo: {hooks}
    rev: {revision}
    hooks:
      - id: feedhold
      - id: feedhold-prove
"""
GUARDED = "O9101\nIF[#1LE0]GOTO90\n#100=5/#1\nN90 M99\n"
NEEDY = "O9102\n(@REQUIRE #1 GT 0)\n(@ENSURE #100 GT 5)\n#100=#1\nM99\n"
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
        (shop / "O9101.nc").write_text(GUARDED)
        self.assertEqual(self.commit(shop).count("Passed"), 2)
        (shop / "O1001.nc").write_text(BAD)
        self.assertIn("missing-equals", self.commit(shop, code=1))
        (shop / "O1001.nc").unlink()
        (shop / "O9102.nc").write_text(NEEDY)
        self.assertIn("O9102.ensures", self.commit(shop, code=1))


if __name__ == "__main__":
    main()
