"""Pages of docs/ show what the program really says: each `$ feedhold ...` in a text fence is run on the page's programs.

`docs_test.py --update` writes what comes out into the pages; then read `git diff`.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from harness import FEEDHOLD, LONGEST_RUN, ROOT

PAGES = ["README.md", "docs/draft.md", "docs/install.md", "docs/many-machines.md", "docs/prove.md",
         "docs/ranges.md", "docs/run.md"]
FENCE = re.compile(r"^```(\S*)([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = "$ feedhold "


def name_of(language, words, text):
    """The file that a fence is, or None: programs by their O word, others by the name behind the language."""
    if words.strip():
        return words.split()[-1]
    number = re.search(r"^(O[0-9]+)", text, re.MULTILINE)
    return f"{number[1]}.nc" if language == "nc" and number else None


def output_of(command, folder):
    """What a person sees in a terminal without colours."""
    words = shlex.split(command)
    if words[0] == "prove":
        words.append("--no-cache")
    result = subprocess.run([FEEDHOLD, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            timeout=LONGEST_RUN, stdin=subprocess.DEVNULL)
    return result.stdout.decode()


def rewritten(page):
    """The page with the real output behind each command."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "corpus").symlink_to(ROOT / "corpus")

        def fresh(match):
            language, words, text = match.groups()
            if file := name_of(language, words, text):
                (folder / file).write_text(text)
            if language != "text" or not text.startswith(COMMAND):
                return match[0]
            lines = [line for line in text.splitlines() if line.startswith("$ ")]
            told = [f"{line}\n{output_of(line[len(COMMAND):], folder)}" for line in lines]
            return f"```text\n{''.join(told)}```"

        return FENCE.sub(fresh, page)


class Docs(unittest.TestCase):
    maxDiff = None

    def test_pages(self):
        for name in PAGES:
            with self.subTest(page=name):
                page = (ROOT / name).read_text()
                self.assertIn(f"\n{COMMAND}", page)
                self.assertMultiLineEqual(page, rewritten(page))


if __name__ == "__main__":
    os.environ["NO_COLOR"] = "1"
    if sys.argv[1:] == ["--update"]:
        for path in (ROOT / name for name in PAGES):
            path.write_text(rewritten(path.read_text()))
    else:
        unittest.main()
