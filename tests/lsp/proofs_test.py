"""Proofs in the background: verdicts as diagnostics, progress, cancelling, the witness."""
import time
import unittest

from harness import ROOT, STEPS, Session, at

GUARDED = STEPS.replace("#1=0\n", "#1=0\nIF[#22GT0]GOTO1\n#3000=1(STEP)\nN1\n")
PROGRESS = {"window": {"workDoneProgress": True}}


def is_proof(diagnostic):
    return "obligation" in diagnostic.get("data", {})


class Proofs(Session):
    def proved(self, client, uri, version):
        """The diagnostics behind the end of the proofs."""
        client.wait(lambda m: m.get("method") == "$/progress" and m["params"]["value"]["kind"] == "end")
        time.sleep(0.3)  # the flow analysis may come behind
        client.request("textDocument/documentColor", {"textDocument": {"uri": uri}})
        last = [m for m in client.kept if m.get("method") == "textDocument/publishDiagnostics" and
                m["params"]["uri"] == uri and m["params"].get("version") == version][-1]
        return [d for d in last["params"]["diagnostics"] if is_proof(d)]

    def test_refuted_with_its_witness(self):
        client = self.client(capabilities=PROGRESS)
        uri = client.open("O9100.nc", STEPS)
        found = self.proved(client, uri, 1)
        loop = next(d for d in found if d["code"] == "loop-ends")
        self.assertEqual(loop["severity"], 1)
        self.assertIn("G65 P9100", loop["message"])
        kinds = [m["params"]["value"]["kind"] for m in client.kept if m.get("method") == "$/progress"]
        self.assertEqual((kinds[0], kinds[-1], kinds.count("end")), ("begin", "end", 1))
        actions = client.request("textDocument/codeAction", {
            "textDocument": {"uri": uri}, "range": loop["range"], "context": {"diagnostics": [loop]}})
        run = next(a["command"] for a in actions if a.get("command", {}).get("command") == "feedhold.runWitness")
        result = client.request("workspace/executeCommand", {"command": run["command"], "arguments": run["arguments"]})
        self.assertTrue(result["call"].startswith("G65 P9100"))
        self.assertTrue(any(a["title"].startswith("insert the missing guard") for a in actions) or
                        "@REQUIRE" in loop["message"], actions)

    def test_proved_is_not_told(self):
        client = self.client(capabilities=PROGRESS)
        uri = client.open("O9100.nc", GUARDED)
        self.assertNotIn("loop-ends", [d["code"] for d in self.proved(client, uri, 1)])

    def test_on_save(self):
        client = self.client(capabilities=PROGRESS)
        uri = client.open("O9100.nc", GUARDED)
        self.proved(client, uri, 1)
        client.change(uri, 2, {"text": STEPS})
        self.assertFalse([d for d in client.all_findings(uri, 2) if d["code"] == "loop-ends"])
        client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
        self.assertIn("loop-ends", [d["code"] for d in self.proved(client, uri, 2)])

    def test_on_type_and_off(self):
        client = self.client(capabilities=PROGRESS, options={"proofs": "off"})
        uri = client.open("O9100.nc", STEPS)
        client.all_findings(uri, 1)
        self.assertFalse([m for m in client.kept if m.get("method") == "$/progress"])
        client.notify("workspace/didChangeConfiguration", {"settings": {"feedhold": {"proofs": "onType"}}})
        self.assertTrue(self.proved(client, uri, 1))
        client.change(uri, 2, {"text": GUARDED})
        self.assertNotIn("loop-ends", [d["code"] for d in self.proved(client, uri, 2)])
        client.notify("workspace/didChangeConfiguration", {"settings": {"feedhold": {"proofs": "always"}}})
        self.assertIn("onSave", client.wait(lambda m: m.get("method") == "window/showMessage")["params"]["message"])

    def test_command(self):
        client = self.client(capabilities=PROGRESS, options={"proofs": "off"})
        uri = client.open("O9100.nc", STEPS)
        self.assertIsNone(client.request("workspace/executeCommand", {"command": "feedhold.prove", "arguments": [uri]}))
        self.assertTrue(self.proved(client, uri, 1))

    def test_edits_stop_proofs(self):
        """Whatever runs for an older text gives way, and the end of the session does not wait for it."""
        client = self.client(capabilities=PROGRESS, options={"proofs": "onType"})
        uri = client.open("O9100.nc", STEPS)
        for version in range(2, 30):
            client.change(uri, version, {"range": at(2, 0), "text": "(A)\n"})
            client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
        begun = time.monotonic()
        self.assertEqual(client.close(), 0)
        self.assertLess(time.monotonic() - begun, 20)

    def test_cancelling(self):
        """A person may stop a proof that takes long; nothing is said of it then."""
        client = self.client(capabilities=PROGRESS)
        path = ROOT / "corpus" / "packages" / "slope" / "O9411.nc"
        uri = client.open(path.as_uri(), path.read_text())
        begin = client.wait(lambda m: m.get("method") == "$/progress")["params"]
        self.assertTrue(begin["value"]["cancellable"])
        client.notify("window/workDoneProgress/cancel", {"token": begin["token"]})
        asked = time.monotonic()
        end = client.wait(lambda m: m.get("method") == "$/progress" and m["params"]["value"]["kind"] == "end")["params"]
        self.assertEqual((end["token"], end["value"]["message"]), (begin["token"], "stopped"))
        self.assertLess(time.monotonic() - asked, 10)
        client.request("textDocument/documentColor", {"textDocument": {"uri": uri}})
        self.assertFalse([d for m in client.kept if m.get("method") == "textDocument/publishDiagnostics"
                          for d in m["params"]["diagnostics"] if is_proof(d)])

    def test_programs_without_a_contract_are_left_alone(self):
        client = self.client(capabilities=PROGRESS)
        uri = client.open("a.nc", "%\nO1\n#1=#2/#3\nM30\n%\n")
        self.assertFalse([d for d in client.all_findings(uri, 1) if is_proof(d)])
        self.assertFalse([m for m in client.kept if m.get("method") == "$/progress"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
