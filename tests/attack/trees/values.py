"""Numbers of a control, exact: vacant is None, all else a fraction.

What has no exact result (a sine, most roots) becomes the nearest fraction of a double, and the run is marked `inexact`;
what a double cannot hold exactly is marked `rounds`, so that machines that compute in doubles are told apart soundly.
"""
import math
from fractions import Fraction

from . import syntax
from .controls import is_common

HALF = Fraction(1, 2)


class Model:
    """Of numbers: fractions, or doubles as the control computes with (docs/arithmetic.md)."""

    doubles = False

    @classmethod
    def held(cls, value):
        return Fraction(float(value)) if cls.doubles and value is not None else value


class ControlAlarm(Exception):
    """A stop by the control; kinds are words of these tests, by meaning."""

    def __init__(self, kind: str):
        super().__init__(kind)
        self.kind = kind


class Unmodelled(Exception):
    """Facts do not say what comes now: the run is judged up to here."""


def number_of(value) -> Fraction:
    """Vacant counts as 0 in arithmetic."""
    return Fraction(0) if value is None else value


def nearest(value: Fraction, choices) -> int:
    """Halves away from zero; of negative ones not all manuals say so."""
    if value >= 0:
        return math.floor(value + HALF)
    if (value * 2).denominator == 1 and value.denominator == 2:
        return math.floor(value) if choices.choose("negative-half", ("away", "up")) == "away" else math.ceil(value)
    return -math.floor(-value + HALF)


def least_increment(value: Fraction) -> Fraction:
    """A coordinate, as the machine rounds it: steps of 0.001, halves away from zero."""
    if not Model.doubles:
        return value
    steps = Fraction(float(value) * 1000.0)
    whole = math.floor(abs(steps) + HALF)
    return Fraction((whole if steps >= 0 else -whole) / 1000.0)


def fits_double(value: Fraction) -> bool:
    denominator = value.denominator
    return denominator & (denominator - 1) == 0 and abs(value.numerator) < 2 ** 53 and denominator < 2 ** 1000


class Arithmetic:
    def __init__(self, choices, tolerance=Fraction(0)):
        """`tolerance`: within which EQ holds."""
        self.choices = choices
        self.tolerance = tolerance
        self.rounds = False
        self.inexact = False

    def noted(self, value: Fraction) -> Fraction:
        if Model.doubles:
            if value and not Fraction(1, 10 ** 300) < abs(value) < 10 ** 300:
                raise Unmodelled("a number too large or too small")
            return Fraction(float(value))
        if not fits_double(value):
            self.rounds = True
        if abs(value) > 10 ** 12 or value.denominator > 10 ** 15:
            raise Unmodelled("a number too large, too small or too long")
        return value

    def binary(self, operator: str, left, right) -> Fraction:
        a, b = number_of(left), number_of(right)
        match operator:
            case "+":
                return self.noted(a + b)
            case "-":
                return self.noted(a - b)
            case "*":
                return self.noted(a * b)
            case "/":
                if b == 0:
                    raise ControlAlarm("divided by zero")
                return self.noted(a / b)
            case "MOD":
                a, b = nearest(a, self.choices), nearest(b, self.choices)
                if b == 0:
                    raise ControlAlarm("divided by zero")
                return Fraction(abs(a) % abs(b) * (1 if a >= 0 else -1))
            case "AND" | "OR" | "XOR":
                a, b = nearest(a, self.choices), nearest(b, self.choices)
                if max(abs(a), abs(b)) >= 2 ** 31:
                    raise Unmodelled("integers of more than 32 bits")
                return Fraction(a & b if operator == "AND" else a | b if operator == "OR" else a ^ b)
        raise ValueError(operator)

    def function(self, name: str, operand) -> Fraction:
        a = number_of(operand)
        match name:
            case "ABS":
                return abs(a)
            case "FIX":
                return Fraction(math.trunc(a))
            case "FUP":
                return Fraction(math.floor(a) if a < 0 else math.ceil(a))
            case "ROUND":
                return Fraction(nearest(a, self.choices))
            case "SQRT":
                if a < 0:
                    raise ControlAlarm("out of domain")
                return self.root(a)
            case "LN":
                if a <= 0:
                    raise ControlAlarm("out of domain")
                return self.approximate(math.log(a)) if a != 1 else Fraction(0)
            case "ASIN" | "ACOS":
                if abs(a) > 1:
                    raise ControlAlarm("out of domain")
                raise Unmodelled("inverse sine by parameter")
            case "SIN" | "COS":
                if Model.doubles and a % 90 != 0:
                    return self.approximate((math.sin if name == "SIN" else math.cos)(math.radians(a % 360)))
                exact = {("SIN", 0): 0, ("SIN", 90): 1, ("SIN", 180): 0, ("SIN", 270): -1, ("COS", 0): 1,
                         ("COS", 90): 0, ("COS", 180): -1, ("COS", 270): 0, ("SIN", 30): HALF, ("SIN", 150): HALF,
                         ("COS", 60): HALF, ("COS", 300): HALF}.get((name, a % 360))
                if exact is not None:
                    self.rounds = True  # on a machine of doubles they may be off
                    return Fraction(exact)
                return self.approximate((math.sin if name == "SIN" else math.cos)(math.radians(a)))
        raise ValueError(name)

    def root(self, a: Fraction) -> Fraction:
        if Model.doubles:
            return Fraction(math.sqrt(a))
        top, bottom = math.isqrt(a.numerator), math.isqrt(a.denominator)
        if top * top == a.numerator and bottom * bottom == a.denominator:
            return Fraction(top, bottom)
        return self.approximate(math.sqrt(a))

    def approximate(self, value: float) -> Fraction:
        self.inexact = self.rounds = True
        if Model.doubles:
            return Fraction(value)
        return Fraction(value).limit_denominator(10 ** 12)

    def holds(self, operator: str, left, right) -> bool:
        """EQ and NE tell vacant from 0, all other comparisons do not."""
        if operator in ("EQ", "NE"):
            equal = (left is None) == (right is None) and abs(number_of(left) - number_of(right)) <= self.tolerance
            return equal == (operator == "EQ")
        a, b = number_of(left), number_of(right)
        return {"GT": a > b, "GE": a >= b, "LT": a < b, "LE": a <= b}[operator]


class Evaluator:
    """Of expressions, with some way to read variables."""

    def __init__(self, arithmetic: Arithmetic, read, old=None, position=None):
        self.arithmetic = arithmetic
        self.read = read  # of a number
        self.old = old
        self.position = position

    def index(self, variable: syntax.Variable) -> int:
        if isinstance(variable.index, int):
            return variable.index
        value = self.value(variable.index)
        if value is None:
            raise Unmodelled("#[..] of a vacant value")
        return nearest(value, self.arithmetic.choices)

    def value(self, expression: syntax.Expression):
        match expression:
            case syntax.Number(value):
                if Model.doubles:
                    return Model.held(value)
                if not fits_double(value):
                    self.arithmetic.rounds = True
                return value
            case syntax.Variable():
                return self.read(self.index(expression))
            case syntax.Minus(operand):
                return -number_of(self.value(operand))
            case syntax.Binary(operator, left, right):
                first, second = self.value(left), self.value(right)
                return self.arithmetic.binary(operator, first, second)
            case syntax.Function(name, operand):
                return self.arithmetic.function(name, self.value(operand))
            case syntax.AtEntry(variable):
                return self.old(self.index(variable))
            case syntax.Position(when, axis):
                return self.position(when, axis)
        raise TypeError(expression)

    def holds(self, condition: syntax.Expression) -> bool:
        match condition:
            case syntax.Relation(operator, left, right):
                first, second = self.value(left), self.value(right)
                return self.arithmetic.holds(operator, first, second)
            case syntax.Joined(operator, left, right):
                first, second = self.holds(left), self.holds(right)
                return {"AND": first and second, "OR": first or second, "XOR": first != second}[operator]
        raise TypeError(condition)
