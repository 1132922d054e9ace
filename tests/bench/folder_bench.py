#!/usr/bin/env python3
"""Measures `feedhold check` on a folder of probing macros that call one another, and on one of them alone.

    folder_bench.py --feedhold PROGRAM [--macros N]

Every macro has some 60 blocks: guards on its arguments, a loop of touches, a call of a helper, offsets written at the end.
"""
import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MACRO = """O{number}(PROBE POCKET {number})
IF[#24EQ#0]THEN#3000=101(X MISSING)
IF[#9EQ#0]THEN#9=500.
IF[#17LE0]THEN#3000=102(Q MUST BE POSITIVE)
#10=#4003
#11=#4001
#30=0
#31=#24
N10 WHILE[#30LT4]DO1
G90G01X[#31]F#9
G91G31X[#17]F[#9/10]
#[100+#30]=#5061
G90G01X[#31]F#9
IF[#[100+#30]GT[#31+#17]]GOTO900
#31=#31+#17
#30=#30+1
END1
G65P{helper}A[#100]B[#101]C#17
#32=[#102+#103]/2
IF[ABS[#32-#24]GT#19]GOTO901
#5221=#5221+[#32-#24]
N20 #20=SQRT[#24*#24+#32*#32]
IF[#20LT0.001]GOTO30
#21=ATAN[#32]/[#24]
#22=COS[#21]*#20
#23=SIN[#21]*#20
G90G01X#22Y#23
{filler}N30 G#10G#11
M99
N900#3000=103(NO TOUCH)
N901#3000=104(OUT OF TOLERANCE)
"""
HELPER = """O{number}(HELPER {number})
#20=0
WHILE[#20LT5]DO1
#21=#1+[#2-#1]*#20/5
#20=#20+1
END1
#110=#21
M99
"""


def macro(number, helper, fillers):
    filler = "".join(f"#{100 + i % 20}=#{101 + i % 20}*#17+{i}\nG90G01Y[#{100 + i % 20}]F#9\n" for i in range(fillers))
    return MACRO.format(number=number, helper=helper, filler=filler)


def write_folder(folder, macros):
    for i in range(macros):
        number = 1000 + i
        if i % 10 == 9:
            text = HELPER.format(number=number)
        else:
            text = macro(number, 1000 + min(i - i % 10 + 9, macros - 1), 15)
        (folder / f"O{number}.nc").write_text(f"%\n{text}%\n")


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds(command, clock=time.monotonic):
    start = clock()
    result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if result.returncode not in (0, 1):
        sys.exit(f"{command} ended with {result.returncode}: {result.stderr[-500:].decode()}")
    return clock() - start


def median_milliseconds(command):
    """Of processor time: what else the machine does is left out."""
    return 1000 * sorted(seconds(command, processor_time) for _ in range(21))[10]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--feedhold", required=True)
    parser.add_argument("--macros", type=int, default=5000)
    options = parser.parse_args()
    check = [options.feedhold, "check", "--dialect", "fanuc-30i"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for count in (options.macros // 5, options.macros):
            write_folder(folder, count)
            print(f"folder of {count} macros, all processors: {seconds([*check, name]):.2f} s", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "O1000.nc").write_text(f"%\n{macro(1000, 1009, 135)}%\n")
        (folder / "O1009.nc").write_text(f"%\n{HELPER.format(number=1009)}%\n")
        whole = median_milliseconds([*check, name])
        empty = folder / "empty"
        empty.mkdir()
        (empty / "O1.nc").write_text("%\nO1\nM30\n%\n")
        base = median_milliseconds([*check, str(empty)])
        print(f"a probing macro of 300 blocks with its helper: {whole - base:.1f} ms of processor time beside the start of "
              f"the process ({base:.1f} ms)")
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"largest memory of all these runs: {peak:.0f} MiB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
