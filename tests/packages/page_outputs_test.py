"""What the program of the page says, under Node.js, compared with the packaged one: byte for byte, but for proofs.  The
page is built with another compiler, which evaluates arguments in another order and so numbers terms differently: where
a search ends without an answer, the other may find one."""
import json
import re
import shutil
import subprocess
import unittest

from packaged import ROOT, Packaged, linux_program
from page import NODE, PROGRAM, WEB, main

FENCE = re.compile(r"^```nc \S+(?: (?!escaped)(\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"\bO(\d+)", re.IGNORECASE)
FOLDER = re.compile(r"/work(?![\w.-])")  # of the programs, in the page
PACKAGES = ROOT / "corpus/packages"
PROVED = ["mould-entry/O9115.nc", "pocket/O9313.nc", "set-up/O9700.nc", "ims/O0142.nc", "slope/O9415.nc"]

DECIDED = ("proved", "refuted", "unreachable")


def verdicts_of(output):
    return {(row["kind"], row["id"], row["claim"]): row["verdict"] for file in json.loads(output)["files"] for row in file["obligations"]}


class Outputs(Packaged):
    def setUp(self):
        super().setUp()
        self.work = self.folder / "work"
        self.work.mkdir()

    def in_page(self, *requests):
        """Each a list of words, in the folder of the test."""
        asked = [{"words": words, "folder": str(self.work)} for words in requests]
        told = subprocess.run([NODE, ROOT / "tests/packages/page_node.mjs", WEB, PROGRAM], input=json.dumps(asked),
                              capture_output=True, text=True, timeout=900)
        self.assertEqual(told.returncode, 0, told.stderr)
        return json.loads(told.stdout)

    def packaged(self, words):
        return subprocess.run([linux_program(), *words], cwd=self.work, env={"PATH": "/nowhere", "HOME": "/nowhere"},
                              capture_output=True, timeout=600, stdin=subprocess.DEVNULL)

    def compare(self, *requests):
        """Both programs say the same; what it was."""
        said = []
        for words, ours in zip(requests, self.in_page(*requests)):
            theirs = self.packaged(words)
            with self.subTest(words=words):
                self.assertNotIn("fault", ours)
                self.assertEqual(FOLDER.sub(str(self.work), ours["output"]), theirs.stdout.decode())
                self.assertEqual(ours["errors"], theirs.stderr.decode())
                self.assertEqual(ours["code"], theirs.returncode)
            said.append(ours["output"])
        return said

    def test_findings_in_rule_pages(self):
        count = 0
        for page in sorted((ROOT / "rules").rglob("*.md")):
            for number, (name, text) in enumerate(FENCE.findall(page.read_text())):
                program = NUMBER.search(text)
                path = self.work / page.parent.name / page.stem / str(number)
                path.mkdir(parents=True, exist_ok=True)
                (path / (name or (f"O{program[1]}.nc" if program else "part.nc"))).write_text(text)
                count += 1
        self.assertGreater(count, 500)
        said = self.compare(["check", "--format", "json", "."], ["check", "--format", "sarif", "--severity", "info", "."])
        self.assertGreater(len(json.loads(said[0])["findings"]), 400)

    def test_findings_ranges_and_runs_in_corpus(self):
        shutil.copytree(PACKAGES, self.work / "packages")
        programs = sorted(path.relative_to(self.work).as_posix() for path in (self.work / "packages").rglob("*.nc"))
        self.assertGreater(len(programs), 60)
        self.compare(["check", "--format", "json", "."], *(["ranges", "--format", "json", name] for name in programs))
        self.compare(*(["run", name] for name in programs), *(["plot", name] for name in programs))

    def test_proofs(self):
        for name in PROVED:
            shutil.copy(PACKAGES / name, self.work)
        requests = [["prove", "--no-cache", "--format", "json", name.split("/")[1]] for name in PROVED]
        verdicts = []
        for words, ours in zip(requests, self.in_page(*requests)):
            theirs = self.packaged(words)
            with self.subTest(words=words):
                self.assertNotIn("fault", ours)
                self.assertEqual(ours["errors"], theirs.stderr.decode())
                ours, theirs = verdicts_of(ours["output"]), verdicts_of(theirs.stdout)
                self.assertEqual(ours.keys(), theirs.keys())
                verdicts += [(ours[row], theirs[row]) for row in ours]
        self.assertLessEqual({("proved", "proved"), ("refuted", "refuted")}, set(verdicts))
        self.assertLessEqual({one for one in verdicts if "unknown" not in one}, {(each, each) for each in DECIDED})
        decided = [one for one in verdicts if one[1] in DECIDED]
        self.assertGreater(sum(ours in DECIDED for ours, _ in decided), 0.9 * len(decided))

    def test_self_check(self):
        said = self.compare(["self-check"], ["--version"], ["dialects", "--format", "json"])
        self.assertIn("the self-check passed", said[0])

    def test_mistakes(self):
        (self.work / "O1.nc").write_text("O1\n#1=[1\nM30\n")
        self.compare(["check", "nothing.nc"], ["check", "--dialect", "none", "O1.nc"], ["run", "O1.nc"], ["nonsense"])


if __name__ == "__main__":
    main()
