#!/usr/bin/env python3
"""Measures whole runs of `feedhold check` on generated programs, and other tools on the same files.

    whole_process.py --feedhold PROGRAM --generate PROGRAM [--npm NODE_MODULES] [--lines N,N,..] [--json FILE]

A row is one tool on one file: processor time (the median of five runs where one is short), lines and megabytes a second,
peak memory and how many times the size of the file that is.  Where a tool has no row it was not there.  The last lines
say whether time grows linearly from the smallest to the largest file, the start of the process left out.
"""
import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = ("plain", "macro", "plain-long", "macro-long")
# Time a line on the largest file over time a line on the smallest one that runs long enough to be measured: the aim is
# 1.1, the rest is for other work on the machine.
LINEAR = 1.3
SHORTEST_MEASURED = 0.04
REPEATED_BELOW = 0.5
# The other tools are slower: they get no larger files.
MOST_LINES_OF_OTHERS = 1_000_000
MOST_MACRO_LINES = 1_000_000

# Processor time after which a run is stopped.
LONGEST = 300

NODE_PARSER = "console.log(require(process.argv[1] + '/gcode-parser').parseFileSync(process.argv[2]).length)"


def limit_processor_time():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))


def measure(command, accepted, cwd=None, env=None):
    """(seconds of processor time, peak MiB) of one run; an error when it fails."""
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, stdin=subprocess.DEVNULL,
                                   cwd=cwd, env=env, preexec_fn=limit_processor_time)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in accepted:
            errors.seek(0)
            raise RuntimeError(f"{command[0]} ended with {process.returncode}: {errors.read()[-500:].decode()}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def median(run, path):
    """Of five runs where one is short."""
    runs = [run(path)]
    if runs[0][0] < REPEATED_BELOW:
        runs += [run(path) for _ in range(4)]
    return sorted(runs)[len(runs) // 2]


def run_feedhold(options, path):
    return measure([options.feedhold, "check", "--isolated", "--dialect", "fanuc-30i", "--jobs", "1", str(path)], (0, 1))


def run_rs274(path):
    """LinuxCNC's interpreter: the same blocks without the O word, one tool in the table, a home of its own."""
    with tempfile.TemporaryDirectory() as home:
        folder = Path(home)
        blocks = path.read_bytes().split(b"\n")
        (folder / "program.ngc").write_bytes(b"\n".join(line for line in blocks if not line.startswith(b"O")))
        (folder / "tools.tbl").write_text("T1 P1 D6.0 Z10\n")
        command = ["rs274", "-g", "-t", "tools.tbl", "-v", "variables.txt", "program.ngc", "canon.txt"]
        return measure(command, (0,), cwd=home, env={**os.environ, "HOME": home})


def run_gcode_parser(npm, path):
    return measure(["node", "--max-old-space-size=8192", "-e", NODE_PARSER, npm, str(path)], (0,))


def tools_for(kind, lines, options):
    yield "feedhold check", lambda path: run_feedhold(options, path)
    if lines > MOST_LINES_OF_OTHERS:
        return
    if shutil.which("rs274") and kind == "plain-long":  # it knows one program a file, and no macro statements
        yield "rs274", run_rs274
    if options.npm and shutil.which("node") and (Path(options.npm) / "gcode-parser").is_dir():
        yield "gcode-parser", lambda path: run_gcode_parser(str(Path(options.npm).resolve()), path)


def row_of(tool, kind, path, run):
    text_lines, size = path.read_bytes().count(b"\n"), path.stat().st_size
    row = {"tool": tool, "input": kind, "lines": text_lines}
    try:
        seconds, peak = median(run, path)
    except (RuntimeError, OSError) as error:
        return {**row, "error": str(error)}
    return {**row, "seconds": round(seconds, 3), "lines_per_second": round(text_lines / seconds),
            "megabytes_per_second": round(size / seconds / 1e6, 1), "peak_mib": round(peak),
            "peak_over_size": round(peak * 1048576 / size, 1)}


def show(row):
    head = f"{row['tool']:<15} {row['input']:<11} {row['lines']:>9}"
    if "error" in row:
        return f"{head}  failed: {row['error']}"
    return (f"{head} {row['seconds']:>9.3f} s {row['lines_per_second']:>10} lines/s "
            f"{row['megabytes_per_second']:>7.1f} MB/s {row['peak_mib']:>6} MiB {row['peak_over_size']:>6} of the size")


def growth(rows, tool, kind, start):
    """Time a line on the largest file over that on the smallest measured one; None with fewer than two.  `start`: of the
    process, in seconds."""
    measured = [row for row in rows if row["tool"] == tool and row["input"] == kind and "error" not in row
                and row["seconds"] - start >= SHORTEST_MEASURED]
    if len(measured) < 2:
        return None
    smallest, largest = ((row["seconds"] - start) / row["lines"] for row in (measured[0], measured[-1]))
    return largest / smallest


def start_of_process(folder, options):
    path = Path(folder) / "empty.nc"
    path.write_text("%\nO1\nM30\n%\n")
    return median(lambda file: run_feedhold(options, file), path)[0]


def sizes_of(kind, options):
    for lines in (int(word) for word in options.lines.split(",")):
        if kind.startswith("plain") or lines <= MOST_MACRO_LINES:
            yield lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--generate", required=True)
    parser.add_argument("--npm")
    parser.add_argument("--lines", default="50000,500000,5000000")
    parser.add_argument("--json")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        start = start_of_process(folder, options)
        for kind in KINDS:
            for lines in sizes_of(kind, options):
                path = Path(folder) / f"{kind}-{lines}.nc"
                with path.open("wb") as stream:
                    subprocess.run([options.generate, kind, str(lines)], stdout=stream, check=True)
                for tool, run in tools_for(kind, lines, options):
                    rows.append(row_of(tool, kind, path, run))
                    print(show(rows[-1]), flush=True)
                path.unlink()
    if options.json:
        Path(options.json).write_text(json.dumps(rows, indent=2) + "\n")
    failed = any("error" in row for row in rows if row["tool"] == "feedhold check")
    for kind in KINDS:
        factor = growth(rows, "feedhold check", kind, start)
        if factor is not None:
            print(f"growth of time a line, {kind}: {factor:.2f} (linear: below {LINEAR})")
            failed = failed or factor >= LINEAR
    return 1 if failed or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
