"""Programs that end anywhere, as a file does that is still being written or was copied in part: every program of the
rules' pages, cut behind each of its lines, is checked and analysed without an internal error."""
import re
import subprocess
import unittest
from collections import defaultdict

from harness import FEEDHOLD, ROOT, Scratch

PROGRAM = re.compile(r"^```nc ([a-z0-9-]+)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)


def cut_programs():
    """By dialect: the texts, each once."""
    texts = defaultdict(set)
    for page in sorted((ROOT / "rules").rglob("*.md")):
        for dialect, program in PROGRAM.findall(page.read_text(encoding="utf-8", errors="surrogateescape")):
            lines = program.splitlines()
            texts[dialect].update("\n".join(lines[:count]) for count in range(1, len(lines) + 1))
    return texts


class CutPrograms(Scratch):
    def test_every_beginning_of_a_program(self):
        texts = cut_programs()
        self.assertGreater(sum(map(len, texts.values())), 3000, "the pages were not read")
        for dialect, programs in sorted(texts.items()):
            for number, text in enumerate(sorted(programs)):  # a folder each: they call one another otherwise
                self.write(f"{dialect}/{number}/O1.nc", text.encode(errors="surrogateescape"))
            choice = [] if dialect == "guess" else ["--dialect", dialect]
            result = subprocess.run([FEEDHOLD, "check", "--isolated", "--exit-zero", "--quiet", "--severity", "info",
                                     "--format", "concise", *choice, dialect], cwd=self.folder, capture_output=True)
            self.assertEqual((result.returncode, result.stderr), (0, b""), dialect)


if __name__ == "__main__":
    unittest.main()
