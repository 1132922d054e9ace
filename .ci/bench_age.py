#!/usr/bin/env python3
"""Says which benchmarks that the docs quote are stale: code that they measure has changed since they were run.

    bench_age.py [--root FOLDER]

Above each quoted table stands where its numbers come from, as a comment that no reader sees:

    <!-- bench whole-process at 1a2b3c4 -->

with the revision of the code that was measured.  What a benchmark measures stands in MEASURED below.  Ends with 1 when a
table is stale, or has no such comment.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

FRONT_END = ["analyzer/base", "analyzer/language", "dialects"]
CHECK = [*FRONT_END, "analyzer/meaning", "analyzer/inference", "analyzer/findings", "rules"]
PROOF = [*CHECK, "analyzer/proof"]
MEASURED = {
    "engine": [*CHECK, "tests/bench/engine_bench.cpp", "tests/bench/generate.cpp"],
    "whole-process": [*CHECK, "tests/bench/whole_process.py", "tests/bench/generate.cpp"],
    "folder": [*CHECK, "tests/bench/folder_bench.py"],
    "files": [*CHECK, "tests/bench/files_bench.py"],
    "prove": [*PROOF, "corpus/packages", "tests/bench/prove_bench.py"],
    "shards": [*PROOF, "tests/bench/shards_bench.py"],
    "simulation": [*PROOF, "corpus/packages", "tests/bench/simulation_bench.cpp"],
    "lsp": [*CHECK, "analyzer/surface/lsp", "tests/bench/lsp_bench.py"],
}
DOCS = ["docs/benchmarks.md"]

MARK = re.compile(r"<!-- bench ([a-z-]+) at ([0-9a-f]{7,40}) -->")


def git(root, *words):
    return subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True)


def tables_of(text):
    """(line, mark or None) of each table: the mark is the last comment above it, used by one table alone."""
    mark = None
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if found := MARK.fullmatch(line.strip()):
            mark = found
        starts = line.startswith("|") and not inside
        inside = line.startswith("|")
        if starts:
            yield number, mark
            mark = None


def age_of(root, bench, revision):
    """What is wrong with the numbers; None when nothing that they measure has changed."""
    if bench not in MEASURED:
        return f"`{bench}` is no benchmark: {', '.join(MEASURED)}"
    changes = git(root, "rev-list", "--count", f"{revision}..HEAD", "--", *MEASURED[bench])
    if changes.returncode != 0:
        return f"{revision} is no revision of this repository"
    if git(root, "diff", "--quiet", revision, "--", *MEASURED[bench]).returncode == 0:
        return None
    return f"stale: what it measures has changed since {revision} (commits: {int(changes.stdout)})"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root
    stale = 0
    for doc in DOCS:
        for line, mark in tables_of((root / doc).read_text()):
            wrong = age_of(root, *mark.groups()) if mark else "no comment says at which revision it was measured"
            name = f"{mark[1]}: " if mark else ""
            if wrong:
                stale += 1
                print(f"{doc}:{line}: {name}{wrong}")
            else:
                print(f"{doc}:{line}: {name}fresh")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
