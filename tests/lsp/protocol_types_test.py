"""Every message of the server against the types that the authors of the protocol publish, made into a JSON Schema."""
import copy
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema

from golden_test import Player, recordings
from harness import ROOT

NPM = ROOT / "build" / "oracles"
GENERATOR = NPM / "node_modules" / "typescript-json-schema" / "bin" / "typescript-json-schema"
TYPES = Path(__file__).resolve().with_suffix(".ts").with_name("protocol_types.ts")
SKIPPED = 77  # ctest's word for a test that could not run here
OUR_OWN = {"feedhold/renumber": "textDocument/rename"}  # requests beyond the protocol, and whose result they have

# What a capability lets a client ask.
ASKED_BY = {
    "callHierarchyProvider": ("textDocument/prepareCallHierarchy", "callHierarchy/incomingCalls",
                              "callHierarchy/outgoingCalls"),
    "codeActionProvider": ("textDocument/codeAction",),
    "codeLensProvider": ("textDocument/codeLens",),
    "colorProvider": ("textDocument/documentColor",),
    "completionProvider": ("textDocument/completion",),
    "definitionProvider": ("textDocument/definition",),
    "diagnosticProvider": ("textDocument/diagnostic",),
    "documentFormattingProvider": ("textDocument/formatting",),
    "documentHighlightProvider": ("textDocument/documentHighlight",),
    "documentRangeFormattingProvider": ("textDocument/rangeFormatting",),
    "documentSymbolProvider": ("textDocument/documentSymbol",),
    "executeCommandProvider": ("workspace/executeCommand",),
    "foldingRangeProvider": ("textDocument/foldingRange",),
    "hoverProvider": ("textDocument/hover",),
    "inlayHintProvider": ("textDocument/inlayHint",),
    "referencesProvider": ("textDocument/references",),
    "renameProvider": ("textDocument/prepareRename", "textDocument/rename"),
    "semanticTokensProvider": ("textDocument/semanticTokens/full",),
    "signatureHelpProvider": ("textDocument/signatureHelp",),
    "workspaceSymbolProvider": ("workspace/symbol",),
}
ALWAYS_EMPTY = {"textDocument/documentColor"}
AT_A_PLACE = ("hover", "definition", "references", "documentHighlight", "prepareRename", "rename", "completion",
              "signatureHelp", "prepareCallHierarchy")
OF_A_DOCUMENT = ("documentSymbol", "semanticTokens/full", "foldingRange", "codeLens", "documentColor", "diagnostic",
                 "formatting", "rangeFormatting", "inlayHint", "codeAction")

CALLED = """%
O9100(STEPS)
(@PARAM #21 DEPTH 0.5..50.)
(@PARAM #22 STEP 0..5.)
#1=0
WHILE[#1LT#21]DO1
#1=#1+#22
IF[#1GT40.]GOTO 90
END1
N90  M99
%
"""
CALLING = """%
O1001(MAIN)
G17 G21 G40 G49 G80 G90 G94
#510-[0-1.5]
G65 P9100 U10. V1.
M98 P9100
G00 X1.
GOTO 99
M30
%
"""
CAPABILITIES = {
    "window": {"workDoneProgress": True},
    "workspace": {"diagnostics": {"refreshSupport": True}, "codeLens": {"refreshSupport": True},
                  "inlayHint": {"refreshSupport": True},
                  "didChangeWatchedFiles": {"dynamicRegistration": True},
                  "workspaceEdit": {"documentChanges": True, "resourceOperations": ["create"]}},
    "textDocument": {"hover": {"contentFormat": ["markdown"]}, "publishDiagnostics": {"relatedInformation": True}}}


def schema():
    """Of the results and parameters of all methods; without members that the types do not know."""
    with tempfile.TemporaryDirectory(dir=NPM) as holder:  # where the packages are found
        shutil.copy(TYPES, holder)
        made = subprocess.run(
            ["node", str(GENERATOR), str(Path(holder) / TYPES.name), "Messages", "--required", "--noExtraProps",
             "--strictNullChecks", "--skipLibCheck", "--module", "node16", "--moduleResolution", "node16"],
            capture_output=True, check=False)
        if made.returncode != 0:
            raise RuntimeError(made.stderr.decode())
        return json.loads(made.stdout)


class Judge:
    def __init__(self):
        self.schema = schema()
        self.validators = {}

    def methods(self, part):
        return self.schema["definitions"][part]["properties"]

    def complaint(self, value, reference):
        """Empty: the value is of that type."""
        if reference not in self.validators:
            self.validators[reference] = jsonschema.Draft7Validator(
                {"$ref": reference, "definitions": self.schema["definitions"]})
        error = jsonschema.exceptions.best_match(self.validators[reference].iter_errors(value))
        return f"{error.json_path}: {error.message}" if error else ""

    def complaint_about(self, message, asked):
        """`asked`: the methods of the client's requests by id."""
        kind = ("ResponseMessage" if "method" not in message else
                "RequestMessage" if "id" in message else "NotificationMessage")
        if wrong := self.complaint(message, f"#/definitions/{kind}"):
            return wrong
        if kind == "ResponseMessage":
            if ("result" in message) == ("error" in message):
                return "has either a result or an error"
            method = OUR_OWN.get(asked[message["id"]], asked[message["id"]])
            return self.of_method("Results", method, message["result"]) if "result" in message else ""
        return self.of_method("Params", message["method"], message.get("params"))

    def of_method(self, part, method, value):
        if method not in self.methods(part):
            return f"the protocol has no {method}"
        name = method.replace("~", "~0").replace("/", "~1")
        return self.complaint(value, f"#/definitions/{part}/properties/{name}")


class Typed(Player):
    @classmethod
    def setUpClass(cls):
        cls.judge = Judge()

    def assertTyped(self, client):
        self.assertTrue(client.kept)
        for message in client.kept:
            wrong = self.judge.complaint_about(message, client.asked)
            self.assertEqual(wrong, "", json.dumps(message)[:1500])

    def test_recorded_sessions(self):
        for path in recordings():
            with self.subTest(path.stem):
                self.assertTyped(self.play(json.loads(path.read_text())))

    def test_every_feature(self):
        for pulls in (False, True):
            with self.subTest(pulls=pulls):
                client = self.conversation(pulls)
                self.assertTyped(client)
                self.assertEveryFeatureAnswered(client)

    def test_every_kind_of_message(self):
        """What is not an answer: findings, progress, requests to the client, what is shown and logged, errors."""
        client = self.conversation(pulls=True)
        seen = {message.get("method", "error" if "error" in message else "result") for message in client.kept}
        self.assertLessEqual({"textDocument/publishDiagnostics", "$/progress", "window/workDoneProgress/create",
                              "client/registerCapability", "workspace/codeLens/refresh", "workspace/diagnostic/refresh",
                              "window/showMessage", "window/logMessage", "error", "result"}, seen)

    def test_broken_messages_are_refused(self):
        """Each member that a type asks for is missed in a real message, and so is each wrong type."""
        client = self.conversation(pulls=False)
        broken = 0
        for message in self.one_of_each(client):
            for place in places(message):
                for spoil in (dropped, mistyped, misspelt):
                    spoilt = copy.deepcopy(message)
                    if spoil(spoilt, place) and self.judge.complaint_about(spoilt, client.asked):
                        broken += 1
            self.assertEqual(self.judge.complaint_about(message, client.asked), "")
        self.assertGreater(broken, 500)
        published = next(m for m in client.kept if m.get("method") == "textDocument/publishDiagnostics" and
                         any("relatedInformation" in d for d in m["params"]["diagnostics"]))
        index = next(i for i, d in enumerate(published["params"]["diagnostics"]) if "relatedInformation" in d)
        for way in (("message",), ("range", "start", "character"), ("relatedInformation", 0, "location", "uri")):
            place = ("params", "diagnostics", index, *way)
            for spoil in (dropped, mistyped, misspelt):
                spoilt = copy.deepcopy(published)
                self.assertTrue(spoil(spoilt, place))
                self.assertTrue(self.judge.complaint_about(spoilt, client.asked), (spoil.__name__, way))

    def one_of_each(self, client):
        """The longest message of each method."""
        longest = {}
        for message in client.kept:
            key = message.get("method") or client.asked.get(message.get("id"))
            if key and len(json.dumps(message)) > len(json.dumps(longest.get(key))):
                longest[key] = message
        return longest.values()

    def assertEveryFeatureAnswered(self, client):
        answered = {client.asked[m["id"]] for m in client.kept if "method" not in m and m.get("result")}
        asked = set(client.asked.values())
        for name in client.server["capabilities"]:
            if not name.endswith("Provider"):
                continue
            self.assertIn(name, ASKED_BY)
            self.assertLessEqual(set(ASKED_BY[name]), asked)
            self.assertLessEqual(set(ASKED_BY[name]) - ALWAYS_EMPTY, answered)

    def conversation(self, pulls):
        """Every feature is asked at every place of two programs, one of which calls the other."""
        self.write("O9100.nc", CALLED)
        self.write("O1001.nc", CALLING)
        self.write("O9100.contract", "@REQUIRE #21 GR 0\n")
        capabilities = copy.deepcopy(CAPABILITIES)
        if pulls:
            capabilities["textDocument"]["diagnostic"] = {}
        client = self.client(capabilities=capabilities, arguments=("--cache-dir", str(self.folder / "cache")))
        (self.folder / "O9100.contract").unlink()
        for name, text in (("O9100.nc", CALLED), ("O1001.nc", CALLING)):
            uri = client.open(name, text)
            client.wait(lambda m: is_end_of_proof(m) or name != "O9100.nc")
            self.ask_all(client, uri, text)
        client.request("workspace/symbol", {"query": "9"})
        client.request("workspace/executeCommand", {"command": "feedhold.brew", "arguments": [uri]})
        client.notify("workspace/didChangeConfiguration", {"settings": {"feedhold": {"proofs": "always"}}})
        client.notify("textDocument/didChange", {"textDocument": {"uri": uri}})
        client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
        self.assertEqual(client.close(), 0)
        client.drain()
        return client

    def ask_all(self, client, uri, text):
        document = {"textDocument": {"uri": uri}}
        lines = text.split("\n")
        everything = {"start": {"line": 0, "character": 0}, "end": {"line": len(lines), "character": 0}}
        more = {"options": {"tabSize": 2, "insertSpaces": True}, "range": everything, "context": {"diagnostics": []}}
        for line, words in enumerate(lines):
            for character in range(len(words) + 1):
                place = {**document, "position": {"line": line, "character": character}, "newName": "N95",
                         "context": {"includeDeclaration": True, "triggerKind": 1}}
                for method in AT_A_PLACE:
                    self.follow(client, method, client.request("textDocument/" + method, place))
        for method in OF_A_DOCUMENT:
            self.follow(client, method, client.request("textDocument/" + method, {**document, **more}))
        client.request("feedhold/renumber", {**document, "start": 10, "step": 10})

    def follow(self, client, method, result):
        """Asks what an answer leads to."""
        if method == "prepareCallHierarchy":
            for item in result or ():
                client.request("callHierarchy/incomingCalls", {"item": item})
                client.request("callHierarchy/outgoingCalls", {"item": item})
        commands = {"codeLens": result, "codeAction": result}.get(method) or ()
        for command in (each["command"] for each in commands if isinstance(each.get("command"), dict)):
            if command["command"].startswith("feedhold."):
                client.request("workspace/executeCommand", {key: command[key] for key in ("command", "arguments")})


def is_end_of_proof(message):
    return message.get("method") == "$/progress" and message["params"]["value"]["kind"] == "end"


def places(value, way=()):
    """The ways to all members of a message."""
    members = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, member in members:
        yield (*way, key)
        yield from places(member, (*way, key))


def holder_of(message, place):
    for key in place[:-1]:
        message = message[key]
    return message


def dropped(message, place):
    holder = holder_of(message, place)
    if not isinstance(holder, dict):
        return False
    del holder[place[-1]]
    return True


def mistyped(message, place):
    holder_of(message, place)[place[-1]] = [{"no": "such"}]
    return True


def misspelt(message, place):
    holder = holder_of(message, place)
    if not isinstance(holder, dict):
        return False
    holder[place[-1] + "s"] = holder.pop(place[-1])
    return True


if __name__ == "__main__":
    if os.environ.get("FEEDHOLD_ORACLES") != "1":
        sys.exit(SKIPPED)
    unittest.main(verbosity=1)
