"""Documents in a folder of the workspace: findings as `feedhold check` of the folder has them, files with contracts that
several programs share, and URIs in the client's own spelling."""
import json
import os
import subprocess
import unittest

from diagnostics_test import rows_of, rows_of_check
from harness import ROOT, STEPS, Session, at

FEEDHOLD = os.environ["FEEDHOLD"]

CALLER = "%\nO1000\nG17 G21 G40 G49 G80 G90 G94\n#500=1\nM98 P2000\nN50 M30\n%\n"
CALLED = "%\nO2000\nG65 P9000 A1. B2.\nM99 P50\n%\n"
READER = "%\nO9000\n#500=#1\nM99\n%\n"


def check(path):
    """Findings of a file or a folder by path, as rows."""
    result = subprocess.run([FEEDHOLD, "check", "--severity", "info", "--format", "json", str(path)], capture_output=True)
    found = {}
    for finding in json.loads(result.stdout)["findings"]:
        if not finding.get("suppressed"):
            found.setdefault(finding["path"], []).append(finding)
    return {path: rows_of_check(findings) for path, findings in found.items()}


class Folder(Session):
    def last(self, client, uri):
        """What is shown once everything that is under way has been said."""
        client.settle()
        return [m["params"]["diagnostics"] for m in client.kept
                if m.get("method") == "textDocument/publishDiagnostics" and m["params"]["uri"] == uri][-1]

    def test_calls_of_other_files(self):
        """Only with all files it is known that the label is missing, who reads an argument, and what no file has."""
        for name, text in (("O1000.nc", CALLER), ("O2000.nc", CALLED), ("O9000.nc", READER)):
            self.write(name, text)
        expected = check(self.folder)
        codes = [row[4] for row in expected[str(self.folder / "O2000.nc")]]
        self.assertIn("unread-argument", codes)
        client = self.client(options={"proofs": "off"})
        uri = client.open("O2000.nc", CALLED)
        self.assertEqual(rows_of(client.all_findings(uri, 1)), expected[str(self.folder / "O2000.nc")])

    def test_a_change_in_another_document(self):
        """What a caller says of a program comes a moment after the caller is another one."""
        for name, text in (("O1000.nc", CALLER), ("O2000.nc", CALLED), ("O9000.nc", READER)):
            self.write(name, text)
        client = self.client(options={"proofs": "off"})
        called = client.open("O2000.nc", CALLED)
        self.assertNotIn("goto-missing-label", self.codes(client.all_findings(called, 1)))
        caller = client.open("O1000.nc", CALLER)
        client.all_findings(caller, 1)
        client.change(caller, 2, {"text": CALLER.replace("N50", "N60")})
        self.assertIn("goto-missing-label", self.codes(client.diagnostics(called, 1)))
        client.change(caller, 3, {"text": CALLER})
        self.assertNotIn("goto-missing-label", self.codes(client.diagnostics(called, 1)))

    def test_what_the_folder_denies_does_not_come_back(self):
        """A suppression that only the folder uses is not unused at the next keystroke either."""
        allowed = CALLED.replace("B2.\n", "B2. (@ALLOW unread-argument the other machine reads it)\n")
        for name, text in (("O2000.nc", allowed), ("O9000.nc", READER)):
            self.write(name, text)
        client = self.client(options={"proofs": "off"})
        uri = client.open("O2000.nc", allowed)
        self.assertEqual(self.codes(client.all_findings(uri, 1)), [])
        for version in range(2, 6):
            client.change(uri, version, {"range": at(1, 5), "text": "\n"})
            for _ in range(2):
                self.assertNotIn("unused-suppression", self.codes(client.diagnostics(uri, version)))
        fixes = client.request("textDocument/codeAction", {
            "textDocument": {"uri": uri}, "context": {"diagnostics": [], "only": ["source.fixAll"]},
            "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}})
        self.assertEqual(fixes, [])

    def test_packages(self):
        """Every third program of the corpus, among all of them."""
        folder = ROOT / "corpus" / "packages"
        expected = check(folder)
        client = self.client(options={"proofs": "off"}, folder=folder)
        compared = 0
        for path in sorted(folder.rglob("*.nc"))[::3]:
            try:
                text = path.read_bytes().decode("utf-8")
            except UnicodeDecodeError:
                continue
            uri = client.open(path.as_uri(), text)
            self.assertEqual(rows_of(client.all_findings(uri, 1)), expected.get(str(path), []), path)
            client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
            compared += 1
        self.assertGreater(compared, 20)

    def test_several_documents_at_once(self):
        for number in range(8):
            self.write(f"O{1000 + number}.nc", CALLER.replace("O1000", f"O{1000 + number}"))
        self.write("O2000.nc", CALLED)
        self.write("O9000.nc", READER)
        expected = check(self.folder)
        client = self.client(options={"proofs": "off"})
        uris = {path: client.open(path.name, path.read_text()) for path in sorted(self.folder.glob("*.nc"))}
        for path, uri in uris.items():
            self.assertEqual(rows_of(self.last(client, uri)), expected.get(str(path), []), path)

    def test_folders_beyond_measure(self):
        """A workspace that is no folder of programs: findings are those of the document alone."""
        for folder in range(25):
            for name in range(1000):
                self.write(f"f{folder}/{name}.h", "")
        self.write("O2000.nc", CALLED)
        self.write("O9000.nc", READER)
        client = self.client(options={"proofs": "off"})
        uri = client.open("O2000.nc", CALLED)
        self.assertEqual(rows_of(client.all_findings(uri, 1)), check_alone(self.folder / "O2000.nc"))

    def test_large_folders_say_what_a_document_says_alone_first(self):
        for number in range(600):
            self.write(f"more/O{3000 + number}.nc", f"%\nO{3000 + number}\nM99\n%\n")
        self.write("O2000.nc", CALLED)
        self.write("O9000.nc", READER)
        client = self.client(options={"proofs": "off"})
        uri = client.open("O2000.nc", CALLED)
        self.assertEqual(rows_of(client.all_findings(uri, 1)), check_alone(self.folder / "O2000.nc"))
        self.assertEqual(rows_of(client.diagnostics(uri, 1)), check(self.folder)[str(self.folder / "O2000.nc")])


def check_alone(path):
    return check(path).get(str(path), [])


class Sidecars(Session):
    def test_shared_by_two_programs(self):
        """Closing one of two programs leaves what the other says of the file that they share."""
        contract = self.write("O9100.contract", "@REQUIRE #21 GR 0\n").as_uri()
        both = [self.write(name, STEPS) for name in ("one.nc", "two.nc")]
        client = self.client(options={"proofs": "off"})
        uris = [client.open(path.name, STEPS) for path in both]
        client.settle()
        self.assertEqual(len(self.shown(client, contract)), 1)
        client.notify("textDocument/didClose", {"textDocument": {"uri": uris[0]}})
        client.settle()
        self.assertEqual(len(self.shown(client, contract)), 1)
        client.notify("textDocument/didClose", {"textDocument": {"uri": uris[1]}})
        client.settle()
        self.assertEqual(self.shown(client, contract), [])

    def test_what_one_of_two_programs_uses_is_not_unused(self):
        self.write("O9100.contract", "@ALLOW goto-missing-label released like this\n")
        self.write("one.nc", STEPS.replace("M99", "GOTO 77\nM99"))
        self.write("two.nc", STEPS)
        self.assertFalse(check(self.folder).get(str(self.folder / "O9100.contract")))
        client = self.client(options={"proofs": "off"})
        client.all_findings(client.open("two.nc", STEPS), 1)
        client.settle()
        self.assertEqual(self.shown(client, client.uri("O9100.contract")), [])
        uri = client.open("O9100.contract", "@ALLOW goto-missing-label released like this\n")
        self.assertEqual(client.all_findings(uri, 1), [])
        client.change(uri, 2, {"text": "@ALLOW unread-argument nobody\n"})
        self.assertIn("unused-suppression", self.codes(client.all_findings(uri, 2)))

    def shown(self, client, uri):
        said = [m["params"]["diagnostics"] for m in client.kept
                if m.get("method") == "textDocument/publishDiagnostics" and m["params"]["uri"] == uri]
        return said[-1] if said else []


class Uris(Session):
    """Whatever spelling a client has for a document, it is told of the document under it, and its text counts."""

    def calls(self, spell):
        """A caller on disk, and the program that it calls, open under another URI than ours and with another text."""
        (self.folder / "shop #1").mkdir()
        client = self.client(options={"proofs": "off"})
        self.write("shop #1/O1000.nc", CALLER)
        self.write("shop #1/O2000.nc", "%\nO2000\nM99\n%\n")
        called = client.open(spell("O2000.nc"), "%\nO2000\n(NEW)\n#500=1\nM99\n%\n")
        caller = client.open(spell("O1000.nc"), CALLER)
        client.all_findings(caller, 1)
        return client, caller, called

    def assertSpelling(self, spell):
        client, caller, called = self.calls(spell)
        target = client.request("textDocument/definition", {"textDocument": {"uri": caller}, "position": {
            "line": 4, "character": 6}})
        for location in target if isinstance(target, list) else [target]:
            self.assertEqual(location.get("uri", location.get("targetUri")), called)
        edit = client.request("textDocument/rename", {"textDocument": {"uri": caller}, "newName": "#501", "position": {
            "line": 3, "character": 1}})
        self.assertEqual(set(edit["changes"]), {caller, called}, edit)
        told = {m["params"]["uri"] for m in client.kept if m.get("method") == "textDocument/publishDiagnostics"}
        self.assertLessEqual(told, {caller, called})
        places = client.request("textDocument/references", {
            "textDocument": {"uri": caller}, "position": {"line": 3, "character": 1}, "context": {
                "includeDeclaration": True}})
        self.assertIn((called, 3), [(place["uri"], place["range"]["start"]["line"]) for place in places])

    def test_escapes_of_the_client(self):
        self.assertSpelling(lambda name: f"file://{self.folder}/shop%20%231/%4f{name[1:]}")

    def test_escapes_in_small_letters(self):
        self.assertSpelling(lambda name: f"file://{self.folder}/shop%20%231/{name[0]}%32000.nc" if name[1] == "2"
                            else f"file://{self.folder}/shop%20%231/{name}")

    def test_links(self):
        """The folder of one is a link to the folder of the other."""
        link = self.folder / "link"
        link.symlink_to(self.folder / "shop #1")
        self.assertSpelling(lambda name: (link / name if name.startswith("O2") else
                                          self.folder / "shop #1" / name).as_uri())

    def test_files_with_contracts(self):
        """Of one that is not open the folder is spelt as for its program."""
        (self.folder / "shop (1)").mkdir()
        self.write("shop (1)/O9100.contract", "@REQUIRE #21 GR 0\n")
        self.write("shop (1)/O9100.nc", STEPS)
        client = self.client(options={"proofs": "off"})
        client.all_findings(client.open(f"file://{self.folder}/shop%20(1)/O9100.nc", STEPS), 1)
        contract = f"file://{self.folder}/shop%20(1)/O9100.contract"
        client.settle()
        self.assertIn(contract, {m["params"]["uri"] for m in client.kept
                                 if m.get("method") == "textDocument/publishDiagnostics"})


if __name__ == "__main__":
    unittest.main(verbosity=1)
