#!/usr/bin/env python3
"""Measures how `check` grows with the number of files: four times as many should take four times as long.

    files_bench.py --feedhold PROGRAM [--files N]

A row is a kind of folders with N and with 4 N files: processor time of each, and its growth.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

FILES_IN_FOLDER = 200
FACTOR = 4


def plain(index, folder):
    """Nothing in them tells anything of another: what a rule asks of all files, it has to know without looking."""
    yield f"family {folder}", 1000 + index % FILES_IN_FOLDER, (
        "G90G54G17G40G80\nG00X#24Y#25\nIF[#18NE0]GOTO5\n#110=#18*2\nG01X#110F#9\nN5G00Z50.\nM99")


def missing_calls(index, folder):
    """Calls of programs that folders of other machines have."""
    own, other = folder % 2 * 1000, (folder + 1) % 2 * 1000
    calls = "\n".join(f"G65P{1000 + (index * 7 + i) % FILES_IN_FOLDER + other}A1." for i in range(20))
    yield f"machine {folder % 2}/family {folder}", 1000 + index % FILES_IN_FOLDER + own, (
        f"G90G54G17G40G80\nG00X#24Y#25\n{calls}\nG00Z50.\nM30")


def one_helper(index, _):
    """All in one folder, and all call one program."""
    yield "all", 10000 + index, f"G90G54G17G40G80\nG65P9000A1.B{index}.\nG00Z50.\nM30"
    if index == 0:
        yield "all", 9000, "G01X#1F#2\nM99"


def write(root, kind, count):
    for index in range(count):
        for folder, number, blocks in kind(index, index // FILES_IN_FOLDER):
            place = root / folder
            place.mkdir(parents=True, exist_ok=True)
            (place / f"O{number}.nc").write_text(f"%\nO{number}\n{blocks}\n%\n")


def seconds_of(feedhold, folder):
    before = os.times()
    told = subprocess.run([feedhold, "check", "--jobs", "1", "--dialect", "fanuc-30i", "--statistics", "."], cwd=folder,
                          stdout=subprocess.DEVNULL)
    after = os.times()
    if told.returncode not in (0, 1):
        sys.exit(f"{folder}: exit code {told.returncode}")
    return after.children_user + after.children_system - before.children_user - before.children_system


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--files", type=int, default=2000)
    options = parser.parse_args()
    print(f"| folders of | {options.files} files | {options.files * FACTOR} files | growth |\n|---|---|---|---|", flush=True)
    for kind in (plain, missing_calls, one_helper):
        times = []
        for count in (options.files, options.files * FACTOR):
            with tempfile.TemporaryDirectory() as name:
                write(Path(name), kind, count)
                times.append(seconds_of(options.feedhold, name))
        print(f"| {kind.__name__.replace('_', ' ')} | {times[0]:.1f} s | {times[1]:.1f} s | {times[1] / times[0]:.1f} |", flush=True)


if __name__ == "__main__":
    main()
