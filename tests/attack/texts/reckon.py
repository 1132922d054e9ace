"""Expressions of macro programs, reckoned from the text with two stacks: one of values, one of waiting operators.

Numbers are fractions and None is vacant.  Shares nothing with the interpreter of trees.
"""
import contextlib
import math
import re
from fractions import Fraction as F

NAMES = "SIN COS TAN ASIN ACOS ATAN SQRT ABS FIX FUP ROUND LN EXP OLD POS ENTRY".split()
INFIX = {"EQ": 1, "NE": 1, "GT": 1, "GE": 1, "LT": 1, "LE": 1, "+": 2, "-": 2, "OR": 2, "XOR": 2,
         "*": 3, "/": 3, "MOD": 3, "AND": 3}
PREFIX = 5
TOKEN = re.compile(r"\s*(\d+\.?\d*|\.\d+|" + "|".join(sorted(NAMES + [w for w in INFIX if w.isalpha()], key=len,
                                                              reverse=True)) + r"|[-+*/#\[\]]|[A-Z])")


class Model:
    """Of numbers: exact, or doubles, where each result is the double nearest to it (docs/arithmetic.md)."""

    doubles = False

    @classmethod
    def held(cls, value):
        return F(float(value)) if cls.doubles and value is not None else value


class Stop(Exception):
    """The control stops; `why` is a word of these tests."""

    def __init__(self, why):
        super().__init__(why)
        self.why = why


class Unsaid(Exception):
    """No fact tells what the control does here."""


def away(value: F, ask) -> int:
    """To the nearest whole number, halves away from 0; of halves below 0 this is not said."""
    low = math.floor(value)
    if value - low == F(1, 2):
        return low + 1 if value > 0 or ask("half below 0", ("away", "up")) == "up" else low
    return round(value)


def to_increment(value: F) -> F:
    """As words are rounded, halves away from 0; in doubles."""
    steps = float(value) * 1000.0
    return F(math.copysign(math.floor(abs(F(steps)) + F(1, 2)), steps) / 1000.0)


def of_angle(name, degrees) -> float:
    quarters = F(degrees) / 90 + (1 if name == "COS" else 0)
    if quarters.denominator == 1:
        return (0.0, 1.0, 0.0, -1.0)[int(quarters) % 4]
    turn = math.radians(F(degrees) % 360)
    return math.sin(turn) if name == "SIN" else math.cos(turn)


class Reckoner:
    """`read(number)` tells a variable; `special(name, operand)` answers for OLD, POS and ENTRY of contracts."""

    def __init__(self, read, ask, special=None, apart=F(0)):
        """`apart`: numbers that differ by no more are equal."""
        self.read, self.ask, self.special, self.apart = read, ask, special, apart
        self.step = F(1)  # to which ROUND rounds
        self.rounded = False  # a double would not do
        self.guessed = False  # by a function that has no exact value

    # ---- text to value ----

    def whole(self, text: str):
        value, end = self.reckon(text, 0, None)
        if text[end:].strip():
            raise Unsaid(f"text behind an expression: {text[end:]}")
        return value

    @contextlib.contextmanager
    def in_word(self):
        """ROUND rounds to the least increment of the address there; not in arguments."""
        self.step = F(1, 1000)
        yield
        self.step = F(1)

    def bracket(self, text: str, at: int):
        """From `[` on: the value and the place behind `]`."""
        return self.reckon(text, at + 1, "]")

    def reckon(self, text: str, at: int, until):
        values, waiting, operand_next = [], [], True
        while True:
            if not text[at:].strip():
                break
            match = TOKEN.match(text, at)
            if not match:
                break
            token = match[1]
            if token == "]":
                if "[" not in waiting:
                    break
                self.settle(values, waiting, 0)
                waiting.pop()
                operand_next = False
            elif token == "[":
                waiting.append("[")
                operand_next = True
            elif operand_next and token in "-+#":
                waiting.append("~" if token == "-" else token if token == "#" else "")
            elif operand_next and token in NAMES:
                if token == "OLD" or token in ("POS", "ENTRY"):
                    close = self.closing(text, text.index("[", match.end()))
                    inner = text[text.index("[", match.end()) + 1:close].strip()
                    values.append(self.special(token, inner))
                    operand_next = False
                    at = close + 1
                    continue
                waiting.append(token)
            elif operand_next and token[0] in "0123456789.":
                values.append(Model.held(F(token.rstrip(".") or "0") if not token.startswith(".") else F("0" + token)))
                operand_next = False
            elif operand_next and len(token) == 1 and token.isalpha():
                values.append(self.special("WORD", token))
                operand_next = False
            elif not operand_next and token in INFIX:
                self.settle(values, waiting, INFIX[token])
                waiting.append(token)
                operand_next = True
            else:
                break
            at = match.end()
        self.settle(values, waiting, 0)
        if waiting or len(values) != 1:
            raise Unsaid(f"no expression: {text}")
        if until:
            at = text.index(until, at) + 1
        return values[0], at

    @staticmethod
    def closing(text: str, at: int) -> int:
        depth = 0
        for place in range(at, len(text)):
            depth += {"[": 1, "]": -1}.get(text[place], 0)
            if depth == 0:
                return place
        raise Unsaid("brackets")

    def settle(self, values, waiting, rank: int):
        """Applies what binds as tightly as `rank` or more."""
        while waiting and waiting[-1] != "[" and self.rank(waiting[-1]) >= rank:
            operator = waiting.pop()
            if operator == "":
                continue
            if operator in INFIX:
                right, left = values.pop(), values.pop()
                values.append(self.infix(operator, left, right))
            else:
                values.append(self.prefix(operator, values.pop()))

    @staticmethod
    def rank(operator) -> int:
        return INFIX.get(operator, PREFIX)

    # ---- operators ----

    def kept(self, value: F) -> F:
        if Model.doubles:
            if value and not 1e-300 < abs(value) < 1e300:
                raise Unsaid("beyond what is modelled")
            return F(float(value))
        bits = value.denominator
        if bits & (bits - 1) or abs(value.numerator) >> 53:
            self.rounded = True
        if abs(value) > 10 ** 12 or bits > 10 ** 15:
            raise Unsaid("digits")
        return value

    def prefix(self, name, operand):
        if name == "#":
            if operand is None:
                raise Unsaid("# of vacant")
            return self.read(away(operand, self.ask))
        x = F(0) if operand is None else operand
        if name == "~":
            return -x
        if name == "ABS":
            return abs(x)
        if name == "FIX":
            return F(int(x))
        if name == "FUP":
            return F(-math.floor(-x) if x > 0 else math.floor(x))
        if name == "ROUND":
            if Model.doubles and self.step != 1:
                return to_increment(x)
            return self.step * away(x / self.step, self.ask)
        if name == "SQRT":
            if x < 0:
                raise Stop("domain")
            if Model.doubles:
                return F(math.sqrt(x))
            exact = F(math.isqrt(x.numerator), math.isqrt(x.denominator))
            return exact if exact * exact == x else self.guess(math.sqrt(x))
        if name in ("SIN", "COS"):
            if Model.doubles:
                return self.guess(of_angle(name, x))
            turn = (x + (90 if name == "COS" else 0)) % 360
            known = {0: 0, 30: F(1, 2), 90: 1, 150: F(1, 2), 180: 0, 210: F(-1, 2), 270: -1, 330: F(-1, 2)}
            self.rounded = True
            return F(known[turn]) if turn in known else self.guess(math.sin(math.radians(turn)))
        if name == "LN":
            if x <= 0:
                raise Stop("domain")
            return F(0) if x == 1 else self.guess(math.log(x))
        if name in ("ASIN", "ACOS", "TAN", "EXP") and Model.doubles:
            return self.curved(name, x)
        raise Unsaid(name)

    def curved(self, name, x):
        if name == "EXP":
            if x > 700:
                raise Stop("domain")
            return self.guess(math.exp(x))
        if name == "TAN":
            if abs(of_angle("COS", x)) < 1e-9:
                raise Unsaid("TAN near 90")
            return self.guess(math.tan(math.radians(x)))
        if abs(x) > 1:
            raise Stop("domain")
        angle = math.degrees((math.asin if name == "ASIN" else math.acos)(x))
        return self.guess(angle if angle >= 0 or self.ask("ASIN below 0", ("turned", "as it is")) == "as it is" else
                          angle + 360)

    def guess(self, value: float) -> F:
        self.guessed = self.rounded = True
        if Model.doubles:
            return F(value)
        return F(value).limit_denominator(10 ** 12)

    def infix(self, name, left, right):
        if isinstance(left, bool) or isinstance(right, bool):
            if not (isinstance(left, bool) and isinstance(right, bool)):
                raise Unsaid("a condition as a number")
            return {"AND": left and right, "OR": left or right, "XOR": left != right}[name]
        if name in ("EQ", "NE"):
            same = left == right if None in (left, right) else abs(left - right) <= self.apart
            return same if name == "EQ" else not same
        a, b = left or F(0), right or F(0)
        if INFIX[name] == 1:
            return {"G": a > b, "L": a < b}[name[0]] or name[1] == "E" and a == b
        if name in "+-*":
            return self.kept(a + b if name == "+" else a - b if name == "-" else a * b)
        if name == "/":
            if b == 0:
                raise Stop("zero divisor")
            return self.kept(a / b)
        m, n = away(a, self.ask), away(b, self.ask)
        if name == "MOD":
            if n == 0:
                raise Stop("zero divisor")
            return F(math.fmod(m, n))
        if max(abs(m), abs(n)) >= 1 << 31:
            raise Unsaid("32 bits")
        return F({"AND": m & n, "OR": m | n, "XOR": m ^ n}[name])
