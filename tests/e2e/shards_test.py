"""`--shard`, `--part` and `merge`: a run in parts says what one run says, byte for byte, or says why it cannot."""
import hashlib
import json
import random
import shutil
import subprocess
import time
import unittest

from harness import BAD, FEEDHOLD, GOOD, Scratch

MAIN = """%
O{number}(PART {number})
G90G54G00X0.Y0.
#5=#501
G65P{macro}A#5B2.
M98P{helper}
#510-[0-1.5]
M30
%
"""
MACRO = """%
O{number}(STEPS)
N10 #10=FUP[#1/#2]
WHILE[#10GT0]DO1
#10=#10-1
G91G01Z-[#2]F100.
END1
G90
IF[#1GT50.]GOTO90
#511-#6
M99
N90#3000=1(TOO DEEP)
%
"""
HELPER = "%\nO{number}(BACK)\n#100=10./#101\nG00Z50.\nM99\n%\n"
CONTRACT = "@PARAM #1 DEPTH 0.5..20.\n@PARAM #2 STEP 0.1..20.\n@ALLOW missing-equals THE SHOP WRITES SO\n"
DEEP = "@PARAM #1 DEPTH 0.5..60.\n@PARAM #2 STEP 0.1..20.\n"
UNUSED = "@ALLOW missing-equals NOT ANY MORE\n"
MISTAKEN = "@PARAM #26 Z 0..1.\n"
FOREIGN = "0 BEGIN PGM TEST MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 L X+2 Y+0 R0 FMAX M3\n3 END PGM TEST MM\n"
ARC = "%\nO{number}(FACE)\nG90G54G17\nG1X0.Y0.F100\nG2X10.Y5.\nG3X0.Y0.\nM30\n%\n"
LINUXCNC = "o<pocket> sub\nG21 G90\n#<depth> = [#1 / #2]\nG1 Z-#<depth> F100\no<pocket> endsub\nM2\n"
BROKEN = "dialekt = 5\n"
FORMATS = {"check": ("text", "concise", "json", "sarif", "junit", "github"), "prove": ("text", "json", "sarif")}
MANY = (1, 2, 5, 13)  # of which the last are more than there are groups of programs that call one another
COMPONENTS = [{"cell 1/O1000.nc", "cell 1/O9001.nc", "cell 1/O9002.nc"},
              {"cell 2/O1010.nc", "cell 2/O9011.nc", "cell 2/O9012.nc"},
              {"across/O1030.nc", "across/deep/O9031.nc"}]


class Fields:
    """The record of a part: numbers with a blank behind them, texts with their size before them."""

    def __init__(self, part):
        self.rest = part.read_bytes().split(b"\n", 2)[2]

    def number(self):
        number, _, self.rest = self.rest.partition(b" ")
        return int(number)

    def text(self):
        size = self.number()
        text, self.rest = self.rest[:size], self.rest[size:]
        return text.decode(errors="surrogateescape")

    def rows(self, *columns):
        return [[column() for column in columns] for _ in range(self.number())]


def files_of(part, command):
    """The files of a shard: those of which its part has findings, or, of proofs, costs."""
    fields = Fields(part)
    fields.text(), fields.text()  # the build, the solvers
    fields.rows(fields.text)
    fields.number(), fields.number()
    costs = fields.rows(fields.text, fields.number)
    answers = fields.rows(fields.text, fields.text)
    names = [key.split(" ", 2)[2] for key, _ in answers if key.startswith("check ")]
    return names if command == "check" else [name for name, _ in costs]


class Tree(Scratch):
    """Folders of programs that call one another, and parts of runs over them in a folder elsewhere."""

    def setUp(self):
        super().setUp()
        self.parts = self.cache / "parts of a run"
        self.parts.mkdir()
        for cell, tens in ((1, 0), (2, 1)):
            name = f"cell {cell}"
            main = MAIN.format(number=f"10{tens}0", macro=f"90{tens}1", helper=f"90{tens}2")
            self.write(f"{name}/O10{tens}0.nc", main)
            self.write(f"{name}/O90{tens}1.nc", MACRO.format(number=f"90{tens}1"))
            self.write(f"{name}/O90{tens}2.nc", HELPER.format(number=f"90{tens}2"))
        self.write("cell 1/O9001.contract", CONTRACT)
        self.write("cell 2/O9011.contract", DEEP)
        self.write("cell 2/O9012.contract", UNUSED)
        self.write("across/O1030.nc", "%\nO1030\nG65P9031A1.\nM30\n%\n")
        self.write("across/deep/O9031.nc", HELPER.format(number=9031).replace("#101", "#1"))
        self.write("alone/\u00e4 part; with 'quotes'.nc", GOOD)
        self.write("alone/O1001.nc", BAD)
        self.write("foreign/program.h", FOREIGN)
        self.write("linuxcnc/pocket.ngc", LINUXCNC)
        self.write("faces/O3000.nc", ARC.format(number=3000))
        self.write("faces/O3001.nc", ARC.format(number=3001))
        self.write("settings/feedhold.toml", '[switches]\nnat = true\n[severity]\nmissing-equals = "info"\n')
        self.write("settings/O4000.nc", BAD.replace("1001", "4000"))
        self.write("notes.txt", "Dear all,\nthis is text.\n")

    def part(self, index, count):
        return self.parts / f"{index} of {count}.part"

    def shard(self, command, index, count, *options):
        return self.feedhold(command, "--shard", f"{index}/{count}", "--part", self.part(index, count), *options)

    def shards(self, command, count, *options):
        """Their parts are there, and those of no other run."""
        for old in self.parts.iterdir():
            old.unlink()
        return [self.shard(command, index, count, *options) for index in range(1, count + 1)]

    def merge(self, *options):
        return self.feedhold("merge", self.parts, *options)

    def assertSame(self, result, expected):
        self.assertMultiLineEqual(result.stdout, expected.stdout)
        self.assertMultiLineEqual(result.stderr, expected.stderr)
        self.assertEqual(result.returncode, expected.returncode)

    def assertRefused(self, result, *words):
        self.assertExit(result, 2)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(word, result.stderr)

    def forge(self, path, old, new):
        """Changes a part so that it does not look damaged."""
        head, _, record = path.read_bytes().split(b"\n", 2)
        self.assertEqual(len(old), len(new))
        self.assertIn(old, record)
        record = record.replace(old, new)
        path.write_bytes(b"\n".join([head, hashlib.sha256(record).hexdigest().encode(), record]))


class SameBytes(Tree):
    maxDiff = None

    def compare(self, command, counts=(3,)):
        """Of one run and of some numbers of parts, in all formats; returns the run."""
        formats = FORMATS[command]
        expected = {name: self.feedhold(command, "--format", name) for name in formats}
        for count in counts:
            self.shards(command, count)
            for name in formats:
                with self.subTest(count=count, format=name):
                    self.assertSame(self.merge("--format", name), expected[name])
        return expected[formats[0]]

    def test_check(self):
        result = self.compare("check", MANY)
        self.assertExit(result, 1)
        for words in ("cell 1/O1000.nc", "unused-suppression", "with 'quotes'", "program.h", "no NC program", "dialect linuxcnc"):
            self.assertIn(words, result.stdout)
        self.assertTrue(json.loads(self.merge("--format", "json").stdout)["inferred"])

    def test_prove(self):
        result = self.compare("prove", MANY)
        self.assertExit(result, 1)
        for words in ("cell 1/O9001.nc: O9001", "unreachable", "refuted", "unknown"):
            self.assertIn(words, result.stdout)

    def test_configuration_and_contract_with_mistakes(self):
        self.write("settings/feedhold.toml", BROKEN)
        self.write("cell 2/O9012.contract", MISTAKEN)
        for command in ("check", "prove"):
            result = self.compare(command)
            self.assertExit(result, 2)
            self.assertIn("dialekt", result.stderr)

    def test_no_findings(self):
        shutil.rmtree(self.folder)
        self.write("a/O1000.nc", GOOD)
        self.write("b/O1000.nc", GOOD.replace("FACING", "FACING AGAIN"))
        for command in ("check", "prove"):
            self.assertExit(self.compare(command), 0)

    def test_unknown_verdicts(self):
        shutil.rmtree(self.folder)
        self.write("a/O1000.nc", "O1000\n#1=#500\nWHILE[#1GT0]DO1\n#1=#1-#501\nEND1\nM30\n")
        self.write("b/O1000.nc", GOOD)
        self.assertIn(self.compare("prove").returncode, (1, 3))

    def test_options(self):
        check = (("--statistics",), ("--select", "missing-equals,contract", "--ignore=contract"), ("--severity", "info"),
                 ("--error-on", "error", "cell 1"), ("--dialect", "fanuc-30i", "cell 2", "alone"), ("-q",),
                 ("--show-suppressed",), ("--exit-zero",), ("--isolated",), ("--config", "settings/feedhold.toml"),
                 ("--color", "always"), ("cell 1/O1000.nc", "cell 1"), ("./cell 1", "missing.nc"))
        prove = (("--statistics",), ("-v",), ("-q", "--effort", "2"), ("--only", "loop-ends", "--only", "program-ends"),
                 ("--arithmetic", "exact", "cell 1"), ("--missing", "havoc", "--no-cache", "across/O1030.nc"))
        for command, rows in (("check", check), ("prove", prove)):
            for options in rows:
                with self.subTest(command=command, options=options):
                    expected = self.feedhold(command, *options)
                    self.shards(command, 2, *options)
                    self.assertSame(self.merge(), expected)

    def test_options_of_merge(self):
        for command, rows in (("check", (["--statistics"], ["-q"], ["--show-suppressed"], ["--exit-zero"],
                                         ["--color", "always"], ["--format=json", "-q"])),
                              ("prove", (["--statistics"], ["-v"], ["-q"], ["--color=always"]))):
            self.shards(command, 2, "--format", "sarif")
            for options in rows:
                with self.subTest(command=command, options=options):
                    words = options if options[0].startswith("--format") else ["--format", "text", *options]
                    self.assertSame(self.merge(*words), self.feedhold(command, *words))
        self.assertExit(self.merge("--exit-zero"), 2)  # prove has no such option

    def test_output(self):
        expected = self.check("--output", self.cache / "one.json", "--format", "json")
        self.shards("check", 2)
        self.assertSame(self.merge("--output", self.cache / "merged.json", "--format", "json"), expected)
        self.assertEqual((self.cache / "merged.json").read_bytes(), (self.cache / "one.json").read_bytes())

    def test_jobs(self):
        expected = self.check()
        self.shard("check", 1, 2, "--jobs", "1")
        self.shard("check", 2, 2, "--jobs", "3")
        self.assertSame(self.merge(), expected)

    def test_baseline(self):
        for command in ("check", "prove"):
            with self.subTest(command=command):
                self.write("alone/O1001.nc", BAD)
                one = self.feedhold(command, "--baseline", ".one.json", "--update-baseline")
                self.shards(command, 2)
                merged = self.merge("--baseline", ".merged.json", "--update-baseline")
                self.assertExit(merged, 0)
                self.assertEqual(merged.stdout.replace(".merged.json", ".one.json"), one.stdout)
                self.assertEqual((self.folder / ".merged.json").read_bytes(), (self.folder / ".one.json").read_bytes())

                self.write("alone/O1001.nc", BAD.replace("#510", "#1=1/#500\n#512-[1]\n#510"))
                expected = self.feedhold(command, "--baseline", ".one.json")
                self.assertExit(expected, 1)
                self.shards(command, 2)
                self.assertSame(self.merge("--baseline", ".one.json"), expected)
                self.shards(command, 2, "--baseline", ".one.json")
                self.assertSame(self.merge(), expected)

    def test_answers_come_from_the_parts(self):
        self.shards("prove", 2)
        for path in self.parts.iterdir():
            self.forge(path, b"the program comes to an end", b"the program COMES to an end")
        self.assertIn("the program COMES to an end", self.merge().stdout)
        self.shards("check", 2)
        for path in self.parts.iterdir():
            if b"is a statement" in path.read_bytes():
                self.forge(path, b"is a statement", b"IS a statement")
        self.assertIn("IS a statement", self.merge().stdout)

    def test_parts_among_the_programs(self):
        """As in a folder of a build server: they are nobody's programs, whatever texts they hold."""
        for command in ("check", "prove"):
            with self.subTest(command=command):
                expected = self.feedhold(command)
                (self.folder / "parts").mkdir(exist_ok=True)
                for index in (1, 2, 3):
                    self.feedhold(command, "--shard", f"{index}/3", "--part", f"parts/{index}.part")
                self.assertSame(self.feedhold("merge", "parts"), expected)


class Distribution(Tree):
    def files(self, command, index, count, *options, cwd=None):
        """Of a shard, as its part names them."""
        path = self.cache / "one shard"
        self.feedhold(command, "--shard", f"{index}/{count}", "--part", path, *options, cwd=cwd)
        return files_of(path, command)

    def distribution(self, command, count, *options):
        return [self.files(command, index, count, *options) for index in range(1, count + 1)]

    def test_each_file_is_in_one_shard(self):
        for command in ("check", "prove"):
            everything = self.files(command, 1, 1)
            self.assertGreater(len(everything), 12)
            for count in (2, 5, 13):
                with self.subTest(command=command, count=count):
                    shards = self.distribution(command, count)
                    self.assertEqual(sorted(sum(shards, [])), everything)
                    self.assertGreaterEqual(sum(bool(shard) for shard in shards), min(count, 7))

    def test_programs_that_call_one_another_stay_together(self):
        for count in (2, 5, 13):
            for shard in self.distribution("check", count):
                for component in COMPONENTS[:2]:
                    self.assertIn(len(component & set(shard)), (0, len(component)))

    def test_shards_of_one_cost(self):
        for number in range(40):
            self.write(f"equal/O{5000 + number}.nc", GOOD.replace("1000", str(5000 + number)))
        sizes = [len(shard) for shard in self.distribution("check", 4, "equal")]
        self.assertEqual(sizes, [10, 10, 10, 10])

    def test_same_shards_again(self):
        before = self.distribution("check", 3)
        self.assertEqual(self.distribution("check", 3, "--jobs", "1"), before)
        self.assertEqual(self.distribution("check", 3), before)
        moved = self.cache / "elsewhere"
        shutil.copytree(self.folder, moved)
        self.assertEqual([self.files("check", index, 3, cwd=moved) for index in (1, 2, 3)], before)

    def test_calls_between_named_folders(self):
        """What is together depends on the files that are named, as everything in a run does."""
        self.assertEqual(sorted(sum(self.distribution("check", 2, "cell 1", "alone"), [])),
                         sorted([*COMPONENTS[0], "alone/O1001.nc", "alone/\u00e4 part; with 'quotes'.nc"]))

    def test_costs_of_an_earlier_run(self):
        """A small program that is dear to prove goes alone once that is known."""
        shutil.rmtree(self.folder)
        dear = "O1000\n(@PARAM #1 A 1..40 INT)\n#2=#1\nWHILE[#2GT0]DO1\n#3=#2\nWHILE[#3GT0]DO2\n#3=#3-1\nEND2\n#2=#2-1\nEND1\n#4=1/#1\nM30\n"
        self.write("dear/O1000.nc", dear)
        for number in range(2000, 2006):
            self.write(f"cheap {number}/O{number}.nc", f"O{number}\n" + "G01X1.F100\n" * 40 + "M30\n")
        guessed = self.distribution("prove", 2)
        self.assertNotIn(["dear/O1000.nc"], guessed)
        self.shards("prove", 2)
        known = self.distribution("prove", 2, "--costs", self.parts)
        self.assertEqual(sorted(sum(known, [])), sorted(sum(guessed, [])))
        self.assertIn(["dear/O1000.nc"], known)
        one_by_one = ("--costs", self.part(1, 2), "--costs", self.part(2, 2))
        self.assertEqual(self.distribution("prove", 2, *one_by_one), known)
        self.assertEqual(sorted(sum(self.distribution("check", 2, "--costs", self.parts), [])), sorted(sum(known, [])))
        self.assertIn(["dear/O1000.nc"], self.distribution("check", 2, "--costs", self.parts))

    def test_costs_do_not_change_the_result(self):
        expected = self.feedhold("prove")
        self.shards("prove", 3)
        earlier = self.cache / "earlier"
        shutil.copytree(self.parts, earlier)
        self.write("cell 3/O1000.nc", GOOD)  # whose cost nobody knows
        expected = self.feedhold("prove")
        self.shards("prove", 4, "--costs", earlier)
        self.assertSame(self.merge(), expected)

    def test_costs_that_cannot_be_read(self):
        self.assertExit(self.check("--shard", "1/2", "--costs", self.parts), 2)
        self.assertExit(self.check("--shard", "1/2", "--costs", "notes.txt"), 2)
        self.assertExit(self.check("--costs", "notes.txt"), 2)


class Merging(Tree):
    def test_twice_changes_nothing(self):
        for command in ("check", "prove"):
            expected = self.feedhold(command)
            self.shards(command, 2)
            before = {path.name: path.read_bytes() for path in self.parts.iterdir()}
            self.shard(command, 1, 2)
            self.assertEqual({path.name: path.read_bytes() for path in self.parts.iterdir()}, before)
            shutil.copy(self.part(2, 2), self.parts / "again.part")
            self.assertSame(self.merge(), expected)
            parts = [self.part(2, 2), self.part(1, 2), self.part(2, 2)]
            self.assertSame(self.feedhold("merge", *parts), expected)
            self.assertSame(self.feedhold("merge", self.parts, *parts), expected)

    def test_same_part_on_every_machine(self):
        self.shards("prove", 2)
        before = self.part(1, 2).read_bytes()
        moved = self.cache / "elsewhere"
        shutil.copytree(self.folder, moved)
        self.feedhold("prove", "--shard", "1/2", "--part", self.part(1, 2), "--no-cache", "--jobs", "1", cwd=moved)
        self.assertEqual(self.part(1, 2).read_bytes(), before)

    def test_empty_values_and_strange_paths(self):
        self.write("-y.nc", GOOD)
        before = (self.folder / "-y.nc").read_bytes()
        expected = self.feedhold("check", "--isolated", "--", "-y.nc", "alone")
        self.feedhold("check", "--isolated", "--output", "", "--statistics=false", "--shard", "1/1", "--part",
                      self.part(1, 1), "--", "-y.nc", "alone")
        self.assertSame(self.merge(), expected)
        self.assertEqual((self.folder / "-y.nc").read_bytes(), before)

    def test_missing_parts(self):
        self.shards("check", 5)
        self.part(3, 5).unlink()
        self.assertRefused(self.merge(), "of 5 parts, 3 is missing")
        self.part(4, 5).unlink()
        self.assertRefused(self.merge(), "of 5 parts, 3, 4 are missing")
        for path in self.parts.iterdir():
            path.unlink()
        self.assertRefused(self.merge(), str(self.parts))
        self.assertRefused(self.feedhold("merge", "nowhere.part"), "nowhere.part")
        self.assertExit(self.feedhold("merge"), 2)

    def test_damaged_part(self):
        self.shards("check", 2)
        content = self.part(2, 2).read_bytes()
        middle = len(content) // 2
        for text in (b"", content[:20], content[:-1], content + b" ", bytes(len(content)), content.upper(),
                     content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1:], b"%\nO1000\nM30\n%\n"):
            with self.subTest(text=text[:40]):
                self.part(2, 2).write_bytes(text)
                self.assertRefused(self.merge(), self.part(2, 2).name)

    def test_record_that_is_none(self):
        self.shards("check", 2)
        head, _, record = self.part(2, 2).read_bytes().split(b"\n", 2)
        for text in (b"", b"1 ", b"99999999999999999999 ", b"9999 ", b"3 abc9 1 x", b"x" * 300, record[:-2], record + b"0 "):
            with self.subTest(text=text[:30]):
                self.part(2, 2).write_bytes(b"\n".join([head, hashlib.sha256(text).hexdigest().encode(), text]))
                self.assertRefused(self.merge(), self.part(2, 2).name, "damaged")

    def test_record_of_a_shard_that_cannot_be(self):
        self.shards("check", 2)
        for index, count in ((0, 0), (3, 2), (1, 4294967295), (2, 0)):
            with self.subTest(index=index, count=count):
                for path in self.parts.iterdir():
                    path.unlink()
                tool, command = b"8 feedhold", b"1 5 check"
                record = b"%s0 %s%d %d 0 0 " % (tool, command, index, count)
                path = self.parts / "a.part"
                path.write_bytes(b"\n".join([b"feedhold part 1", hashlib.sha256(record).hexdigest().encode(), record]))
                result = subprocess.run([FEEDHOLD, "merge", self.parts], cwd=self.folder, capture_output=True, timeout=20)
                self.assertEqual(result.returncode, 2)
                self.assertLess(len(result.stderr), 2000)

    def test_different_runs(self):
        self.shard("check", 1, 2)
        self.shard("prove", 2, 2)
        self.assertRefused(self.merge(), "different runs", "check", "prove")
        self.shard("check", 2, 2, "--severity", "info")
        self.assertRefused(self.merge(), "different runs", "--severity=info")
        self.shard("check", 2, 2, "cell 1")
        self.assertRefused(self.merge(), "different runs", "cell 1")
        self.part(2, 2).unlink()
        self.shard("check", 2, 3)
        self.assertRefused(self.merge(), "one of 2", "one of 3")

    def test_spelling_makes_no_other_run(self):
        expected = self.check("--format", "json", "--select", "missing-equals", "--select", "contract")
        self.shard("check", 1, 2, "--format", "json", "--select", "missing-equals", "--select", "contract")
        self.shard("check", 2, 2, "--select=missing-equals,contract", "--format=json")
        self.assertSame(self.merge(), expected)

    def test_caches_of_their_own_make_no_other_run(self):
        expected = self.feedhold("prove")
        for index in (1, 2):
            self.shard("prove", index, 2, "--cache-dir", self.cache / f"machine {index}")
        self.assertSame(self.merge(), expected)

    def test_other_builds(self):
        self.shards("check", 2)
        tool = self.part(1, 2).read_bytes().split(b"\n", 2)[2].split(b" ", 1)[1].split(b" ")[2][:16]
        other = bytes(reversed(tool))
        self.forge(self.part(1, 2), tool, other)
        self.assertRefused(self.merge(), "different builds")
        self.forge(self.part(2, 2), tool, other)
        self.assertRefused(self.merge(), "another build", other.decode(), tool.decode())

    def changed(self, name, text):
        """A file is changed between the shards and the merge: what is told."""
        path = self.folder / name
        before = path.read_bytes() if path.exists() else None
        self.write(name, text)
        result = self.merge()
        if before is None:
            path.unlink()
        else:
            path.write_bytes(before)
        return result

    def test_files_that_change_between(self):
        rows = (("alone/O1001.nc", BAD + "\n", "alone/O1001.nc"),
                ("alone/O1002.nc", GOOD.replace("1000", "1002"), "alone/O1002.nc"),
                ("cell 1/O9002.nc", HELPER.format(number=9002).replace("#101", "#102"), "cell 1/O1000.nc"),
                ("cell 1/O9001.contract", CONTRACT.replace("@ALLOW", "; @ALLOW"), "cell 1/O9001.nc"),
                ("cell 1/O1000.contract", "@ALLOW missing-equals SO\n@MODAL G17\n", "cell 1/O1000.nc"),
                ("cell 2/O9012.contract", UNUSED + "@GLOBAL #101 D 1..2.\n", "cell 2/O9012.nc"),
                ("settings/feedhold.toml", "[switches]\nnat = false\n", "settings/O4000.nc"),
                ("alone/feedhold.toml", 'dialect = "haas-ngc"\n', "alone/O1001.nc"))
        for command in ("check", "prove"):
            expected = self.feedhold(command)
            self.shards(command, 2)
            for name, text, told in rows:
                with self.subTest(command=command, name=name):
                    result = self.changed(name, text)
                    self.assertExit(result, 2)
                    self.assertIn(told, result.stderr)
                    self.assertIn("changed since", result.stderr)
            self.assertSame(self.merge(), expected)

    def test_file_that_is_gone(self):
        for command in ("check", "prove"):
            self.shards(command, 2)
            (self.folder / "cell 1/O9002.nc").rename(self.cache / "kept")
            self.assertExit(self.merge(), 2)
            (self.cache / "kept").rename(self.folder / "cell 1/O9002.nc")

    def test_file_that_changes_between_the_shards(self):
        for command in ("check", "prove"):
            self.shard(command, 1, 2)
            self.write("cell 1/O9002.nc", HELPER.format(number=9002).replace("#101", "#102"))
            self.shard(command, 2, 2)
            result = self.merge()
            one = self.feedhold(command)
            if result.returncode != 2:  # what changed was in the second shard alone
                self.assertSame(result, one)
            else:
                self.assertIn("changed since", result.stderr)
            self.write("cell 1/O9002.nc", HELPER.format(number=9002))

    # ---- options ----

    def test_shards_that_are_none(self):
        for word in ("0/2", "3/2", "1", "/2", "1/", "a/b", "1/0", "-1/2", "1/2/3", "1 / 2", "1/999999999999", "1.5/2"):
            for command in ("check", "prove"):
                with self.subTest(word=word, command=command):
                    result = self.feedhold(command, f"--shard={word}")
                    self.assertRefused(result, "--shard")

    def test_options_that_do_not_go_together(self):
        rows = [(command, words) for command in ("check", "prove") for words in (
                    ("--baseline", "b.json", "--update-baseline"), ("--changed-since", "HEAD"), ("-",))]
        rows += [("check", ("--fix",)), ("check", ("--diff",)), ("check", ("--watch",)),
                 ("prove", ("--certificate", "proofs")), ("prove", ("--with-callers", "cell 1/O9001.nc"))]
        for command, words in rows:
            for shard in (("--shard", "1/2"), ("--part", self.parts / "a.part")):
                with self.subTest(command=command, words=words, shard=shard):
                    result = self.feedhold(command, *shard, *words)
                    self.assertRefused(result, "cannot be combined")
                    self.assertEqual(list(self.parts.iterdir()), [])

    def test_part_without_shard_is_the_whole(self):
        for command in ("check", "prove"):
            expected = self.feedhold(command)
            self.assertSame(self.feedhold(command, "--part", self.part(1, 1)), expected)
            self.assertSame(self.merge(), expected)

    def test_shard_that_has_nothing_to_do(self):
        for command in ("check", "prove"):
            result = self.feedhold(command, "--shard", "2/2", "alone/O1001.nc")
            self.assertExit(result, 0)

    # ---- writing ----

    def test_no_place_for_a_part(self):
        result = self.check("--shard", "1/2", "--part", "nowhere/a.part")
        self.assertExit(result, 2)
        self.assertIn("nowhere/a.part", result.stderr)

    def test_killed_shards_leave_no_half_part(self):
        """At any moment, the part is the old one, or the new one, or is not there."""
        self.shard("check", 1, 2)
        new = self.part(1, 2).read_bytes()
        self.write("cell 9/O1000.nc", GOOD)
        self.shard("check", 1, 2)
        old = self.part(1, 2).read_bytes()
        (self.folder / "cell 9/O1000.nc").unlink()
        self.assertNotEqual(old, new)
        command = [FEEDHOLD, "check", "--shard", "1/2", "--part", self.part(1, 2)]
        start = time.monotonic()
        subprocess.run(command, cwd=self.folder, capture_output=True, env=self.environment())
        longest = time.monotonic() - start
        pause = random.Random(1)
        for turn in range(40):
            before = old if turn % 2 else None
            self.part(1, 2).write_bytes(old) if before else self.part(1, 2).unlink(missing_ok=True)
            run = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env=self.environment())
            time.sleep(pause.uniform(0, 1.2 * longest))
            run.kill()
            run.wait()
            found = self.part(1, 2).read_bytes() if self.part(1, 2).exists() else None
            self.assertIn(found, (before, new))
        self.shards("check", 2)
        self.assertSame(self.merge(), self.check())

    def test_shards_side_by_side(self):
        expected = self.feedhold("prove")
        runs = [subprocess.Popen([FEEDHOLD, "prove", "--shard", f"{index}/4", "--part", self.part(index, 4)],
                                 cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 env=self.environment()) for index in (1, 2, 3, 4, 1, 3)]
        self.assertTrue({run.wait() for run in runs} <= {0, 1, 2, 3})
        self.assertSame(self.merge(), expected)


if __name__ == "__main__":
    unittest.main()
