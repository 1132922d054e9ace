#!/usr/bin/env python3
"""Measures what shards cost: `check` of the macros of a group of plants, `prove` of a sample of them.

    shards_bench.py --feedhold PROGRAM [--folders N] [--proved N] [--shards N,N,..]

A folder is a family of parts: main programs, macros of features, probing and shared subprograms, which call one another,
some of them with contracts; 200 files of 5 to 150 lines.  The shards run one after the other, each alone, with one
thread.  A row is a number of shards: processor time and memory of the dearest, all of them together relative to one run,
the dearest relative to the average, and the merge.  Merged output is compared with that of one run.
"""
import argparse
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FILES_IN_FOLDER = 200
FILES_IN_SAMPLE = 20
SEED = 7


def main_program(number, features, chance):
    yield f"O{number}(PART {number})"
    yield "G90G54G17G40G80"
    for tool in range(1, chance.randint(2, 8)):
        yield f"T{tool}M06"
        yield f"S{chance.randrange(800, 9000, 50)}M03"
        for _ in range(chance.randint(1, 4)):
            x, y = chance.randint(-200, 200), chance.randint(-100, 100)
            yield f"G00X{x}.Y{y}."
            depth = chance.randint(2, 40)
            yield f"G65P{chance.choice(features)}A{depth}.B{chance.randint(1, 4)}.C{chance.randint(100, 900)}.X{x}.Y{y}."
        yield "G00Z100."
    yield "M30"


def feature(number, helper, lines, chance):
    """Steps down to a depth; alarms for what it cannot do."""
    yield f"O{number}(FEATURE {number})"
    yield "IF[#1EQ#0]THEN#3000=101(A MISSING)"
    yield "IF[#2LE0]GOTO901"
    yield "#10=FUP[#1/#2]"
    yield "#11=#1/#10"
    yield "WHILE[#10GT0]DO1"
    yield "G91G01Z-#11F#3"
    for i in range(lines):
        yield f"G01X{chance.randint(1, 50)}.{chance.randint(0, 9)}Y-{chance.randint(1, 50)}.F[#3*2]"
        if i % 7 == 3:
            yield f"#{100 + i % 30}=#11*{chance.randint(2, 9)}+#{101 + i % 30}"
    yield "#10=#10-1"
    yield "END1"
    yield f"G65P{helper}A#1Z[#1+2.]"
    yield "G90"
    yield "M99"
    yield "N901#3000=102(B MUST BE POSITIVE)"


def probe(number, helper, lines, chance):
    yield f"O{number}(PROBE {number})"
    yield "IF[#24EQ#0]THEN#3000=111(X MISSING)"
    yield "IF[#9EQ#0]THEN#9=500."
    yield "#30=0"
    yield "WHILE[#30LT4]DO1"
    yield "G90G01X[#24+#30]F#9"
    yield f"G91G31Z-{chance.randint(5, 20)}.F[#9/10]"
    yield "#[100+#30]=#5063"
    yield "G90G00Z50."
    yield "#30=#30+1"
    yield "END1"
    for i in range(lines):
        yield f"#{120 + i % 20}=[#{100 + i % 4}-#{101 + i % 4}]/{chance.randint(2, 9)}"
    yield "IF[ABS[#100-#101]GT#19]GOTO901"
    yield f"G65P{helper}A#100Z#103"
    yield "M99"
    yield "N901#3000=112(OUT OF TOLERANCE)"


def helper(number, lines, chance):
    yield f"O{number}(SHARED {number})"
    yield "#20=0"
    yield f"WHILE[#20LT{chance.randint(3, 9)}]DO1"
    yield "#21=#1+[#26-#1]*#20/5"
    yield "#20=#20+1"
    yield "END1"
    for i in range(lines):
        yield f"#{130 + i % 10}=#21*{chance.randint(1, 9)}."
    yield "M99"


CONTRACTS = {"feature": "@PARAM #1 DEPTH 0.5..60.\n@PARAM #2 STEP 0.1..20.\n@PARAM #3 FEED 1..2000\n",
             "probe": "@PARAM #24 X -500..500.\n@PARAM #19 TOLERANCE 0.01..1.\n@PARAM #9 FEED 10..2000\n"}


def write_family(folder, files, chance):
    """A fifth main programs, half features, a fifth probing, the rest shared; most call within a group of twenty."""
    folder.mkdir(parents=True)
    for start in range(0, files, 20):
        shared = [9000 + start + i for i in range(18, 20)]
        features = [9000 + start + i for i in range(4, 14)]
        for i in range(20):
            size = min(130, int(chance.paretovariate(1.1) * 5))
            number = (1000 if i < 4 else 9000) + start + i
            if i < 4:
                kind, lines = "main", main_program(number, features, chance)
            elif i < 14:
                kind, lines = "feature", feature(number, chance.choice(shared), size, chance)
            elif i < 18:
                kind, lines = "probe", probe(number, chance.choice(shared), size, chance)
            else:
                kind, lines = "shared", helper(number, size, chance)
            (folder / f"O{number}.nc").write_text("%\n" + "\n".join(lines) + "\n%\n")
            if kind in CONTRACTS and chance.random() < 0.3:
                (folder / f"O{number}.contract").write_text(CONTRACTS[kind])


def write_plants(root, folders, files=FILES_IN_FOLDER):
    chance = random.Random(SEED)
    for i in range(folders):
        write_family(root / f"plant {i % 5 + 1}/family {i:03}", files, chance)


class Run:
    def __init__(self, command, cwd, output):
        """One process alone: `seconds` of its processor, `peak` of memory in MiB."""
        start = time.monotonic()
        with open(output, "wb") as out:
            process = subprocess.Popen(command, cwd=cwd, stdout=out, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
            _, status, used = os.wait4(process.pid, 0)
        self.clock = time.monotonic() - start
        code = status >> 8
        if code not in (0, 1, 3) or status & 0x7F:
            sys.exit(f"{command} ended with status {status}")
        self.seconds = used.ru_utime + used.ru_stime
        self.peak = used.ru_maxrss / 1024
        self.output = Path(output)


class Bench:
    def __init__(self, feedhold, command, root, holder):
        self.base = [feedhold, command, "--jobs", "1", "--dialect", "fanuc-30i"]
        if command == "prove":
            self.base.append("--no-cache")
        self.feedhold, self.command, self.root, self.holder = feedhold, command, root, Path(holder)
        self.one = Run(self.base, root, self.holder / "one")
        print(f"| `{command}`, one run | {self.one.seconds:.1f} s | {self.one.peak:.0f} MiB | | | |", flush=True)

    def shards(self, count, costs=None):
        """Returns the folder with the parts."""
        parts = self.holder / f"{self.command} {count} {'with' if costs else 'without'} costs"
        parts.mkdir()
        options = ["--costs", costs] if costs else []
        runs = [Run([*self.base, "--shard", f"{index}/{count}", "--part", parts / f"{index}.part", *options], self.root,
                    self.holder / "shard") for index in range(1, count + 1)]
        merge = Run([self.feedhold, "merge", parts], self.root, self.holder / "merged")
        if merge.output.read_bytes() != self.one.output.read_bytes():
            sys.exit(f"{count} shards of {self.command}: the merged output differs from that of one run")
        times = [run.seconds for run in runs]
        dearest = max(times)
        size = sum(path.stat().st_size for path in parts.iterdir()) / (1 << 20)
        print(f"| `{self.command}`, {count} shard{'s' if count > 1 else ''}{', --costs' if costs else ''} | {dearest:.1f} s | "
              f"{max(run.peak for run in runs):.0f} MiB | {sum(times) / self.one.seconds:.2f} | "
              f"{dearest * count / sum(times):.2f} | {merge.seconds:.1f} s, {merge.peak:.0f} MiB, {size:.1f} MiB |", flush=True)
        return parts


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--folders", type=int, default=250, help="of 200 macros each, for `check`")
    parser.add_argument("--proved", type=int, default=50, help="folders of 20 macros each, for `prove`")
    parser.add_argument("--shards", default="1,2,4,8")
    options = parser.parse_args()
    counts = [int(word) for word in options.shards.split(",")]
    with tempfile.TemporaryDirectory() as name:
        holder = Path(name)
        print("| | dearest shard | its memory | all shards / one run | dearest / average | merge: time, memory, parts |")
        print("|---|---|---|---|---|---|", flush=True)
        for command, folders in (("check", options.folders), ("prove", options.proved)):
            if folders == 0:
                continue
            root = holder / f"plants of {command}"
            write_plants(root, folders, FILES_IN_FOLDER if command == "check" else FILES_IN_SAMPLE)
            bench = Bench(options.feedhold, command, root, holder)
            for count in counts:
                parts = bench.shards(count)
                if command == "prove" and count > 1:
                    bench.shards(count, parts)
    return 0


if __name__ == "__main__":
    sys.exit(main())
