"""Checks that a program makes of itself, `IF[#1NE3]THEN#3000=7`, with numbers that runs have shown at the place."""
import random
from fractions import Fraction

from . import controls
from . import syntax
from .choices import Choices
from .inputs import InputMaker
from .machine import Machine
from .random_programs import named_in
from .syntax import Alarm, Block, IfThen, Number, Relation, Variable
from .values import ControlAlarm, Unmodelled

RUNS = 6
FIRST_ALARM = 20


def add_checks(project: syntax.Project, rng: random.Random):
    seen = observe(project, rng)
    for program in project.programs():
        alarm = FIRST_ALARM
        places = [b for (p, b) in seen if p == program.number]
        for index in sorted(rng.sample(places, min(len(places), rng.choice((0, 1, 1, 2)))), reverse=True):
            values = seen[program.number, index]
            variable = rng.choice(sorted(values))
            alarm += 1
            insert(program, index, IfThen(condition(variable, values[variable], rng), Alarm(Number(Fraction(alarm)))))


def observe(project, rng) -> dict:
    """By program and block, the values that variables had before it."""
    watched = {p.number: watched_in(p) for p in project.programs()}
    seen: dict = {}

    def look(machine, frame):
        number = frame.activation.program.number
        values = seen.setdefault((number, frame.at), {})
        for variable in watched[number]:
            try:
                values.setdefault(variable, set()).add(machine.read(variable))
            except (ControlAlarm, Unmodelled):
                pass
    for _ in range(RUNS):
        program = project.programs()[0] if rng.random() < 0.7 else rng.choice(project.programs())
        inputs = InputMaker(project, program, rng).any()
        Machine(project, inputs, Choices(), 120, before_block=look, random=rng).run(program)
    return {place: {v: s for v, s in values.items() if s} for place, values in seen.items() if values}


def watched_in(program) -> set:
    return {n for n in named_in(program) if n} | {100, 4003, 5001}


def condition(variable: int, values: set, rng) -> Relation:
    values = sorted(values, key=lambda v: (v is not None, v or 0))
    value = rng.choice(values)
    if value is None:
        return Relation(rng.choice(("EQ", "NE")), Variable(variable), Variable(0))
    number = Number(Fraction(round(value * 8), 8))
    roll = rng.random()
    if roll < 0.4:
        return Relation("NE", Variable(variable), number)
    if roll < 0.7:
        return Relation(rng.choice(("GT", "LT")), Variable(variable), number)
    top = max((v for v in values if v is not None))
    return Relation("GT", Variable(variable), Number(Fraction(round(top * 8), 8)))


def insert(program: syntax.Program, index: int, statement):
    """Before a block, and behind its label."""
    block = program.blocks[index]
    program.blocks[index:index + 1] = [Block(statement, block.label), Block(block.statement, None, block.skip)]
