"""Random programs of the macro language; every feature has a name and can be left out."""
import math
import random
from dataclasses import dataclass
from fractions import Fraction

from . import contracts
from . import syntax
from .controls import CONTROLS
from .syntax import (Alarm, Assign, Binary, Block, Call, End, Function, Goto, IfGoto, IfThen, Minus, Nothing, Number,
                    Program, Project, Relation, Return, SourceFile, Variable, While, Words)

FEATURES = ("calls", "repeats", "modal-calls", "modal-in-callee", "indirect", "system", "skip", "jumps", "jumps-into-loops",
            "computed-goto", "return-to-label", "vacant", "functions", "contracts", "guarded", "alarms", "modes", "files",
            "recursion", "bits", "bare-loops", "promises", "letters-of-codes", "checks", "differences", "ranges", "decimals")

SMALL = [Fraction(n) for n in (0, 0, 1, 1, 2, 3, 4, 5, 7, 10)] + [Fraction(n, 8) for n in (1, 2, 4, 6, 12, 20, -4)]
DECIMALS = [Fraction(n) for n in ("0.1", "0.1", "0.3", "0.7", "1.1", "2.54", "0.01", "3.3", "0.05")]
LOCALS = (1, 2, 3, 4, 7, 10, 11, 20)
COMMONS = (100, 101, 102, 500, 501)
ALIASES = ((2001, 10001), (2201, 11001), (5221, 2501), (5222, 2601), (5201, 2500), (5241, 2502), (7001, 14001),
           (7022, 14022), (1132, 1100), (1132, 1101))
OUTPUTS = ALIASES[-2:]


def number(value) -> Number:
    return Number(Fraction(value))


@dataclass
class Pending:
    """A block in the making: a jump names a label that is placed later."""

    statement: object
    depth: tuple = ()  # loops around it, each by a name
    skip: bool = False
    label: int = None


class ProgramMaker:
    """One program of a project."""

    def __init__(self, rng: random.Random, features, dialect, own: int, callees, is_main: bool):
        self.rng, self.features, self.dialect = rng, features, dialect
        self.own, self.callees, self.is_main = own, callees, is_main
        self.blocks: list[Pending] = []
        self.labels_wanted: list[tuple[int, int]] = []  # label, index of the jump
        self.next_label = 10
        self.loop_names = 0
        self.open_loops: tuple = ()
        self.open_numbers: tuple = ()
        self.modal_open = False
        self.alarms = 0

    def has(self, feature: str, one_in: float = 1) -> bool:
        return feature in self.features and self.rng.random() < 1 / one_in

    def any(self, options):
        return self.rng.choice(list(options))

    # ---- expressions ----

    def constant(self) -> Number:
        return Number(self.any(DECIMALS if self.has("decimals", 3) else SMALL))

    def variable(self) -> Variable:
        if self.has("indirect", 70):
            return Variable(Binary("+", number(self.any((99, 100, 500, 0))), Variable(self.any(LOCALS))))
        if self.has("system", 14):
            return Variable(self.any(self.any(ALIASES if CONTROLS[self.dialect].fanuc_offsets else OUTPUTS)))
        return Variable(self.any(LOCALS if self.rng.random() < 0.65 else COMMONS))

    def readable(self) -> syntax.Expression:
        if self.has("vacant", 30):
            return Variable(0)
        if self.has("modes", 25):
            return Variable(self.any((4001, 4003, 5001, 5003)))
        return self.variable()

    def expression(self, depth: int = 2) -> syntax.Expression:
        roll = self.rng.random()
        if depth == 0 or roll < 0.3:
            return self.readable() if self.rng.random() < 0.6 else self.constant()
        if roll < 0.72:
            operator = self.any("+++--*")
            right = self.constant() if operator == "*" and self.rng.random() < 0.8 else self.expression(depth - 1)
            return Binary(operator, self.expression(depth - 1), right)
        if roll < 0.76:
            return Binary("/", self.expression(depth - 1), self.divisor())
        if roll < 0.79 and self.has("bits"):
            return Binary(self.any(("AND", "OR", "XOR", "MOD")), self.readable(), number(self.any((1, 2, 3, 7))))
        if roll < 0.86:
            return Minus(self.readable())
        if self.has("functions", 3):
            return Function(self.any(("ABS", "ABS", "FIX", "FUP", "ROUND", "ABS", "SQRT")), self.expression(depth - 1))
        return self.readable()

    def divisor(self) -> syntax.Expression:
        if self.rng.random() < 0.4:
            return number(self.any((2, 4, 8)))
        return self.readable() if self.rng.random() < 0.6 else Binary(self.any("+-"), self.readable(), self.constant())

    def condition(self) -> Relation:
        operator = self.any(("EQ", "NE", "GT", "GE", "LT", "LE"))
        left = self.readable() if self.rng.random() < 0.8 else self.expression(1)
        if operator in ("EQ", "NE") and self.has("vacant", 3):
            return Relation(operator, left, Variable(0))
        return Relation(operator, left, self.constant() if self.rng.random() < 0.8 else self.readable())

    def target(self) -> Variable:
        target = self.variable()
        return target if target.index != 0 else Variable(1)

    # ---- statements ----

    def add(self, statement, skippable=True):
        self.blocks.append(Pending(statement, self.open_loops,
                                   skippable and self.has("skip", 25) and not isinstance(statement, (While, End))))

    def statement(self, budget: int) -> int:
        """Adds some blocks; returns how many of the budget are left."""
        roll = self.rng.random()
        before = len(self.blocks)
        if self.callees and self.has("calls", 4):
            self.call()
        elif roll < 0.30:
            self.add(Assign(self.target(), self.value()))
        elif roll < 0.40:
            self.move()
        elif roll < 0.50:
            self.add(IfThen(self.condition(), Assign(self.target(), self.value())))
        elif roll < 0.53 and self.has("alarms"):
            self.alarms += 1
            self.add(IfThen(self.condition(), Alarm(number(self.alarms))), False)
        elif roll < 0.66 and len(self.open_numbers) < 2 and budget > 3:
            self.loop(min(budget - 2, 6))
        elif roll < 0.78 and self.has("jumps"):
            self.jump()
        elif self.callees and self.has("calls"):
            self.call()
        else:
            self.add(Assign(self.target(), self.value()))
        return budget - (len(self.blocks) - before)

    def value(self) -> syntax.Expression:
        return self.constant() if self.rng.random() < 0.35 else self.expression(2)

    def move(self):
        codes, words = [], []
        if self.has("modes", 5):
            codes.append(self.any(("G90", "G91", "G0", "G1", "G17", "G18", "G94", "G49", "G98", "G99")))
        if self.has("modes", 15):
            codes.append(self.any(("M3", "M5")))
        for axis in "XYZ":
            if self.rng.random() < 0.45:
                words.append((axis, self.any((self.constant(), self.readable(), Minus(self.readable()),
                                              Binary("+", self.readable(), self.constant())))))
        if not codes and not words:
            words.append(("X", self.constant()))
        if self.rng.random() < 0.25:
            words.append(("F", number(self.any((100, 200, 50)))))
        if self.has("modes", 8):
            words.append((self.any("SDH"), number(self.any((1, 2)))))
        self.add(Words(tuple(codes), tuple(words)))

    def loop(self, budget: int):
        self.loop_names += 1
        name = self.loop_names
        use = next(n for n in (1, 2, 3) if n not in self.open_numbers)
        roll = self.rng.random()
        counter = Variable(self.any((20, 11, 10, 100)))
        if roll < 0.85:  # a counter
            self.add(Assign(counter, number(self.any((0, 0, 1)))))
            limit = number(self.any((2, 3, 4, 5))) if self.rng.random() < 0.6 else self.readable()
            condition = Relation(self.any(("LT", "LE", "LT", "NE")), counter, limit)
        elif roll < 0.9 or not self.has("bare-loops"):
            condition = self.condition()
        else:
            condition = None
        self.add(While(condition, use))
        outer = self.open_loops, self.open_numbers
        self.open_loops, self.open_numbers = self.open_loops + (name,), self.open_numbers + (use,)
        left = budget
        while left > 0:
            left = self.statement(left)
        if roll < 0.85:
            step = number(self.any((1, 1, 1, Fraction(1, 2), 2)))
            self.add(Assign(counter, Binary("+", counter, step)), False)
        elif self.rng.random() < 0.7:
            self.jump(always_out=True)
        self.add(End(use))
        self.open_loops, self.open_numbers = outer

    def new_label(self) -> int:
        self.next_label += 10
        return self.next_label

    def jump(self, always_out=False):
        if self.has("computed-goto", 8):
            self.dispatch()
            return
        label = self.new_label()
        self.labels_wanted.append((label, len(self.blocks), always_out))
        self.add(IfGoto(self.condition(), number(label)) if self.rng.random() < 0.9 else Goto(number(label)), False)

    def dispatch(self):
        """GOTO to one of three labels; behind each a block and, often, a way out."""
        base = self.new_label()
        self.next_label += 10
        self.add(Goto(Binary("+", number(base), self.readable())), False)
        for offset in range(self.any((2, 3))):
            self.add(Assign(self.target(), self.value()), False)
            self.blocks[-1].label = base + offset

    def call(self):
        program = self.any(self.callees)
        repeats = None
        if self.has("repeats", 3):
            repeats = number(self.any((2, 3))) if self.rng.random() < 0.7 else self.readable()
        roll = self.rng.random()
        if roll < 0.35:
            self.add(Call("M98", number(program), repeats), False)
        elif roll < 0.7 or not self.has("modal-calls") or not (self.is_main or self.has("modal-in-callee")):
            self.add(Call("G65", number(program), repeats, self.arguments()), False)
        elif self.modal_open and self.rng.random() < 0.6:
            self.add(Words(("G67",)), False)
            self.modal_open = False
        else:
            self.add(Call("G66", number(program), repeats, self.arguments()), False)
            self.modal_open = True
            if self.rng.random() < 0.8:
                self.move()

    def arguments(self):
        known = "ABCDEFHIJKMQRSTUVXYZ" if "letters-of-codes" in self.features else "ABCEIJKQRUVXYZ"
        letters = [l for l in known if self.rng.random() < (0.5 if l in "ABC" else 0.07)]
        return tuple((letter, self.any((self.constant(), self.constant(), self.readable(),
                                        Binary("+", self.readable(), self.constant())))) for letter in letters)

    # ---- the whole ----

    def settle(self):
        """Constants for most variables, so that much of what comes is known."""
        for variable in self.rng.sample(LOCALS + COMMONS, 5):
            self.add(Assign(Variable(variable), self.constant()), False)
        if "modes" in self.features:
            self.add(Words(("G90", "G0"), (("X", self.constant()), ("Y", self.constant()), ("Z", self.constant()))), False)

    def make(self, size: int) -> list[Block]:
        if self.is_main and self.rng.random() < 0.75:
            self.settle()
        while size > 0:
            size = self.statement(size)
        if self.modal_open and (self.is_main or not self.has("modal-in-callee", 2)):
            self.add(Words(("G67",)), False)
        self.finish()
        self.place_labels()
        return [Block(p.statement, p.label, p.skip) for p in self.blocks]

    def finish(self):
        if self.is_main and self.rng.random() < 0.6:
            self.add(Words(("M30",)), False)
        elif not self.is_main and self.has("return-to-label", 8):
            self.add(Return(number(self.any((20, 30, 40)))), False)
        else:
            self.add(Return(), False)

    def place_labels(self):
        for label, source, always_out in self.labels_wanted:
            around = self.blocks[source].depth
            places = [i for i, block in enumerate(self.blocks) if block.label is None and i != source]
            if "jumps-into-loops" not in self.features or self.rng.random() < 0.9:
                places = [i for i in places if self.blocks[i].depth == around[:len(self.blocks[i].depth)]]
            if always_out:
                places = [i for i in places if len(self.blocks[i].depth) < len(around) and i > source]
            forward = [i for i in places if i > source]
            if forward and self.rng.random() < 0.94:
                places = forward
            if not places:
                self.blocks.append(Pending(Nothing()))
                places = [len(self.blocks) - 1]
                self.finish()
            self.blocks[self.any(places)].label = label


class ProjectMaker:
    def __init__(self, rng: random.Random, features=FEATURES, dialect: str = "fanuc-30i"):
        self.rng, self.features, self.dialect = rng, frozenset(features), dialect

    def make(self) -> Project:
        count = self.rng.choice((1, 2, 2, 3, 3, 4)) if "calls" in self.features else 1
        programs = []
        for number_ in range(1, count + 1):
            callees = list(range(number_ + 1, count + 1))
            if "recursion" in self.features and self.rng.random() < 0.04:
                callees.append(number_)
            maker = ProgramMaker(self.rng, self.features, self.dialect, number_, callees, number_ == 1)
            blocks = maker.make(self.rng.choice((2, 3, 4, 6) if number_ > 1 else (3, 4, 6, 8)))
            programs.append(Program(number_, [], blocks))
        if "files" in self.features and count > 1 and self.rng.random() < 0.3:
            files = [SourceFile(f"O{p.number}.nc", [p]) for p in programs]
        else:
            files = [SourceFile("O1.nc", programs)]
        project = Project(self.dialect, files)
        if "contracts" in self.features:
            ContractMaker(self.rng, self.features).add(project)
        return project


class ContractMaker:
    """Clauses on entry; promises come from what runs show (promises.py)."""

    def __init__(self, rng, features):
        self.rng, self.features = rng, features

    def add(self, project: Project):
        for program in project.programs():
            if self.rng.random() < 0.35:
                continue
            for variable in sorted(self.locals_of(program)):
                if self.rng.random() < 0.6:
                    program.clauses.append(self.range_of(variable, False, program))
            for variable in sorted(self.commons_of(program)):
                if self.rng.random() < 0.25:
                    program.clauses.append(self.range_of(variable, True, program))
            known = [c.variable for c in program.clauses if not c.optional]
            if len(known) > 1 and self.rng.random() < 0.25:
                a, b = self.rng.sample(known, 2)
                program.clauses.append(contracts.Require(
                    Relation(self.rng.choice(("LE", "LT", "NE", "GE")), Variable(a), Variable(b))))
            if "modes" in self.features and self.rng.random() < 0.3:
                program.clauses.append(contracts.Modal(self.rng.choice((("G90",), ("G91",), ("G90", "G17"), ("G0",)))))
            if self.rng.random() < 0.12:
                program.clauses.append(contracts.Start((("X", self.rng.choice(SMALL)),)))
            if "guarded" in self.features and self.rng.random() < 0.3:
                self.guard(program)

    @staticmethod
    def locals_of(program):
        return {n for n in read_in(program) if n in (1, 2, 3, 4, 7)}

    @staticmethod
    def commons_of(program):
        return {n for n in read_in(program) if n in COMMONS}

    def range_of(self, variable: int, is_global: bool, program) -> contracts.Range:
        optional = not is_global and self.rng.random() < 0.12
        if self.rng.random() < 0.15:
            return contracts.Range(variable, values=tuple(sorted({Fraction(v) for v in self.rng.sample((0, 1, 2, 3), 2)})),
                                   optional=optional, is_global=is_global)
        low = self.rng.choice((0, 0, 1, 1, -2, Fraction(1, 2)))
        high = low + self.rng.choice((1, 2, 2, 4, Fraction(3, 2)))
        whole = self.rng.random() < 0.3
        if whole:
            low, high = math.floor(low), math.floor(high)
        step = self.rng.choice((Fraction(1, 10), Fraction(1, 1000))) if not whole and self.rng.random() < 0.3 else None
        return contracts.Range(variable, number(low), number(high) if self.rng.random() < 0.9 else None,
                               whole=whole, optional=optional, is_global=is_global, step=step)

    def guard(self, program: Program):
        """Guards for the clauses, most of the time all that are needed."""
        guards = []
        for clause in program.clauses:
            if self.rng.random() < 0.06:
                continue
            match clause:
                case contracts.Range(variable, low, high, values, whole, optional, _, _):
                    if not optional:
                        guards.append(Relation("EQ", Variable(variable), Variable(0)))
                    if values:
                        continue
                    if low is not None:
                        guards.append(Relation("LT", Variable(variable), low))
                    if high is not None:
                        guards.append(Relation("GT", Variable(variable), high))
                    if whole:
                        guards.append(Relation("NE", Variable(variable), Function("FIX", Variable(variable))))
                case contracts.Require(condition):
                    opposite = dict(LE="GT", LT="GE", NE="EQ", GE="LT")[condition.operator]
                    guards.append(Relation(opposite, condition.left, condition.right))
                case contracts.Modal(codes) if self.rng.random() < 0.7:
                    groups = {"G90": (4003, 90), "G91": (4003, 91), "G17": (4002, 17), "G0": (4001, 0)}
                    guards += [Relation("NE", Variable(groups[c][0]), number(groups[c][1])) for c in codes]
                case contracts.Start(places) if self.rng.random() < 0.7:
                    guards += [Relation("NE", Variable(5001), Number(v)) for _, v in places]
        program.blocks[:0] = [Block(IfThen(guard, Alarm(number(90)))) for guard in guards]
        excepted = tuple(word for word, kind in (("MODAL", contracts.Modal), ("START", contracts.Start))
                         if any(isinstance(c, kind) for c in program.clauses) and self.rng.random() < 0.5)
        program.clauses.append(contracts.Guarded(excepted))


def expressions_of(program: Program):
    for block in program.blocks:
        for root in roots_of(block.statement):
            yield from syntax.parts(root)


def named_in(program: Program) -> set:
    return {e.index for e in expressions_of(program) if isinstance(e, Variable) and isinstance(e.index, int)}


def read_in(program: Program):
    """Numbers of variables that are read: a contract on others is refused."""
    for block in program.blocks:
        inner = block.statement.statement if isinstance(block.statement, IfThen) else block.statement
        target = inner.target if isinstance(inner, Assign) else None
        for root in roots_of(block.statement):
            yield from (e.index for e in syntax.parts(root) if isinstance(e, Variable) and isinstance(e.index, int)
                        and e is not target)


def roots_of(statement):
    match statement:
        case Assign(target, value):
            return [target, value]
        case Alarm(value):
            return [value]
        case IfGoto(condition, target):
            return [condition, target]
        case IfThen(condition, inner):
            return [condition] + roots_of(inner)
        case While(condition, _):
            return [] if condition is None else [condition]
        case Goto(target):
            return [target]
        case Words(_, words):
            return [value for _, value in words]
        case Call(_, program, repeats, arguments):
            return [program] + ([repeats] if repeats is not None else []) + [value for _, value in arguments]
        case Return(target):
            return [] if target is None else [target]
    return []
