"""Inputs for a program: within its contract on its borders, inside, and, to try guards, just outside."""
import random
from fractions import Fraction

from . import contracts
from . import controls
from . import syntax
from .machine import Inputs, Machine
from .choices import Choices
from .random_programs import ALIASES, expressions_of
from .values import Arithmetic, ControlAlarm, Evaluator, Model, Unmodelled

EIGHTH = Fraction(1, 8)
START_CODES = ("G91", "G91", "G1", "G18", "G99", "G95")


def interesting(project) -> list:
    """The numbers of the texts, and what lies beside them."""
    found = {Fraction(0), Fraction(1), Fraction(-1)}
    for program in project.programs():
        roots = list(expressions_of(program))
        for clause in program.clauses:
            for part in (getattr(clause, "low", None), getattr(clause, "high", None)):
                if part is not None:
                    roots += list(syntax.parts(part))
        for expression in roots:
            if isinstance(expression, syntax.Number) and abs(expression.value) < 1000:
                found.update((expression.value, expression.value + EIGHTH, expression.value - EIGHTH,
                              expression.value + 1, expression.value - 1, -expression.value))
    return sorted(found)


class InputMaker:
    def __init__(self, project: syntax.Project, program: syntax.Program, rng: random.Random):
        self.project, self.program, self.rng = project, program, rng
        self.numbers = interesting(project)
        self.locals, self.cells = self.used()

    def used(self):
        """Variables that the programs name, and those beside commons that are named by computed numbers."""
        locals_, cells = set(), {100, 101, 500}
        for program in self.project.programs():
            for expression in expressions_of(program):
                if isinstance(expression, syntax.Variable) and isinstance(expression.index, int):
                    number = expression.index
                    if controls.is_local(number) and program is self.program:
                        locals_.add(number)
                    elif controls.is_common(number):
                        cells.add(number)
                    elif controls.is_offset(controls.canonical(number)):
                        cells.add(controls.canonical(number))
        for clause in self.program.clauses:
            if isinstance(clause, contracts.Range):
                (locals_ if controls.is_local(clause.variable) else cells).add(clause.variable)
        return sorted(locals_), sorted(cells)

    def value(self, vacant: bool = True):
        roll = self.rng.random()
        if vacant and roll < 0.2:
            return None
        if roll < 0.8:
            return self.rng.choice(self.numbers)
        return Fraction(self.rng.randint(-40, 80), 8)

    def any(self) -> Inputs:
        inputs = Inputs(skip=self.rng.choice((True, False, False)))
        for number in self.locals:
            inputs.locals[number] = self.value()
        for number in self.cells:
            inputs.cells[number] = self.value(vacant=controls.is_common(number))
        if self.rng.random() < 0.6:
            inputs.place = {axis: self.rng.choice((Fraction(0), self.rng.choice(self.numbers))) for axis in controls.AXES}
        if self.rng.random() < 0.25:
            inputs.modes = {controls.GROUP_OF[code]: code for code in self.rng.sample(START_CODES, 2)}
        for clause in self.program.clauses:
            self.draw(clause, inputs)
        return inputs

    def draw(self, clause, inputs: Inputs):
        match clause:
            case contracts.Range():
                into = inputs.locals if controls.is_local(clause.variable) else inputs.cells
                into[clause.variable] = self.within(clause, inputs)
            case contracts.Modal(codes):
                for code in codes:
                    inputs.modes[controls.GROUP_OF[code]] = code
            case contracts.Start(places):
                inputs.place.update(dict(places))

    def within(self, clause: contracts.Range, inputs: Inputs):
        if clause.optional and self.rng.random() < 0.3:
            return None
        if clause.values:
            return self.rng.choice(clause.values)
        evaluator = evaluator_of(inputs)
        low = evaluator.value(clause.low) if clause.low is not None else None
        high = evaluator.value(clause.high) if clause.high is not None else None
        if low is None:
            low = (high if high is not None else Fraction(0)) - 20
        if high is None:
            high = low + 20
        grid = 1 / clause.step if clause.step else 1 if clause.whole else self.rng.choice((1, 2, 8))
        inside = [Model.held(Fraction(n) / grid) for n in range(int(low * grid) - 1, int(high * grid) + 2)
                  if low <= Fraction(n) / grid <= high]
        if not inside:
            return low
        roll = self.rng.random()
        return inside[0] if roll < 0.25 else inside[-1] if roll < 0.5 else self.rng.choice(inside)

    def outside(self) -> Inputs:
        """One argument of the contract is off; other clauses may then be broken, too."""
        inputs = self.any()
        guard = next(c for c in self.program.clauses if isinstance(c, contracts.Guarded))
        clauses = [c for c in self.program.clauses
                   if isinstance(c, (contracts.Range, contracts.Modal, contracts.Start, contracts.Require))
                   and not guard.leaves(c)]
        if not clauses:
            return inputs
        match self.rng.choice(clauses):
            case contracts.Range() as clause:
                into = inputs.locals if controls.is_local(clause.variable) else inputs.cells
                into[clause.variable] = self.value()
            case contracts.Modal(codes):
                code = self.rng.choice(codes)
                others = [c for c, g in controls.GROUP_OF.items() if g == controls.GROUP_OF[code] and c != code]
                inputs.modes[controls.GROUP_OF[code]] = self.rng.choice(others)
            case contracts.Start(places):
                axis, value = self.rng.choice(places)
                inputs.place[axis] = value + self.rng.choice((EIGHTH, -1, 5))
            case contracts.Require():
                for number in self.locals:
                    inputs.locals[number] = self.value()
        return inputs


def evaluator_of(inputs: Inputs) -> Evaluator:
    def read(number):
        if number == 0:
            return None
        if controls.is_local(number):
            return inputs.locals.get(number)
        if controls.is_common(number):
            return inputs.cells.get(number)
        raise Unmodelled(f"#{number}")
    return Evaluator(Arithmetic(Choices()), read)


def is_allowed(program: syntax.Program, inputs: Inputs) -> bool:
    modes = {**controls.POWER_ON, **inputs.modes}
    try:
        return not contracts.broken_at_entry(program.clauses, evaluator_of(inputs), modes,
                                             lambda axis: inputs.place.get(axis, Fraction(0)))
    except (ControlAlarm, Unmodelled):
        return False
