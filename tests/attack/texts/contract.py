"""Clauses of contracts, read from their text when they are asked."""
import re
from fractions import Fraction as F

from .path import GROUPS, XYZ
from .reckon import Reckoner, Stop, Unsaid

END = r"(-?\d+(?:\.\d+)?|-?\.\d+|#\d+|\[.*?\])?"
RANGE = re.compile(r"\s" + END + r"\s?\.\.\s?" + END + r"(?=\s|$)")
CODE = re.compile(r"G\d+(\.\d)?$")


def words_of(clause: str):
    return clause.split()


def of(text, head):
    return [(line, clause) for line, clause in text.clauses() if clause.split()[0] == head]


def reckoner_at(state, ask, entry=None):
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
    return Reckoner(read, ask, special)


def broken_at_entry(text, state, ask) -> list:
    """The clauses that do not hold in a state at entry."""
    reckoner = reckoner_at(state, ask)
    found = []
    for _, clause in text.clauses():
        head, words = clause.split()[0], clause.split()[1:]
        if head in ("@PARAM", "@GLOBAL") and not in_range(clause, reckoner) or \
                head == "@REQUIRE" and not reckoner.whole(clause[8:]) or \
                head == "@MODAL" and any(state.modes[GROUPS[code]] != code for code in words) or \
                head == "@START" and any(state.place[XYZ.index(axis)] != value for axis, value in places(words)):
            found.append(clause)
    return found


def places(words):
    """Of @START."""
    return [(word[0], F(word[1:].rstrip(".") if word.endswith(".") else word[1:])) for word in words]


def excepted(clause: str) -> list:
    """The words behind EXCEPT."""
    return clause.split("EXCEPT")[1].split() if "EXCEPT" in clause else []


def in_range(clause, reckoner) -> bool:
    words = clause.split()
    value = reckoner.read(int(words[1][1:]))
    if value is None:
        return "OPTIONAL" in words
    if "INT" in words and value.denominator != 1:
        return False
    if "IN" in words:
        return value in [F(each) for each in words[words.index("IN") + 1].split(",")]
    ends = RANGE.search(clause[clause.index("#"):])
    if not ends:
        return True
    low, high = (None if each is None else reckoner.whole(each) for each in ends.groups())
    return (low is None or value >= low) and (high is None or value <= high)


def range_ends(clause, reckoner):
    """(low, high, whole, optional, values) for those who draw arguments."""
    words = clause.split()
    values = [F(each) for each in words[words.index("IN") + 1].split(",")] if "IN" in words else []
    ends = RANGE.search(clause[clause.index("#"):])
    low, high = (None if each is None else reckoner.whole(each) for each in ends.groups()) if ends else (None, None)
    return low, high, "INT" in words, "OPTIONAL" in words, values


def promise_holds(clause, visit, ask) -> bool:
    """Of @ENSURE on a return."""
    body = clause.split(None, 1)[1]
    if all(CODE.match(word) for word in body.split()):
        return all(visit.exit.modes[GROUPS[code]] == code for code in body.split())
    try:
        return bool(reckoner_at(visit.exit, ask, visit.entry).whole(body))
    except (Stop, Unsaid):
        return True
