"""Clauses that a program seems to keep: what a few runs show, and sometimes a little more than that."""
import random
from fractions import Fraction

from . import contracts
from . import controls
from . import syntax
from .choices import Choices
from .inputs import InputMaker
from .machine import Machine
from .random_programs import named_in
from .syntax import AtEntry, Binary, Number, Position, Relation, Variable

RUNS = 8


def add_promises(project: syntax.Project, rng: random.Random, counts):
    for program in project.programs():
        if rng.random() < 0.45:
            continue
        outcomes = [run_of(project, program, rng) for _ in range(RUNS)]
        returned = [o for o in outcomes if o.end == "return"]
        clauses = []
        for _ in range(rng.choice((1, 1, 2))):
            clauses.append(promise(program, outcomes, returned, rng))
        program.clauses += [c for c in clauses if c is not None and c not in program.clauses]
        program.clauses = list(dict.fromkeys(program.clauses))


def run_of(project, program, rng):
    return Machine(project, InputMaker(project, program, rng).any(), Choices(), 600, random=rng).run(program)


def promise(program, outcomes, returned, rng):
    roll = rng.random()
    if roll < 0.25:
        return assigns(outcomes, rng)
    if roll < 0.40:
        return contracts.EnsurePreserved(rng.choice(((), (), ("F",), ("F", "S"), tuple("FSTHD"))))
    if roll < 0.55:
        return alarm_clause(program, rng)
    if not returned:
        return contracts.EnsureCodes(("G90",)) if roll < 0.7 else assigns(outcomes, rng)
    if roll < 0.65:
        codes = {o.root.exit_state.modes[3] for o in returned}
        return contracts.EnsureCodes((rng.choice(sorted(codes)),))
    return ensure(program, returned, rng)


def assigns(outcomes, rng):
    written = sorted({v for o in outcomes if o.root for v in o.root.written if controls.is_common(v)})
    if written and rng.random() < 0.15:
        written.remove(rng.choice(written))
    return contracts.Assigns(tuple((v, v) for v in written))


def alarm_clause(program, rng):
    alarms = [b.statement for b in program.blocks if isinstance(b.statement, syntax.IfThen)
              and isinstance(b.statement.statement, syntax.Alarm)]
    if not alarms:
        return None
    alarm = rng.choice(alarms)
    number = int(alarm.statement.number.value)
    condition = alarm.condition
    if any(isinstance(e, Variable) and not isinstance(e.index, int) for e in syntax.parts(condition)):
        return None
    if any(isinstance(e, Variable) and not is_of_entry(e.index) for e in syntax.parts(condition)):
        return None
    return contracts.AlarmClause(number, rng.random() < 0.6, condition)


def is_of_entry(number: int) -> bool:
    return number == 0 or controls.is_local(number) or controls.is_common(number)


def ensure(program, returned, rng):
    states = [(o.root, o.root.exit_state) for o in returned]
    named = sorted(n for n in named_in(program) if controls.is_common(n))
    placed = all(s.tool.coordinates and r.entry_tool.coordinates for r, s in states)
    if placed and (rng.random() < 0.25 or not named):
        axis = rng.choice("XYZ")
        index = controls.AXES.index(axis)
        ends = {s.tool.coordinates[index] for _, s in states}
        if all(s.tool.coordinates[index] == r.entry_tool.coordinates[index] for r, s in states):
            return contracts.Ensure(Relation("EQ", Position("POS", axis), Position("ENTRY", axis)))
        return contracts.Ensure(Relation("LE", Position("POS", axis), short(max(ends))))
    if not named:
        return None
    common = rng.choice(named)
    ends = [s.cells.get(common) for _, s in states]
    if all(e == r.entry_cells.get(common) for e, (r, _) in zip(ends, states)):
        return contracts.Ensure(Relation("EQ", Variable(common), AtEntry(Variable(common))))
    numbers = [Fraction(0) if e is None else e for e in ends]
    steps = {e - (r.entry_cells.get(common) or 0) for e, (r, _) in zip(numbers, states)}
    if len(steps) == 1 and None not in ends:
        return contracts.Ensure(Relation("EQ", Variable(common),
                                         Binary("+", AtEntry(Variable(common)), short(steps.pop()))))
    if rng.random() < 0.5:
        return contracts.Ensure(Relation("LE", Variable(common), short(max(numbers))))
    return contracts.Ensure(Relation("GE", Variable(common), short(min(numbers))))


def short(value: Fraction) -> Number:
    """With three binary places, so that it can be written."""
    return Number(Fraction(round(value * 8), 8))
