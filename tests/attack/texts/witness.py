"""Refuted claims: the command is typed in, and the run has to break the claim on this machine as well."""
import collections
import re
import shlex
from dataclasses import replace
from fractions import Fraction as F

from .claims import SPACE, is_about_typed, is_typed, judge
from .contract import broken_at_entry, longest_tool, places, reckoner_at
from .machine import ARGUMENTS, Run, Start, cell_of, is_common
from .path import GROUPS, XYZ
from .starts import StateOf
from .switches import Switches, every_way


def start_of(command: str, text):
    """What the words of the command and the contract say of the start; None when they are not understood."""
    words = shlex.split(command)
    if "--input" in words: # these interpreters read 0
        return None
    start = Start(skip="--block-skip" in words)
    for _, clause in text.clauses():
        if clause.startswith("@MODAL"):
            start.modes.update({GROUPS[c]: c for c in clause.split()[1:] if c in GROUPS})
    for option, word in zip(words, words[1:]):
        if option == "--arg":
            letter, value = word.split("=")
            start.locals[ARGUMENTS[letter]] = F(value)
        elif option == "--var":
            name, value = word.split("=")
            if not name.isdigit():
                return None
            number, value = int(name), F(value)
            if number < 34:
                start.locals[number] = value
            elif is_common(number):
                start.cells[number] = value
            else:
                cell, bit = cell_of(number, "")
                if cell is None or bit is not None:
                    return None
                start.cells[cell] = value
    for _, clause in text.clauses():
        if clause.startswith("@START"):
            start.place.update(places(clause.split()[1:], reckoner_at(StateOf(start), Switches())))
    for option, word in zip(words, words[1:]):
        if option == "--start":
            if not re.fullmatch(r"[XYZ]-?[0-9.e-]+", word):
                return None
            start.place[word[0]] = F(word[1:])
        elif option == "--modal":
            code = re.sub(r"^G0(?=[0-9])", "G", word)
            if code not in GROUPS:
                return None
            start.modes[GROUPS[code]] = code
    start.spindle = longest_tool(text, reckoner_at(StateOf(start), Switches())) or F(0)  # as the engine tries it
    return start


def typed_in(claim, engine, counts):
    """What is wrong with the command itself: it must be accepted, and end where an alarm is told."""
    words = shlex.split(claim.witness["run"])[1:]
    counts["witnesses typed in"] += 1
    done = engine.try_run(words[1:] + ["--format", "json"])
    if done is None:
        return "its command is not accepted"
    if claim.kind in ("no-control-alarm", "alarm-unreachable") and (done["end"] != "alarm" or
                                                                   done["alarm"]["line"] != claim.line):
        return f"its command ends by {done['end']}"
    return None


def called_there(run, claim) -> bool:
    """A call against a contract, somewhere within the call that the row is about."""
    def is_within(visit):
        return visit.outer is not None and (
            visit.outer.text.number == claim.program and visit.from_line == claim.line or is_within(visit.outer))
    is_bad = (lambda visit: not is_typed(visit.entry)) if is_about_typed(claim) else \
        lambda visit: broken_at_entry(visit.text, visit.entry, run.ask)
    return any(is_within(visit) and is_bad(visit) for visit in run.visits)


def idle(files, dialect, text, claim, counts):
    """Why the run that is told breaks nothing; None when it does, or when it cannot be told."""
    start = start_of(claim.witness["run"], text)
    if start is None or claim.kind in ("contract-satisfiable",) or claim.kind in SPACE and claim.kind == "keep-in":
        return None
    counts["witnesses"] += 1
    believed = replace(claim, verdict="proved")
    last = ""
    for run in every_way(lambda ask: Run(files, dialect, start, ask, 20000).go(text.number), 24):
        if run.end == "unsaid" or run.reckoner.guessed or run.reckoner.rounded:
            return None
        if any(w.claim is believed for w in judge(run, lambda n: [believed] if n == text.number else [],
                                                  lambda n: True, collections.Counter())):
            return None
        if claim.kind == "call-meets-contract" and called_there(run, claim):
            return None
        if claim.kind in ("loop-ends", "program-ends") and run.end in ("endless", "fuel"):
            return None
        if claim.kind == "alarm-unreachable" and run.end == "alarm" and run.line == claim.line:
            return None  # raised where the program has called itself
        last = f"{run.end} {run.detail}"
    return f"its run breaks nothing, and ends by {last}"
