#!/usr/bin/env python3
"""Measures the language server: from a keystroke to its diagnostics, memory over many edits, and the answers to requests.

    lsp_bench.py --feedhold PROGRAM [--blocks N] [--edits N] [--requests N]

The program is a macro of loops, branches and calls.  An edit types or takes back one sign in the middle; the time is that
from writing the notification to having read the diagnostics of its version.  Flow findings and proofs come later and are
not in it; the server works on the former meanwhile, as it does under a person's hands.

Requests come from all over the program.  "First" is the one that follows an edit, when nothing of the text has been asked yet.
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


def quantiles(times):
    times = sorted(times)
    return f"p50 {times[len(times) // 2]:.2f} ms, p99 {times[len(times) * 99 // 100]:.2f} ms, most {times[-1]:.2f} ms"


class Requests:
    """Asks a server for features of one document."""

    def __init__(self, client, uri, text, version):
        self.client, self.uri, self.version = client, uri, version
        self.lines = text.split("\n")

    def edit(self):
        self.version += 1
        begin, end = ({"line": len(self.lines) // 2, "character": n} for n in (0, self.version % 2))
        self.client.change(self.uri, self.version, {"range": {"start": begin, "end": end},
                                                    "text": "" if self.version % 2 else " "})
        self.client.diagnostics(self.uri, self.version)

    def ask(self, method, line, **more):
        start = time.monotonic()
        answer = self.client.request("textDocument/" + method, {"textDocument": {"uri": self.uri}, **more})
        took = (time.monotonic() - start) * 1e3
        self.client.kept.clear()
        if answer is None:
            raise RuntimeError(f"{method} in line {line} is answered with nothing")
        return took

    def at(self, method, line, sign):
        character = self.lines[line].index(sign) + 1
        return self.ask(method, line, position={"line": line, "character": character})

    def hints(self, line):
        return self.ask("inlayHint", line, range={"start": {"line": line, "character": 0},
                                                  "end": {"line": line + 60, "character": 0}})

    def hints_of_the_flow(self, line):
        """With those that come when the flow of the text has been followed, and the client is told to ask again."""
        start = time.monotonic()
        self.hints(line)
        self.client.wait(lambda m: m.get("method") == "workspace/inlayHint/refresh")
        self.hints(line)
        return (time.monotonic() - start) * 1e3

    def measure_flow(self, line, edits):
        times = []
        for _ in range(edits):
            self.edit()
            times.append(self.hints_of_the_flow(line))
        print(f"hints with G90 and G91, from the edit: {quantiles(times)}")

    def measure(self, name, ask, places, edits):
        """`edits` times the first answer for a text, then at each of the places for the same text."""
        first = []
        for i in range(edits):
            self.edit()
            first.append(ask(places[i * len(places) // edits]))
        print(f"{name}: first {quantiles(first)}; then {quantiles([ask(place) for place in places])}")


def measure_requests(client, uri, text, version, count):
    requests = Requests(client, uri, text, version)
    every = max(1, len(requests.lines) // count)
    # Not the line that is edited, whose characters move.
    variables = [i for i, line in enumerate(requests.lines) if line.endswith("=#1+1")][::max(1, every // 8)]
    edits = max(1, count // 10)
    requests.measure("hover", lambda line: requests.at("hover", line, "#"), variables, edits)
    requests.measure("hints of 60 lines", requests.hints, range(0, len(requests.lines), every), edits)
    requests.measure_flow(len(requests.lines) // 2, edits)
    requests.measure("completion", lambda line: requests.at("completion", line, "#"), variables, edits)


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
    parser.add_argument("--requests", type=int, default=200, help="of each kind")
    parser.add_argument("--pause", type=float, default=0.0, help="seconds between two keystrokes of the first hundred")
    options = parser.parse_args()
    os.environ["FEEDHOLD"] = str(Path(options.feedhold).resolve())
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lsp"))
    from client import Client
    text = macro(options.blocks)
    line = text.count("\n") // 2
    times, memory = [], []
    with tempfile.TemporaryDirectory() as folder:
        client = Client(folder, options={"proofs": "off"},
                        capabilities={"workspace": {"inlayHint": {"refreshSupport": True}}})
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
        measure_requests(client, uri, text, options.edits + 1, options.requests)
        print(f"memory after them: {resident_kib(client.process) / 1024:.1f} MiB")
        client.close()
    p99 = sorted(times)[len(times) * 99 // 100]
    print(f"keystroke to diagnostics, {len(times)} edits: {quantiles(times)}")
    print("memory, MiB:", " ".join(f"{kib / 1024:.1f}" for kib in memory))
    return 0 if p99 < P99_LIMIT_MS and memory[-1] < GROWTH_LIMIT * memory[0] else 1


if __name__ == "__main__":
    sys.exit(main())
