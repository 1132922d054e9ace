"""One run of this machine with `feedhold run`, or with another machine that tells the same summary."""
from dataclasses import dataclass
from fractions import Fraction as F

CLOSE = 1.2e-3  # words are rounded to the least increment


@dataclass
class Summary:
    end: str  # return end stop alarm endless fuel
    line: object = None  # of a stop or an alarm
    file: str = ""
    number: object = None
    variables: dict = None
    moves: list = None  # (x, y, z) of each movement with a distance


def of_run(run) -> Summary:
    variables = {n: v for n, v in run.cells.items() if n < 1000}
    if run.end == "return":
        variables.update(run.frames[0].locals)
    moves = []
    for stroke in run.tool.strokes:
        if stroke.points[0] != stroke.points[-1] or len(stroke.points) > 2:
            moves.append(tuple(float(c) for c in stroke.work))
    return Summary(run.end, run.line, run.where.text.file if run.where else "", run.detail, variables, moves)


def is_apart(a, b):
    """By more than doubles round where a zero point is subtracted and added again."""
    return any(abs(a[axis] - b[axis]) > 1e-9 * (1 + abs(a[axis])) for axis in a)


def of_engine(answer) -> Summary:
    alarm = answer["alarm"] or {}
    end = {"M99": "return", "M30": "end", "M02": "end"}.get(answer["end"], answer["end"])
    if end == "alarm" and alarm.get("by") != "program":
        end = "stop"
    moves = [tuple(m["to"][axis] for axis in "XYZ") for m in answer["moves"]
             if m["kind"] not in ("dwell", "probe") and (is_apart(m["from"], m["to"]) or m["kind"].startswith("arc"))]
    return Summary(end, alarm.get("line"), alarm.get("file", ""), alarm.get("number"),
                   {int(n): v for n, v in answer["variables"].items() if n.isdigit() and int(n) < 1000}, moves)


def unlike(a: Summary, b: Summary):
    """What differs, or None."""
    if {a.end, b.end} <= {"endless", "fuel"}:
        return None
    if a.end != b.end:
        return f"one ends by {a.end} {a.number or ''} at line {a.line}, the other by {b.end} {b.number or ''} at line {b.line}"
    if a.end in ("stop", "alarm") and (a.line != b.line or not (a.file.endswith(b.file) or b.file.endswith(a.file))):
        return f"one stops at line {a.line} of {a.file}, the other at line {b.line} of {b.file}"
    for number in sorted(set(a.variables) | set(b.variables)):
        mine, theirs = a.variables.get(number), b.variables.get(number)
        if number < 34 and a.end != "return":
            continue
        if (mine is None) != (theirs is None) or mine is not None and abs(float(mine) - float(theirs)) > 1e-9 * (1 + abs(float(mine))):
            return f"#{number} is {show(mine)} in one and {show(theirs)} in the other"
    one, other = levels(a.moves), levels(b.moves)
    if len(one) != len(other):
        return f"one moves {len(one)} times, the other {len(other)} times"
    for mine, theirs in zip(one, other):
        if any(abs(p - q) > CLOSE for p, q in zip(mine, theirs)):
            return f"a movement ends at {mine} in one and at {theirs} in the other"
    return None


def levels(moves: list) -> list:
    """Up and down at one place count as one: how a drill pecks is a parameter's matter."""
    found = []
    for x, y, z in moves:
        if found and abs(found[-1][0] - x) < CLOSE and abs(found[-1][1] - y) < CLOSE:
            found[-1] = x, y, z, min(z, found[-1][3])
        else:
            found.append((x, y, z, z))
    return found


def show(value):
    return str(value) if value is None or isinstance(value, F) else f"{value:.9g}"
