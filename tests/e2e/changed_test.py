"""`--changed-since` and `--with-callers` on real git repositories: what changed, and all that calls it."""
import json
import os
import subprocess
import unittest

from harness import BAD, Scratch

CALLEE = "O9101\nIF[#1EQ0]GOTO90\n#100=5/#1\nN90 M99\n"
BROKEN = "O9101\n#100=5/#1\nM99\n"
MIDDLE = "O9100\nG65 P9101 A#1\nM99\n"
TOP = "O1\nG65 P9100 A0\nM30\n"
ALONE = "O2\nG90\nM30\n"


class Changed(Scratch):
    def setUp(self):
        super().setUp()
        self.git("init", "-q", "-b", "main")
        for name, text in (("nc/O9101.nc", CALLEE), ("nc/O9100.nc", MIDDLE), ("nc/O1.nc", TOP), ("nc/O2.nc", ALONE),
                           ("other/O2.nc", ALONE)):
            self.write(name, text)
        self.commit()

    def environment(self, changes=None):
        return {**super().environment(changes), "HOME": str(self.cache), "GIT_CONFIG_NOSYSTEM": "1",
                "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@localhost",
                "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@localhost"}

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.folder, check=True, capture_output=True, env=self.environment())

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-qm", "programs")

    def prove(self, *arguments, **options):
        return self.feedhold("prove", "--dialect", "fanuc-30i", *arguments, **options)

    def proved(self, *arguments, **options):
        report = json.loads(self.prove("--format", "json", *arguments, **options).stdout)
        self.assertEqual(report["errors"], [])
        return sorted(os.path.normpath(file["path"]) for file in report["files"])

    def since(self, revision="HEAD"):
        return self.proved("--changed-since", revision)

    # ---- what counts as changed ----

    def test_nothing_changed(self):
        self.assertEqual(self.since(), [])
        self.assertExit(self.prove("--changed-since", "HEAD"), 0)

    def test_callers_of_callers(self):
        self.write("nc/O9101.nc", BROKEN)
        self.assertEqual(self.since(), ["nc/O1.nc", "nc/O9100.nc", "nc/O9101.nc"])
        self.assertEqual(self.proved("--changed-since", "HEAD", "other"), [])
        self.write("nc/O9101.nc", CALLEE)
        self.write("nc/O1.nc", TOP + "\n")
        self.assertEqual(self.since(), ["nc/O1.nc"])

    def test_broken_callee_fails_its_caller(self):
        self.assertExit(self.prove("nc/O9100.nc"), 0)
        self.write("nc/O9101.nc", BROKEN.replace("O9101\n", "O9101\n(@REQUIRE #1 GT 0)\n"))
        self.assertExit(self.prove("nc/O9101.nc"), 0)
        report = json.loads(self.prove("--changed-since", "HEAD", "--format", "json").stdout)
        self.assertIn(("nc/O9100.nc", "call-meets-contract", "refuted"),
                      [(file["path"], row["kind"], row["verdict"]) for file in report["files"]
                       for row in file["obligations"]])

    def test_untracked_staged_and_committed(self):
        self.write("nc/O3.nc", "O3\nG65 P9100 A1\nM30\n")
        self.assertEqual(self.since(), ["nc/O3.nc"])
        self.git("add", "-A")
        self.assertEqual(self.since(), ["nc/O3.nc"])
        self.commit()
        self.assertEqual(self.since(), [])
        self.assertEqual(self.since("HEAD~1"), ["nc/O3.nc"])

    def test_ignored_files_do_not_count(self):
        self.write(".gitignore", "scratch*\n")
        self.write("nc/scratch.nc", "O7\nM30\n")
        self.assertEqual(self.since(), [])

    def test_branch_that_went_on(self):
        self.git("checkout", "-qb", "work")
        self.write("nc/O2.nc", ALONE + "(MINE)\n")
        self.commit()
        self.git("checkout", "-q", "main")
        self.write("nc/O9101.nc", BROKEN)
        self.commit()
        self.git("checkout", "-q", "work")
        self.assertEqual(self.since("main"), ["nc/O2.nc"])

    def test_contracts(self):
        self.write("nc/O9101.contract", "@REQUIRE #1 GT 0\n")
        self.assertEqual(self.since(), ["nc/O1.nc", "nc/O9100.nc", "nc/O9101.nc"])
        self.commit()
        (self.folder / "nc/O9101.contract").unlink()
        self.assertEqual(self.since(), ["nc/O1.nc", "nc/O9100.nc", "nc/O9101.nc"])

    def test_program_that_is_gone(self):
        (self.folder / "nc/O9101.nc").unlink()
        self.assertEqual(self.since(), ["nc/O1.nc", "nc/O9100.nc"])

    def test_configuration(self):
        self.write("other/feedhold.toml", "[switches]\nnat = true\n")
        self.assertEqual(self.since(), ["other/O2.nc"])

    def test_remaps(self):
        self.write("other/part.ngc", "o<part> sub\nG0 X1\no<part> endsub\nM2\n")
        self.commit()
        self.write("other/mill.ini", "[RS274NGC]\nREMAP=M462 ngc=probe\n")
        report = self.feedhold("prove", "--dialect", "linuxcnc", "--format", "json", "--changed-since", "HEAD").stdout
        self.assertEqual([file["path"] for file in json.loads(report)["files"]], ["other/O2.nc", "other/part.ngc"])
        self.assertEqual(self.since(), [])  # another control does not read it

    def test_call_that_is_only_known_in_a_run(self):
        self.write("nc/O5.nc", "O5\n#2=#500\nM98 P#2\nM30\n")
        self.commit()
        self.write("nc/O9101.nc", BROKEN)
        self.assertIn("nc/O5.nc", self.since())

    def test_from_another_folder_and_odd_names(self):
        self.write("nc/\u00e4 b\n.nc", "O8\nM30\n")
        self.assertEqual(self.proved("--changed-since", "HEAD", ".", cwd=self.folder / "nc"), ["\u00e4 b\n.nc"])
        self.assertEqual(self.proved("--changed-since", "HEAD", "../nc", cwd=self.folder / "other"),
                         ["../nc/\u00e4 b\n.nc"])

    # ---- check ----

    def test_check_reports_on_what_changed_alone(self):
        self.write("nc/O1001.nc", BAD)
        self.commit()
        self.write("nc/O9100.nc", MIDDLE.replace("M99", "#510-[0]\nM99"))
        report = json.loads(self.check("--changed-since", "HEAD", "--format", "json").stdout)
        rows = {(row["path"], row["rule"]) for row in report["findings"]}
        self.assertIn(("nc/O9100.nc", "missing-equals"), rows)
        self.assertNotIn("nc/O1001.nc", {path for path, _ in rows})
        self.assertNotIn("program-not-found", {rule for _, rule in rows})
        self.assertIn("in 2 files", self.check("--changed-since", "HEAD").stdout)
        self.commit()
        result = self.check("--changed-since", "HEAD")
        self.assertExit(result, 0)
        self.assertIn("no findings in 0 files", result.stdout)

    # ---- refusals ----

    def test_no_such_revision(self):
        for revision in ("nowhere", "--all", "HEAD:nc", "nowhere..HEAD"):
            for command in ("check", "prove"):
                with self.subTest(revision=revision, command=command):
                    result = self.feedhold(command, f"--changed-since={revision}")
                    self.assertExit(result, 2)
                    self.assertIn(f"no revision `{revision}`", result.stderr)

    def test_no_repository(self):
        outside = self.cache / "outside"
        outside.mkdir()
        (outside / "a.nc").write_text(ALONE)
        for command in ("check", "prove"):
            result = self.feedhold(command, "--changed-since", "HEAD", cwd=outside)
            self.assertExit(result, 2)
            self.assertIn("not in a git repository", result.stderr)

    def test_no_git(self):
        result = self.prove("--changed-since", "HEAD", environment={"PATH": str(self.cache)})
        self.assertExit(result, 2)
        self.assertIn("git", result.stderr)

    def test_standard_input(self):
        self.assertExit(self.check("--changed-since", "HEAD", "-"), 2)
        self.assertExit(self.prove("--with-callers", "-"), 2)
        self.assertExit(self.prove("--with-callers", "--changed-since", "HEAD"), 2)

    # ---- named files ----

    def test_named_files_and_their_callers(self):
        self.assertEqual(self.proved("--with-callers", "nc/O9101.nc"), ["nc/O1.nc", "nc/O9100.nc", "nc/O9101.nc"])
        self.assertEqual(self.proved("--with-callers", "nc/O9101.nc", "other/O2.nc"),
                         ["nc/O1.nc", "nc/O9100.nc", "nc/O9101.nc", "other/O2.nc"])
        self.assertEqual(self.proved("--with-callers", "nc/O1.nc"), ["nc/O1.nc"])

    def test_named_contract(self):
        self.write("nc/O9100.contract", "@REQUIRE #1 GE 0\n")
        self.assertEqual(self.proved("--with-callers", "nc/O9100.contract"), ["nc/O1.nc", "nc/O9100.nc"])

    def test_named_file_that_is_no_program(self):
        self.write("docs/notes.txt", "Dear all,\nthis is text.\n")
        self.assertExit(self.prove("--with-callers", "docs/notes.txt"), 0)
        self.assertExit(self.prove("--with-callers", "missing.nc"), 2)

    def test_configuration_with_mistakes_is_no_free_pass(self):
        self.write("nc/feedhold.toml", "dialekt = 5\n")
        self.assertExit(self.prove("--with-callers", "nc/O9101.nc"), 2)
        self.assertExit(self.prove("--changed-since", "HEAD"), 2)


if __name__ == "__main__":
    unittest.main()
