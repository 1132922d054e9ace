"""Refuted claims: the run that is told must break the claim on this machine, too, in one of the ways left open."""
import random
from dataclasses import replace

from . import contracts
from . import controls
from . import syntax
from .choices import Choices
from engine import Claim, Proofs

from .files import line_of, witness_inputs
from .inputs import is_allowed
from .judge import Contradiction, Judge, is_about_typed, is_typed

SWITCHES = {
    "negative-half": ("away", "up"),
    "left-loop-is-forgotten": (True, False),
    "minus-vacant-word": ("dropped", "zero"),
    "repeat-keeps-locals": (True, False),
    "return-to-label-ends-repeats": (True, False),
    "m99-p-of-a-main-program": (True, False),
    "nested-modal-calls": ("last-first",),
    "no-distance-is-a-movement": (True, False),
    "g67-alone-stops": (True, False),
    "do-without-end-stops-at-do": (True, False),
}


def all_choices(asked: dict):
    settings = [{}]
    for name in sorted(asked):
        settings = [{**each, name: option} for each in settings for option in SWITCHES.get(name, (asked[name],))]
    return settings[:32]


def idle_witness(project: syntax.Project, claim: Claim, counts):
    """A contradiction, or None."""
    program = next(p for p in project.programs() if p.number == claim.program)
    inputs = witness_inputs(claim.witness)
    if inputs is None or claim.kind in ("keep-in", "keep-out", "clearance", "travel", "limit", "contract-satisfiable"):
        return None
    with_modes(program, inputs)
    if claim.kind != "guarded" and not is_allowed(program, inputs):
        return Contradiction(f"{claim.id} is refuted by a call that the contract does not allow: {claim.witness['run']}",
                             f"refuted: {claim.kind}, outside of the contract", claim.program, inputs, {}, claim)
    counts["witnesses"] += 1
    asked = {}
    tried = []
    for given in [{}] + [None] * 31:
        if given is None:
            rest = [c for c in all_choices(asked) if c not in tried]
            if not rest:
                break
            given = rest[0]
        tried.append(given)
        judge = Judge(project, Proofs({claim.program: [replace(claim, verdict="proved")]}, {}, []),
                      counts)
        outcome = judge.run(program, inputs, Choices(given=given), random.Random(0), fuel=20000)
        asked.update(outcome.choices)
        by_rounding = outcome.rounds and "rounds" in claim.witness["happened"]
        if outcome.end == "unmodelled" or outcome.inexact or by_rounding or any(c.claim is not None for c in judge.found):
            return None
        if stops_there(project, claim, outcome) or \
                claim.kind == "call-meets-contract" and called_there(project, claim, outcome.root):
            return None
        if claim.kind in ("loop-ends", "program-ends") and outcome.end in ("endless", "fuel"):
            return None
    return Contradiction(f"{claim.id} is refuted ({claim.text}), and its run breaks nothing: {claim.witness['run']}; it "
                         f"ends by {outcome.end} {outcome.alarm if outcome.alarm is not None else ''}",
                         f"refuted: {claim.kind}", claim.program, inputs, {}, claim, outcome.rounds)


def stops_there(project, claim, outcome) -> bool:
    """Also in a call of the program by itself, whatever its contract says of that call."""
    return claim.kind in ("alarm-unreachable", "no-control-alarm") and outcome.end in ("alarm", "user-alarm") and \
        outcome.activation.program.number == claim.program and \
        line_of(project, claim.program, outcome.block) == claim.line


def called_there(project, claim, activation) -> bool:
    """A call against a contract, somewhere within the call that the row is about."""
    is_bad = (lambda child: not is_typed(child)) if is_about_typed(claim) else lambda child: child.broken
    return any(called_there(project, claim, child) or is_bad(child) and is_within(project, claim, child)
               for child in activation.children)


def is_within(project, claim, activation) -> bool:
    caller = activation.parent
    return caller is not None and (
        caller.program.number == claim.program and line_of(project, claim.program, activation.called_from) == claim.line
        or is_within(project, claim, caller))


def with_modes(program, inputs):
    """What the contract says of the start, where the command leaves it to the contract."""
    for clause in program.clauses:
        if isinstance(clause, contracts.Modal):
            inputs.modes.update({controls.GROUP_OF[code]: code for code in clause.codes})
        elif isinstance(clause, contracts.Start):
            for axis, value in clause.places:
                inputs.place.setdefault(axis, value)
