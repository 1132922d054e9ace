"""What is claimed, against one run of the machine of texts."""
from dataclasses import dataclass

from . import contract
from .reckon import Model, Stop, Unsaid
from .space import Space, cut_depths, rng_of
from .switches import Switches

SPACE = ("keep-in", "keep-out", "clearance", "travel", "limit")
OF_WHOLE = ("ensures", "modal-preserved", "assigns", "alarm-iff", "guarded", "program-ends", "contract-satisfiable")
# The same stops in the words of the claims.
WORDS = {"zero divisor": ("PS0112", "P283", "divide"), "domain": ("PS0119", "P282", "argument", "111"),
         "no label": ("PS0128", "PS1128", "PS0078", "P231", "sequence", "jump", "label"), "no DO": ("1124", "P294", "END"),
         "no END": ("0124", "P294", "END"), "no variable": ("PS0115", "P241", "variable"),
         "not to be written": ("PS0116", "PS0115", "P241", "P243", "writ", "read"),
         "G67 alone": ("PS1100", "P276", "G67"), "text ends": ("PS5010", "end")}


@dataclass
class Wrong:
    kind: str
    what: str
    claim: object = None


def is_about_typed(claim) -> bool:
    """A call, and not against a contract."""
    return "numbers of at most 8 digits" in claim.text


def is_typed(entry) -> bool:
    """In the arithmetic of the control, what a call passes is taken to be a number of 8 digits."""
    return not Model.doubles or all(1e-8 <= abs(value) <= 99999999 for value in (*entry.locals.values(), *entry.cells.values())
                                    if value)


def region_of(claim) -> str:
    """What tells claims of one kind on one line apart."""
    return claim.text.split()[1 if claim.kind.startswith("keep") else 0]


def judge(run, claims_of, is_complete, counts) -> list:
    """`claims_of(number)`: the claims of a program.  All that the run contradicts."""
    return Judgement(run, claims_of, is_complete, counts).found


class Judgement:
    def __init__(self, run, claims_of, is_complete, counts):
        self.run, self.claims_of, self.is_complete, self.counts = run, claims_of, is_complete, counts
        self.again = Switches(run.ask.answers)
        self.found = []
        self.good = {}
        for visit in run.visits:
            self.good[visit] = self.is_good(visit)
            if self.good[visit]:
                self.one_visit(visit)

    def add(self, kind, what, claim=None):
        self.found.append(Wrong(kind, what, claim))

    def is_good(self, visit) -> bool:
        """Its own claims have to hold; a call against the contract is looked at here."""
        if visit.outer is not None and not (self.good[visit.outer] and is_typed(visit.entry)):
            return False
        try:
            broken = contract.broken_at_entry(visit.text, visit.entry, self.again)
            broken = broken or self.starts_inside(visit)
        except (Stop, Unsaid, TypeError):
            return False
        if broken and visit.outer is not None:
            self.bad_call(visit, broken[0])
        elif broken and not visit.modal_at_entry:
            self.guarded(visit, broken)
        return not broken and not visit.modal_at_entry

    def starts_inside(self, visit) -> list:
        heads = [clause for _, clause in contract.of(visit.text, "@KEEPOUT")]
        return heads[:1] if heads and Space(visit.text, visit.entry, self.again).has_start_inside(visit.text, visit.entry) else []

    def kind(self, visit, kind):
        return [c for c in self.claims_of(visit.text.number) if c.kind == kind]

    def bad_call(self, visit, breach):
        number = visit.outer.text.number
        if not self.is_complete(number):
            return
        claims = [c for c in self.kind(visit.outer, "call-meets-contract") if not is_about_typed(c)]
        here = [c for c in claims if c.line == visit.from_line]
        elsewhere_open = any(not c.holds for c in claims)
        if here and all(c.holds for c in here) and not (elsewhere_open and self.run.modal):
            self.add("call-meets-contract", f"O{visit.text.number} is called at line {visit.from_line} against {breach}, "
                     f"and {here[0].id} is {here[0].verdict}", here[0])
        elif not here and not elsewhere_open:
            self.add("call-meets-contract missing", f"O{visit.text.number} is called at line {visit.from_line} of "
                     f"O{number} against {breach}, and nothing is claimed of it")

    def guarded(self, visit, broken):
        strokes = len(self.run.tool.strokes) > visit.first_stroke
        heads = {clause.split()[0][1:] for clause in broken}
        for claim in self.kind(visit, "guarded"):
            if claim.holds and (strokes or visit.left) and not heads & set(contract.excepted(claim.text)):
                self.add("guarded", f"{claim.id} is {claim.verdict}, the start breaks {broken[0]}, and "
                         f"{'it moves' if strokes else 'it ends'}", claim)

    # ---- a visit whose contract is kept ----

    def one_visit(self, visit):
        self.reached(visit)
        self.assigned(visit)
        if visit.left == "return" or visit.left == "end" and visit.outer is None:
            self.left(visit)
        self.ended(visit)
        if visit.outer is None:
            self.space(visit)

    def reached(self, visit):
        for claim in self.claims_of(visit.text.number):
            if claim.verdict != "unreachable" or claim.kind in OF_WHOLE or claim.line not in visit.lines:
                continue
            text = visit.text.lines[claim.line - visit.text.first]
            if "IF[" in text and claim.line not in visit.held:
                continue
            if claim.kind == "call-meets-contract" and claim.line not in visit.done and self.run.line == claim.line:
                continue  # stopped before the call
            self.add(f"{claim.kind} unreachable", f"{claim.id} is unreachable ({claim.text}), and line {claim.line} is run",
                     claim)
            return

    def assigned(self, visit):
        claims = [c for c in self.kind(visit, "assigns") if c.holds]
        if not claims:
            return
        allowed = set()
        for _, clause in contract.of(visit.text, "@ASSIGNS"):
            for word in clause.split()[1:]:
                ends = [int(e[1:]) for e in word.split("..")] if word != "NOTHING" else []
                allowed |= set(range(ends[0], ends[-1] + 1)) if ends else set()
        for number, (where, line) in visit.written.items():
            if number not in allowed:
                self.add("assigns", f"{claims[0].id} is {claims[0].verdict}, and #{number} is written in line {line} of "
                         f"O{where.text.number}", claims[0])
                return

    def left(self, visit):
        clauses = {clause.replace(" ", ""): clause for _, clause in visit.text.clauses()}
        for claim in self.claims_of(visit.text.number):
            if not claim.holds:
                continue
            clause = clauses.get(claim.text.replace(" ", ""))
            if claim.kind == "ensures" and (claim.verdict == "unreachable" or clause and
                                            not contract.promise_holds(clause, visit, self.again)):
                self.add(f"ensures {claim.verdict}", f"{claim.id} is {claim.verdict} ({claim.text}), and O"
                         f"{visit.text.number} returns otherwise", claim)
            if claim.kind == "modal-preserved":
                self.preserved(visit, claim)
            if claim.kind == "alarm-iff" and clause:
                self.alarm(visit, claim, clause, None)

    def preserved(self, visit, claim):
        before, after = visit.entry, visit.exit
        other = [code for group, code in after.modes.items() if before.modes[group] != code]
        other += [f"{k}{after.words[k]}" for k in after.words
                  if after.words[k] != before.words[k] and k not in contract.excepted(claim.text)]
        if after.shifts != before.shifts:
            other.append("other shifts, mappings or words of a cycle")
        if after.modal != before.modal:
            other.append("G66")
        if other:
            self.add("modal-preserved", f"{claim.id} is {claim.verdict}, and O{visit.text.number} returns in {other}", claim)

    def alarm(self, visit, claim, clause, number):
        words = clause.split(None, 3)
        try:
            meant = contract.reckoner_at(visit.entry, self.again).whole(words[3])
        except (Stop, Unsaid):
            return
        comes = number == int(words[1])
        if meant and not comes or words[2] == "IFF" and comes and not meant:
            self.add("alarm-iff", f"{claim.id} is {claim.verdict} ({claim.text}), and the alarm "
                     f"{'comes' if comes else 'does not come'}", claim)

    # ---- the end of the run ----

    def is_open(self, visit):
        each = self.run.where
        while each is not None and each is not visit:
            each = each.outer
        return each is visit

    def ended(self, visit):
        run, number = self.run, visit.text.number
        if run.end in ("stop", "alarm") and self.is_open(visit):
            clauses = {clause.replace(" ", ""): clause for _, clause in visit.text.clauses()}
            for claim in self.kind(visit, "alarm-iff"):
                if claim.holds and claim.text.replace(" ", "") in clauses:
                    self.alarm(visit, claim, clauses[claim.text.replace(" ", "")], run.detail if run.end == "alarm" else None)
            if run.where is visit:
                self.stopped(visit)
        if run.end == "endless" and any(visit is each for each in run.lasting):
            for claim in self.kind(visit, "program-ends"):
                if claim.holds:
                    self.add("program-ends", f"{claim.id} is {claim.verdict}, and a state comes back at line {run.line}", claim)
            heads = [c for c in self.kind(visit, "loop-ends") if (visit, c.line) in run.cycle]
            if heads and run.where is visit and all(c.holds for c in heads):
                self.add("loop-ends", f"{heads[0].id} is {heads[0].verdict}, and O{number} comes back to a state", heads[0])

    def stopped(self, visit):
        run, number = self.run, visit.text.number
        if run.end == "alarm" and any(clause.split()[1] == str(run.detail) for _, clause in contract.of(visit.text, "@ALARM")):
            return
        kind = "alarm-unreachable" if run.end == "alarm" else "no-control-alarm"
        claims = [c for c in self.kind(visit, kind) if c.line == run.line]
        named = [c for c in claims if run.end == "alarm" or any(w in c.text for w in WORDS[run.detail])]
        if named and all(c.holds for c in named):
            self.add(f"{kind} {named[0].verdict}", f"{named[0].id} is {named[0].verdict} ({named[0].text}), and the run "
                     f"stops there: {run.detail}", named[0])
        elif not named and all(c.holds for c in claims) and self.is_complete(number):
            self.add(f"{kind} missing: {run.detail}", f"O{number} stops at line {run.line}: {run.detail}, and nothing is claimed of it")

    # ---- space ----

    def space(self, visit):
        claims = [c for c in self.claims_of(visit.text.number) if c.kind in SPACE]
        if not claims or self.run.end == "unsaid" and not self.run.tool.strokes:
            return
        try:
            space = Space(visit.text, visit.entry, self.again)
        except (Stop, Unsaid, TypeError):
            return
        rng, rounded = rng_of(len(self.run.tool.strokes), visit.text.number), 1e-5 if self.run.reckoner.guessed else 2e-6
        rounded += 1e-3 if Model.doubles else 0  # the tolerance, where the contract names none
        strokes = self.run.tool.strokes
        for stroke, cut in zip(strokes, cut_depths(strokes)):
            line = stroke.levels[0][1]
            self.counts["strokes"] += 1
            here = [c for c in claims if c.line == line]
            for claim in here:
                name = region_of(claim)
                if not claim.holds or any(not c.holds and c.kind == claim.kind and region_of(c) == name for c in here):
                    continue
                if claim.kind == "limit" and "@LIMIT F" not in claim.text and "@LIMIT S" not in claim.text:
                    continue
                why = space.breaks(claim.kind, name, stroke, cut, rng, rounded)
                if why:
                    self.add(f"{claim.kind} {claim.verdict}", f"{claim.id} is {claim.verdict} ({claim.text}): {why}", claim)
                    return
