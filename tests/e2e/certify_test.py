"""`certify`: a report that is the same each time, that fits together, and whose changes `recheck` finds."""
import hashlib
import html
import html.parser
import json
import re
import shutil
import subprocess
import unittest

import jsonschema

from harness import ROOT, Scratch

SCHEMA = json.loads((ROOT / "docs" / "schemas" / "certificate.schema.json").read_text())

POCKET = """O9100(SLOT <1 & 2>)
(@PARAM #1 LENGTH 10..100 MM)
(@PARAM #18 RADIUS 1..5 MM)
(@MODAL G17 G21 G40 G49 G80 G90 G94)
(@START X0 Y0 Z5.)
(@TOOL FLAT RADIUS #18)
(@CLEARANCE Z2.)
#10=#10(@ALLOW self-assignment KEPT FOR THE DISPLAY)
G90G00Z2.
N20G01Z-5.F100.
N30X[#1-#18]
N50G00Z5.
M99
"""
CONTRACT = "@KEEPIN SLOT BOX X-10..#1 Y-10..10 Z-5..5\n@LIMIT F 1..500\n"
GOUGING = """O9101(SLOT THAT IS TOO LONG)
(@PARAM #1 LENGTH 10..100 MM)
(@MODAL G17 G21 G40 G49 G80 G90 G94)
(@START X0 Y0 Z5.)
(@TOOL FLAT RADIUS 1)
(@KEEPIN SLOT BOX X-10..#1 Y-10..10 Z-5..5)
N20G01Z-5.F100.
N30X#1
N40G65P9100A20.R2.
N50G65P9999
M99
"""


class Links(html.parser.HTMLParser):
    """All ids and all references of a page, and the elements that it must not have."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.references, self.tags = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "xlink:href", "data"):
                self.references.append(value)


class Certify(Scratch):
    made = None  # the files of a report: it is made once

    def setUp(self):
        super().setUp()
        self.write("nc/O9100.nc", POCKET)
        self.write("nc/O9100.contract", CONTRACT)
        self.write("nc/O9101.nc", GOUGING)
        self.write("nc/picture.nc", bytes(range(256)) * 64)
        self.write("feedhold.toml", 'dialect = "fanuc-30i"\n[switches]\nnat = true\n')
        self.report = self.folder / "report"
        if Certify.made is None:
            self.assertExit(self.certify(), 1)
            Certify.made = self.files()
        for name, content in Certify.made.items():
            self.write(f"report/{name}", content)
        self.document = json.loads((self.report / "certificate.json").read_text())
        self.page = (self.report / "index.html").read_text()

    def certify(self, *arguments, paths=("nc",), output="report", **more):
        return self.feedhold("certify", *paths, "-o", output, *arguments, **more)

    def files(self, folder=None):
        folder = folder or self.report
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def program(self, name):
        return next(program for file in self.document["files"] for program in file["programs"]
                    if program["name"] == name)

    def change(self, name, before, after):
        path = self.folder / name
        text = path.read_text()
        self.assertIn(before, text)
        path.write_text(text.replace(before, after, 1))

    def test_the_self_check_is_cited(self):
        told = json.loads(self.feedhold("self-check", "--format", "json").stdout)
        self.assertEqual(self.document["selfCheck"], told["steps"])
        self.assertIn("Self-check of the program that made this report", self.page)
        for step in told["steps"]:
            self.assertIn(html.escape(step["message"], quote=False), self.page)

    def assertDetected(self, *words):
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 1)
        for word in words:
            self.assertIn(word, result.stdout)

    def assertSameBytes(self):
        files = self.files()
        self.assertEqual(sorted(files), sorted(Certify.made))
        self.assertEqual([name for name in files if files[name] != Certify.made[name]], [])

    # ---- the document ----

    def test_document_follows_the_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        jsonschema.validate(self.document, SCHEMA)
        text = (self.report / "certificate.json").read_bytes()
        self.assertEqual(text.decode(), json.dumps(self.document, indent=2, sort_keys=True, ensure_ascii=False) + "\n")

    def test_what_was_read(self):
        sources = {row["path"]: row for row in self.document["sources"]}
        self.assertEqual({path: row["roles"] for path, row in sources.items()},
                         {"../feedhold.toml": ["configuration"], "../nc/O9100.contract": ["contract"],
                          "../nc/O9100.nc": ["called", "program"], "../nc/O9101.nc": ["program"]})
        for path, row in sources.items():
            content = (self.report / path).read_bytes()
            self.assertEqual((row["sha256"], row["bytes"]), (hashlib.sha256(content).hexdigest(), len(content)))

    def test_settings_and_who_chose_them(self):
        file = self.document["files"][0]
        self.assertEqual((file["dialect"], file["chosenBy"], file["config"]),
                         ("fanuc-30i", "config", "../feedhold.toml"))
        switches = {row["name"]: (row["value"], row["chosenBy"]) for row in file["switches"]}
        self.assertEqual(switches["nat"], ("on", "config"))
        self.assertEqual(switches["dpi"][1], "dialect")

    def test_verdicts_are_those_of_prove(self):
        proved = json.loads(self.feedhold("prove", "nc", "--missing", "havoc", "--format", "json").stdout)
        expected = {row["id"]: (row["verdict"], row["claim"], row["line"])
                    for file in proved["files"] for row in file["obligations"]}
        found = {row["id"]: (row["verdict"], row["claim"], row["line"])
                 for file in self.document["files"] for program in file["programs"] for row in program["obligations"]}
        self.assertEqual(found, expected)
        self.assertIn("refuted", {verdict for verdict, _, _ in found.values()})
        self.assertIn("proved", {verdict for verdict, _, _ in found.values()})

    def test_calls_findings_and_what_was_not_checked(self):
        calls = {row["to"]: row["path"] for row in self.program("O9101")["calls"]}
        self.assertEqual(calls, {"O9100": "../nc/O9100.nc", "O9999": None})
        finding = next(row for file in self.document["files"] for row in file["findings"] if row["suppressed"])
        self.assertEqual((finding["rule"], finding["reason"]), ("self-assignment", "KEPT FOR THE DISPLAY"))
        self.assertEqual([row["path"] for row in self.document["skipped"]], ["../nc/picture.nc"])
        self.assertTrue(self.program("O9101")["unmodelled"])

    def test_witness_commands_run_from_the_report(self):
        row = next(row for row in self.program("O9101")["obligations"]
                   if row["kind"] == "keep-in" and row["verdict"] == "refuted")
        command = row["witness"]["plot"].split()
        result = self.feedhold(*command[1:], cwd=self.report)
        self.assertExit(result, 1)
        self.assertIn("outside SLOT", result.stderr)

    # ---- the page ----

    def test_page_stands_alone(self):
        links = Links(self.page)
        self.assertFalse(links.tags & {"script", "link", "img", "iframe", "object", "embed"})
        self.assertNotIn("url(", self.page)
        self.assertNotRegex(self.page.replace("http://www.w3.org/2000/svg", ""), r"https?://")
        self.assertEqual(len(links.ids), len(set(links.ids)))
        for reference in links.references:
            if reference.startswith("#"):
                self.assertIn(reference[1:], links.ids)
            else:
                self.assertTrue((self.report / reference).is_file(), reference)

    def test_page_says_what_there_is(self):
        sha256 = hashlib.sha256((self.report / "certificate.json").read_bytes()).hexdigest()
        self.assertIn(sha256, self.page)
        for row in self.document["sources"]:
            self.assertIn(row["sha256"], self.page)
        for file in self.document["files"]:
            for program in file["programs"]:
                for row in program["obligations"]:
                    self.assertIn(row["id"], self.page)
                for row in program["clauses"]:
                    self.assertIn(row["text"], self.page)
        for words in ("SLOT &lt;1 &amp; 2&gt;", "KEPT FOR THE DISPLAY", "picture.nc", "Author", "Checker", "Approver",
                      "not a safety function", "Do not run", "nat = on", "O9999"):
            self.assertTrue(words in self.page, words)
        for row in self.document["assumptions"]:
            self.assertIn(f'id="{row["id"]}"', self.page)

    def test_pictures(self):
        [good], [bad] = self.program("O9100")["runs"], self.program("O9101")["runs"]
        self.assertIsNone(good["witnessOf"])
        self.assertRegex(good["call"], r"^G65 P9100 A[0-9.]+ R[0-9.]+$")
        self.assertIn(".keep-in.", bad["witnessOf"])
        self.assertEqual(self.page.count("<svg xmlns"), 2)
        self.assertEqual(self.page.count("<style>"), 2, "the style of pictures stands there once")
        self.assertIn("outside SLOT", (self.report / bad["picture"]["file"]).read_text())

    # ---- the same each time ----

    def test_same_bytes(self):
        shutil.rmtree(self.report)
        self.assertExit(self.certify("--jobs", "1"), 1)
        self.assertSameBytes()
        self.assertExit(self.certify("--jobs", "2", cwd=self.folder / "nc", paths=["."], output="../report"), 1)
        self.assertSameBytes()
        absolute = self.certify(paths=[self.folder / "nc"], output=self.report, cwd="/")
        self.assertExit(absolute, 1)
        self.assertSameBytes()

    def test_date(self):
        self.assertIsNone(self.document["date"])
        self.certify("--only", "limit", environment={"SOURCE_DATE_EPOCH": "1700000000"})
        self.assertIn("2023-11-14", (self.report / "index.html").read_text())
        self.certify("--only", "limit", "--date", "week <7>", environment={"SOURCE_DATE_EPOCH": "1700000000"})
        self.assertIn("week &lt;7&gt;", (self.report / "index.html").read_text())
        self.assertExit(self.feedhold("recheck", "report"), 0)
        self.assertExit(self.certify(environment={"SOURCE_DATE_EPOCH": "soon"}), 2)

    # ---- a report or none ----

    def test_exit_codes_are_those_of_prove(self):
        self.assertExit(self.certify("--only", "limit"), 0)
        self.write("nc/O9102.nc", "O9102\nN10 IF[#1000EQ1]GOTO10\nM99\n")
        self.assertExit(self.certify("--only", "limit"), 0)
        self.assertExit(self.certify(paths=["nc/O9102.nc"]), self.feedhold("prove", "nc/O9102.nc").returncode)

    def test_failed_run_leaves_the_old_report(self):
        self.write("nc/O9103.nc", "O9103\n(@PARAM #1 LENGTH 5..ABC MM)\nM99\n")
        result = self.certify()
        self.assertExit(result, 2)
        self.assertIn("the contract of O9103 has errors", result.stderr)
        self.assertSameBytes()
        self.assertExit(self.certify(paths=["missing.nc"], output="fresh"), 2)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["feedhold.toml", "nc", "report"])

    def test_other_folders_are_not_taken(self):
        self.write("other/notes.txt", "mine")
        result = self.certify(output="other")
        self.assertExit(result, 2)
        self.assertIn("contains other files", result.stderr)
        self.assertExit(self.certify(paths=["-"]), 2)
        self.assertEqual(self.files(self.folder / "other"), {"notes.txt": b"mine"})

    # ---- recheck ----

    def test_nothing_changed(self):
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 0)
        self.assertRegex(result.stdout, r"no differences: 4 sources unchanged, [1-9][0-9]* obligations proved again\n"
                                        r"evidence: [1-9][0-9]* questions, [1-9][0-9]* certificates verified")
        self.assertExit(self.feedhold("recheck", "../report", cwd=self.folder / "nc"), 0)

    def test_report_moves_with_its_programs(self):
        other = self.folder / "elsewhere"
        other.mkdir()
        for name in ("nc", "report", "feedhold.toml"):
            shutil.move(self.folder / name, other / name)
        self.assertExit(self.feedhold("recheck", "elsewhere/report"), 0)

    def test_report_without_programs(self):
        """Nothing is wrong, but not all was compared."""
        shutil.move(self.folder / "nc", self.folder / "away")
        (self.folder / "feedhold.toml").unlink()
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 3)
        self.assertIn("nothing proved again", result.stdout)
        self.assertIn("`../nc/O9100.nc` is missing", result.stderr)
        self.write("away/feedhold.toml", 'dialect = "fanuc-30i"\n[switches]\nnat = true\n')
        self.assertExit(self.feedhold("recheck", "report", "--against", "away"), 3)
        self.change("away/O9100.nc", "F100.", "F101.")
        result = self.feedhold("recheck", "report", "--against", "away")
        self.assertExit(result, 1)
        self.assertIn("`../nc/O9100.nc` has changed", result.stdout)

    def test_changed_sources(self):
        for name, before, after in (("nc/O9100.nc", "(SLOT", "(SLIT"), ("nc/O9100.contract", "1..500", "1..600"),
                                    ("feedhold.toml", "nat = true", "nat = false")):
            with self.subTest(name=name):
                self.change(name, before, after)
                self.assertDetected(f"`../{name}` has changed since it was proved")
                self.change(name, after, before)

    def test_source_that_goes_or_comes(self):
        self.write("nc/O9102.nc", "O9102\nM99\n")
        self.assertDetected("O9102.nc")
        (self.folder / "nc/O9102.nc").unlink()
        (self.folder / "nc/O9100.contract").unlink()
        self.assertDetected("`../nc/O9100.contract` was read for the proof but is missing now")

    def test_forged_verdict(self):
        self.change("report/certificate.json", '"verdict": "refuted"', '"verdict": "proved"')
        self.assertDetected("`index.html` is not the page of this `certificate.json`", "verdict` differs from a new proof")

    def test_forged_page(self):
        for before, after in (("✗ refuted", "✓ proved"), ("Not fit for release", "Fit for release"), ("A-3", "A-4")):
            with self.subTest(before=before):
                self.change("report/index.html", before, after)
                self.assertDetected("`index.html` is not the page of this `certificate.json`")
                self.change("report/index.html", after, before)

    def test_forged_document_members(self):
        for before, after in (('"summary": "', '"summary": "Fine. '), ('"bytes": ', '"bytes": 1'),
                              ('"chosenBy": "config"', '"chosenBy": "option"'), ('"version": 2', '"version":  2')):
            with self.subTest(before=before):
                self.change("report/certificate.json", before, after)
                self.assertDetected("certificate.json")
                self.change("report/certificate.json", after, before)

    def test_changed_evidence_and_pictures(self):
        largest = {}
        for path in self.report.rglob("*"):
            if path.suffix in (".smt2", ".certificate", ".svg"):
                largest[path.suffix] = max(largest.get(path.suffix, path), path, key=lambda each: each.stat().st_size)
        self.assertEqual(len(largest), 3)
        for path in [*largest.values(), self.report / "certificate" / "index.json"]:
            text = path.read_text()
            digit = re.search(r"[1-8]", text[len(text) // 2:]).start() + len(text) // 2
            with self.subTest(path=path.name):
                path.write_text(text[:digit] + str(int(text[digit]) + 1) + text[digit + 1:])
                self.assertDetected(f"`{path.relative_to(self.report).as_posix()}`")
                path.unlink()
                self.assertDetected(f"`{path.relative_to(self.report).as_posix()}` is missing")
            path.write_text(text)
        self.assertExit(self.feedhold("recheck", "report"), 0)

    def test_files_that_do_not_belong(self):
        self.write("report/more.txt", "more")
        self.assertDetected("`more.txt` does not belong to the report")

    def test_other_version(self):
        self.change("report/certificate.json", '"feedhold": "', '"feedhold": "9')
        self.assertDetected("it was made by feedhold 9")

    def test_no_report(self):
        for text in ("{", "[]", '{"version": 1}', '{"version": 2, "feedhold": 3}'):
            with self.subTest(text=text):
                self.write("none/certificate.json", text)
                self.assertExit(self.feedhold("recheck", "none"), 2)

    def test_folder_that_holds_none(self):
        self.write("none/index.html", "of some other program")
        result = self.feedhold("recheck", "none")
        self.assertExit(result, 2)
        self.assertIn("no certificate.json and no index.json", result.stderr)


class QuestionsToSolvers(Scratch):
    """Of a claim that two solvers prove and no certificate."""

    def setUp(self):
        super().setUp()
        if not shutil.which("cvc5"):
            self.skipTest("cvc5 is not installed")
        self.write("O9115.nc", (ROOT / "corpus" / "packages" / "mould-entry" / "O9115.nc").read_bytes())
        self.assertExit(self.feedhold("certify", "O9115.nc", "-o", "report", "--dialect", "fanuc-30i"), 1)
        self.questions = sorted((self.folder / "report" / "certificate").rglob("*.smt2"))
        (self.query,) = (path for path in self.questions if not path.with_suffix(".certificate").exists())

    def test_each_solver_is_asked(self):
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 0)
        asked = len(self.questions)
        self.assertGreater(asked, 1)
        self.assertIn(f"{asked} questions, {asked - 1} certificates verified by the checker, {asked} asked again",
                      result.stdout)
        for solver in ("z3", "cvc5"):
            said = re.search(solver + r" [0-9.]+ refutes (\d+)(?:, gives no answer to (\d+))?[;)]", result.stdout)
            self.assertEqual(int(said[1]) + int(said[2] or 0), asked, "a solver contradicts a certificate")
            self.assertGreaterEqual(int(said[1]), 0.9 * asked - 1)

    def test_each_solver_is_asked_where_it_is_needed(self):
        result = self.feedhold("recheck", "report", "--solvers", "needed", "-v")
        self.assertExit(result, 0)
        self.assertRegex(result.stdout, r" 1 asked again \(z3 [0-9.]+ refutes 1; cvc5 [0-9.]+ refutes 1\)")
        name = self.query.relative_to(self.folder / "report").as_posix()
        self.assertIn(f"{name}: Z3 refutes it, cvc5 refutes it\n", result.stdout)

    def test_changed_question_is_found(self):
        text = self.query.read_text()
        first = text.index("(assert")
        self.query.write_text(text[:first] + "(assert true)\n" + text[first:])
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 1)
        self.assertIn(self.query.name, result.stdout)

    def test_question_without_its_assumptions_is_refuted_by_nobody(self):
        lines = self.query.read_text().splitlines()
        self.query.write_text("\n".join(line for line in lines if not line.startswith("(assert")) + "\n")
        result = self.feedhold("recheck", "report")
        self.assertExit(result, 1)
        self.assertIn(f"{self.query.name}`: neither Z3 nor cvc5 refutes it", result.stdout)

    def test_questions_are_smtlib(self):
        """What the solvers say of the files themselves, run by hand as a reader of the report would."""
        for question in self.questions:
            with self.subTest(question=question.name):
                said = subprocess.run(["cvc5", "--nl-ext=full", "--nl-ext-tplanes-interleave", "--rlimit=40000",
                                       question], capture_output=True, text=True, check=False)
                self.assertEqual(said.stderr, "")
                self.assertIn(said.stdout, ("unsat\n", "unknown\n"))


if __name__ == "__main__":
    unittest.main()
