"""Programs as trees, and the text of a tree.

The generator makes trees and prints them; the interpreter runs the same trees.  Nothing here reads text, so that no
parser is shared with the engine that is judged.
"""
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Optional, Union

# ---- expressions ----


@dataclass(frozen=True)
class Number:
    value: Fraction

    def __post_init__(self):
        object.__setattr__(self, "value", Fraction(self.value))


@dataclass(frozen=True)
class Variable:
    index: Union[int, "Expression"]


@dataclass(frozen=True)
class Minus:
    operand: "Expression"


@dataclass(frozen=True)
class Binary:
    operator: str  # + - * / MOD AND OR XOR
    left: "Expression"
    right: "Expression"


@dataclass(frozen=True)
class Function:
    name: str
    operand: "Expression"


@dataclass(frozen=True)
class Relation:
    operator: str  # EQ NE GT GE LT LE
    left: "Expression"
    right: "Expression"


@dataclass(frozen=True)
class Joined:
    """Two conditions, each in brackets: `[#1 GT 0] AND [#2 GT 0]`.  Contracts only."""

    operator: str
    left: "Expression"
    right: "Expression"


@dataclass(frozen=True)
class AtEntry:
    variable: Variable  # OLD[#500]


@dataclass(frozen=True)
class Position:
    when: str  # POS or ENTRY
    axis: str


Expression = Union[Number, Variable, Minus, Binary, Function, Relation, Joined, AtEntry, Position]

_MULTIPLICATIVE = ("*", "/", "MOD", "AND")


def decimal(value: Fraction) -> str:
    """With a decimal point always: without one a control counts increments."""
    if value < 0:
        return "-" + decimal(-value)
    whole, rest = divmod(value, 1)
    digits = ""
    while rest:
        rest *= 10
        digits += str(int(rest))
        rest -= int(rest)
        if len(digits) > 6:
            raise ValueError(f"{value} has no short decimal form")
    return (str(int(whole)) if whole or not digits else "") + "." + digits


def _level(expression: Expression) -> int:
    if isinstance(expression, Binary):
        return 1 if expression.operator in _MULTIPLICATIVE else 0
    return 2


def text(expression: Expression) -> str:
    """As a FANUC reads it: `* / MOD AND` before `+ - OR XOR`, the same level from the left."""
    match expression:
        case Number(value):
            return decimal(value) if value.denominator != 1 else str(value)
        case Variable(index):
            return f"#{index}" if isinstance(index, int) else f"#[{text(index)}]"
        case Minus(operand):
            return f"-{text(operand)}" if isinstance(operand, Variable) else f"-[{text(operand)}]"
        case Function(name, operand):
            return f"{name}[{text(operand)}]"
        case Relation(operator, left, right):
            return f"{text(left)}{operator}{text(right)}"
        case Joined(operator, left, right):
            return f"[{text(left)}] {operator} [{text(right)}]"
        case AtEntry(variable):
            return f"OLD[{text(variable)}]"
        case Position(when, axis):
            return f"{when}[{axis}]"
        case Binary(operator, left, right):
            own = _level(expression)
            first = text(left) if _level(left) >= own else f"[{text(left)}]"
            second = text(right) if _level(right) > own and not text(right).startswith("-") else f"[{text(right)}]"
            return f"{first}{operator}{second}"
    raise TypeError(expression)


def word_text(letter: str, value: Expression, whole: bool) -> str:
    """A word of a block: `X2.5`, `X-#1`, `P10`, `Z[#1+1]`."""
    match value:
        case Number(number):
            return letter + (str(int(number)) if whole else decimal(number))
        case Variable():
            return letter + text(value)
        case Minus(Variable()):
            return letter + text(value)
    return f"{letter}[{text(value)}]"


def parts(expression: Expression):
    """The expression and all that is in it."""
    yield expression
    match expression:
        case Variable(index) if not isinstance(index, int):
            yield from parts(index)
        case Minus(operand) | Function(_, operand):
            yield from parts(operand)
        case Binary(_, left, right) | Relation(_, left, right) | Joined(_, left, right):
            yield from parts(left)
            yield from parts(right)
        case AtEntry(variable):
            yield from parts(variable)


# ---- statements ----


@dataclass(frozen=True)
class Assign:
    target: Variable
    value: Expression


@dataclass(frozen=True)
class Alarm:
    number: Expression  # #3000=n(X)


@dataclass(frozen=True)
class IfGoto:
    condition: Expression
    target: Expression


@dataclass(frozen=True)
class IfThen:
    condition: Expression
    statement: Union[Assign, Alarm]


@dataclass(frozen=True)
class While:
    condition: Optional[Expression]  # none: DO without WHILE
    number: int


@dataclass(frozen=True)
class End:
    number: int


@dataclass(frozen=True)
class Goto:
    target: Expression


@dataclass(frozen=True)
class Words:
    """G and M codes, then words: `G90G1X#1F100.`"""

    codes: tuple[str, ...]
    words: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True)
class Call:
    kind: str  # G65 G66 G66.1 M98 M97
    program: Expression
    repeats: Optional[Expression] = None
    arguments: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True)
class Return:
    target: Optional[Expression] = None  # M99 P


@dataclass(frozen=True)
class Nothing:
    """A block with a label only, or one with a comment."""

    comment: str = ""


Statement = Union[Assign, Alarm, IfGoto, IfThen, While, End, Goto, Words, Call, Return, Nothing]

WHOLE_LETTERS = frozenset("GMPLNOTDHS")


def _bracketed(expression: Expression) -> str:
    return text(expression) if isinstance(expression, (Number, Variable)) else f"[{text(expression)}]"


def _assigned(value: Expression) -> str:
    return text(value)


def statement_text(statement: Statement) -> str:
    match statement:
        case Assign(target, value):
            return f"{text(target)}={_assigned(value)}"
        case Alarm(number):
            return f"#3000={text(number)}(ALARM)"
        case IfGoto(condition, target):
            return f"IF[{text(condition)}]GOTO{_bracketed(target)}"
        case IfThen(condition, inner):
            return f"IF[{text(condition)}]THEN{statement_text(inner)}"
        case While(None, number):
            return f"DO{number}"
        case While(condition, number):
            return f"WHILE[{text(condition)}]DO{number}"
        case End(number):
            return f"END{number}"
        case Goto(target):
            return f"GOTO{_bracketed(target)}"
        case Words(codes, words):
            return "".join(codes) + "".join(word_text(l, v, l in WHOLE_LETTERS) for l, v in words)
        case Call(kind, program, repeats, arguments):
            head = kind + word_text("P", program, True)
            if repeats is not None:
                head += word_text("L", repeats, True)
            return head + "".join(word_text(l, v, False) for l, v in arguments)
        case Return(None):
            return "M99"
        case Return(target):
            return "M99" + word_text("P", target, True)
        case Nothing(comment):
            return f"({comment})" if comment else ""
    raise TypeError(statement)


# ---- programs ----


@dataclass(frozen=True)
class Block:
    statement: Statement
    label: Optional[int] = None
    skip: bool = False

    def text(self) -> str:
        head = ("/" if self.skip else "") + (f"N{self.label}" if self.label is not None else "")
        return head + statement_text(self.statement)


@dataclass
class Program:
    number: int
    clauses: list = field(default_factory=list)  # of contracts.py
    blocks: list[Block] = field(default_factory=list)

    def lines(self) -> list[str]:
        return [f"O{self.number}"] + [f"({clause.text()})" for clause in self.clauses] + [b.text() for b in self.blocks]

    @property
    def first_block_line(self) -> int:
        """Behind the O word and the clauses, counted from the O word as line 0."""
        return 1 + len(self.clauses)


@dataclass
class SourceFile:
    name: str
    programs: list[Program]

    def text(self) -> str:
        return "".join(line + "\n" for program in self.programs for line in program.lines())


@dataclass
class Project:
    """Files of one folder, for one control."""

    dialect: str
    files: list[SourceFile]

    def programs(self):
        return [program for file in self.files for program in file.programs]
