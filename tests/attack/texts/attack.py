"""Rounds of the second generator: projects are written, proved, checked, run, and what is claimed is judged."""
import collections
import random
import re
from pathlib import Path

from engine import EngineFailed, rows_twice
from parts import parts_of
from . import witness
from .claims import Wrong, judge
from .compare import of_engine, of_run, unlike
from .machine import Run, texts_of
from .messages import wrong_message
from .ranges import outside_of_ranges, told_of
from .starts import Starts, as_words, runs_alike
from .switches import Switches, every_way

RUNS = 14
COMPARISONS = 3
RANGE_RUNS = 6


class TextAttack:
    """`writer(rng, dialect)` makes a project: a dict of names to texts."""

    def __init__(self, name, engine, tally, writer, dialects, runs=RUNS, range_runs=RANGE_RUNS):
        self.name, self.engine, self.tally, self.writer, self.dialects = name, engine, tally, writer, dialects
        self.runs, self.range_runs = runs, range_runs

    def dialect(self, seed):
        return self.dialects[seed % len(self.dialects)]

    def project(self, seed) -> dict:
        rng = random.Random(f"{self.name} {seed}")
        return self.writer(rng, self.dialect(seed)).files()

    def batch(self, seeds, folder: Path):
        projects = {seed: self.project(seed) for seed in seeds}
        for seed, files in projects.items():
            write(files, folder / self.dialect(seed) / f"p{seed}")
        proofs, messages = {}, {}
        for dialect in sorted({self.dialect(seed) for seed in projects}):
            proofs.update(self.engine.prove(folder / dialect, dialect))
            messages.update(self.engine.messages(folder / dialect, dialect))
        for seed, files in projects.items():
            place = str(folder / self.dialect(seed) / f"p{seed}")
            found = proofs.get(place)
            self.tally.parts(self.name, parts_of(files))
            if found is None or found.errors:
                self.tally.not_read(self.name, seed, found.errors if found else "", files)
                continue
            self.tally.claims(self.name, found)
            for number, wrong, start in self.wrong(files, self.dialect(seed), found, messages.get(place, []), seed,
                                                   Path(place))[:1]:
                self.report(seed, files, number, wrong, start)

    def wrong(self, files, dialect, proofs, messages, seed, folder, only=None, counts=None):
        """(program, wrong, start) of what is found."""
        counts = self.tally.counts if counts is None else counts
        found = [(0, Wrong("a row twice", f"{c.id}: {c.text}", c), None) for c in rows_twice(proofs)]
        found += [(0, Wrong("a verdict withdrawn", what), None) for what in proofs.withdrawn]
        texts = texts_of(files)
        called = {int(n) for t in texts.values() for n in re.findall(r"(?:G65|G66|M98)P(\d+)", "\n".join(t.lines))}
        for number, text in texts.items():
            rng = random.Random(f"start {seed} {number}")
            starts = Starts(files, text, rng)
            guarded = any(c.kind == "guarded" for c in proofs.claims.get(number, []))
            for index in range(self.runs):
                outside = guarded and index % 3 == 0
                start = starts.outside() if outside else starts.any()
                run = Run(files, dialect, start, Switches(seed=f"{seed} {index}" if index % 3 == 2 else None)).go(number)
                counts["runs"] += 1
                counts["runs that end by " + run.end] += 1
                wrong = judge(run, lambda n: proofs.claims.get(n, []), proofs.is_complete, counts)
                if not wrong and number not in called and not outside:
                    wrong = wrong_message(run, messages, counts)
                if wrong:
                    found.append((number, wrong[0], start))
                    break
                if index < COMPARISONS and runs_alike(start, text):
                    unlike_ = self.machines(files, dialect, folder, text, start, counts)
                    if unlike_:
                        found.append((number, unlike_, start))
                        break
            found += self.refuted(files, dialect, text, proofs, folder, counts)
            found += self.ranges(files, dialect, text, seed, folder, starts, counts)
        return found

    def ranges(self, files, dialect, text, seed, folder, starts, counts):
        told = told_of(files, folder, text, dialect, self.engine) if self.range_runs else None
        for index in range(self.range_runs):
            start = starts.any()
            why = outside_of_ranges(files, dialect, told, text.number, start,
                                    Switches(seed=f"{seed} {index}" if index % 2 else None), counts)
            if why:
                return [(text.number, Wrong("ranges", why), start)]
        return []

    def machines(self, files, dialect, folder, text, start, counts):
        answer = self.engine.run([str(folder / text.file), "--program", f"O{text.number}", "--dialect", dialect,
                                  "--fuel", "1500", *as_words(start)])
        if answer["end"] == "unmodelled" or answer["notes"]:
            counts["runs that `feedhold run` does not follow"] += 1
            return None
        theirs, first = of_engine(answer), None
        if any(m["kind"] == "somehow" for m in answer["moves"]):
            return None
        counts["runs compared with `feedhold run`"] += 1
        for run in every_way(lambda ask: Run(files, dialect, start, ask).go(text.number)):
            if run.end == "unsaid" or run.reckoner.rounded:
                return None
            why = unlike(of_run(run), theirs)
            if why is None:
                return None
            first = first or why
        return Wrong("feedhold run differs", first)

    def refuted(self, files, dialect, text, proofs, folder, counts):
        found = []
        for claim in proofs.claims.get(text.number, []):
            if claim.verdict != "refuted" or not claim.witness:
                continue
            if Path(folder).exists():
                why = witness.typed_in(claim, self.engine, counts)
                if why:
                    found.append((text.number, Wrong("a witness that cannot be shown",
                                                     f"{claim.id}: {why}: {claim.witness['run']}", claim), None))
            why = witness.idle(files, dialect, text, claim, counts)
            if why:
                found.append((text.number, Wrong(f"refuted: {claim.kind}", f"{claim.id} is refuted ({claim.text}): {why}: "
                                                 f"{claim.witness['run']}", claim), None))
        return found

    # ---- what is found ----

    def report(self, seed, files, number, wrong, start):
        def shows(candidate, work):
            if not all(text.startswith("O") for text in candidate.values()):
                return None
            write(candidate, work / "p")
            try:
                only = wrong.claim.kind if wrong.claim else None
                proofs = self.engine.prove(work / "p", self.dialect(seed), only).get(str(work / "p"))
                if proofs is None or proofs.errors:
                    return None
                messages = self.engine.messages(work / "p", self.dialect(seed)).get(str(work / "p"), []) \
                    if wrong.kind.startswith("message") else []
                found = self.wrong(candidate, self.dialect(seed), proofs, messages, seed, work / "p",
                                   counts=collections.Counter())
            except (EngineFailed, ValueError, KeyError, IndexError, AttributeError):
                return None
            return next(((n, w, s) for n, w, s in found if w.kind == wrong.kind), None)
        self.tally.found(self.name, seed, self.dialect(seed), files, number, wrong, start and " ".join(as_words(start)), shows)


def write(files: dict, folder: Path):
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.n*"):
        old.unlink()
    for name, text in files.items():
        (folder / name).write_text(text)
