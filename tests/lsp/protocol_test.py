"""The base protocol: framing, the order of a session, errors, cancelling."""
import random
import unittest

from client import frame
from harness import SLIP, Session

PARSE_ERROR, INVALID_REQUEST, NOT_FOUND, INVALID_PARAMS = -32700, -32600, -32601, -32602
NOT_INITIALIZED, CANCELLED, INTERNAL_ERROR = -32002, -32800, -32603
HOVER = {"textDocument": {"uri": "file:///nowhere.nc"}, "position": {"line": 0, "character": 0}}


class Lifecycle(Session):
    def test_requests_before_initialize(self):
        client = self.client(fresh=True)
        self.assertEqual(client.error("textDocument/hover", HOVER), NOT_INITIALIZED)
        self.assertEqual(client.error("shutdown", None), NOT_INITIALIZED)

    def test_notifications_before_initialize_are_dropped(self):
        client = self.client(fresh=True)
        client.open("a.nc", SLIP)
        result = client.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.assertEqual(result["serverInfo"]["name"], "feedhold")
        self.assertFalse([m for m in client.kept if m.get("method") == "textDocument/publishDiagnostics"])

    def test_initialize_comes_once(self):
        self.assertEqual(self.client().error("initialize", {"capabilities": {}}), INVALID_REQUEST)

    def test_after_shutdown(self):
        client = self.client()
        self.assertIsNone(client.request("shutdown", None))
        self.assertEqual(client.error("textDocument/hover", HOVER), INVALID_REQUEST)
        client.notify("exit", None)
        self.assertEqual(client.process.wait(20), 0)

    def test_exit_without_shutdown(self):
        client = self.client()
        client.notify("exit", None)
        self.assertEqual(client.process.wait(20), 1)

    def test_client_that_is_gone(self):
        client = self.client()
        client.process.stdin.close()
        self.assertEqual(client.process.wait(20), 1)


class Errors(Session):
    def test_unknown_method(self):
        self.assertEqual(self.client().error("textDocument/brew", {}), NOT_FOUND)

    def test_unknown_notifications_are_passed_over(self):
        client = self.client()
        client.notify("$/unheardOf", {"x": 1})
        client.notify("textDocument/unheardOf", {"x": 1})
        self.assertEqual(client.close(), 0)

    def test_bad_params(self):
        client = self.client()
        uri = client.open("a.nc", SLIP)
        for params in (None, {}, [], 3, {"textDocument": 1}, {"textDocument": {"uri": 7}},
                       {"textDocument": {"uri": uri}, "range": {"start": 1}, "context": {}},
                       {"textDocument": {"uri": uri}, "range": {"start": {"line": -1, "character": "x"}}, "context": {}}):
            self.assertEqual(client.error("textDocument/codeAction", params), INVALID_PARAMS, params)
        self.assertEqual(client.error("textDocument/hover", HOVER), INVALID_PARAMS)  # is not open

    def test_bad_commands(self):
        client = self.client()
        for command, arguments, complaint in (("feedhold.brew", [], "unknown command `feedhold.brew`"),
                                              ("feedhold.prove", [], "needs the URI of a document"),
                                              ("feedhold.prove", None, "needs the URI of a document"),
                                              ("feedhold.prove", [{}], "'uri' not found"),
                                              ("feedhold.runWitness", ["untitled:a"], "untitled:a is not open")):
            answer = client.answer(client.ask("workspace/executeCommand", {"command": command, "arguments": arguments}))
            self.assertEqual(answer["error"]["code"], INVALID_PARAMS)
            self.assertIn(complaint, answer["error"]["message"])
            self.assertNotIn("json.exception", answer["error"]["message"])

    def test_a_long_line(self):
        """Its colours are found in one pass: counting each place from the head of the line would take minutes."""
        client = self.client(options={"proofs": "off"})
        words = 100_000
        uri = client.open("a.nc", "O1\n(µ😀) " + "X1 " * words)
        data = client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}}, 30)["data"]
        rows = list(zip(*[iter(data)] * 5))
        self.assertEqual([row[:3] for row in rows[:4]], [(0, 0, 2), (1, 0, 5), (0, 6, 1), (0, 1, 1)])
        self.assertEqual({row[:3] for row in rows[4:]}, {(0, 2, 1), (0, 1, 1)})
        self.assertEqual(len(rows), 2 + 2 * words)

    def test_bad_notifications_change_nothing(self):
        client = self.client()
        uri = client.open("a.nc", SLIP)
        before = client.all_findings(uri, 1)
        client.notify("textDocument/didChange", {"textDocument": {"uri": uri, "version": 2},
                                                 "contentChanges": [{"text": ""}, {"text": 5}]})
        client.notify("textDocument/didOpen", {"textDocument": {}})
        client.change(client.uri("closed.nc"), 1, {"text": "x"})
        client.change(uri, 3, {"range": {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}},
                               "text": ""})
        self.assertEqual(client.all_findings(uri, 3), before)

    def test_messages_of_wrong_form(self):
        client = self.client()
        for message in ([], 1, "x", {}, {"id": 1}, {"id": {}, "method": "shutdown"}, {"method": 5, "id": 1}):
            client.send(message)
            answer = client.wait(lambda m: "error" in m)
            self.assertEqual(answer["error"]["code"], INVALID_REQUEST, message)
        self.assertEqual(client.close(), 0)

    def test_ids_may_be_texts(self):
        client = self.client()
        client.send({"jsonrpc": "2.0", "id": "a", "method": "shutdown"})
        self.assertIsNone(client.answer("a")["result"])


class Framing(Session):
    def broken(self, *pieces):
        """Each piece is answered as broken, and the session goes on."""
        client = self.client()
        for piece in pieces:
            client.raw(piece)
            self.assertEqual(client.wait(lambda m: "error" in m)["error"]["code"], PARSE_ERROR, piece[:80])
        self.assertEqual(client.close(), 0)

    def test_body_that_is_no_json(self):
        self.broken(frame(b"{nonsense"), frame(b""), frame(b'{"a": "\xff"}'), frame(b"[" * 100_000))

    def test_headers_without_length(self):
        self.broken(b"Content-Type: x\r\nnonsense\r\n\r\n", b"Content-Length: many\r\n\r\n",
                    b"Content-Length: -1\r\n\r\n", b"Content-Length: 99999999999999999999999\r\n\r\n",
                    b"Content-Length: 1000000000000\r\n\r\n")

    def test_body_longer_than_its_length(self):
        client = self.client()
        client.raw(b'Content-Length: 3\r\n\r\n{"jsonrpc": "2.0"}')
        client.send({"jsonrpc": "2.0", "id": 77, "method": "shutdown"})
        self.assertIsNone(client.answer(77)["result"])

    def test_long_garbage(self):
        client = self.client()
        client.raw(b"x" * 1_000_000 + b"\n")
        client.send({"jsonrpc": "2.0", "id": 77, "method": "shutdown"})
        self.assertIsNone(client.answer(77)["result"])

    def test_truncated_input(self):
        client = self.client()
        client.raw(b"Content-Length: 100\r\n\r\n{")
        client.process.stdin.close()
        self.assertEqual(client.process.wait(20), 1)

    def test_headers_in_any_case_and_order(self):
        client = self.client()
        body = b'{"jsonrpc": "2.0", "id": 5, "method": "shutdown"}'
        client.raw(b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\ncontent-length:%d\r\n\r\n%s"
                   % (len(body), body))
        self.assertIsNone(client.answer(5)["result"])

    def test_large_message(self):
        client = self.client()
        text = "%\nO1\nG17 G21 G40 G49 G80 G90 G94\n" + "G01 X10. Y20. F100.\n" * 100_000 + "M30\n%\n"
        uri = client.open("large.nc", text)
        self.assertLess(len(client.all_findings(uri, 1)), 5)


class Cancelling(Session):
    def test_storm(self):
        """Requests that are taken back are answered once each, by a result or as cancelled; later ones as ever."""
        client = self.client()
        uri = client.open("a.nc", SLIP * 200)
        requests = []
        for version in range(2, 200):
            client.change(uri, version, {"range": {"start": {"line": 1, "character": 0},
                                                   "end": {"line": 1, "character": 0}}, "text": "(A)\n"})
            requests.append(client.ask("textDocument/codeAction", {
                "textDocument": {"uri": uri}, "context": {"diagnostics": []},
                "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}}))
            client.notify("$/cancelRequest", {"id": requests[-1]})
        client.notify("$/cancelRequest", {"id": 123456})
        client.notify("$/cancelRequest", None)
        self.assertEqual(client.close(), 0)
        answers = [m for m in client.kept if "method" not in m and m.get("id") in requests]
        self.assertEqual(sorted(m["id"] for m in answers), requests)
        codes = {m["error"]["code"] for m in answers if "error" in m}
        self.assertEqual(codes, {CANCELLED})


class Storm(Session):
    METHODS = ("codeAction", "formatting", "rangeFormatting", "documentColor", "diagnostic", "hover", "definition",
               "references", "documentSymbol", "semanticTokens/full", "completion", "signatureHelp", "inlayHint",
               "codeLens", "foldingRange", "rename", "prepareRename", "prepareCallHierarchy", "documentHighlight")

    def test_random_params(self):
        """Whatever the parameters are, each request has one answer, a result or an error, and the server lives on."""
        generator = random.Random(6)
        client = self.client(options={"proofs": "off"})
        uri = client.open("a.nc", SLIP * 3)
        client.all_findings(uri, 1)
        failures = []
        for _ in range(1500):
            params = self.params(generator, uri)
            method = "textDocument/" + generator.choice(self.METHODS)
            answer = client.answer(client.ask(method, params))
            self.assertEqual("result" in answer, "error" not in answer)
            if answer.get("error", {}).get("code") == INTERNAL_ERROR:
                failures.append((method, params, answer["error"]))
        self.assertEqual(failures, [])
        self.assertEqual(client.close(), 0)

    def params(self, generator, uri):
        params = {"textDocument": {"uri": uri}, "position": self.position(generator), "newName": "N77",
                  "range": {"start": self.position(generator), "end": self.position(generator)},
                  "options": {"tabSize": generator.choice((0, 2, 8, 10**9)), "insertSpaces": True},
                  "context": {"diagnostics": [], "includeDeclaration": True}}
        if generator.random() < 0.5:
            return params
        holder = generator.choice((params, params["textDocument"], params["position"], params["range"],
                                   params["options"], params["context"]))
        key = generator.choice(sorted(holder))
        wrong = (None, -1, 2**40, 1.5, "", "x", [], {}, [1], {"start": 1}, True)
        if generator.random() < 0.3:
            del holder[key]
        else:
            holder[key] = generator.choice(wrong)
        return params

    def position(self, generator):
        return {"line": generator.choice((0, 1, 2, 3, 7, 17, 18, 19, 10**6)), "character": generator.choice((0, 1, 5, 9, 99))}


if __name__ == "__main__":
    unittest.main(verbosity=1)
