"""One session in any editor: two programs, what is done with them, and what must be seen."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from harness import FEEDHOLD

LONGEST_SESSION = 120
CALLER = """%
O1000(CALLER)
G90 G54 G00 X0. Y0.
#100=[#500-1]*2
IF[#100EQ2]GOTO30
G65 P9010 A#100
(MAß 😀) g01 X10. F100.
#101=SQRT[#100+1]+#1
N30 G00 Y5.
IF[#100EQ3]GOTO99
IF[#100EQ4]GOTO30
M30
%
"""
CALLED = """%
O9010(CALLED)
#510=#1*2
M99
%
"""
PROMISED = """%
O9020(DOUBLE)
(@PARAM #1 WIDTH 1..50. MM)
(@ENSURE #510 EQ #1*2)
#510=#1*2
IF[#1LT40]GOTO10
#510=#1*3
N10 M99
%
"""
REPAIRED = CALLER.replace("g01", "G01")
RENAMED = REPAIRED.replace("N30", "N50").replace("GOTO30", "GOTO50")
TYPED = RENAMED.replace("GOTO99", "GOTO50")
SEVERITIES = {"error": 1, "warning": 2, "info": 3}


def write_programs(folder):
    (folder / "O1000.nc").write_text(CALLER, encoding="utf-8")
    (folder / "O9010.nc").write_text(CALLED, encoding="utf-8")
    (folder / "O9020.nc").write_text(PROMISED, encoding="utf-8")
    (folder / "feedhold.toml").write_text('dialect = "fanuc-30i"\n')


class EditorSession:
    """For a TestCase that says in `command` how the editor is started."""

    maxDiff = None

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        write_programs(cls.folder)
        cls.expected = cls.findings_of_check()
        home = {"HOME": holder.name, "XDG_CACHE_HOME": holder.name, "LC_ALL": "C.UTF-8", "FEEDHOLD": FEEDHOLD}
        told = subprocess.run(cls.command, cwd=cls.folder, env={**os.environ, **home}, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST_SESSION)
        results = cls.folder / "session.json"
        if not results.exists():
            raise AssertionError(told.stdout.decode())
        cls.seen = json.loads(results.read_text(encoding="utf-8"))
        if "problem" in cls.seen:
            raise AssertionError(f"{cls.seen['problem']}\n{told.stdout.decode()}\n{cls.seen}")

    @classmethod
    def findings_of_check(cls):
        """What the command line says of the file in its folder, as (line, marked text, rule, severity)."""
        told = subprocess.run([FEEDHOLD, "check", "--severity", "info", "--format", "json", "."], cwd=cls.folder, capture_output=True)
        lines = CALLER.splitlines()
        return sorted((it["line"], lines[it["line"] - 1][it["column"] - 1:it["endColumn"] - 1], it["rule"],
                       SEVERITIES[it["severity"]])
                      for it in json.loads(told.stdout)["findings"] if Path(it["path"]).name == "O1000.nc")

    @staticmethod
    def shown(findings):
        return sorted((it["line"], it["marked"], it["code"], it["severity"]) for it in findings)

    def test_findings_are_those_of_check(self):
        self.assertEqual(self.shown(self.seen["diagnostics"]), self.expected)
        self.assertIn((7, "g", "lower-case", 3), self.expected)
        self.assertIn((10, "99", "goto-missing-label", 1), self.expected)

    def test_messages(self):
        (missing,) = (it for it in self.seen["diagnostics"] if it["code"] == "goto-missing-label")
        self.assertIn("this program has no `N99`", missing["message"])

    def test_hover_tells_what_the_variable_is_here(self):
        self.assertIn("#100", self.seen["hover"])

    def test_a_repair_behind_a_character_of_two_units(self):
        self.assertEqual(self.seen["repaired"], REPAIRED.splitlines())

    def test_a_label_gets_a_new_name_with_all_jumps(self):
        self.assertEqual(self.seen["renamed"], RENAMED.splitlines())

    def test_findings_follow_what_is_typed(self):
        self.assertEqual(self.seen["typed"], TYPED.splitlines())
        codes = {it["code"] for it in self.seen["left"]}
        self.assertIn("never-set-variable", codes)
        self.assertNotIn("lower-case", codes)
        self.assertNotIn("goto-missing-label", codes)

    def test_the_called_program_is_found_in_its_file(self):
        self.assertEqual(self.seen["definition"], ["O9010.nc", 2])

    def test_a_promise_that_is_not_kept(self):
        (refuted,) = (it for it in self.seen["refuted"] if it["severity"] == SEVERITIES["error"])
        self.assertIn("`@ENSURE #510 EQ #1*2` is not kept", refuted["message"])
        self.assertRegex(refuted["message"], r"G65 P9020 A[45][0-9.]+")

    def test_nothing_is_said_of_a_promise_that_is_proved(self):
        self.assertEqual(self.seen["proved"], [])
