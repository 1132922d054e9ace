"""Messages of `check` with never, always or stops, against one run of a program that no other calls."""
import re

from wording import require_on_pages
from . import contract
from .claims import Wrong
from .reckon import Stop, Unsaid
from .switches import Switches

HELD, FAILED, RUN, PAST, OVER, LEFT = "held", "failed", "run", "past", "over", "left"
SAYINGS = (("decided-condition", "never true", HELD), ("decided-condition", "always true", FAILED),
           ("constant-condition", "never true", HELD), ("constant-condition", "always true", FAILED),
           ("unreachable-block", "never executed", RUN), ("loop-never-entered", "never entered", HELD),
           ("endless-loop", "never ends", LEFT), ("loop-without-progress", "never ends", OVER),
           ("loop-without-progress", "only an alarm ends", LEFT),
           ("loop-in-wrong-direction", "in the wrong direction", LEFT), ("alarm-never-fires", "never raised", "alarm"),
           ("division-by-zero", "divides by zero", PAST), ("out-of-domain", "is outside the range", PAST),
           ("goto-missing-label", "has no target", PAST))
require_on_pages((rule, text) for rule, text, _ in SAYINGS)
CONDITIONAL = re.compile(r"(WHILE|IF)\[")
# Of all calls; the others of those that contracts allow.
ALL_CALLS = ("decided-condition", "alarm-never-fires", "loop-never-entered")


def wrong_message(run, messages, counts) -> list:
    """`messages`: (rule, text, file, line)."""
    if not messages or not run.visits:
        return []
    visits = run.visits
    for rule, text, file, line in messages:
        saying = next((s for s in SAYINGS if s[0] == rule and s[1] in text), None)
        if saying is None:
            continue
        counts["messages judged"] += 1
        for visit in visits:
            if visit.text.file == file and not visit.modal_at_entry and is_about(text, visit) and \
                    shows(run, visit, line, saying[2]) and (rule in ALL_CALLS or is_allowed(run, visit)):
                return [Wrong(f"message {rule}", f"line {line}: {text}; but a run shows otherwise")]
    return []


def is_about(text, visit) -> bool:
    """Of `M99 P` it is said which caller lacks the label."""
    lacking = re.search(r"`O(\d+)` has no", text)
    return not lacking or visit.outer is not None and visit.outer.text.number == int(lacking[1])


def is_allowed(run, visit) -> bool:
    """By its contract and those of the programs that led to it."""
    try:
        return not contract.broken_at_entry(visit.text, visit.entry, Switches(run.ask.answers)) and \
            (visit.outer is None or is_allowed(run, visit.outer))
    except (Stop, Unsaid):
        return False


def shows(run, visit, line, how) -> bool:
    first, last = visit.text.first, visit.text.first + len(visit.text.lines)
    if not first <= line < last:
        return False
    if how == HELD:
        return line in visit.held
    if how == FAILED:
        return line in visit.failed
    if how == RUN:
        return line in visit.lines
    text = visit.text.lines[line - first]
    if how == PAST:
        return line in visit.done and ("IF[" not in text or line in visit.held)
    if how == "alarm":
        return run.end == "alarm" and run.where is visit and run.line == line
    ends = ("return", "end") if how == LEFT else ("return", "end", "stop", "alarm")
    return line in visit.lines and run.end in ends and \
        (not CONDITIONAL.search(text) or line in visit.held)
