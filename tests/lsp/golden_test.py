"""Recorded sessions: the messages of a client in sessions/NAME.json, and beside them, in NAME.expected.json, all that the
server says.  `UPDATE_GOLDENS=1` writes the expectations anew; then read `git diff`."""
import json
import os
import re
import unittest
from pathlib import Path

from harness import Client, Session

SESSIONS = Path(__file__).resolve().parent / "sessions"
EXPECTED = ".expected.json"
FOLDER = "file:///folder"  # in recordings, where the folder of the test is
FULL = "lifecycle"  # the session whose expectation holds what the server can do; one place to change is enough


def replaced(json_value, old, new):
    """With every occurrence in every text, keys included: edits are keyed by document."""
    if isinstance(json_value, str):
        return json_value.replace(old, new)
    if isinstance(json_value, list):
        return [replaced(each, old, new) for each in json_value]
    if isinstance(json_value, dict):
        return {replaced(key, old, new): replaced(value, old, new) for key, value in json_value.items()}
    return json_value


def recordings():
    return [path for path in sorted(SESSIONS.glob("*.json")) if not path.name.endswith(EXPECTED)]


def shown(messages):
    """For people to read; rows of numbers and places stay on one line."""
    text = json.dumps(messages, indent=2, ensure_ascii=False, sort_keys=True)
    for short in (r"\[[\s\d,]+\]", r"\{\s+\"character\": \d+,\s+\"line\": \d+\s+\}"):
        text = re.sub(short, lambda found: re.sub(r"\s+", " ", found[0]), text)
    return text + "\n"


class Player(Session):
    def place(self):
        """The folder as the server shows it, and its URI."""
        return str(self.folder), self.folder.as_uri()

    def play(self, messages):
        """The client at the end.  Each answer is waited for, and so are both publications for a text, so that the order is
        one."""
        client = self.client(fresh=True)
        for message in replaced(messages, FOLDER, self.place()[1]):
            client.send({"jsonrpc": "2.0", **message})
            if "id" in message:
                client.answer(message["id"])
            elif message["method"] in ("textDocument/didOpen", "textDocument/didChange"):
                document = message["params"]["textDocument"]
                client.all_findings(document["uri"], document["version"])
        client.drain()
        self.assertEqual(client.process.returncode, 0)
        return client


class Recorded(Player):
    def said(self, messages):
        said = self.play(messages).kept
        path, uri = self.place()
        return replaced(replaced(said, uri, FOLDER), path, FOLDER[len("file://"):])

    def test_sessions(self):
        self.assertGreaterEqual(len(recordings()), 4)
        for path in recordings():
            with self.subTest(path.stem):
                messages = self.said(json.loads(path.read_text()))
                begun = messages[0]["result"]
                begun["serverInfo"]["version"] = "VERSION"
                if path.stem != FULL:
                    begun["capabilities"] = f"as in {FULL}{EXPECTED}"
                said = shown(messages)
                beside = path.with_name(path.stem + EXPECTED)
                if os.environ.get("UPDATE_GOLDENS"):
                    beside.write_text(said)
                self.assertMultiLineEqual(said, beside.read_text())

    def test_each_expectation_has_its_session(self):
        for path in SESSIONS.glob("*" + EXPECTED):
            self.assertTrue(path.with_name(path.name.replace(EXPECTED, ".json")).exists(), path)


if __name__ == "__main__":
    unittest.main(verbosity=1)
