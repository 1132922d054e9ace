#!/usr/bin/env python3
"""Measures `feedhold prove` on the programs of corpus/packages: for each obligation, all together, and from the cache.

    prove_bench.py --feedhold PROGRAM [PATHS]

The time of an obligation is its share of the processor time of its program: the ways through a program are followed once
for all of them.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 3
PROVE = ["prove", "--dialect", "fanuc-30i", "--format", "json"]


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(command):
    """(report, seconds of processor time, seconds)"""
    begin, start = time.monotonic(), processor_time()
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if result.returncode not in (0, 1, 3):
        sys.exit(f"{command} ended with {result.returncode}: {result.stderr[-500:].decode()}")
    return json.loads(result.stdout), processor_time() - start, time.monotonic() - begin


def obligations(report):
    return [row for file in report["files"] for row in file["obligations"]]


def at(share, values):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def programs(paths):
    for path in map(Path, paths):
        yield from sorted(path.rglob("*.nc")) if path.is_dir() else [path]


def of_each(feedhold, paths):
    """(milliseconds of each obligation, milliseconds and path of each program), beside the start of a process."""
    with tempfile.TemporaryDirectory() as name:
        empty = Path(name) / "O1.nc"
        empty.write_text("O1\nM30\n")
        base = min(run([feedhold, *PROVE, "--no-cache", empty])[1] for _ in range(5))
    each, whole = [], []
    for path in programs(paths):
        rounds = [run([feedhold, *PROVE, "--no-cache", path]) for _ in range(ROUNDS)]
        spent = 1000 * max(min(processor for _, processor, _ in rounds) - base, 0)
        count = len(obligations(rounds[0][0]))
        each += [spent / count] * count
        whole.append((spent, path))
    return each, whole


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("paths", nargs="*", default=[ROOT / "corpus" / "packages"])
    options = parser.parse_args()
    each, whole = of_each(options.feedhold, options.paths)
    slowest, where = max(whole)
    print(f"obligations: {len(each)}; median {at(0.5, each):.1f} ms, 95 % below {at(0.95, each):.1f} ms, "
          f"largest {max(each):.0f} ms")
    print(f"slowest program: {slowest:.0f} ms, {where.name}")
    with tempfile.TemporaryDirectory() as cache:
        os.environ["XDG_CACHE_HOME"] = cache
        report, processor, seconds = min((run([options.feedhold, *PROVE, "--no-cache", *options.paths])
                                          for _ in range(ROUNDS)), key=lambda each: each[2])
        verdicts = [row["verdict"] for row in obligations(report)]
        counts = ", ".join(f"{verdicts.count(each)} {each}" for each in sorted(set(verdicts)))
        print(f"all together, {os.cpu_count()} processors: {seconds:.2f} s ({processor:.2f} s of processor time); {counts}")
        run([options.feedhold, *PROVE, *options.paths])
        print(f"from the cache: {run([options.feedhold, *PROVE, *options.paths])[2]:.2f} s")
    print(f"largest memory: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MiB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
