#!/usr/bin/env python3
"""Measures how the time of `feedhold prove` grows with a program: loops, branches, calls, cells of a table.

    growth_bench.py --feedhold PROGRAM [--sizes N,N,..]

A row is one kind of program at one size: processor time, and how many obligations are answered.  The last column is the
exponent of the growth since the size before: 1 is linear, 2 quadratic.
"""
import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

PROVE = ["prove", "--isolated", "--no-cache", "--dialect", "fanuc-30i", "--format", "json"]
SHORTEST_MEASURED = 0.02


def loops(size):
    """One after the other, each with a counter of its own."""
    yield "O9000"
    yield "(@PARAM #1 COUNT 1..20 INT)"
    for i in range(size):
        counter = 500 + i
        yield f"#{counter}=0"
        yield f"WHILE[#{counter}LT#1]DO1"
        yield f"G01X#{counter}F100"
        yield f"#{counter}=#{counter}+1"
        yield "END1"
    yield "M99"


def branches(size):
    """Each doubles the paths, and the alarm at the end depends on the first."""
    yield "O9000"
    yield "(@PARAM #1 FIRST 0..1 INT)"
    for i in range(size):
        yield f"IF[#{500 + i}EQ1]GOTO{10 + i}"
        yield f"G01X{i}.F100"
        yield f"N{10 + i}#{100 + i}=#1"
    yield f"IF[#{100 + size - 1}GT1]GOTO9000"
    yield "M99"
    yield "N9000#3000=1(FIRST)"


def calls(size):
    """Of one macro that guards its argument."""
    yield "O9000"
    for i in range(size):
        yield f"G65P9001A{1 + i % 9}."
    yield "M99"
    yield "O9001"
    yield "IF[#1EQ#0]GOTO90"
    yield "IF[#1LE0]GOTO90"
    yield "G01X[10./#1]F100"
    yield "M99"
    yield "N90#3000=1(A)"


def cells(size):
    """A table that is written cell by cell and read by a computed number."""
    yield "O9000"
    yield f"(@PARAM #1 INDEX 0..{size - 1} INT)"
    for i in range(size):
        yield f"#{500 + i}={i + 1}."
    yield "G01X[10./#[500+#1]]F100"
    yield "M99"


KINDS = {"loops": loops, "branches": branches, "calls": calls, "cells": cells}


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def prove(feedhold, path):
    """(seconds, obligations, those without an answer)"""
    start = processor_time()
    result = subprocess.run([feedhold, *PROVE, str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    seconds = processor_time() - start
    if result.returncode not in (0, 1, 3):
        sys.exit(f"{path.name} ended with {result.returncode}: {result.stderr[-500:].decode()}")
    rows = [row for file in json.loads(result.stdout)["files"] for row in file["obligations"]]
    return seconds, len(rows), sum(row["verdict"] == "unknown" for row in rows)


def exponent(before, now):
    (small, fast), (large, slow) = before, now
    if fast < SHORTEST_MEASURED:
        return ""
    return f"{math.log(slow / fast) / math.log(large / small):.1f}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--sizes", default="5,10,20,40,80")
    options = parser.parse_args()
    print("| program | size | time | obligations | unknown | growth |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "O9000.nc"
        for name, lines in KINDS.items():
            before = None
            for size in (int(word) for word in options.sizes.split(",")):
                path.write_text("%\n" + "\n".join(lines(size)) + "\n%\n")
                seconds, rows, unknown = prove(options.feedhold, path)
                growth = exponent(before, (size, seconds)) if before else ""
                print(f"| {name} | {size} | {seconds:.2f} s | {rows} | {unknown} | {growth} |", flush=True)
                before = (size, seconds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
