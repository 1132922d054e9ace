"""Clauses of contracts, read from their text when they are asked."""
import re
from fractions import Fraction as F

from .path import ADDITIONAL, GROUPS, LENGTHS, XYZ, offset_of_code
from .reckon import Model, Reckoner, Stop, Unsaid

CODE = re.compile(r"G\d+(\.\d)?$")


def words_of(clause: str):
    return clause.split()


def of(text, head):
    return [(line, clause) for line, clause in text.clauses() if clause.split()[0] == head]


def reckoner_at(state, ask, entry=None, apart=F(0)):
    def read(number):
        if number == 0:
            return None
        if number < 34:
            return state.locals.get(number)
        if 100 <= number < 200 or 500 <= number < 1000:
            return state.cells.get(number)
        raise Unsaid(f"#{number} in a clause")

    def special(name, inner):
        if name == "OLD":
            return reckoner_at(entry, ask).whole(inner)
        if name in ("POS", "ENTRY"):
            return (state if name == "POS" else entry).place[XYZ.index(inner)]
        raise Unsaid(name)
    return Reckoner(read, ask, special, apart)


def broken_at_entry(text, state, ask) -> list:
    """The clauses that do not hold in a state at entry."""
    reckoner = reckoner_at(state, ask)
    found = []
    for _, clause in text.clauses():
        head, words = clause.split()[0], clause.split()[1:]
        if head in ("@PARAM", "@GLOBAL") and not in_range(clause, reckoner) or \
                head == "@REQUIRE" and not reckoner.whole(clause[8:]) or \
                head == "@MODAL" and any(state.modes[GROUPS[code]] != code for code in words) or \
                head in SET_UP and not is_set_up(text, clause, state, reckoner) or \
                head == "@START" and any(state.place[XYZ.index(axis)] != value for axis, value in places(words, reckoner)):
            found.append(clause)
    return found


SET_UP = ("@OFFSET", "@LENGTH", "@MACHINE")


def is_set_up(text, clause, state, reckoner) -> bool:
    """Where the zero points and axes are, and how long tools."""
    words = clause.split()
    if words[0] == "@LENGTH":
        (low, high), = sides_of(clause, reckoner)
        sums = [sum((state.cells.get(first + n) or F(0) for first in LENGTHS), F(0)) for n in numbers_of_length(text, words[1])]
        return all(is_between(each, low, high) for each in sums)
    if any(state.shifts[0]) or any(state.shifts[1]):
        return False
    sides = named_sides_of(clause, reckoner)
    if words[0] == "@MACHINE":
        return all(is_between(state.machine[i], low, high) for i, low, high in sides)
    return all(is_between(state.cells.get(first_of(words) + i) or F(0), low, high) for i, low, high in sides)


def first_of(words) -> int:
    """Of `@OFFSET G54 X..`, `@OFFSET G54.1 P2 X..`."""
    return 5201 if words[1] == "EXT" else offset_of_code(words[1], int(words[2][1:]) if words[1] in ADDITIONAL else None)


def numbers_of_length(text, word) -> list:
    if word != "H*":
        return [int(word[1:])]
    own = {int(clause.split()[1][1:]) for _, clause in of(text, "@LENGTH") if clause.split()[1] != "H*"}
    return sorted(text.lengths - own)


def sides_of(clause, reckoner) -> list:
    """Of `@LENGTH H1 50..60`: its range."""
    return [range_of(clause.split()[2], reckoner)]


def named_sides_of(clause, reckoner) -> list:
    """(index, low, high) of each axis that `@OFFSET` or `@MACHINE` names."""
    words = clause.split("HOME")[0].split()
    words = words[1 if words[0] == "@MACHINE" else 3 if words[1] in ADDITIONAL else 2:]
    return [(XYZ.index(word[0]), *range_of(word[1:], reckoner)) for word in words]


def range_of(text, reckoner):
    low, dots, high = text.partition("..")
    return tuple(reckoner.whole(end) if end else None for end in ((low, high) if dots else (text, text)))


def is_between(value, low, high) -> bool:
    slack = F(1, 10 ** 9) if Model.doubles else 0  # of a sum of doubles
    return (low is None or value >= low - slack) and (high is None or value <= high + slack)


def longest_tool(text, reckoner):
    """Of the clauses; None: they tell no lengths, or no longest one."""
    highs = [sides_of(clause, reckoner)[0][1] for _, clause in of(text, "@LENGTH")]
    return None if not highs or None in highs else max(highs)


def places(words, reckoner):
    """Of @START; an axis without a value may be anywhere."""
    return [(word[0], reckoner.whole(word[1:].removesuffix("."))) for word in words if word[1:]]


def excepted(clause: str) -> list:
    """The words behind EXCEPT."""
    return clause.split("EXCEPT")[1].split() if "EXCEPT" in clause else []


def ends_of(clause):
    """The texts of both ends of a range; an end that is not there is None.  None: no range is told."""
    words = clause.split()
    for at, word in enumerate(words):
        if ".." not in word:
            continue
        cut = word.index("..") + (1 if "..." in word else 0)
        low, high = word[:cut], word[cut + 2:]
        if word == "..":
            low, high = words[at - 1], words[at + 1] if at + 1 < len(words) else ""
        return (low if re.match(r"[-\d.#\[]", low) else None), high or None
    return None


def in_range(clause, reckoner) -> bool:
    words = clause.split()
    value = reckoner.read(int(words[1][1:]))
    if value is None:
        return "OPTIONAL" in words
    if "INT" in words and value.denominator != 1:
        return False
    step = step_of(words)
    if step and (F(repr(float(value))) / step).denominator != 1:
        return False
    if "IN" in words:
        return value in [Model.held(F(each)) for each in words[words.index("IN") + 1].split(",")]
    ends = ends_of(clause)
    if not ends:
        return True
    low, high = (None if each is None else reckoner.whole(each) for each in ends)
    return (low is None or value >= low) and (high is None or value <= high)


def step_of(words):
    """Of `BY 0.001`."""
    return F(words[words.index("BY") + 1]) if "BY" in words else None


def range_ends(clause, reckoner):
    """(low, high, grid, optional, values) for those who draw arguments; grid: numbers by unit, None: any."""
    words = clause.split()
    values = [Model.held(F(each)) for each in words[words.index("IN") + 1].split(",")] if "IN" in words else []
    low, high = (None if each is None else reckoner.whole(each) for each in ends_of(clause) or (None, None))
    grid = 1 / step_of(words) if "BY" in words else F(1) if "INT" in words else None
    return low, high, grid, "OPTIONAL" in words, values


def promise_holds(clause, visit, ask) -> bool:
    """Of @ENSURE on a return."""
    body = clause.split(None, 1)[1]
    if all(CODE.match(word) for word in body.split()):
        return all(visit.exit.modes[GROUPS[code]] == code for code in body.split())
    try:
        return bool(reckoner_at(visit.exit, ask, visit.entry, F(1, 1000) if Model.doubles else F(0)).whole(body))
    except (Stop, Unsaid):
        return True
