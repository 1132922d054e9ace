"""Messages of `feedhold check` that say `never`, `always` or `stops`, against runs."""
import re
from dataclasses import dataclass

from wording import require_on_pages
from . import syntax
from .files import file_of, line_of


ALL_CALLS = ("decided-condition", "alarm-never-fires", "loop-never-entered")  # the others: of those that contracts allow
CALLER = re.compile(r"`O(\d+)` has no")


@dataclass(frozen=True)
class Message:
    rule: str
    text: str
    file: str
    line: int


class MessageJudge:
    """Of the programs that no other calls, from any inputs: such messages are about all calls."""

    def __init__(self, project, messages, counts):
        self.project, self.counts = project, counts
        self.by_line = {}
        for message in (Message(*each) for each in messages):
            if any(row.rule == message.rule and re.search(row.text, message.text) for row in ROWS):
                self.by_line.setdefault((message.file, message.line), []).append(message)
                counts["messages that say never, always or stops"] += 1

    def wrong(self, outcome):
        """(message, why) of the first one that a run contradicts."""
        if not self.by_line or outcome.root is None:
            return None
        todo = [outcome.root]
        while todo:
            activation = todo.pop()
            todo += activation.children
            if not activation.is_standard:
                continue
            name = file_of(self.project, activation.program.number).name
            for block in activation.visited:
                line = line_of(self.project, activation.program.number, block)
                for message in self.by_line.get((name, line), ()):
                    for row in ROWS:
                        if row.rule == message.rule and re.search(row.text, message.text) and \
                                (row.rule in ALL_CALLS or is_allowed(activation)) and \
                                is_about(message, activation) and row.is_wrong(activation, block, outcome):
                            return message, row.why
        return None


def is_allowed(activation) -> bool:
    return not activation.broken and (activation.parent is None or is_allowed(activation.parent))


def is_about(message, activation) -> bool:
    """A return to a label that one caller does not have may find it in another."""
    caller = CALLER.search(message.text)
    return not caller or activation.parent is not None and activation.parent.program.number == int(caller[1])


@dataclass(frozen=True)
class Row:
    rule: str
    text: str
    is_wrong: object  # (activation, block, outcome)
    why: str


def has_ended(activation, block, outcome) -> bool:
    return outcome.end in ("return", "M30", "alarm", "user-alarm")


def has_left(activation, block, outcome) -> bool:
    return outcome.end in ("return", "M30")


def went_on(activation, block, outcome) -> bool:
    statement = activation.program.blocks[block].statement
    is_conditional = isinstance(statement, (syntax.IfThen, syntax.IfGoto))
    return block in activation.passed and (not is_conditional or block in activation.taken)


def once_in(activation, block, outcome) -> bool:
    return block in activation.taken and has_ended(activation, block, outcome)


def once_in_left(activation, block, outcome) -> bool:
    return block in activation.taken and has_left(activation, block, outcome)


ROWS = (
    Row("decided-condition", "never true", lambda a, b, o: b in a.taken, "it held"),
    Row("decided-condition", "always true", lambda a, b, o: b in a.refused, "it did not hold"),
    Row("constant-condition", "never true", lambda a, b, o: b in a.taken, "it was true"),
    Row("constant-condition", "always true", lambda a, b, o: b in a.refused, "it was not"),
    Row("unreachable-block", "never executed", lambda a, b, o: True, "it was run"),
    Row("alarm-never-fires", "never raised",
        lambda a, b, o: o.end == "user-alarm" and o.activation is a and o.block == b, "it came"),
    Row("loop-never-entered", "never entered", lambda a, b, o: b in a.taken, "it was entered"),
    Row("endless-loop", "never ends", has_left, "the run left it"),
    Row("loop-without-progress", "never ends", once_in, "the run ended"),
    Row("loop-without-progress", "only an alarm ends", once_in_left, "the run left it"),
    Row("loop-in-wrong-direction", "in the wrong direction", once_in_left, "the run left it"),
    Row("division-by-zero", "^divides by zero", went_on, "it went on"),
    Row("out-of-domain", "is outside the range", went_on, "it went on"),
    Row("goto-missing-label", "has no target", went_on, "it went on"),
)
require_on_pages((row.rule, row.text) for row in ROWS)
