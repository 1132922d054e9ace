"""The proved programs of a folder on random calls that their contracts allow: `feedhold prove` against `feedhold run`.

The machine is the engine's own, which computes in doubles and rounds words: so claims are asked of the control's numbers.
"""
import random
from pathlib import Path
from types import SimpleNamespace

from texts import contract
from texts.machine import HEAD, Text
from texts.path import XYZ
from texts.reckon import Model, Stop, Unsaid
from texts.starts import Starts, StateOf, as_words
from texts.switches import Switches

FUEL = 20000
TRIES = 60  # of a call that the whole contract allows


class CorpusCalls:
    def __init__(self, engine, tally, dialect, calls):
        self.engine, self.tally, self.dialect, self.calls = engine, tally, dialect, calls

    def run(self, folder: Path):
        for place in sorted({path.parent for path in folder.rglob("*.nc")}):
            for path in sorted(place.glob("*.nc")):
                texts = read(path)
                proofs = self.engine.prove(path, self.dialect).get(str(place)) if texts else None
                if proofs is None or proofs.errors:
                    self.tally.counts["files that were not proved"] += 1
                    continue
                self.tally.claims("corpus", proofs)
                for text in texts:
                    self.program(path, text, proofs)

    def program(self, path, text, proofs):
        """Calls of one program, until one breaks a claim."""
        claims = [claim for claim in proofs.claims.get(text.number, []) if claim.holds]
        if not claims:
            return
        starts = Starts({path.name: "\n".join(text.lines)}, text, random.Random(f"calls {path.name} {text.number}"))
        for _ in range(self.calls):
            start = self.allowed(starts, text)
            if start is None:
                self.tally.counts["programs without a call that the contract allows"] += 1
                return
            answer = self.engine.run([str(path), "--program", f"O{text.number}", "--dialect", self.dialect, "--fuel", str(FUEL),
                                      *as_words(start)])
            self.tally.counts["runs"] += 1
            self.tally.counts["runs that end by " + answer["end"]] += 1
            wrong = next((f"{claim.id} is {claim.verdict} ({claim.text}): {why}" for claim in claims
                          if (why := broken(claim, text, start, answer))), None)
            if wrong:
                if self.tally.is_new("corpus", f"{path.name} {text.number}"):
                    print(f"corpus: {wrong}\n  feedhold run {path} --program O{text.number} --dialect {self.dialect} "
                          + " ".join(as_words(start)), flush=True)
                return

    @staticmethod
    def allowed(starts, text):
        for _ in range(TRIES):
            start = starts.any()
            start.modes = {}  # the command begins with those of the contract
            state = StateOf(start)
            try:
                broken_clauses = contract.broken_at_entry(text, state, Switches())
            except (Stop, Unsaid, ValueError, IndexError, KeyError, TypeError):
                return None
            if not [clause for clause in broken_clauses if not clause.startswith("@MODAL")]:
                return start
        return None


def broken(claim, text, start, answer):
    """How the run breaks the claim; None."""
    end, alarm = answer["end"], answer["alarm"] or {}
    if answer["notes"] or end == "unmodelled":
        return None
    if claim.kind in ("alarm-unreachable", "no-control-alarm"):
        is_here = alarm and not answer["calls"] and alarm["line"] == claim.line
        if alarm.get("by") == "program":
            foreseen = any(c.split()[1] == f"{alarm['number']:g}" for _, c in contract.of(text, "@ALARM"))
            is_meant = claim.kind == "alarm-unreachable" and not foreseen
        else:
            is_meant = claim.kind == "no-control-alarm" and str(alarm.get("number")) in claim.text
        return f"stops with alarm {alarm['number']}" if is_here and is_meant else None
    if claim.kind == "program-ends":  # a run that used up its fuel may only be long
        return "a state comes back" if end == "endless" else None
    if end not in ("M99", "M30", "M02"):
        return None
    cells = {int(n): Model.held(v) for n, v in answer["variables"].items() if n.isdigit()}
    if claim.kind == "ensures":
        clause = next((c for _, c in text.clauses() if c.replace(" ", "") == claim.text.replace(" ", "")), None)
        if clause is None or all(contract.CODE.match(word) for word in clause.split()[1:]):
            return None
        return None if contract.promise_holds(clause, visit_of(start, answer, cells), Switches()) else "it does not hold"
    if claim.kind == "assigns":
        allowed = {n for _, c in contract.of(text, "@ASSIGNS") for n in numbers_of(c)}
        other = [n for n in range(100, 1000) if cells.get(n) != Model.held(start.cells.get(n)) and n not in allowed]
        return f"#{other[0]} is changed" if other else None
    return None


def numbers_of(clause):
    for word in clause.split()[1:]:
        if word != "NOTHING":
            ends = [int(end[1:]) for end in word.split("..")]
            yield from range(ends[0], ends[-1] + 1)


def visit_of(start, answer, cells):
    entry = StateOf(start)
    entry.place = [Model.held(place) for place in entry.place]
    last = answer["moves"][-1]["to"] if answer["moves"] else dict(zip(XYZ, entry.place))
    after = SimpleNamespace(locals={n: v for n, v in cells.items() if n < 34}, cells=cells, modes={},
                            place=[Model.held(last[axis]) for axis in XYZ])
    return SimpleNamespace(entry=entry, exit=after)


def read(path: Path) -> list:
    """The programs of the file; clauses before an O word belong to that one."""
    found = []
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        head = HEAD.match(line)
        if head:
            found.append(Text(int(head[1]), path.name, number, []))
        if found:
            found[-1].lines.append(line)
    return found
