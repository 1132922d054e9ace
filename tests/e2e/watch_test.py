"""`check --watch`: a fresh report for each change, until Ctrl-C."""
import os
import queue
import signal
import subprocess
import threading
import unittest

from harness import BAD, FEEDHOLD, GOOD, Scratch


class Watch(Scratch):
    def start(self, *arguments):
        process = subprocess.Popen([FEEDHOLD, "check", "--watch", *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   env=self.environment())
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.lines = queue.Queue()
        threading.Thread(target=lambda: [self.lines.put(line) for line in process.stdout], daemon=True).start()
        return process

    def report(self):
        """Up to the line that says that it waits."""
        text = ""
        while "--- watching" not in text:
            text += self.lines.get(timeout=30)
        return text

    def silence(self):
        with self.assertRaises(queue.Empty):
            self.lines.get(timeout=1.5)

    def test_changes(self):
        self.write("a.nc", GOOD)
        process = self.start("--format", "concise")
        self.assertIn("no findings", self.report())
        self.silence()
        self.write("a.nc", BAD)
        self.assertIn("a.nc:3:", self.report())
        self.write("sub/b.nc", BAD.replace("1001", "1002"))
        self.assertIn("sub/b.nc:3", self.report())
        self.write("feedhold.toml", 'ignore = ["syntax", "structure", "expression"]\n')
        self.report()
        self.write("a.contract", "@ALLOW missing-equals FROZEN\n")
        self.report()
        (self.folder / "sub/b.nc").unlink()
        self.assertNotIn("b.nc", self.report())
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=10), -signal.SIGINT)

    def test_own_output_is_no_change(self):
        self.write("a.nc", BAD)
        self.start("--format", "json", "--output", "report.json")
        self.report()
        self.silence()
        self.assertIn("missing-equals", (self.folder / "report.json").read_text())

    def test_mistake_on_the_way(self):
        self.write("a.nc", GOOD)
        self.start()
        self.report()
        self.write("feedhold.toml", "dialekt = 5\n")
        self.assertIn("dialekt", self.report())
        os.remove(self.folder / "feedhold.toml")
        self.assertIn("no findings", self.report())

    def test_named_file(self):
        self.write("a.nc", GOOD)
        self.start("a.nc")
        self.report()
        self.write("a.nc", BAD)
        self.assertIn("missing-equals", self.report())

    def test_what_does_not_go_together(self):
        self.write("a.nc", GOOD)
        for words in (["-"], ["--fix"], ["--diff"], ["--baseline", "b.json", "--update-baseline"]):
            self.assertExit(self.check("--watch", *words), 2)


if __name__ == "__main__":
    unittest.main()
