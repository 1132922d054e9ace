"""Runs against claims: each contradiction says which claim, which run, and why."""
from dataclasses import dataclass
from fractions import Fraction

from . import contracts
from . import controls
from . import syntax
from .choices import Choices
from engine import Claim, Proofs

from .files import line_of
from .machine import Inputs, Machine, Outcome
from .values import Arithmetic, ControlAlarm, Evaluator, Model, Unmodelled, number_of

# What the claims of a stop are called by the engine, for each kind of stop.
ALARM_WORDS = {
    "divided by zero": ("PS0112", "P283", "divided by zero"),
    "out of domain": ("PS0119", "P282", "argument", "111"),
    "label": ("PS0128", "PS1128", "PS0078", "P231", "label", "sequence number", "jump"),
    "END without DO": ("PS1124", "124", "P294", "END", "DO"),
    "DO without END": ("PS0124", "P294", "END"),
    "variable": ("PS0115", "P241", "variable"),
    "write": ("PS0116", "PS0115", "P241", "P243", "writ", "read-only"),
    "G67 without G66": ("PS1100", "P276", "G67"),
    "end of record": ("PS5010", "end"),
}


@dataclass
class Contradiction:
    what: str  # one line
    kind: str  # for counts: the kind of the claim and how it is wrong
    program: int  # that was started
    inputs: Inputs
    choices: dict
    claim: Claim = None
    rounds: bool = False


class Judge:
    """Of one project and what is proved of it."""

    def __init__(self, project: syntax.Project, proofs: Proofs, counts):
        self.project, self.proofs, self.counts = project, proofs, counts
        self.found: list[Contradiction] = []

    def run(self, program: syntax.Program, inputs: Inputs, choices: Choices, rng, fuel=1500) -> Outcome:
        outcome = Machine(self.project, inputs, choices, fuel, random=rng).run(program)
        self.counts["runs"] += 1
        self.counts["runs that end by " + outcome.end] += 1
        self.outcome, self.inputs, self.root = outcome, inputs, program
        if outcome.root is not None:
            self.judge(outcome.root)
        return outcome

    def add(self, kind: str, what: str, claim=None):
        self.found.append(Contradiction(what, kind, self.root.number, self.inputs, dict(self.outcome.choices), claim,
                                        self.outcome.inexact))

    def line(self, activation, block: int) -> int:
        return line_of(self.project, activation.program.number, block)

    # ---- an activation as a run of its program ----

    def judge(self, activation):
        """Of an activation whose contract is kept; those within it first."""
        if activation.broken:
            self.guarded(activation)
            return
        for child in activation.children:
            if not child.broken:
                if not is_typed(child):
                    continue
                if child.is_standard:
                    self.judge(child)
                else:
                    self.excused_or_judged(activation, child)
            else:
                self.broken_call(activation, child)
        self.unreachable(activation)
        self.assigned(activation)
        if activation.ended == "return" or activation.ended == "end" and activation.parent is None:
            self.returned(activation)
        self.stopped(activation)
        self.endless(activation)

    def excused_or_judged(self, caller, child):
        """A callee is begun as its own claims do not foresee (a modal call is active): its caller must say so."""
        if not self.call_claims_hold(caller, child):
            return
        before = len(self.found)
        self.judge(child)
        for each in self.found[before:]:
            each.kind = "assumption of a callee: " + each.kind
            each.what += f"; O{child.program.number} was begun under modal calls of {child.entry_modal_calls}"

    def call_claims_hold(self, caller, child) -> bool:
        """Nothing open is said of the call, or of any modal call."""
        number = caller.program.number
        if not self.proofs.is_complete(number):
            return False
        return all(claim.holds for claim in self.proofs.of(number, "call-meets-contract")) and \
            (caller.parent is None or not caller.entry_modal_calls or self.call_claims_hold(caller.parent, caller))

    def broken_call(self, caller, child):
        number, line, breach = caller.program.number, self.line(caller, child.called_from), child.broken[0].text()
        if not caller.is_standard:
            # What fires here comes from further out: anyone in between may own the open claim.
            if not self.call_claims_hold(caller, child):
                return
            self.add("assumption of a callee: call-meets-contract",
                     f"O{child.program.number} is called at line {line} of O{number} against {breach}, and every "
                     "call is claimed to meet its contract")
            return
        if not self.proofs.is_complete(number):
            return
        claims = [c for c in self.proofs.of(number, "call-meets-contract") if not is_about_typed(c)]
        here = [c for c in claims if c.line == line]
        modal = [c for c in claims if not c.holds]
        if here and all(c.holds for c in here) and not self.is_modal(caller, child, modal):
            self.add("call-meets-contract", f"O{child.program.number} is called at line {line} against {breach}, "
                     f"and {here[0].id} is {here[0].verdict}", here[0])
        elif not here and not modal:
            self.add("call-meets-contract missing", f"O{child.program.number} is called at line {line} of O{number} "
                     f"against {breach}, and nothing is claimed of it")

    def is_modal(self, caller, child, unproved) -> bool:
        """A modal call may be charged to the G66 block."""
        statement = caller.program.blocks[child.called_from].statement
        return isinstance(statement, syntax.Words) and bool(unproved)

    # ---- single claims ----

    def unreachable(self, activation):
        number = activation.program.number
        for claim in self.proofs.claims.get(number, []):
            if claim.verdict != "unreachable" or claim.kind in ("ensures", "modal-preserved", "assigns", "alarm-iff",
                                                                 "guarded", "program-ends", "contract-satisfiable"):
                continue
            for block in activation.visited:
                if self.line(activation, block) == claim.line and self.is_reached(activation, block, claim):
                    beside = any(c.kind == claim.kind and c.line == claim.line and not c.holds
                                 for c in self.proofs.claims[number])
                    self.add(f"{claim.kind} unreachable{' beside an open row' if beside else ''}", f"{claim.id} is unreachable ({claim.text}), and a run comes to "
                             f"line {claim.line}", claim)
                    break

    @staticmethod
    def is_reached(activation, block: int, claim: Claim) -> bool:
        """Behind a condition that did not hold nothing was reached."""
        return block in activation.taken or \
            not isinstance(activation.program.blocks[block].statement, (syntax.IfThen, syntax.IfGoto))

    def assigned(self, activation):
        number = activation.program.number
        claims = [c for c in self.proofs.of(number, "assigns") if c.holds]
        if not claims:
            return
        clauses = [c for c in activation.program.clauses if isinstance(c, contracts.Assigns)]
        ranges = [r for c in clauses for r in c.variables]
        for variable, (where, block) in activation.written.items():
            if not any(a <= variable <= b for a, b in ranges):
                what = "common" if controls.is_common(variable) else "system"
                self.add(f"assigns ({what} variable, {claims[0].verdict})",
                         f"{claims[0].id} is {claims[0].verdict}, and #{variable} is written in line "
                         f"{self.line(where, block)} of O{where.program.number}", claims[0])
                return

    def returned(self, activation):
        number = activation.program.number
        state = activation.exit_state
        for claim in self.proofs.claims.get(number, []):
            if not claim.holds:
                continue
            if claim.kind == "ensures" and claim.verdict == "unreachable":
                self.add("ensures unreachable", f"{claim.id} is unreachable, and O{number} returns", claim)
            elif claim.kind == "ensures":
                clause = self.clause_of(activation.program, claim)
                if clause is not None and not self.ensured(activation, clause):
                    self.add("ensures", f"{claim.id} is proved ({claim.text}), and does not hold on return", claim)
            elif claim.kind == "modal-preserved":
                self.preserved(activation, claim, state)
        for clause in activation.program.clauses:
            if isinstance(clause, contracts.AlarmClause):
                self.alarm_clause(activation, clause, None)

    @staticmethod
    def clause_of(program, claim):
        """By its words: the claim of a promise has them."""
        def squeezed(text):
            return text.replace(" ", "")
        return next((c for c in program.clauses if squeezed(c.text()) == squeezed(claim.text)), None)

    def ensured(self, activation, clause) -> bool:
        state = activation.exit_state
        if isinstance(clause, contracts.EnsureCodes):
            return all(state.modes[controls.GROUP_OF[c]] == c for c in clause.codes)
        if not isinstance(clause, contracts.Ensure):
            return True
        return self.holds_at(clause.condition, activation, state.cells, state.locals, state.tool,
                             Fraction(1, 1000) if Model.doubles else Fraction(0))

    def holds_at(self, condition, activation, cells, locals_, tool, tolerance=Fraction(0)) -> bool:
        entry_tool = activation.entry_tool

        def position(when, axis):
            coordinates = (tool if when == "POS" else entry_tool).coordinates
            if coordinates is None:
                raise Unmodelled("another zero point")
            return coordinates[controls.AXES.index(axis)]
        arithmetic = Arithmetic(Choices(given=self.outcome.choices), tolerance)
        evaluator = Evaluator(arithmetic, reader(locals_, cells), reader(activation.entry_locals, activation.entry_cells),
                              position)
        try:
            return evaluator.holds(condition)
        except (ControlAlarm, Unmodelled):
            return True

    def preserved(self, activation, claim, state):
        changed = [code for group, code in state.modes.items() if activation.entry_modes.get(group) != code]
        if changed:
            self.add("modal-preserved", f"{claim.id} is {claim.verdict}, and O{activation.program.number} returns in "
                     f"{' '.join(changed)}", claim)
        elif state.modal_calls != activation.entry_modal_calls:
            self.add("modal-preserved (modal call)", f"{claim.id} is {claim.verdict}, and modal calls are "
                     f"{state.modal_calls}, were {activation.entry_modal_calls}", claim)
        else:
            clause = self.clause_of(activation.program, claim)
            words = dict(set(state.tool.registers) - set(activation.entry_tool.registers))
            words = {letter: value for letter, value in words.items() if letter not in clause.excepted}
            if words:
                self.add("modal-preserved (words)", f"{claim.id} is {claim.verdict}, and other words are in force: {words}",
                         claim)

    def alarm_clause(self, activation, clause, alarm):
        """Of a run that ended by `alarm`, or by none."""
        claims = [c for c in self.proofs.of(activation.program.number, "alarm-iff")
                  if c.holds and self.clause_of(activation.program, c) == clause]
        if not claims:
            return
        condition = self.holds_at(clause.condition, activation, activation.entry_cells, activation.entry_locals,
                                  activation.entry_tool)
        raised = alarm == clause.number
        if condition and not raised or clause.both_ways and raised and not condition:
            self.add("alarm-iff", f"{claims[0].id} is {claims[0].verdict} ({claims[0].text}), and the alarm "
                     f"{'comes' if raised else 'does not come'}", claims[0])

    # ---- how the run ended ----

    def stopped(self, activation):
        outcome = self.outcome
        if outcome.end not in ("alarm", "user-alarm") or not self.is_open(activation):
            return
        for clause in activation.program.clauses:
            if isinstance(clause, contracts.AlarmClause):
                self.alarm_clause(activation, clause, outcome.alarm if outcome.end == "user-alarm" else None)
        if outcome.activation is not activation:
            return
        number, line = activation.program.number, self.line(activation, outcome.block)
        if outcome.end == "user-alarm" and contracts.foresees(activation.program.clauses, outcome.alarm):
            return
        kind = "alarm-unreachable" if outcome.end == "user-alarm" else "no-control-alarm"
        claims = [c for c in self.proofs.of(number, kind) if c.line == line]
        named = [c for c in claims if kind == "alarm-unreachable" or any(w in c.text for w in ALARM_WORDS[outcome.alarm])]
        if named and all(c.holds for c in named):
            self.add(f"{kind} {named[0].verdict}", f"{named[0].id} is {named[0].verdict} ({named[0].text}), and the run "
                     f"stops there: {outcome.alarm}", named[0])
        elif not named and all(c.holds for c in claims) and self.proofs.is_complete(number):
            self.add(f"{kind} missing: {outcome.alarm}", f"O{number} stops at line {line}: {outcome.alarm}, and nothing is claimed of it")

    def is_open(self, activation) -> bool:
        each = self.outcome.activation
        while each is not None and each is not activation:
            each = each.parent
        return each is activation

    def endless(self, activation):
        if self.outcome.end != "endless" or activation not in self.outcome.lasting:
            return
        number = activation.program.number
        where = f"a state comes back at line {self.line(self.outcome.activation, self.outcome.block)}"
        for claim in self.proofs.of(number, "program-ends"):
            if claim.holds:
                self.add("program-ends", f"{claim.id} is {claim.verdict}, and {where}", claim)
        lines = {self.line(each, block) for each, block in self.outcome.cycle if each is activation}
        heads = [c for c in self.proofs.of(number, "loop-ends") if c.line in lines]
        if heads and all(c.holds for c in heads) and self.outcome.activation is activation:
            self.add("loop-ends", f"{heads[0].id} is {heads[0].verdict}, and {where}", heads[0])

    def guarded(self, activation):
        claims = [c for c in self.proofs.of(activation.program.number, "guarded") if c.holds]
        guard = next((c for c in activation.program.clauses if isinstance(c, contracts.Guarded)), None)
        if not claims or not activation.is_standard or any(guard.leaves(clause) for clause in activation.broken):
            return
        if activation.moves or activation.ended:
            breach = activation.broken[0].text()
            self.add(f"guarded ({breach.split()[0]})", f"{claims[0].id} is {claims[0].verdict}, the call breaks {breach}, "
                     f"and {'an axis moves' if activation.moves else 'it ends'}", claims[0])


def is_about_typed(claim) -> bool:
    """A call, and not against a contract."""
    return "numbers of at most 8 digits" in claim.text


def is_typed(activation) -> bool:
    """In doubles, what a call passes is taken to be a number of 8 digits."""
    values = (*activation.entry_locals.values(), *activation.entry_cells.values())
    return not Model.doubles or all(Fraction(1, 10 ** 8) <= abs(value) <= 99999999 for value in values if value)


def reader(locals_, cells):
    def read(number):
        if number == 0:
            return None
        if controls.is_local(number):
            return locals_.get(number)
        if controls.is_common(number):
            return cells.get(number)
        cell = controls.canonical(number)
        if controls.is_offset(cell):
            return number_of(cells.get(cell))
        raise Unmodelled(f"#{number}")
    return read
