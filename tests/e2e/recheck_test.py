"""`prove --certificate` and `recheck`: a bundle holds as long as nothing in it or behind it changes."""
import json
import shutil
import unittest

import jsonschema

from harness import ROOT, Scratch

SCHEMA = json.loads((ROOT / "docs" / "schemas" / "bundle.schema.json").read_text())

PROGRAM = """O9100(PECK)
N10 #10=FUP[#21/#22]
N20 WHILE[#10GT0]DO1
G91 G01 Z-#22 F100.
#10=#10-1
END1
#11=0
N30 WHILE[#11LT#21]DO1
#11=#11+#22
END1
IF[#500EQ7]GOTO90
M99
N90#3000=1(SEVEN)
"""
CONTRACT = "@PARAM #21 DEPTH 0.5..200. MM\n@PARAM #22 STEP 0.1..20. MM\n"


class Recheck(Scratch):
    proved = None  # the files of a bundle: the proof is made once

    def setUp(self):
        super().setUp()
        self.program = self.write("nc/O9100.nc", PROGRAM)
        self.contract = self.write("nc/O9100.contract", CONTRACT)
        self.bundle = self.folder / "proofs"
        if Recheck.proved is None:
            self.assertExit(self.prove(), 1)
            Recheck.proved = self.files()
        for name, content in Recheck.proved.items():
            self.write(f"proofs/{name}", content)
        self.index = json.loads((self.bundle / "index.json").read_text())

    def prove(self, *arguments):
        return self.feedhold("prove", "--dialect", "fanuc-30i", "--isolated", "nc", "--certificate", "proofs",
                             *arguments)

    def files(self):
        return {path.relative_to(self.bundle).as_posix(): path.read_bytes()
                for path in self.bundle.rglob("*") if path.is_file()}

    def recheck(self):
        return self.feedhold("recheck", "proofs")

    def assertDetected(self, *words):
        result = self.recheck()
        self.assertExit(result, 1)
        for word in words:
            self.assertIn(word, result.stdout)

    def change(self, path, before, after):
        text = path.read_text()
        self.assertIn(before, text)
        path.write_text(text.replace(before, after, 1))

    def evidence(self, kind):
        return sorted(self.bundle.glob(f"*/*.{kind}"))

    # ---- what is written ----

    def test_index_follows_the_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        jsonschema.validate(self.index, SCHEMA)
        [file] = self.index["files"]
        self.assertEqual([source["path"] for source in file["sources"]], ["../nc/O9100.contract", "../nc/O9100.nc"])
        [program] = file["programs"]
        self.assertEqual(program["name"], "O9100")
        claims = [(self.bundle / step["claim"]["file"]).read_text() for step in program["steps"]]
        self.assertEqual(len(claims), len(set(claims)))
        self.assertGreater(max(map(len, claims)), 200, "what was certified on the way is missing")
        verdicts = {row["id"]: row["verdict"] for row in file["obligations"]}
        self.assertEqual(verdicts["O9100.loop-ends.N20"], "proved")
        self.assertEqual(verdicts["O9100.alarm-unreachable.N90"], "refuted")
        for row in file["obligations"]:
            for part in row["evidence"]:
                for stored in (value for value in part.values() if isinstance(value, dict)):
                    self.assertTrue((self.bundle / stored["file"]).exists())

    def test_same_proof_same_bytes(self):
        shutil.rmtree(self.bundle)
        self.assertExit(self.prove("--jobs", "1"), 1)
        self.assertEqual(self.files(), Recheck.proved)

    def test_no_leftovers(self):
        self.write("nc/O9100.nc", "O9100\nM99\n")
        self.prove()
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["nc", "proofs"])
        self.assertEqual(len(self.evidence("smt2")), 0)

    def test_other_folders_are_not_taken(self):
        self.write("other/notes.txt", "mine")
        result = self.feedhold("prove", "nc", "--certificate", "other")
        self.assertExit(result, 2)
        self.assertIn("contains other files", result.stderr)
        self.assertExit(self.feedhold("prove", "nc", "--certificate", "nc/O9100.nc"), 2)
        self.assertExit(self.feedhold("prove", "-", "--certificate", "fresh"), 2)

    # ---- what holds ----

    def test_nothing_changed(self):
        result = self.recheck()
        self.assertExit(result, 0)
        self.assertRegex(result.stdout, r"no differences: [1-9][0-9]* obligations proved again")
        self.assertRegex(result.stdout, r"[1-9][0-9]* certificates verified by the checker")

    def test_bundle_and_programs_may_move_together(self):
        other = self.folder / "elsewhere"
        other.mkdir()
        shutil.move(self.folder / "nc", other / "nc")
        shutil.move(self.bundle, other / "proofs")
        self.assertExit(self.feedhold("recheck", "proofs", cwd=other), 0)
        self.assertExit(self.feedhold("recheck", "elsewhere/proofs"), 0)

    def test_kinds_and_configuration_are_remembered(self):
        self.write("feedhold.toml", 'dialect = "fanuc-0i"\n')
        self.feedhold("prove", "nc", "--config", "feedhold.toml", "--only", "loop-ends", "--certificate", "some")
        index = json.loads((self.folder / "some" / "index.json").read_text())
        self.assertEqual([row["kind"] for row in index["files"][0]["obligations"]], ["loop-ends"] * 2)
        self.assertExit(self.feedhold("recheck", "some"), 0)
        self.write("feedhold.toml", 'dialect = "fanuc-30i"\n')
        self.assertExit(self.feedhold("recheck", "some"), 1)

    # ---- what is detected ----

    def test_changed_program(self):
        self.change(self.program, "(PECK)", "(PECKS)")
        self.assertDetected("`../nc/O9100.nc` has changed since it was proved")

    def test_program_that_breaks_the_proof(self):
        self.change(self.program, "#10=#10-1", "#10=#10+1")
        self.assertDetected("`../nc/O9100.nc`", "O9100.loop-ends.N20: the bundle says proved; it is now")

    def test_changed_contract(self):
        self.change(self.contract, "0.1..20.", "0...20.")
        self.assertDetected("`../nc/O9100.contract` has changed since it was proved")

    def test_contract_that_goes_or_comes(self):
        self.contract.unlink()
        self.assertDetected("`../nc/O9100.contract` was read for the proof but is missing now")
        self.contract.write_text(CONTRACT)
        self.write("nc/O9100.nc.contract", "@GLOBAL #500 MODE 0..6\n")
        self.assertDetected("`../nc/O9100.nc.contract` is new in the folder of the program")

    def test_changed_certificate(self):
        for path in self.evidence("certificate"):
            text = path.read_text()
            place = next(i for i, sign in enumerate(text) if sign in "123456789")
            path.write_text(text[:place] + str(int(text[place]) % 9 + 1) + text[place + 1:])
            with self.subTest(path=path.name):
                self.assertDetected(path.relative_to(self.bundle).as_posix())
            path.write_text(text)

    def test_certificate_that_fails_is_not_told_as_followed(self):
        path = self.evidence("certificate")[0]
        questions = len(self.evidence("smt2"))
        path.write_text("(combination)\n")
        result = self.feedhold("recheck", "proofs", "-v")
        self.assertExit(result, 1)
        name = path.with_suffix(".smt2").relative_to(self.bundle).as_posix()
        self.assertIn(f"{name}: certificate rejected, Z3 was not asked, cvc5 was not asked\n", result.stdout)
        self.assertIn(f" {questions - 1} certificates verified by the checker", result.stdout)

    def test_claim_made_easier(self):
        """A claim that contradicts itself has a certificate, but it is not what the program has to keep."""
        easy = "(set-logic QF_LRA)\n(assert (>= (- 1.0) 0.0))\n(check-sat)\n"
        [certificate] = {path.with_suffix(".certificate").read_text()
                         for path in self.evidence("smt2") if path.read_text() == easy}
        path = max(self.evidence("smt2"), key=lambda path: len(path.read_text()))
        self.assertNotEqual(path.read_text(), easy)
        path.write_text(easy)
        path.with_suffix(".certificate").write_text(certificate)
        self.assertDetected(f"`{path.relative_to(self.bundle).as_posix()}` has been changed")

    def test_forged_verdict(self):
        self.change(self.bundle / "index.json", '"verdict": "refuted"', '"verdict": "proved"')
        self.assertDetected("O9100.alarm-unreachable.N90: the bundle says proved; it is now refuted")

    def test_forged_bound_and_witness(self):
        index = self.bundle / "index.json"
        text = index.read_text()
        self.change(index, '"bound": "FUP[#21/#22]"', '"bound": "1"')
        self.assertDetected("O9100.loop-ends.N20: ")
        index.write_text(text)
        self.change(index, '"500": 7.0', '"500": 8.0')
        self.assertDetected("O9100.alarm-unreachable.N90: ")

    def test_obligation_left_out(self):
        self.index["files"][0]["obligations"].pop()
        (self.bundle / "index.json").write_text(json.dumps(self.index))
        self.assertDetected("this obligation is missing from the bundle")

    def test_files_that_go_or_come(self):
        path = self.evidence("certificate")[0]
        text = path.read_text()
        path.unlink()
        self.assertDetected(path.relative_to(self.bundle).as_posix())
        path.write_text(text)
        self.write("proofs/more.txt", "more")
        self.assertDetected("`more.txt` does not belong to the bundle")

    def test_index_written_anew(self):
        (self.bundle / "index.json").write_text(json.dumps(self.index))
        self.assertDetected("`index.json` has been changed")

    def test_other_version(self):
        self.change(self.bundle / "index.json", '"feedhold": "', '"feedhold": "9')
        self.assertDetected("it was made by feedhold 9")

    def test_no_bundle(self):
        for text in (None, "{", "[]", '{"version": 1}', '{"version": 2, "feedhold": 3, "options": {}, "files": []}'):
            with self.subTest(text=text):
                folder = self.folder / "none"
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                if text is not None:
                    (folder / "index.json").write_text(text)
                self.assertExit(self.feedhold("recheck", "none"), 2)
        self.assertExit(self.feedhold("recheck", "nowhere"), 2)


if __name__ == "__main__":
    unittest.main()
