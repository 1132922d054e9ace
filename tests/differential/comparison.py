"""The tool path of one program by the interpreter of LinuxCNC and by `feedhold run`, side by side."""
import json
import math
import os
import subprocess

from interpreter import AXES, Run

FEEDHOLD = os.environ["FEEDHOLD"]
TOLERANCE = 1e-6
LONGEST_RUN = 60
STANDING = 1e-12  # a straight movement that is shorter is none
STRAIGHT = ("rapid", "feed")
INCHES = {"inch": 1, "mm": 1 / 25.4}
ROTARY = "ABC"
ENDED = ("M02", "M30", "M99", "end-of-file")


def report_of(path, *options, dialect="linuxcnc"):
    result = subprocess.run([FEEDHOLD, "run", str(path), "--dialect", dialect, "--isolated", "--format", "json", *options],
                            capture_output=True, text=True, timeout=LONGEST_RUN)
    if result.returncode not in (0, 1):
        raise AssertionError(f"{path}: ended with {result.returncode}:\n{result.stderr}")
    return json.loads(result.stdout)


def moves_of_tool(report):
    """Under cutter compensation the moves of the tool's centre in place of the programmed ones."""
    return [{**move, **step} for move in report["moves"] for step in move.get("toolPath", [{}])]


def counts(move):
    """What a machine sees: not a movement to where it stands, a dwell of no time, or the tool pulled out by hand."""
    if move["kind"] == "dwell":
        return bool(move["time"])
    stands = all(abs(move["to"][axis] - move["from"][axis]) < STANDING for axis in move["to"])
    return move["kind"] != "unmodelled" and not (move["kind"] in STRAIGHT and stands)


def canonical(move):
    """A move of ours in the words and units of `interpreter.Canon`."""
    if move["kind"] == "dwell":
        return ("dwell", move["time"])
    scale = INCHES[move["units"]]
    point = {axis: value * (1 if axis in ROTARY else scale) for axis, value in move["to"].items()}
    if not move["kind"].startswith("arc"):
        return (move["kind"], point)
    centre = {axis: value * scale for axis, value in move["centre"].items()}
    return ("arc", point, centre, -move["turns"] if move["kind"] == "arc-clockwise" else move["turns"])


def near(first, second):
    return math.isclose(first, second, rel_tol=1e-14, abs_tol=TOLERANCE)


def same(first, second):
    if first[0] != second[0]:
        return False
    if first[0] == "dwell":
        return near(first[1], second[1])
    if not all(near(first[1].get(axis, 0), second[1].get(axis, 0)) for axis in AXES):
        return False
    if first[0] != "arc":
        return True
    return first[2].keys() == second[2].keys() and first[3] == second[3] and \
        all(near(first[2][axis], second[2][axis]) for axis in first[2])


class Comparison:
    """`difference`: in words; empty where both machines do the same.  `stopped`: why both stopped; empty at an end."""

    def __init__(self, path, theirs):
        report = report_of(path)
        moves = [move for index, move in enumerate(moves_of_tool(report)) if index == 0 or counts(move)]
        self.moves = len(theirs.moves)
        self.stopped = theirs.error
        self.difference = self.first_difference(theirs, moves, report)

    def first_difference(self, theirs, moves, report):
        for index, (expected, move) in enumerate(zip(theirs.moves, moves)):
            actual = canonical(move)
            if not same(expected, actual):
                return f"move {index}, line {move['line']}: expected {shown(expected)}, was {shown(actual)}"
        ended = f"{report['end']} {report['alarm'] or ''} in line {report['place']['line']}"
        if len(theirs.moves) != len(moves):
            return f"{len(theirs.moves)} moves expected, were {len(moves)}; expected {theirs.error or 'an end'}, was {ended}"
        if bool(theirs.error) == (report["end"] in ENDED):
            return f"expected {theirs.error or 'an end'}, was {ended}"
        return ""


def shown(move):
    return " ".join(str({axis: value for axis, value in part.items() if value} if isinstance(part, dict) else part)
                    for part in move)
