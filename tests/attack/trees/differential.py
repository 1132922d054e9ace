"""The two machines, this one and `feedhold run`, on the same program and inputs."""
import random
from fractions import Fraction

from . import contracts
from . import controls
from .choices import Choices
from .files import file_of, line_of, run_arguments
from .machine import Machine
from .witnesses import all_choices

ENDS = {"return": "M99", "M30": "M30", "alarm": "alarm", "user-alarm": "alarm", "endless": "endless", "fuel": "fuel"}
WORD = Fraction(11, 10000)  # what `run` may round of a word
FUEL = 1500


def is_comparable(program, inputs) -> bool:
    """The command begins with the codes of power-on or of the contract, and throws the switch once."""
    said = {controls.GROUP_OF[c]: c for clause in program.clauses if isinstance(clause, contracts.Modal)
            for c in clause.codes}
    return inputs.skip is not None and all(said.get(g, controls.POWER_ON[g]) == c for g, c in inputs.modes.items())


def difference(project, folder, program, inputs, engine, counts):
    """What differs under every choice that is left open; None when the two agree under one."""
    answer = engine.run(run_arguments(project, folder, program.number, inputs) + ["--fuel", str(FUEL)])
    if answer["end"] == "unmodelled" or answer["notes"]:
        counts["runs that `feedhold run` does not follow"] += 1
        return None
    asked, tried, first = {}, [], None
    while True:
        rest = [c for c in all_choices(asked) if c not in tried]
        if not rest:
            return first
        tried.append(rest[0])
        outcome = Machine(project, inputs, Choices(given=rest[0]), FUEL, random=random.Random(0)).run(program)
        if outcome.end == "unmodelled":
            return None
        asked.update(outcome.choices)
        counts["runs on both machines"] += 1
        why = compare(project, program, outcome, answer)
        if why is None or outcome.rounds:
            return None
        first = first or (why, outcome)


def compare(project, program, outcome, answer):
    if {outcome.end, answer["end"]} <= {"endless", "fuel"}:
        return None
    if ENDS[outcome.end] != answer["end"]:
        return f"one ends by {outcome.end} {outcome.alarm or outcome.reason}, the other by {answer['end']} " \
               f"{(answer['alarm'] or {}).get('number', '')} {(answer['alarm'] or {}).get('message', '')}"
    if answer["end"] == "alarm":
        alarm = answer["alarm"]
        line = line_of(project, outcome.activation.program.number, outcome.block)
        name = file_of(project, outcome.activation.program.number).name
        if alarm["line"] != line or not alarm["file"].endswith(name):
            return f"one stops at line {line}, the other at line {alarm['line']}"
        if (alarm["by"] == "program") != (outcome.end == "user-alarm"):
            return f"one stops by {outcome.end}, the other by {alarm['by']}"
    return variables(outcome, answer) or moves(outcome, answer)


def variables(outcome, answer):
    ours = {n: v for n, v in outcome.cells.items() if controls.is_common(n)}
    if outcome.end == "return":
        ours.update(outcome.locals)
    for number, value in ours.items():
        theirs = answer["variables"].get(str(number))
        if (value is None) != (theirs is None) or value is not None and abs(float(value) - theirs) > 1e-9:
            return f"#{number} is {value} in one and {theirs} in the other"
    return None


def moves(outcome, answer):
    theirs = [m for m in answer["moves"] if m["kind"] in ("rapid", "feed") and m["from"] != m["to"]]
    ours = [m for m in outcome.moves if m.start != m.end]
    if len(theirs) != len(ours):
        return f"one moves {len(ours)} times, the other {len(theirs)} times"
    for mine, other in zip(ours, theirs):
        end = [Fraction(other["to"][a]) for a in "XYZ"]
        if any(abs(a - b) > WORD for a, b in zip(mine.coordinates, end)):
            return f"a movement of line {other['line']} ends at {[str(c) for c in mine.coordinates]} in one and at " \
                   f"{[float(e) for e in end]} in the other"
    return None
