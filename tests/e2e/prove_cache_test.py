"""The cache of `feedhold prove`: found again when nothing changed, proved anew when anything did, never believed when
it is damaged."""
import hashlib
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from harness import FEEDHOLD, ROOT, Scratch

MAIN = """O9100
N10 #10=#21/#22
IF[#21GT5]GOTO90
G65 P9101 A#22
M99
N90#3000=1(DEEP)
"""
HELPER = "O9101\n#100=#1\nM99\n"
CONTRACT = "@PARAM #21 DEPTH 0..5.\n@PARAM #22 STEP 0.1..20.\n"
NEEDS_TWO_SOLVERS = ROOT / "corpus/packages/mould-entry/O9115.nc"
CLAIM = b"this alarm is never raised"
FORGED = b"this alarm is NEVER raised"
BUILD_ID = re.compile(rb"\x04\x00\x00\x00\x14\x00\x00\x00\x03\x00\x00\x00GNU\x00.{20}", re.DOTALL)


class Cache(Scratch):
    def setUp(self):
        super().setUp()
        self.write("nc/O9100.nc", MAIN)
        self.write("nc/O9101.nc", HELPER)
        self.write("nc/O9100.contract", CONTRACT)

    def prove(self, *arguments, **options):
        return self.feedhold("prove", "--dialect", "fanuc-30i", *(arguments or ["nc/O9100.nc"]), **options)

    def entries(self):
        return sorted(path for path in self.cache.rglob("*") if path.is_file())

    def fill(self):
        """Proves once, then changes what is remembered: from now on a hit shows."""
        result = self.prove()
        self.assertExit(result, 0)
        self.assertIn(CLAIM.decode(), result.stdout)
        for path in self.entries():
            head, key, _, record = path.read_bytes().split(b"\n", 3)
            self.assertIn(CLAIM, record)
            record = record.replace(CLAIM, FORGED)
            path.write_bytes(b"\n".join([head, key, hashlib.sha256(record).hexdigest().encode(), record]))

    def isHit(self, *arguments, **options):
        result = self.prove(*arguments, **options)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return FORGED.decode() in result.stdout

    # ---- hits ----

    def test_nothing_changed(self):
        self.fill()
        self.assertTrue(self.isHit())
        self.assertTrue(self.isHit("--jobs", "1", "-v", "nc/O9100.nc"))

    def test_same_bytes(self):
        for words in (["-v"], ["--format", "json"], ["--format", "sarif"]):
            with self.subTest(words=words):
                shutil.rmtree(self.cache, ignore_errors=True)
                self.write("nc/O9102.nc", "O9102\n#1=#2/#3\nWHILE[#1000EQ0]DO1\nEND1\n@@@\nG999\nM99\n")
                before = self.prove(*words, "nc")
                self.assertGreater(len(self.entries()), 2)
                after = self.prove(*words, "nc")
                self.assertEqual((before.returncode, before.stdout), (after.returncode, after.stdout))

    def test_folder_that_moves(self):
        self.fill()
        shutil.move(self.folder / "nc", self.folder / "other")
        self.assertTrue(self.isHit("other/O9100.nc"))

    def test_place_of_the_cache(self):
        self.prove("--cache-dir", "mine", "nc/O9100.nc")
        self.assertEqual(self.entries(), [])
        self.assertEqual(len([path for path in (self.folder / "mine").rglob("*") if path.is_file()]), 1)

    def test_home(self):
        self.prove(environment={"XDG_CACHE_HOME": "", "HOME": str(self.folder / "home")})
        self.assertTrue((self.folder / "home/.cache/feedhold").is_dir())

    # ---- misses ----

    def test_changed_program(self):
        self.fill()
        self.write("nc/O9100.nc", MAIN.replace("DEEP", "TOO DEEP"))
        self.assertFalse(self.isHit())

    def test_changed_callee(self):
        self.fill()
        self.write("nc/O9101.nc", HELPER.replace("#100=#1", "#100=#1+1"))
        self.assertFalse(self.isHit())

    def test_file_that_comes(self):
        self.fill()
        self.write("nc/O9102.nc", "O9102\nM99\n")
        self.assertFalse(self.isHit())

    def test_changed_contract(self):
        self.fill()
        self.write("nc/O9100.contract", CONTRACT.replace("0..5.", "0..4."))
        self.assertFalse(self.isHit())
        self.write("nc/O9100.contract", CONTRACT)
        self.assertTrue(self.isHit())

    def test_contract_that_comes(self):
        self.fill()
        self.write("nc/O9100.nc.contract", "@REQUIRE #21 GT 1\n")
        self.assertFalse(self.isHit())

    def test_changed_dialect(self):
        self.fill()
        result = self.feedhold("prove", "--dialect", "fanuc-0i", "nc/O9100.nc")
        self.assertExit(result, 0)
        self.assertNotIn(FORGED.decode(), result.stdout)

    def test_changed_configuration(self):
        self.write("feedhold.toml", "[switches]\nnat = true\n")
        self.fill()
        self.write("feedhold.toml", "[switches]\nnat = true # a remark\n")
        self.assertTrue(self.isHit())
        self.write("feedhold.toml", "[switches]\nnat = false\n")
        self.assertFalse(self.isHit())
        self.write("feedhold.toml", '[switches]\nnat = true\n[[code-calls]]\ncode = "G100"\nprogram = 9101\n')
        self.assertFalse(self.isHit())

    def test_other_options(self):
        self.fill()
        self.assertFalse(self.isHit("--only", "alarm-unreachable", "nc/O9100.nc"))

    def test_another_build(self):
        self.fill()
        other = self.folder / "feedhold"
        program = Path(FEEDHOLD).read_bytes()
        note = BUILD_ID.search(program)
        if not note:
            self.skipTest("the program has no build id")
        other.write_bytes(program[:note.end() - 1] + bytes([program[note.end() - 1] ^ 1]) + program[note.end():])
        other.chmod(0o755)
        result = subprocess.run([other, "prove", "--dialect", "fanuc-30i", "nc/O9100.nc"], cwd=self.folder,
                                capture_output=True, text=True, env=self.environment())
        self.assertEqual(result.returncode, 0)
        self.assertNotIn(FORGED.decode(), result.stdout)
        self.assertEqual(len(self.entries()), 2)

    # ---- what is not kept ----

    def test_no_cache(self):
        self.prove("--no-cache", "nc/O9100.nc")
        self.assertEqual(self.entries(), [])
        self.fill()
        self.assertFalse(self.isHit("--no-cache", "nc/O9100.nc"))

    def test_evidence_is_made_anew(self):
        self.fill()
        self.assertFalse(self.isHit("--certificate", "proofs", "nc/O9100.nc"))
        self.assertExit(self.feedhold("recheck", "proofs"), 0)

    def test_missing_solver(self):
        shutil.copy(NEEDS_TWO_SOLVERS, self.folder)
        name = NEEDS_TWO_SOLVERS.name
        exactly = ("--arithmetic", "exact", name)
        without = self.prove(*exactly, environment={"PATH": str(self.folder)})
        self.assertIn("1 unknown", without.stdout)
        self.assertEqual(self.entries(), [])
        self.assertNotIn("unknown", self.prove(*exactly).stdout)

    def test_solver_that_had_to_be_stopped(self):
        shutil.copy(NEEDS_TWO_SOLVERS, self.folder)
        self.write("bin/cvc5", "#!/bin/sh\nkill -9 $$\n").chmod(0o755)
        path = {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        self.assertIn("1 unknown", self.prove(NEEDS_TWO_SOLVERS.name, environment=path).stdout)
        self.assertEqual(self.entries(), [])

    def test_no_place(self):
        self.write("file", "")
        result = self.prove("--cache-dir", "file/below", "nc/O9100.nc")
        self.assertExit(result, 0)
        self.assertEqual(result.stderr, "")
        self.assertExit(self.prove(environment={"XDG_CACHE_HOME": "", "HOME": ""}), 0)

    def test_folder_that_cannot_be_written(self):
        for folder in ("/proc/feedhold", "/proc/self"):  # also for root
            result = self.prove("--cache-dir", folder, "nc/O9100.nc")
            self.assertExit(result, 0)
            self.assertEqual(result.stderr, "")

    def test_old_entries_go(self):
        self.prove()
        [path] = self.entries()
        path.unlink()
        for number in range(600):
            old = path.parent / f"{number:062x}"
            old.write_text("old")
            os.utime(old, (number, number))
        self.prove()
        names = sorted(entry.name for entry in path.parent.iterdir())
        self.assertEqual(len(names), 512)
        self.assertIn(path.name, names)
        self.assertIn(f"{599:062x}", names)

    # ---- damage ----

    def test_damaged_entries(self):
        good = self.prove().stdout
        [path] = self.entries()
        content = path.read_bytes()
        head = content.index(b"\n", content.index(b"\n", content.index(b"\n") + 1) + 1) + 1
        damaged = [b"", content[:20], content[:-1], content + b" ", bytes(len(content)), content.upper(),
                   content[:head] + content[head:].replace(b"alarm", b"ALARM")]
        for text in damaged:
            with self.subTest(text=text[:40]):
                path.write_bytes(text)
                result = self.prove()
                self.assertExit(result, 0)
                self.assertEqual((result.stdout, result.stderr), (good, ""))
                self.assertEqual(path.read_bytes(), content)

    def test_record_that_is_none(self):
        good = self.prove().stdout
        [path] = self.entries()
        head, key, _, _ = path.read_bytes().split(b"\n", 3)
        for record in (b"", b"1 ", b"99999999999999999999 ", b"9999 ", b"1 0 5 O9100", b"x" * 300, b"0 0 0 more"):
            with self.subTest(record=record[:30]):
                path.write_bytes(b"\n".join([head, key, hashlib.sha256(record).hexdigest().encode(), record]))
                self.assertEqual(self.prove().stdout, good)

    def test_entry_of_another_program(self):
        good = self.prove().stdout
        [path] = self.entries()
        self.write("O5.nc", "O5\n#3000=1(NO)\n")
        self.prove("O5.nc")
        [other] = [entry for entry in self.entries() if entry != path]
        path.write_bytes(other.read_bytes())
        self.assertEqual(self.prove().stdout, good)

    def test_folder_in_its_place(self):
        good = self.prove().stdout
        [path] = self.entries()
        path.unlink()
        path.mkdir()
        self.assertEqual(self.prove().stdout, good)

    def test_runs_that_repair_one_damaged_entry(self):
        good = self.prove().stdout
        [path] = self.entries()
        content = path.read_bytes()
        for _ in range(5):
            path.write_bytes(content[:len(content) // 2])
            runs = [subprocess.Popen([FEEDHOLD, "prove", "--dialect", "fanuc-30i", "nc/O9100.nc"], cwd=self.folder,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                     env=self.environment()) for _ in range(2)]
            self.assertEqual([run.communicate()[0] for run in runs], [good, good])
            self.assertEqual(path.read_bytes(), content)
            self.assertEqual(self.entries(), [path])

    def test_runs_side_by_side(self):
        runs = [subprocess.Popen([FEEDHOLD, "prove", "--dialect", "fanuc-30i", "nc"], cwd=self.folder,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=self.environment())
                for _ in range(6)]
        self.assertEqual(len({run.communicate()[0] for run in runs}), 1)
        self.assertEqual(self.prove("nc").returncode, runs[0].returncode)


if __name__ == "__main__":
    unittest.main()
