"""What can be done about findings, and formatting."""
import json
import os
import re
import subprocess
import unittest
from pathlib import Path
from urllib.parse import unquote

from harness import SLIP, Session, at
from diagnostics_test import programs

FEEDHOLD = os.environ["FEEDHOLD"]


def offset(text, position):
    lines = text.split("\n")
    line = lines[position["line"]]
    units = line.encode("utf-16-le")[:2 * position["character"]].decode("utf-16-le")
    return sum(len(each) + 1 for each in lines[:position["line"]]) + len(units)


def applied(text, edits):
    """The text with edits of the protocol, as an editor applies them."""
    for edit in sorted(edits, key=lambda e: offset(text, e["range"]["start"]), reverse=True):
        text = text[:offset(text, edit["range"]["start"])] + edit["newText"] + text[offset(text, edit["range"]["end"]):]
    return text


class Actions(Session):
    def ask(self, client, uri, begin, end, **context):
        return client.request("textDocument/codeAction", {
            "textDocument": {"uri": uri}, "context": {"diagnostics": [], **context},
            "range": {"start": {"line": begin, "character": 0}, "end": {"line": end, "character": 0}}})

    def opened(self, text, name="a.nc"):
        client = self.client(options={"proofs": "off"})
        uri = client.open(name, text)
        return client, uri, client.all_findings(uri, 1)

    def test_every_fix_is_offered_and_repairs(self):
        client, uri, found = self.opened(SLIP)
        self.assertIn("missing-equals", self.codes(found))
        actions = self.ask(client, uri, 2, 2, only=["quickfix"])
        fix = next(a for a in actions if a["diagnostics"][0]["code"] == "missing-equals" and "allow" not in a["title"])
        client.change(uri, 2, {"text": applied(SLIP, fix["edit"]["changes"][uri])})
        self.assertNotIn("missing-equals", self.codes(client.all_findings(uri, 2)))

    def test_allowing(self):
        """The comment takes the finding away, and the missing reason is asked for."""
        client, uri, _ = self.opened(SLIP)
        for action in self.ask(client, uri, 3, 4):
            if action["title"] == "allow `goto-missing-label` here, with a reason":
                text = applied(SLIP, action["edit"]["changes"][uri])
        client.change(uri, 2, {"text": text})
        codes = self.codes(client.all_findings(uri, 2))
        self.assertNotIn("goto-missing-label", codes)
        self.assertIn("suppression-without-reason", codes)

    def test_allowing_in_front_of_a_comment_without_an_end(self):
        """Behind it, the words of the suppression would be part of that comment, and might close it."""
        cases = (("a.nc", "O1\nGOTO 99 (TO THE CLAMP\nM30\n", "goto-missing-label", "GOTO 99 (@ALLOW goto-missing-label )"),
                 ("b.nc", "O1\n(TO THE CLAMP\nM30\n", "unclosed-comment", "(@ALLOW unclosed-comment )"),
                 ("c.ngc", "#1-3 ; THE CLAMP\nM2\n", "missing-equals", "#1-3 (@ALLOW missing-equals )"))
        for name, before, rule, begin in cases:
            client, uri, found = self.opened(before, name)
            self.assertIn(rule, self.codes(found))
            action, = [a for a in self.ask(client, uri, 0, 9) if a["title"] == f"allow `{rule}` here, with a reason"]
            text = applied(before, action["edit"]["changes"][uri])
            self.assertIn(begin, text)
            client.change(uri, 2, {"text": text})
            codes = self.codes(client.all_findings(uri, 2))
            self.assertNotIn(rule, codes)
            self.assertEqual("unclosed-comment" in codes, name == "a.nc")

    def test_suppressions_are_not_allowed_themselves(self):
        """One suppression more would only be one more that suppresses nothing."""
        client, uri, found = self.opened("O1\nM30 (@ALLOW self-assignment)\n")
        self.assertEqual(set(self.codes(found)), {"suppression-without-reason", "unused-suppression"})
        self.assertEqual([a["title"] for a in self.ask(client, uri, 0, 9) if "allow" in a["title"]], [])

    CREATES = {"workspace": {"workspaceEdit": {"documentChanges": True, "resourceOperations": ["create"]}}}

    def clause_for(self, client, uri, rule):
        return [a for a in self.ask(client, uri, 0, 9) if a["title"].startswith(f"allow `{rule}` for ")]

    def write_as_told(self, client, edit):
        """As an editor carries out an edit of the workspace."""
        changes = edit.get("documentChanges") or [
            {"textDocument": {"uri": uri}, "edits": edits} for uri, edits in edit["changes"].items()]
        for change in changes:
            path = Path(unquote((change.get("textDocument") or change)["uri"].removeprefix("file://")))
            if change.get("kind") == "create":
                path.touch()
            else:
                path.write_text(applied(path.read_text(), change["edits"]))
            client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": path.as_uri(), "type": 2}]})
        return path

    def test_allowing_beside_the_program(self):
        """The program keeps its bytes; the file beside it is made, and added to."""
        text = SLIP.replace("GOTO 99", "N40 GOTO 99")
        program = self.write("O1001.nc", text)
        client = self.client(options={"proofs": "off"}, capabilities=self.CREATES)
        uri = client.open("O1001.nc", text)
        client.all_findings(uri, 1)
        allowed = ("goto-missing-label", "missing-equals")
        for rule in allowed:
            action, = self.clause_for(client, uri, rule)
            self.assertEqual([change.get("kind") for change in action["edit"].get("documentChanges", [])],
                             ["create", None] if rule == allowed[0] else [])
            sidecar = self.write_as_told(client, action["edit"])
            found = client.all_findings(uri, 1)
            while rule in self.codes(found):  # of a run that began before
                found = client.diagnostics(uri, 1)
        self.assertEqual(sidecar, self.folder / "O1001.contract")
        self.assertEqual(sidecar.read_text(), "@ALLOW goto-missing-label N40 \n@ALLOW missing-equals \n")
        self.assertEqual(program.read_text(), text)
        result = subprocess.run([FEEDHOLD, "check", "--severity", "info", "--format", "json", str(program)], capture_output=True)
        left = [f for f in json.loads(result.stdout)["findings"] if not f.get("suppressed")]
        self.assertFalse({f["rule"] for f in left} & set(allowed))
        missed = [f for f in left if f["rule"] == "suppression-without-reason"]
        self.assertEqual([f["path"] for f in missed], [str(sidecar)] * 2)

    def test_the_file_beside_is_in_the_editor_and_ends_without_a_line_end(self):
        self.write("O1001.nc", SLIP)
        self.write("part.contract", "")
        self.write("O1001.contract", "")
        client = self.client(options={"proofs": "off"})
        client.open("O1001.contract", "@REQUIRE #21 GT 0 (µ)")
        uri = client.open("O1001.nc", SLIP)
        client.all_findings(uri, 1)
        action, = self.clause_for(client, uri, "missing-equals")
        (there, edits), = action["edit"]["changes"].items()
        self.assertEqual(there, client.uri("O1001.contract"))
        self.assertEqual(applied("@REQUIRE #21 GT 0 (µ)", edits), "@REQUIRE #21 GT 0 (µ)\n@ALLOW missing-equals \n")

    def test_no_file_is_made_by_editors_that_cannot(self):
        self.write("O1001.nc", SLIP)
        client, uri, _ = self.opened(SLIP, "O1001.nc")
        self.assertEqual(self.clause_for(client, uri, "missing-equals"), [])

    def test_a_program_further_down(self):
        """The clause stands where it means that program, and the first block of a number."""
        text = SLIP.replace("%\n", "") + "O1002\nN10 IF[#1EQ1]GOTO 98\nN10 IF[#1EQ2]GOTO 97\nM99\n"
        self.write("both.nc", text)
        client = self.client(options={"proofs": "off"}, capabilities=self.CREATES)
        uri = client.open("both.nc", text)
        client.all_findings(uri, 1)
        titles = sorted(a["title"] for a in self.clause_for(client, uri, "goto-missing-label"))
        self.assertEqual([title.split(" for ")[1] for title in titles], [
            "N10 in O1002.contract, with a reason", "the whole program in O1001.contract, with a reason",
            "the whole program in O1002.contract, with a reason"])

    def test_fix_all_is_check_fix(self):
        text = "%\nO1\nG17 G21 G40 G49 G80 G90 G94\n#1=1\n\n(@ALLOW unread-argument why)\nM30\n%\n"
        client, uri, _ = self.opened(text)
        actions = self.ask(client, uri, 0, 0, only=["source.fixAll"])
        self.assertEqual([a["kind"] for a in actions], ["source.fixAll.feedhold"])
        path = self.write("b.nc", text)
        subprocess.run([FEEDHOLD, "check", "--fix", "--quiet", str(path)], stdout=subprocess.DEVNULL)
        self.assertNotEqual(path.read_text(), text)
        self.assertEqual(applied(text, actions[0]["edit"]["changes"][uri]), path.read_text())

    def test_nothing_to_do(self):
        client, uri, _ = self.opened("%\nO1\nM30\n%\n")
        self.assertEqual(self.ask(client, uri, 0, 5), [])

    def test_no_colours(self):
        """Editors take `#500` for one."""
        client, uri, _ = self.opened("%\nO1\n#500=1\nM30\n%\n")
        self.assertTrue(client.server["capabilities"]["colorProvider"])
        self.assertEqual(client.request("textDocument/documentColor", {"textDocument": {"uri": uri}}), [])


class Drafts(Session):
    """`feedhold draft` from the editor: a command, and later an edit that creates the file."""
    APPLIES = {"window": {"workDoneProgress": True},
               "workspace": {"applyEdit": True,
                             "workspaceEdit": {"documentChanges": True, "resourceOperations": ["create"]}}}
    MACRO = "O9105\nIF[#7LE0]GOTO9\nG90G01Z-#7F100\nM99\nN9#3000=41(DEPTH)\n"

    def actions(self, client, uri, line=0):
        return [a for a in client.request("textDocument/codeAction", {
            "textDocument": {"uri": uri}, "context": {"diagnostics": [], "only": ["refactor"]},
            "range": {"start": {"line": line, "character": 0}, "end": {"line": line, "character": 0}}})]

    def test_a_draft(self):
        self.write("O9105.nc", self.MACRO)
        client = self.client(options={"proofs": "off"}, capabilities=self.APPLIES)
        uri = client.open("O9105.nc", self.MACRO)
        action, = self.actions(client, uri)
        self.assertEqual(action["title"], "draft a contract for O9105")
        self.assertEqual(self.actions(client, uri, 2), [])
        client.request("workspace/executeCommand", {key: action["command"][key] for key in ("command", "arguments")})
        edit = client.wait(lambda m: m.get("method") == "workspace/applyEdit")["params"]["edit"]
        create, change = edit["documentChanges"]
        self.assertEqual((create["kind"], create["uri"]), ("create", client.uri("O9105.contract")))
        drafted = subprocess.run([FEEDHOLD, "draft", "--stdout", "--quiet", "O9105.nc"], cwd=self.folder,
                                 capture_output=True, text=True).stdout
        self.assertIn("@REQUIRE #7 GT 0", change["edits"][0]["newText"])
        self.assertIn(change["edits"][0]["newText"], drafted)
        self.assertFalse((self.folder / "O9105.contract").exists())

    def test_only_where_there_is_no_contract(self):
        self.write("O9105.nc", self.MACRO)
        self.write("O9105.contract", "@PARAM #7 DEPTH\n")
        client = self.client(options={"proofs": "off"}, capabilities=self.APPLIES)
        self.assertEqual(self.actions(client, client.open("O9105.nc", self.MACRO)), [])
        self.assertEqual(self.actions(client, client.open("new.nc", self.MACRO)), [])  # it has no folder yet

    def test_an_editor_that_cannot(self):
        self.write("O9105.nc", self.MACRO)
        client = self.client(options={"proofs": "off"})
        uri = client.open("O9105.nc", self.MACRO)
        self.assertEqual(self.actions(client, uri), [])
        refused = client.request("workspace/executeCommand",
                                 {"command": "feedhold.draft", "arguments": [{"uri": uri, "program": "O9105"}]})
        self.assertIn("does not create files", refused["error"]["message"])

    def test_nothing_to_draft(self):
        text = "O9106\nG65P9999\nM30\n"
        self.write("O9106.nc", text)
        client = self.client(options={"proofs": "off"}, capabilities=self.APPLIES)
        uri = client.open("O9106.nc", text)
        client.request("workspace/executeCommand",
                       {"command": "feedhold.draft", "arguments": [{"uri": uri, "program": "O9106"}]})
        shown = client.wait(lambda m: m.get("method") == "window/showMessage")["params"]["message"]
        self.assertIn("nothing to draft for O9106", shown)


class Formatting(Session):
    OPTIONS = {"tabSize": 2, "insertSpaces": True}

    def format(self, client, uri, **more):
        method = "textDocument/rangeFormatting" if more else "textDocument/formatting"
        return client.request(method, {"textDocument": {"uri": uri}, "options": self.OPTIONS, **more})

    def test_loops_and_blanks(self):
        text = ("%\n  O9000  (A  B)\n#1=0 \nWHILE[#1LT3]DO1\nG01   X#1\tY2.   (KEPT)\nDO2\n#1=#1+1\nEND2\n/ M00\nEND1\n"
                "M99\n%\n")
        wanted = ("%\nO9000  (A  B)\n#1=0\nWHILE[#1LT3]DO1\n  G01 X#1 Y2.   (KEPT)\n  DO2\n    #1=#1+1\n  END2\n/ M00\n"
                  "END1\nM99\n%\n")
        client = self.client()
        uri = client.open("a.nc", text)
        self.assertEqual(applied(text, self.format(client, uri)), wanted)
        some = self.format(client, uri, range=at(2, 0))
        self.assertEqual(applied(text, some), text.replace("#1=0 \n", "#1=0\n"))

    def test_every_program(self):
        """Only blanks change, formatting twice is formatting once, and the control reads the same words."""
        client = self.client(options={"proofs": "off"})
        formatted = 0
        for path, text in programs():
            if "\r" in text or "\ufeff" in text:
                continue
            uri = client.open(path.as_uri(), text)
            once = applied(text, self.format(client, uri) or [])
            self.assertEqual(once.replace(" ", "").replace("\t", ""), text.replace(" ", "").replace("\t", ""), path)
            client.change(uri, 2, {"text": once})
            self.assertEqual(self.format(client, uri) or [], [], path)
            formatted += once != text
            client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
        self.assertGreater(formatted, 20)

    def test_the_control_reads_the_same(self):
        """Tokens and tree without their places, by the commands that print them."""
        client = self.client(options={"proofs": "off"})
        compared = 0
        for path, text in list(programs())[::7]:
            if "\r" in text or "\ufeff" in text:
                continue
            uri = client.open(path.as_uri(), text)
            once = applied(text, self.format(client, uri) or [])
            if once != text:
                before, after = self.write("before.nc", text), self.write("after.nc", once)
                self.assertEqual(self.tokens(before), self.tokens(after), path)
                compared += 1
        self.assertGreater(compared, 3)

    def tokens(self, path):
        result = subprocess.run([FEEDHOLD, "tokens", "--dialect", "fanuc-30i", str(path)], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [re.sub(r"\s+\d+-\d+\s*", " ", line, count=1) for line in result.stdout.splitlines()]


if __name__ == "__main__":
    unittest.main(verbosity=1)
