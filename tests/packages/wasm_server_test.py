"""The language server in WebAssembly, as the extension for all platforms has it: it passes the tests of the server,
finds what the program for Linux finds, and answers while it proves."""
import json
import os
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

import packaged
from packaged import DIST, FEEDHOLD, ROOT, SKIPPED, VERSION, Packaged

sys.path.insert(0, str(ROOT / "tests/lsp"))
from client import Client  # noqa: E402

NODE = shutil.which("node")
EXTENSION = DIST / f"feedhold-{VERSION}.vsix"
PACKAGES = ROOT / "corpus/packages"
TESTS_OF_THE_SERVER = ["protocol", "diagnostics", "folder", "actions", "proofs", "hints", "golden"]
LONG_PROOF = "pocket/O9313.nc"
ANSWERED_WITHIN = 2  # seconds, in the middle of a proof that takes many
# As the library of the extension starts a script: by `fork`, whose channel stays open.
FORK = """
const words = [...process.argv.slice(2), "--stdio"];
const child = require("node:child_process").fork(process.argv[1], words, { silent: true });
process.stdin.pipe(child.stdin);
child.stdout.pipe(process.stdout);
child.stderr.pipe(process.stderr);
child.on("exit", (code) => process.exit(code));
"""


class Server(Packaged):
    def setUp(self):
        super().setUp()
        self.folder = self.folder.resolve()
        extension = self.folder / "extension of all platforms"
        self.run_clean("unzip", "-q", EXTENSION, "-d", extension)
        self.script = extension / "extension/bin/feedhold.js"
        self.program = self.folder / "feedhold"
        self.program.write_text(f'#!/bin/sh\nexec "{NODE}" "{self.script}" "$@"\n')
        self.program.chmod(0o755)
        self.work = self.folder / "programs"
        self.work.mkdir()

    def client(self, *program, **options):
        client = Client(self.work, program=program, **options)
        self.addCleanup(client.end)
        return client

    def findings(self, program, names):
        """By file, with those of the flow."""
        client = self.client(program, options={"proofs": "off"})
        found = {}
        for name in names:
            found[name] = client.all_findings(client.open(name, (self.work / name).read_text()), 1)
            client.notify("textDocument/didClose", {"textDocument": {"uri": client.uri(name)}})
        self.assertEqual(client.close(), 0)
        return found

    def test_passes_the_tests_of_the_server(self):
        for name in TESTS_OF_THE_SERVER:
            with self.subTest(name):
                told = subprocess.run([sys.executable, ROOT / f"tests/lsp/{name}_test.py"], timeout=900, text=True,
                                      env={**os.environ, "FEEDHOLD": str(self.program)}, capture_output=True)
                self.assertEqual(told.returncode, 0, told.stderr)

    def test_finds_what_the_program_finds(self):
        for path in (ROOT / "corpus").rglob("*.nc"):
            place = self.work / path.relative_to(ROOT / "corpus")
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, place)
        for path in PACKAGES.rglob("*.contract"):
            shutil.copy(path, self.work / path.relative_to(ROOT / "corpus"))
        names = sorted(path.relative_to(self.work).as_posix() for path in self.work.rglob("*.nc"))[::8]
        self.assertGreater(len(names), 10)
        ours, theirs = self.findings(self.program, names), self.findings(FEEDHOLD, names)
        self.assertEqual(ours, theirs)
        self.assertGreater(sum(len(found) for found in ours.values()), 10)

    def test_started_as_the_editor_does(self):
        client = self.client(NODE, "-e", FORK, self.script)
        found = client.all_findings(client.open("O1001.nc", packaged.BAD), 1)
        self.assertIn("missing-equals", [each["code"] for each in found])
        links = {each["codeDescription"]["href"] for each in found if "codeDescription" in each}
        self.assertFalse(links, "there is no cache")
        self.assertEqual(client.close(), 0)

    def test_rules_lead_to_their_pages(self):
        given = {"HOME": str(self.folder), "PATH": packaged.SYSTEM_PATH}
        client = self.client(self.program, arguments=(), environment=given)
        found = client.all_findings(client.open("O1001.nc", packaged.BAD), 1)
        for each in found:
            self.assertTrue(Path(each["codeDescription"]["href"].removeprefix("file://")).is_file())
        self.assertEqual(client.close(), 0)

    def test_other_commands_on_real_files(self):
        """As the terminal of the extension runs them."""
        self.use(self.program)

    def test_nothing_is_lost_where_others_are_slow(self):
        """More than a pipe holds waits until it is read, and a program that comes late is waited for."""
        words = ["check", "--severity", "info", "--format", "json"]
        expected = subprocess.run([FEEDHOLD, *words, PACKAGES], capture_output=True, timeout=300).stdout
        self.assertGreater(len(expected), 1 << 16)
        process = subprocess.Popen([self.program, *words, PACKAGES], stdout=subprocess.PIPE)
        time.sleep(20)
        told = process.stdout.read()
        process.stdout.close()
        process.wait(60)
        self.assertEqual(json.loads(told)["findings"], json.loads(expected)["findings"])
        process = subprocess.Popen([self.program, *words, "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        time.sleep(2)
        told = process.communicate(packaged.BAD.encode(), timeout=60)[0]
        self.assertIn(b"missing-equals", told)

    def proving(self):
        """In the middle of a long proof: the client, and the URI."""
        shutil.copytree((PACKAGES / LONG_PROOF).parent, self.work, dirs_exist_ok=True)
        client = self.client(self.program, capabilities={"window": {"workDoneProgress": True}})
        name = Path(LONG_PROOF).name
        uri = client.open(name, (self.work / name).read_text())
        client.all_findings(uri, 1)
        self.progress(client, "begin")
        time.sleep(0.5)
        return client, uri

    def progress(self, client, kind):
        def is_wanted(message):
            return message.get("method") == "$/progress" and message["params"]["value"]["kind"] == kind
        return next((message for message in client.kept if is_wanted(message)), None) or client.wait(is_wanted)

    def test_answers_while_it_proves(self):
        client, uri = self.proving()
        began = time.monotonic()
        answer = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
        self.assertTrue(answer)
        self.assertLess(time.monotonic() - began, ANSWERED_WITHIN)
        client.change(uri, 2, {"range": {"start": {"line": 1, "character": 0}, "end": {"line": 1, "character": 0}},
                               "text": " "})
        self.assertEqual(self.progress(client, "end")["params"]["value"]["message"], "stopped")
        self.assertLess(time.monotonic() - began, 2 * ANSWERED_WITHIN)
        self.assertEqual(client.close(), 0)

    def test_client_that_is_gone_while_it_proves(self):
        client, _ = self.proving()
        client.process.stdin.close()
        self.assertEqual(client.process.wait(ANSWERED_WITHIN), 1)


def main():
    if NODE is None and os.environ.get("FEEDHOLD_PACKAGES") == "1":
        print("skipped: needs Node.js")
        sys.exit(SKIPPED)
    packaged.main()


if __name__ == "__main__":
    main()
