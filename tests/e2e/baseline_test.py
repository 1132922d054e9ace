"""`--baseline`: old findings and verdicts stay quiet, new ones do not."""
import json
import os
import stat
import threading
import unittest

from harness import BAD, GOOD, Scratch

FILE = ".feedhold-baseline.json"
DIVIDES = "O9100(PECK)\nN10 #10=#21/#22\nM99\n"
ALARM = "N20 IF[#21GT5]GOTO90\nM99\nN90#3000=1(DEEP)\n"


class OfCheck(Scratch):
    def freeze(self, *paths):
        result = self.check("--baseline", FILE, "--update-baseline", *paths)
        self.assertExit(result, 0)
        return result

    def entries(self, key="findings"):
        return json.loads((self.folder / FILE).read_text())[key]

    def test_old_findings_are_hidden(self):
        self.write("a.nc", BAD)
        self.assertExit(self.check(), 1)
        found = json.loads(self.check("--format", "json").stdout)["findings"]
        self.freeze()
        self.assertEqual([(row["path"], row["rule"], row["fingerprint"]) for row in self.entries()],
                         sorted((row["path"], row["rule"], row["fingerprint"]) for row in found))
        result = self.check("--baseline", FILE)
        self.assertExit(result, 0)
        self.assertIn("no findings", result.stdout)
        self.assertIn(f"{len(found)} old", result.stderr)

    def test_new_finding_is_reported_alone(self):
        self.write("a.nc", BAD)
        self.freeze()
        self.write("a.nc", BAD.replace("O1001(SLIP)\n", "O1001(SLIP)\nN5 G00 X1.\n(A REMARK)\n").replace("M30", "#511-[0]\nM30"))
        result = self.check("--baseline", FILE, "--format", "concise")
        self.assertExit(result, 1)
        self.assertIn("#511", result.stdout)
        self.assertNotIn("#510", result.stdout)

    def test_update_prunes_what_is_gone(self):
        self.write("a.nc", BAD)
        self.write("b.nc", BAD.replace("1001", "1002"))
        self.write("c.nc", BAD.replace("1001", "1003"))
        self.freeze()
        self.write("a.nc", GOOD)
        (self.folder / "c.nc").unlink()
        result = self.check("--baseline", FILE)
        self.assertExit(result, 0)
        self.assertIn("a.nc: missing-equals", result.stderr)
        self.assertIn("c.nc: missing-equals", result.stderr)
        self.assertNotIn("b.nc", result.stderr)
        self.assertIn("2 gone", self.freeze().stdout)
        self.assertEqual({row["path"] for row in self.entries()}, {"b.nc"})
        self.assertNotIn("no longer occur", self.check("--baseline", FILE).stderr)

    def test_part_of_the_programs(self):
        self.write("a.nc", BAD)
        self.write("b.nc", BAD.replace("1001", "1002"))
        self.freeze()
        self.assertNotIn("no longer occur", self.check("--baseline", FILE, "a.nc").stderr)
        self.assertNotIn("no longer occur", self.check("--baseline", FILE, "--select", "lower-case").stderr)
        self.write("a.nc", GOOD)
        self.freeze("a.nc")
        self.assertEqual({row["path"] for row in self.entries()}, {"b.nc"})

    def test_paths_start_at_the_baseline(self):
        self.write("nc/a.nc", BAD)
        self.freeze("nc")
        result = self.feedhold("check", "--baseline", "../" + FILE, "a.nc", cwd=self.folder / "nc")
        self.assertExit(result, 0)

    def test_finding_in_a_file_with_contracts(self):
        self.write("a.nc", "O9100\n#1=#21\nM99\n")
        self.write("a.contract", "@PARM #21 DEPTH 0..5.\n")
        self.assertExit(self.check(), 1)
        self.freeze()
        self.assertExit(self.check("--baseline", FILE), 0)
        self.write("a.contract", "@PARAM #21 DEPTH 0..5.\n")
        self.assertIn("a.contract: unknown-contract-clause", self.check("--baseline", FILE).stderr)

    def test_same_bytes_one_entry_a_line(self):
        self.write("b.nc", BAD.replace("1001", "1002"))
        self.write("a.nc", BAD)
        self.freeze()
        first = (self.folder / FILE).read_bytes()
        self.freeze("--jobs", "1", "b.nc", "a.nc")
        self.assertEqual((self.folder / FILE).read_bytes(), first)
        self.assertEqual(first.count(b'\n    {"path"'), len(self.entries()))
        umask = os.umask(0)
        os.umask(umask)
        self.assertEqual(stat.S_IMODE((self.folder / FILE).stat().st_mode), 0o666 & ~umask)

    def test_never_half_written(self):
        for number in range(60):
            self.write(f"{number}.nc", BAD.replace("1001", str(1001 + number)))
        self.freeze()
        seen, stop = [], threading.Event()

        def read():
            while not stop.is_set():
                seen.append((self.folder / FILE).read_text())

        reader = threading.Thread(target=read)
        reader.start()
        for count in (1, 60, 1, 60):
            for number in range(1, 60):
                self.write(f"{number}.nc", (BAD if count == 60 else GOOD).replace("1001", str(1001 + number)))
            self.freeze()
        stop.set()
        reader.join()
        for text in set(seen):
            json.loads(text)

    def test_what_is_no_baseline(self):
        self.write("a.nc", BAD)
        self.freeze()
        good = (self.folder / FILE).read_text()
        newer = json.dumps({**json.loads(good), "version": 2})
        damaged = {"": "not a valid baseline", "[]": "not a valid baseline", good[:-20]: "line", "<<<<<<< HEAD\n" + good: "line 1",
                   newer: "version 2", good.replace('"rule"', '"rules"'): "entry 1 of `findings`",
                   good.replace('"obligations": []', '"obligations": {}'): "`obligations` is not a list"}
        for text, word in damaged.items():
            for words in ([], ["--update-baseline"]):
                with self.subTest(text=text[:30], words=words):
                    self.write(FILE, text)
                    result = self.check("--baseline", FILE, *words)
                    self.assertExit(result, 2)
                    self.assertIn(FILE, result.stderr)
                    self.assertIn(word, result.stderr)
                    self.assertEqual((self.folder / FILE).read_text(), text)

    def test_mistakes_in_the_call(self):
        self.write("a.nc", BAD)
        result = self.check("--baseline", FILE)
        self.assertExit(result, 2)
        self.assertIn("create it with --update-baseline", result.stderr)
        self.assertExit(self.check("--update-baseline"), 2)
        self.assertExit(self.check("--baseline", FILE, "--update-baseline", "--fix"), 2)
        self.assertExit(self.check("--baseline", "missing/" + FILE, "--update-baseline"), 2)
        self.assertExit(self.check("--baseline", ".", "--update-baseline"), 2)


class OfProve(Scratch):
    def prove(self, *arguments):
        return self.feedhold("prove", "--dialect", "fanuc-30i", "--baseline", FILE, *arguments)

    def test_old_verdicts_are_hidden(self):
        self.write("O9100.nc", DIVIDES)
        self.assertExit(self.feedhold("prove", "--dialect", "fanuc-30i"), 1)
        self.assertExit(self.prove("--update-baseline"), 0)
        result = self.prove()
        self.assertExit(result, 0)
        self.assertIn("1 old verdict is hidden", result.stderr)
        self.write("O9100.nc", DIVIDES.replace("M99\n", ALARM))
        result = self.prove("--format", "json")
        self.assertExit(result, 1)
        [row] = [row for file in json.loads(result.stdout)["files"] for row in file["obligations"]
                 if row["verdict"] == "refuted"]
        self.assertEqual(row["kind"], "alarm-unreachable")

    def test_check_and_prove_share_a_file(self):
        self.write("O9100.nc", DIVIDES + "#510-[0]\n")
        self.assertExit(self.check("--baseline", FILE, "--update-baseline"), 0)
        self.assertExit(self.prove("--update-baseline"), 0)
        self.assertExit(self.check("--baseline", FILE), 0)
        self.assertExit(self.check("--baseline", FILE, "--update-baseline"), 0)
        self.assertExit(self.prove(), 0)

    def test_worse_is_new(self):
        self.write("O9100.nc", DIVIDES)
        self.prove("--update-baseline")
        path = self.folder / FILE
        path.write_text(path.read_text().replace('"refuted"', '"unknown"'))
        result = self.prove()
        self.assertExit(result, 1)
        self.assertIn("(unknown)", result.stderr)

    def test_proved_is_gone(self):
        self.write("O9100.nc", DIVIDES)
        self.prove("--update-baseline")
        self.write("O9100.contract", "@PARAM #21 DEPTH 0..5.\n@PARAM #22 STEP 0.1..20.\n")
        self.assertNotIn("no longer occur", self.prove("--only", "alarm-unreachable").stderr)
        self.assertIn("1 entry of " + FILE + " no longer occurs", self.prove().stderr)

    def test_evidence_is_whole(self):
        self.write("O9100.nc", DIVIDES)
        self.prove("--update-baseline")
        self.assertExit(self.prove("--certificate", "proofs"), 0)
        index = json.loads((self.folder / "proofs/index.json").read_text())
        self.assertIn("refuted", {row["verdict"] for file in index["files"] for row in file["obligations"]})


if __name__ == "__main__":
    unittest.main()
