#!/usr/bin/env python3
"""Measures the language server: from a keystroke to its diagnostics, and memory over many edits.

    lsp_bench.py --feedhold PROGRAM [--blocks N] [--edits N]

The program is a macro of loops, branches and calls.  An edit types or takes back one sign in the middle; the time is that
from writing the notification to having read the diagnostics of its version.  Flow findings and proofs come later and are
not in it; the server works on the former meanwhile, as it does under a person's hands.
"""
import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

P99_LIMIT_MS = 20
GROWTH_LIMIT = 1.25  # of memory, from a tenth of the edits to their end


def macro(blocks):
    lines = ["%", "O9000(BENCH)", "G17 G21 G40 G49 G80 G90 G94"]
    number = 0
    while len(lines) < blocks - 3:
        number += 1
        lines += [f"N{number}0 #{100 + number % 50}=#1*2+[#2/3]", f"IF[#{100 + number % 50}GT10.]GOTO {number + 1}0",
                  f"#{500 + number % 20}=#{100 + number % 50}+1.", f"WHILE[#1LT{number % 7}]DO1", "G01 X#1 Y[#2+1.] F200.",
                  "#1=#1+1", "END1", "G65 P9010 A1. B#1"]
    return "\n".join([*lines, f"N{number + 1}0 G00 Z50.", "M99", "%", ""])


def resident_kib(process):
    for line in Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1])
    raise RuntimeError("no VmRSS")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--blocks", type=int, default=2000)
    parser.add_argument("--edits", type=int, default=10_000)
    parser.add_argument("--pause", type=float, default=0.0, help="seconds between two keystrokes of the first hundred")
    options = parser.parse_args()
    os.environ["FEEDHOLD"] = str(Path(options.feedhold).resolve())
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lsp"))
    from client import Client
    text = macro(options.blocks)
    line = text.count("\n") // 2
    times, memory = [], []
    with tempfile.TemporaryDirectory() as folder:
        client = Client(folder, options={"proofs": "off"})
        start = time.monotonic()
        uri = client.open("bench.nc", text)
        client.diagnostics(uri, 1)
        print(f"{text.count(chr(10))} blocks; opened, first diagnostics: {(time.monotonic() - start) * 1e3:.1f} ms")
        for version in range(2, options.edits + 2):
            begin, end = {"line": line, "character": 0}, {"line": line, "character": version % 2}
            start = time.monotonic()
            client.change(uri, version, {"range": {"start": begin, "end": end}, "text": "" if version % 2 else " "})
            client.diagnostics(uri, version)
            times.append((time.monotonic() - start) * 1e3)
            client.kept.clear()
            if version <= 102:
                time.sleep(options.pause)
            if version % (options.edits // 10) == 0:
                memory.append(resident_kib(client.process))
        client.close()
    times.sort()
    p50, p99 = times[len(times) // 2], times[len(times) * 99 // 100]
    print(f"keystroke to diagnostics, {len(times)} edits: p50 {p50:.2f} ms, p99 {p99:.2f} ms, most {times[-1]:.2f} ms")
    print("memory, MiB:", " ".join(f"{kib / 1024:.1f}" for kib in memory))
    return 0 if p99 < P99_LIMIT_MS and memory[-1] < GROWTH_LIMIT * memory[0] else 1


if __name__ == "__main__":
    sys.exit(main())
