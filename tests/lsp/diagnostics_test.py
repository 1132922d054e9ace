"""What the server says of a document is what `feedhold check` says of the file, however the text came about."""
import json
import os
import random
import subprocess
import unittest

from harness import ROOT, SLIP, STEPS, Session, at

FEEDHOLD = os.environ["FEEDHOLD"]


def programs():
    """Programs of the corpus and of the tests that are UTF-8: the editor shows no others as they are."""
    for folder in (ROOT / "corpus", ROOT / "tests"):
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() in (".nc", ".cnc", ".tap", ".ngc", ".eia", ".min", ".mac", ".prg") and path.is_file():
                try:
                    yield path, path.read_bytes().decode("utf-8")
                except UnicodeDecodeError:
                    continue


def rows_of(diagnostics):
    severities = {1: "error", 2: "warning", 3: "info"}
    return sorted((d["range"]["start"]["line"] + 1, d["range"]["start"]["character"] + 1,
                   d["range"]["end"]["line"] + 1, d["range"]["end"]["character"] + 1,
                   d["code"], severities[d["severity"]], d["message"]) for d in diagnostics)


def rows_of_check(findings):
    return sorted((f["line"], f["column"], f["endLine"], f["endColumn"], f["rule"], f["severity"],
                   "\n".join([f["message"], *f["notes"]])) for f in findings)


def check(path):
    result = subprocess.run([FEEDHOLD, "check", "--severity", "info", "--format", "json", str(path)], capture_output=True, cwd=path.parent)
    return [f for f in json.loads(result.stdout)["findings"] if f["path"] == str(path)]


class SameAsCheck(Session):
    def test_programs(self):
        client = self.client(options={"proofs": "off"})
        compared = found = 0
        for path, text in programs():
            if "\r\r" in text or "\ufeff" in text:
                continue  # lines and columns are counted differently by the protocol
            uri = client.open(path.as_uri(), text)
            expected = rows_of_check(check(path))
            if "\r" in text.replace("\r\n", ""):
                expected = sorted(row[4:] for row in expected)
                self.assertEqual(sorted(row[4:] for row in rows_of(client.all_findings(uri, 1))), expected, path)
            else:
                self.assertEqual(rows_of(client.all_findings(uri, 1)), expected, path)
            client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
            self.assertEqual(client.diagnostics(uri), [])
            compared, found = compared + 1, found + len(expected)
        self.assertGreater(compared, 100)
        self.assertGreater(found, 50)


class Edits(Session):
    PIECES = ("", "\n", "G01 X10.\n", "#1=#2/#3\n", "GOTO 10\n", "N10\n", "WHILE[#1LT5]DO1\n", "END1\n", "(", ")", "[",
              "]", "é", "漢字", "𝒳", "%\n", "O2000\n", "IF[#1EQ#0]GOTO 99\n", "G65 P9100 A1\n", " ", "\t", "\r\n")

    def test_random_edits(self):
        """After each series of incremental edits the findings are those of the same text opened anew."""
        generator = random.Random(20)
        for encoding in ("utf-8", "utf-16"):
            client = self.client(capabilities={"general": {"positionEncodings": [encoding]}}, options={"proofs": "off"})
            self.assertEqual(client.server["capabilities"]["positionEncoding"], encoding)
            text, version = SLIP + STEPS, 1
            uri = client.open("edited.nc", text)
            for _ in range(40):
                for _ in range(generator.randrange(1, 6)):
                    version += 1
                    changes = []
                    for _ in range(generator.randrange(1, 3)):
                        text, change = self.edit(generator, text, encoding)
                        changes.append(change)
                    client.change(uri, version, *changes)
                fresh = client.open(f"fresh{version}.nc", text)
                self.assertEqual(client.all_findings(fresh, 1),
                                 json.loads(json.dumps(self.last(client, uri, version)).replace(uri, fresh)), text)
                client.notify("textDocument/didClose", {"textDocument": {"uri": fresh}})
            self.assertEqual(client.close(), 0)

    def last(self, client, uri, version):
        """All findings of this version, which may have come before those of another document."""
        seen = [m["params"] for m in client.kept if m.get("method") == "textDocument/publishDiagnostics" and
                m["params"]["uri"] == uri and m["params"].get("version") == version]
        if len(seen) >= 2:
            return seen[1]["diagnostics"]
        return client.diagnostics(uri, version, count=2 - len(seen))

    def edit(self, generator, text, encoding):
        begin = generator.randrange(len(text) + 1)
        end = min(len(text), begin + generator.choice((0, 0, 1, 2, 10, 60)))
        if generator.random() < 0.05:
            text = text[:begin] + text[end:]
            return text, {"text": text}
        if text[begin - 1:begin + 1] == "\r\n" or text[end - 1:end + 1] == "\r\n":
            begin = end = 0  # no position is between the two
        new = generator.choice(self.PIECES)
        if text[begin - 1:begin] == "\r" or new.endswith("\r") or (new.startswith("\n") and text[begin - 1:begin] == "\r"):
            new = ""
        change = {"range": {"start": self.position(text, begin, encoding), "end": self.position(text, end, encoding)},
                  "text": new}
        return text[:begin] + new + text[end:], change

    @staticmethod
    def position(text, offset, encoding):
        before = text[:offset].replace("\r\n", "\n").replace("\r", "\n")
        line = before.rsplit("\n", 1)[-1]
        width = len(line.encode("utf-8")) if encoding == "utf-8" else len(line.encode("utf-16-le")) // 2
        return {"line": before.count("\n"), "character": width}

    def test_positions_outside(self):
        """Behind the end of a line means its end, behind the text the end of the text."""
        client = self.client()
        uri = client.open("a.nc", SLIP)
        client.change(uri, 2, {"range": {"start": {"line": 3, "character": 5}, "end": {"line": 3, "character": 9999}},
                               "text": "10"},
                      {"range": {"start": {"line": 9999, "character": 0}, "end": {"line": 9999, "character": 5}},
                       "text": ""})
        message = next(d["message"] for d in client.all_findings(uri, 2) if d["code"] == "goto-missing-label")
        self.assertIn("`GOTO 10`", message)


class Flow(Session):
    def test_flow_findings_follow_the_text(self):
        """Until they are found anew they move with their lines, and go with what they speak of."""
        client = self.client(options={"proofs": "off"})
        text = "%\nO1\n#1=5\nG00X1.\nM30\n%\n"
        uri = client.open("a.nc", text)
        first = client.all_findings(uri, 1)
        unset = next(d for d in first if d["code"] == "distance-mode-not-set")
        client.change(uri, 2, {"range": at(1, 0), "text": "(A)\n(B)\n"})
        moved = client.diagnostics(uri, 2)
        line = unset["range"]["start"]["line"]
        self.assertIn((line + 2, "distance-mode-not-set"), [(d["range"]["start"]["line"], d["code"]) for d in moved])
        self.assertEqual(client.diagnostics(uri, 2), moved)
        client.change(uri, 3, {"range": at(line + 2, 0, 6), "text": ""})
        self.assertNotIn("distance-mode-not-set", self.codes(client.diagnostics(uri, 3)))

    def test_unreachable_code_is_greyed(self):
        client = self.client()
        uri = client.open("a.nc", SLIP)
        found = {d["code"]: d for d in client.diagnostics(uri, 1)}
        self.assertEqual(found["unreachable-block"]["tags"], [1])
        self.assertTrue(found["unreachable-block"]["relatedInformation"])


class Documents(Session):
    def test_untitled(self):
        client = self.client()
        uri = client.open("untitled:Untitled-1", SLIP)
        self.assertIn("missing-equals", self.codes(client.all_findings(uri, 1)))

    def test_unsaved_text_counts(self):
        self.write("a.nc", SLIP)
        client = self.client()
        uri = client.open("a.nc", "%\nO1\nM30\n%\n")
        self.assertEqual(client.all_findings(uri, 1), [])

    def test_not_a_program(self):
        self.write("a.txt", "Dear reader,\nthis is a letter.\n")
        client = self.client()
        self.assertEqual(client.diagnostics(client.open("a.txt", "Dear reader,\nthis is a letter.\n")), [])

    def test_pages_of_rules(self):
        client = self.client(arguments=("--cache-dir", str(self.folder / "cache")))
        found = client.diagnostics(client.open("a.nc", SLIP))
        for diagnostic in found:
            page = diagnostic["codeDescription"]["href"]
            self.assertTrue(page.startswith("file://"))
            with open(page.removeprefix("file://"), encoding="utf-8") as stream:
                self.assertIn(f"# {diagnostic['code']}", stream.readline())

    def test_configuration(self):
        """A change of `feedhold.toml` is taken at once; a mistake in it is told once."""
        self.write("a.nc", SLIP)
        client = self.client()
        uri = client.open("a.nc", SLIP)
        self.assertIn("goto-missing-label", self.codes(client.all_findings(uri)))
        config = self.write("feedhold.toml", 'ignore = ["goto-missing-label"]\n')
        client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": config.as_uri(), "type": 1}]})
        self.assertNotIn("goto-missing-label", self.codes(client.all_findings(uri)))
        self.write("feedhold.toml", 'ignroe = ["goto-missing-label"]\n')
        client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": config.as_uri(), "type": 2}]})
        told = client.wait(lambda m: m.get("method") == "window/showMessage")["params"]
        self.assertIn("feedhold.toml:1:1", told["message"])

    def test_folders(self):
        """A document that is not on disk has the configuration of the first folder that is left."""
        self.write("one/feedhold.toml", 'ignore = ["goto-missing-label"]\n')
        self.write("two/feedhold.toml", 'ignore = ["missing-equals"]\n')
        one, two = ({"uri": client_uri, "name": "w"} for client_uri in
                    ((self.folder / "one").as_uri(), (self.folder / "two").as_uri()))
        client = self.client()
        root = {"uri": client.uri(""), "name": "w"}
        uri = client.open("untitled:U", SLIP)
        client.all_findings(uri)
        for added, removed, ignored in ((one, root, "goto-missing-label"), (two, one, "missing-equals")):
            client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [added], "removed": [removed]}})
            codes = self.codes(client.all_findings(uri))
            self.assertNotIn(ignored, codes)
            self.assertEqual(len({"goto-missing-label", "missing-equals"} & set(codes)), 1)

    def test_contract_beside_the_program(self):
        """Findings in a file with contracts are shown there, by its program or when it is open itself."""
        program = "%\nO9100\n#1=#21\nM99\n%\n"
        self.write("O9100.nc", program)
        contract = self.write("O9100.contract", "@REQUIRE #21 GR 0\n")
        client = self.client(options={"proofs": "off"})
        client.open("O9100.nc", program)
        self.assertTrue(client.diagnostics(contract.as_uri()))
        uri = client.open("O9100.contract", "@REQUIRE #21 GT 0\n")
        self.assertEqual(client.diagnostics(uri, 1), [])
        client.change(uri, 2, {"text": "@REQUIRE #21 GE\n"})
        self.assertTrue(client.diagnostics(uri, 2))

    def test_pulling(self):
        client = self.client(capabilities={"textDocument": {"diagnostic": {}}}, options={"proofs": "off"})
        self.assertEqual(client.server["capabilities"]["diagnosticProvider"]["identifier"], "feedhold")
        uri = client.open("a.nc", SLIP)
        params = {"textDocument": {"uri": uri}}
        report = client.request("textDocument/diagnostic", params)
        self.assertEqual(report["kind"], "full")
        self.assertIn("missing-equals", self.codes(report["items"]))
        again = client.request("textDocument/diagnostic", {**params, "previousResultId": report["resultId"]})
        self.assertEqual(again, {"kind": "unchanged", "resultId": report["resultId"]})
        pushed = [m for m in client.kept if m.get("method") == "textDocument/publishDiagnostics"]
        self.assertFalse(any(m["params"]["diagnostics"] for m in pushed), "shown twice")


if __name__ == "__main__":
    unittest.main(verbosity=1)
