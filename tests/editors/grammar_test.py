"""The colours of VS Code, made by its own library, against the tokens of the program."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from harness import FEEDHOLD, NODE, ORACLES, ROOT, SKIPPED

FENCE = re.compile(r"^```nc ([a-z0-9-]+)(?: O?[0-9]+\.nc)?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TOKEN = re.compile(r"^(\S+) +([0-9]+)-([0-9]+) ", re.MULTILINE)
REMARKS = ("comment.", "meta.contract.", "string.quoted.alarm.", "punctuation.definition.string.")
VARIABLES = ("variable.", "support.variable.", "constant.language.", "keyword.operator.indirect.")
SCOPES = {  # token of the program: how its first byte may be coloured
    "comment": REMARKS,
    "function": ("support.function.",),
    "operator": ("keyword.operator.",),
    "control-word": ("keyword.control.", "support.function.print."),
    "#": VARIABLES,
    "=": ("keyword.operator.assignment.",),
    "+": ("keyword.operator.",),
    "*": ("keyword.operator.",),
    "%": ("keyword.other.tape.",),
    "[": ("punctuation.section.", "string.unquoted.print."),
    "address": ("variable.parameter.address.", "support.function.", "keyword.control.", "entity.name."),
    "number": ("constant.numeric.", "support.function.", "keyword.", "entity.name.", *VARIABLES, "string.unquoted.print."),
}


def coloured(scope, *files):
    """For each file a list of scopes for each byte, the innermost last."""
    result = subprocess.run([NODE, ROOT / "tests/editors/tokenize.mjs", scope, *files], capture_output=True, check=True)
    for file, line in zip(files, result.stdout.splitlines(), strict=True):
        scopes = [[] for _ in Path(file).read_bytes()]
        for begin, end, names in json.loads(line):
            for at in range(begin, min(end, len(scopes))):
                scopes[at] = names
        yield scopes


def tokens(file, *options):
    dump = subprocess.run([FEEDHOLD, "tokens", *options, file], capture_output=True, check=True)
    return [(kind, int(begin), int(end)) for kind, begin, end in TOKEN.findall(dump.stdout.decode(errors="replace"))]


def is_one_of(scopes, beginnings):
    return any(scope.startswith(beginnings) for scope in scopes)


def compared(file, scopes, *options):
    """How many tokens of the program there are, and what is wrong with the colours of some."""
    text, seen, wrong = file.read_bytes(), 0, []
    for kind, begin, end in tokens(file, *options):
        if kind not in SCOPES:
            continue
        seen += 1
        if not is_one_of(scopes[begin], SCOPES[kind]) or (kind == "comment") != is_one_of(scopes[begin], REMARKS):
            line = text.count(b"\n", 0, begin) + 1
            wrong.append(f"{file.name}:{line}: {kind} {text[begin:end]} as {scopes[begin]}")
    return seen, wrong


class Grammar(unittest.TestCase):
    maxDiff = None

    def test_programs_are_coloured_as_they_are_read(self):
        files = sorted((ROOT / "corpus").rglob("*.nc"))
        seen, wrong = zip(*(compared(*it) for it in zip(files, coloured("source.macrob", *files))))
        self.assertEqual(sum(wrong, []), [])
        self.assertGreater(sum(seen), 20000)

    def test_programs_of_the_pages(self):
        """Those of rules and goldens are of every dialect; some are no programs at all, on purpose."""
        with tempfile.TemporaryDirectory() as folder:
            files = {}
            for page in (page for room in ("rules", "tests/golden") for page in sorted((ROOT / room).rglob("*.md"))):
                for number, (dialect, text) in enumerate(FENCE.findall(page.read_text())):
                    if dialect != "guess":
                        file = Path(folder) / f"{page.stem}-{number}.nc"
                        file.write_text(text)
                        files[file] = dialect
            seen, wrong = zip(*(compared(file, scopes, "--dialect", files[file])
                                for file, scopes in zip(files, coloured("source.macrob", *files))))
        self.assertLess(len(sum(wrong, [])), sum(seen) / 500, "\n".join(sum(wrong, [])))
        self.assertGreater(sum(seen), 20000)

    def assertColours(self, text, expected, scope="source.macrob"):
        """`expected`: pieces of the text from left to right, with the innermost scope of each."""
        with tempfile.NamedTemporaryFile(suffix=".nc") as file:
            Path(file.name).write_text(text)
            (scopes,) = coloured(scope, file.name)
        at, found = 0, []
        for piece, _ in expected:
            at = text.index(piece, at)
            found.append((piece, next((name for name in reversed(scopes[at])), "").removesuffix(".macrob")))
            at += len(piece)
        self.assertEqual(found, expected)

    def test_a_call(self):
        self.assertColours("N20 G65 P9010 A#1 B-1.5 (SLOT)\n", [
            ("N20", "entity.name.label"), ("G65", "keyword.control.call"), ("P", "variable.parameter.address"),
            ("9010", "entity.name.function.program"), ("A", "variable.parameter.address"), ("#1", "variable.parameter.local"),
            ("-", "keyword.operator.arithmetic"), ("1.5", "constant.numeric"), ("SLOT", "comment.block")])

    def test_words_without_blanks(self):
        self.assertColours("/2N5IF[[#100GTABS[#2]]AND[#5EQ#0]]GOTO10\n", [
            ("/2", "keyword.other.block-skip"), ("N5", "entity.name.label"), ("IF", "keyword.control"),
            ("#100", "variable.other.common"), ("GT", "keyword.operator.relational"), ("ABS", "support.function"),
            ("#2", "variable.parameter.local"), ("AND", "keyword.operator.word"), ("EQ", "keyword.operator.relational"),
            ("#0", "constant.language.vacant"), ("GOTO", "keyword.control.jump"), ("10", "entity.name.label")])

    def test_loops_alarms_and_what_is_printed(self):
        self.assertColours("WHILE[#1LE#4120]DO1\n#3000=1(TOO DEEP)\nEND1\nDPRNT[X#100[34]]\n##7=[#<depth>MOD2]\n", [
            ("WHILE", "keyword.control"), ("#4120", "support.variable.system"), ("DO", "keyword.control.loop"),
            ("#3000", "support.variable.alarm"), ("1", "constant.numeric"), ("TOO DEEP", "string.quoted.alarm"),
            ("END", "keyword.control.loop"), ("DPRNT", "support.function.print"), ("X", "string.unquoted.print"),
            ("#100", "variable.other.common"), ("34", "constant.numeric"), ("#", "keyword.operator.indirect"),
            ("#7", "variable.parameter.local"), ("#<depth>", "variable.other.named"), ("MOD", "keyword.operator.word")])

    def test_contracts_and_suppressions(self):
        self.assertColours("(@PARAM #21 DEPTH 0.5..#7 MM/MIN)\n(@ENSRUE #1)\n(@ALLOW lower-case as printed)\n(MAIL A@B)\n", [
            ("@PARAM", "storage.type.clause"), ("#21", "variable.parameter.local"), ("DEPTH", "entity.name.other.contract"),
            ("0.5", "constant.numeric"), ("..", "keyword.operator.range"), ("#7", "variable.parameter.local"),
            ("MM/MIN", "support.type.unit"), ("@ENSRUE", "invalid.illegal.clause"),
            ("@ALLOW", "storage.modifier.suppression"), ("lower-case", "entity.name.tag.rule"),
            ("as printed", "comment.block.suppression"), ("MAIL", "comment.block")])

    def test_contracts_beside_a_program(self):
        self.assertColours("@PARAM #1 X 0..5 MM ; WIDTH\n@AT N30 INVARIANT #10 GE 0\n", [
            ("@PARAM", "storage.type.clause"), ("0", "constant.numeric"), ("..", "keyword.operator.range"),
            ("MM", "support.type.unit"), ("WIDTH", "comment.line.semicolon"), ("N30", "entity.name.label"),
            ("INVARIANT", "storage.type.clause"), ("GE", "keyword.operator.relational")], "source.macrob.contract")


if __name__ == "__main__":
    if not ORACLES:
        print("skipped: needs the packages of editors/vscode; run `./dev test --oracles`")
        sys.exit(SKIPPED)
    unittest.main()
