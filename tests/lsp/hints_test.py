"""Hints that rest on the flow of a program come a moment later, where the client can be told to ask again."""
import unittest

from harness import Session

TEXT = "%\nO1\nG90\nM98P2\nG01X5.\nM30\nO2\nG91\nM99\n%\n"
HINT = (5, "G91 active here")


class Hints(Session):
    def hints(self, client, uri):
        whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
        found = client.request("textDocument/inlayHint", {"textDocument": {"uri": uri}, "range": whole})
        return [(hint["position"]["line"] + 1, hint["label"]) for hint in found]

    def test_at_once_without_a_refresh(self):
        client = self.client(options={"proofs": "off"})
        self.assertEqual(self.hints(client, client.open("part.nc", TEXT)), [HINT])

    def test_later_with_a_refresh(self):
        client = self.client(capabilities={"workspace": {"inlayHint": {"refreshSupport": True}}},
                             options={"proofs": "off"})
        uri = client.open("part.nc", TEXT)
        self.hints(client, uri)
        client.wait(lambda m: m.get("method") == "workspace/inlayHint/refresh")
        self.assertEqual(self.hints(client, uri), [HINT])
        client.change(uri, 2, {"range": {"start": {"line": 7, "character": 0}, "end": {"line": 7, "character": 3}},
                               "text": "G90"})
        self.hints(client, uri)
        client.wait(lambda m: m.get("method") == "workspace/inlayHint/refresh")
        self.assertEqual(self.hints(client, uri), [])


if __name__ == "__main__":
    unittest.main()
