"""Macro programs in VS Code's real workbench: code-server in Chromium, with the packaged extension.

Heavy (630 MB of packages), so not even with the other tools that results are compared with: `./dev vscode --try`.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from editor_session import REPAIRED, write_programs
from harness import FEEDHOLD, NODE, ORACLES, ROOT, SKIPPED

PACKAGES = ROOT / "build" / "oracles" / "workbench"
LONGEST_SESSION = 240
CODES = ("lower-case", "never-set-variable", "loop-without-progress", "goto-missing-label")


class Workbench(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(holder.cleanup)
        folder = Path(holder.name)
        (folder / "programs").mkdir()
        write_programs(folder / "programs")
        (vsix,) = (ROOT / "build").glob("feedhold-*.vsix")
        environment = {**os.environ, "FEEDHOLD": FEEDHOLD, "HOME": holder.name}
        told = subprocess.run([NODE, ROOT / "tests/editors/workbench.mjs", PACKAGES, vsix, folder], env=environment,
                              capture_output=True, timeout=LONGEST_SESSION)
        if os.environ.get("FEEDHOLD_SCREENSHOT") and (folder / "workbench.png").exists():
            Path(os.environ["FEEDHOLD_SCREENSHOT"]).write_bytes((folder / "workbench.png").read_bytes())
        if told.returncode != 0:
            raise AssertionError(told.stderr.decode())
        cls.seen = json.loads(told.stdout.splitlines()[-1])

    def test_a_missing_program_is_told_with_a_way_out(self):
        self.assertIn("`/nowhere/feedhold` was not found", self.seen["missing"])
        self.assertIn("feedhold.path", self.seen["missing"])

    def test_files_are_macro_programs(self):
        self.assertEqual(self.seen["language"], "Macro B")

    def test_problems_are_the_findings(self):
        problems = "\n".join(self.seen["problems"])
        for code in CODES:
            self.assertIn(code, problems)

    def test_rules_lead_to_their_pages(self):
        pages = {link.rsplit("/", 1)[-1] for link in self.seen["links"]}
        self.assertEqual(pages, {f"{code}.md" for code in CODES})

    def test_variables_are_no_colours(self):
        self.assertEqual((self.seen["swatchesBefore"], self.seen["swatches"]), (0, 0))

    def test_hover(self):
        self.assertIn("#100", self.seen["hover"])

    def test_a_repair(self):
        self.assertEqual(self.seen["repaired"], REPAIRED)

    def test_the_witness_of_a_broken_promise_runs_in_a_terminal(self):
        self.assertEqual(self.seen["lens"], "1 proved, 1 refuted: run witness")
        self.assertRegex(self.seen["terminal"], r"feedhold run \S*O9020\.nc --arg A=[45]")


if __name__ == "__main__":
    if not ORACLES or not (PACKAGES / "node_modules" / "code-server").exists():
        print("skipped: needs code-server; run `./dev vscode --try`")
        sys.exit(SKIPPED)
    unittest.main()
