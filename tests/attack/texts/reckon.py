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


class Reckoner:
    """`read(number)` tells a variable; `special(name, operand)` answers for OLD, POS and ENTRY of contracts."""

    def __init__(self, read, ask, special=None):
        self.read, self.ask, self.special = read, ask, special
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
                values.append(F(token.rstrip(".") or "0") if not token.startswith(".") else F("0" + token))
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
            return self.step * away(x / self.step, self.ask)
        if name == "SQRT":
            if x < 0:
                raise Stop("domain")
            exact = F(math.isqrt(x.numerator), math.isqrt(x.denominator))
            return exact if exact * exact == x else self.guess(math.sqrt(x))
        if name in ("SIN", "COS"):
            turn = (x + (90 if name == "COS" else 0)) % 360
            known = {0: 0, 30: F(1, 2), 90: 1, 150: F(1, 2), 180: 0, 210: F(-1, 2), 270: -1, 330: F(-1, 2)}
            self.rounded = True
            return F(known[turn]) if turn in known else self.guess(math.sin(math.radians(turn)))
        if name == "LN":
            if x <= 0:
                raise Stop("domain")
            return F(0) if x == 1 else self.guess(math.log(x))
        raise Unsaid(name)

    def guess(self, value: float) -> F:
        self.guessed = self.rounded = True
        return F(value).limit_denominator(10 ** 12)

    def infix(self, name, left, right):
        if isinstance(left, bool) or isinstance(right, bool):
            if not (isinstance(left, bool) and isinstance(right, bool)):
                raise Unsaid("a condition as a number")
            return {"AND": left and right, "OR": left or right, "XOR": left != right}[name]
        if name in ("EQ", "NE"):
            same = left == right if None in (left, right) else left - right == 0
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
