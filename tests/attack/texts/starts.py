"""What runs begin with: on and beside the ends of ranges, numbers of the text, vacant ones."""
import math
import re
from decimal import Decimal
from fractions import Fraction as F

from . import contract
from .machine import Start, cell_of, is_common
from .path import AT_POWER_ON, GROUPS, LENGTHS, OFFSETS, XYZ
from .reckon import Model, Stop, Unsaid
from .switches import Switches


LATE = ("@LENGTH", "@START", "@MACHINE")  # these ask what others have settled
RIM = (F(1, 10 ** 8), F(99999999), F(-99999999), F(-1, 10 ** 8), F(1, 3), F(2, 7), F(1, 10), F(254, 100))
CODES = ("G91", "G91", "G1", "G99", "G18", "G95")


class Starts:
    def __init__(self, files: dict, text, rng):
        self.rng, self.text = rng, text
        everything = "\n".join(files.values())
        self.numbers = sorted({F(n) for n in re.findall(r"(?<![#\d.OPN])\d+\.?\d*|\.\d+", everything)
                               if not n.endswith(".")} | {F(0), F(1), F(-1)})
        self.numbers = [n for n in self.numbers if n < 1000] or [F(0)]
        named = {int(n) for n in re.findall(r"#(\d+)", everything)}
        own = {int(n) for n in re.findall(r"#(\d+)", "\n".join(text.lines))}
        self.locals = sorted(n for n in own if 0 < n < 34)
        self.cells = sorted({n for n in named if is_common(n)} | {100, 101, 500} |
                            {cell_of(n, "")[0] for n in named if n > 999} - {None, 1132})

    def value(self):
        rng, roll = self.rng, self.rng.random()
        if roll < 0.15:
            return None
        if Model.doubles and rng.random() < 0.5:
            return Model.held(rng.choice(RIM) if rng.random() < 0.2 else typed(F(rng.uniform(-20, 20)), rng))
        near = rng.choice(self.numbers)
        if roll < 0.6:
            return near
        return near + rng.choice((F(1, 8), -F(1, 8), 1, -1)) if roll < 0.85 else F(rng.randint(-40, 80), 8)

    def any(self) -> Start:
        rng = self.rng
        start = Start(skip=rng.random() < 0.3)
        start.locals = {n: v for n in self.locals if (v := self.value()) is not None}
        start.cells = {n: v for n in self.cells if (v := self.value()) is not None}
        if rng.random() < 0.6:
            start.place = {axis: rng.choice((F(0), rng.choice(self.numbers))) for axis in XYZ}
        if rng.random() < 0.25:
            start.modes = {GROUPS[code]: code for code in rng.sample(CODES, 2)}
        for clause in sorted((clause for _, clause in self.text.clauses()), key=turn_of):
            self.keep(clause, start)
        return start

    def keep(self, clause, start):
        head, words = clause.split()[0], clause.split()
        if head == "@MODAL":
            start.modes.update({GROUPS[c]: c for c in words[1:] if c in GROUPS})
        elif head == "@START":
            start.place.update(contract.places(words[1:], contract.reckoner_at(StateOf(start), Switches())))
        elif head in ("@PARAM", "@GLOBAL"):
            into, number = (start.locals, int(words[1][1:])) if int(words[1][1:]) < 34 else (start.cells, int(words[1][1:]))
            value = self.inside(clause, start)
            into.pop(number, None)
            if value is not None:
                into[number] = value
        elif head in contract.SET_UP:
            self.set_up(clause, head, start)

    def set_up(self, clause, head, start):
        reckoner = contract.reckoner_at(StateOf(start), Switches())
        if head == "@LENGTH":
            low, high = contract.sides_of(clause, reckoner)[0]
            start.spindle = self.rng.choice((start.spindle or high, low, high, self.within(low, high)))
            for number in contract.numbers_of_length(self.text, clause.split()[1]):
                wear = self.rng.choice((F(0), F(0), F(-1, 2), F(1)))
                start.cells.update({first + number: value for first, value in
                                    zip(LENGTHS, (wear, self.within(low, high) - wear))})
        for index, low, high in contract.named_sides_of(clause, reckoner) if head != "@LENGTH" else ():
            value = self.within(low, high)
            if head == "@OFFSET":
                start.cells[contract.first_of(clause.split()) + index] = value
            elif XYZ[index] not in self.given:
                start.place[XYZ[index]] = value - StateOf(start).zero[index]

    @property
    def given(self) -> set:
        return {word[0] for _, clause in contract.of(self.text, "@START") for word in clause.split()[1:] if word[1:]}

    def within(self, low, high):
        low, high = (high - 100 if low is None else low), (low + 100 if high is None else high)
        return self.rng.choice((low, high, low + (high - low) * F(self.rng.randint(0, 8), 8)))

    def inside(self, clause, start):
        state = StateOf(start)
        try:
            low, high, grid, optional, values = contract.range_ends(clause, contract.reckoner_at(state, Switches()))
        except (Stop, Unsaid):
            return None
        rng = self.rng
        if optional and rng.random() < 0.3:
            return None
        if values:
            return rng.choice(values)
        low = (high if high is not None else F(0)) - 20 if low is None else low
        high = low + 20 if high is None else high
        if Model.doubles and not grid and rng.random() < 0.8:
            return between(low, high, rng)
        grid = grid or rng.choice((1, 2, 8))
        first, last = math.ceil(low * grid), math.floor(high * grid)
        if first > last:
            return low
        return Model.held(F(rng.choice((first, last, rng.randint(first, last), rng.randint(first, last)))) / grid)

    def outside(self) -> Start:
        """With one clause that may be broken."""
        start = self.any()
        heads = {"@PARAM", "@GLOBAL", "@MODAL", "@START"} - {"@" + word for _, guard in contract.of(self.text, "@GUARDED")
                                                            for word in contract.excepted(guard)}
        clauses = [c for _, c in self.text.clauses() if c.split()[0] in heads]
        if not clauses:
            return start
        words = self.rng.choice(clauses).split()
        if words[0] == "@MODAL":
            code = self.rng.choice(words[1:])
            start.modes[GROUPS[code]] = self.rng.choice([c for c, g in GROUPS.items() if g == GROUPS[code] and c != code])
        elif words[0] == "@START":
            start.place[words[1][0]] = self.value() or F(3)
        else:
            number = int(words[1][1:])
            into = start.locals if number < 34 else start.cells
            into.pop(number, None)
            value = self.value()
            if value is not None:
                into[number] = value
        return start


def typed(value, rng) -> F:
    """As with few or many decimals, at most 8 digits."""
    most = 8 - len(str(int(abs(value))))
    return F(round(value * 10 ** (digits := rng.choice((1, 1, 2, 3, 4, most)))), 10 ** digits)


def between(low, high, rng) -> F:
    """A decimal of the range: at its ends, beside them, or anywhere."""
    last = F(1, 10 ** max(0, 7 - len(str(int(max(abs(low), abs(high)))))))
    value = typed(low + (high - low) * F(rng.random()) ** rng.choice((1, 1, 3)), rng)
    value = rng.choice((low, high, low + last, high - last, value, value, value, value))
    return Model.held(min(max(value, low), high))


def turn_of(clause: str) -> int:
    head = clause.split()[0]
    return LATE.index(head) if head in LATE else -1


class StateOf:
    """As much of a state as clauses at entry ask for."""

    def __init__(self, start: Start):
        self.locals, self.cells = start.locals, start.cells
        self.modes = {**AT_POWER_ON, **start.modes}
        self.place = [F(start.place.get(axis, 0)) for axis in XYZ]
        self.shifts = ((0,) * 3, (0,) * 3)

    @property
    def zero(self) -> list:
        return [F(self.cells.get(5201 + i) or 0) + F(self.cells.get(OFFSETS[self.modes[14]] + i) or 0) for i in range(3)]

    @property
    def machine(self) -> list:
        return [a + b for a, b in zip(self.place, self.zero)]


def digits(value) -> str:
    """Of a double, without an exponent."""
    return format(Decimal(repr(float(value))), "f")


def short_of(number: int) -> int:
    """A register of lengths by the number that all controls know."""
    return number - 8000 if 10000 < number <= 10200 else number - 8800 if 11000 < number <= 11200 else number


def as_words(start: Start) -> list:
    """For `feedhold run`."""
    words = []
    for number, value in sorted({**start.locals, **start.cells}.items()):
        words += ["--var", f"{short_of(number)}={digits(value)}"]
    if start.place:
        words += ["--start", *(f"{axis}{digits(value)}" for axis, value in start.place.items())]
    return words + (["--block-skip"] if start.skip else [])


def runs_alike(start: Start, text) -> bool:
    """The command begins with the codes of the contract and of power-on."""
    said = {GROUPS[c]: c for _, clause in text.clauses() if clause.startswith("@MODAL") for c in clause.split()[1:]
            if c in GROUPS}
    return all(said.get(group, AT_POWER_ON.get(group)) == code for group, code in start.modes.items())
