"""Clauses of contracts: their text, and what they ask of a call and of a return."""
from dataclasses import dataclass
from fractions import Fraction
from typing import Optional, Union

from . import controls
from . import syntax
from .syntax import Expression, decimal


@dataclass(frozen=True)
class Range:
    """Of @PARAM and @GLOBAL; bounds are expressions over other arguments."""

    variable: int
    low: Optional[Expression] = None
    high: Optional[Expression] = None
    values: tuple[Fraction, ...] = ()
    whole: bool = False
    optional: bool = False
    is_global: bool = False
    step: Optional[Fraction] = None

    def text(self) -> str:
        words = ["@GLOBAL" if self.is_global else "@PARAM", f"#{self.variable}"]
        if self.values:
            words.append("IN " + ",".join(decimal(v) for v in self.values))
        elif self.low is not None or self.high is not None:
            words.append(f"{_bound(self.low)}..{_bound(self.high)}")
        if self.whole:
            words.append("INT")
        if self.step:
            words.append(f"BY {_with_zero(decimal(self.step))}")
        if self.optional:
            words.append("OPTIONAL")
        return " ".join(words)

    def allows(self, value, evaluator) -> bool:
        if value is None:
            return self.optional
        if self.values and value not in self.values:
            return False
        if self.step and (Fraction(repr(float(value))) / self.step).denominator != 1:
            return False
        if self.low is not None and value < evaluator.value(self.low):
            return False
        if self.high is not None and value > evaluator.value(self.high):
            return False
        return not self.whole or value.denominator == 1


def _bound(expression: Optional[Expression]) -> str:
    if expression is None:
        return ""
    if isinstance(expression, syntax.Number):
        whole = expression.value.denominator == 1
        return str(int(expression.value)) if whole else decimal(expression.value).replace("-.", "-0.") \
            if expression.value < 0 else _with_zero(decimal(expression.value))
    if isinstance(expression, syntax.Variable):
        return syntax.text(expression)
    return f"[{syntax.text(expression)}]"


def _with_zero(number: str) -> str:
    return "0" + number if number.startswith(".") else number


@dataclass(frozen=True)
class Require:
    condition: Expression

    def text(self) -> str:
        return f"@REQUIRE {_spaced(self.condition)}"


@dataclass(frozen=True)
class Modal:
    codes: tuple[str, ...]

    def text(self) -> str:
        return "@MODAL " + " ".join(self.codes)


@dataclass(frozen=True)
class Start:
    places: tuple[tuple[str, Fraction], ...]

    def text(self) -> str:
        return "@START " + " ".join(f"{axis}{decimal(value)}" for axis, value in self.places)


@dataclass(frozen=True)
class Ensure:
    condition: Expression

    def text(self) -> str:
        return f"@ENSURE {_spaced(self.condition)}"


@dataclass(frozen=True)
class EnsurePreserved:
    excepted: tuple[str, ...] = ()  # letters of words

    def text(self) -> str:
        return "@ENSURE MODAL PRESERVED" + _except(self.excepted)


@dataclass(frozen=True)
class EnsureCodes:
    codes: tuple[str, ...]

    def text(self) -> str:
        return "@ENSURE " + " ".join(self.codes)


@dataclass(frozen=True)
class Assigns:
    variables: tuple[tuple[int, int], ...]  # ranges

    def text(self) -> str:
        if not self.variables:
            return "@ASSIGNS NOTHING"
        return "@ASSIGNS " + " ".join(f"#{a}" if a == b else f"#{a}..#{b}" for a, b in self.variables)


@dataclass(frozen=True)
class Guarded:
    excepted: tuple[str, ...] = ()  # MODAL START

    def text(self) -> str:
        return "@GUARDED" + _except(self.excepted)

    def leaves(self, clause) -> bool:
        """To the callers: of calls that break the clause nothing is promised."""
        return isinstance(clause, Modal) and "MODAL" in self.excepted or \
            isinstance(clause, Start) and "START" in self.excepted


def _except(words) -> str:
    return " EXCEPT " + " ".join(words) if words else ""


@dataclass(frozen=True)
class AlarmClause:
    number: int
    both_ways: bool  # IFF
    condition: Expression

    def text(self) -> str:
        return f"@ALARM {self.number} {'IFF' if self.both_ways else 'IF'} {_spaced(self.condition)}"


@dataclass(frozen=True)
class Plain:
    """A clause that only its text matters of: @CYCLIC, @INVARIANT of a wrong guess."""

    words: str

    def text(self) -> str:
        return self.words


Clause = Union[Range, Require, Modal, Start, Ensure, EnsurePreserved, EnsureCodes, Assigns, Guarded, AlarmClause, Plain]


def _spaced(condition: Expression) -> str:
    if isinstance(condition, syntax.Relation):
        return f"{_side(condition.left)} {condition.operator} {_side(condition.right)}"
    if isinstance(condition, syntax.Joined):
        return f"[{_spaced(condition.left)}] {condition.operator} [{_spaced(condition.right)}]"
    return syntax.text(condition)


def _side(expression: Expression) -> str:
    if isinstance(expression, (syntax.Binary, syntax.Minus)):
        return f"[{syntax.text(expression)}]"
    return syntax.text(expression)


def broken_at_entry(clauses, evaluator, modes: dict, place) -> tuple:
    """The clauses that a call breaks; `place` tells a coordinate by its axis."""
    def is_kept(clause) -> bool:
        match clause:
            case Range():
                return clause.allows(evaluator.read(clause.variable), evaluator)
            case Require(condition):
                return evaluator.holds(condition)
            case Modal(codes):
                return all(modes.get(controls.GROUP_OF[code]) == code for code in codes)
            case Start(places):
                return all(place(axis) == value for axis, value in places)
        return True
    return tuple(clause for clause in clauses if not is_kept(clause))


def foresees(clauses, number) -> bool:
    return any(isinstance(clause, AlarmClause) and clause.number == number for clause in clauses)
