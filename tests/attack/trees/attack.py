"""Rounds of the first generator and its interpreter, both on trees."""
import collections
import random
import tempfile
import time
from dataclasses import replace
from pathlib import Path

from engine import EngineFailed, rows_twice
from parts import parts_of
from tally import SHRINK_SECONDS
from .choices import Choices
from .differential import difference, is_comparable
from .files import write_project
from .inputs import InputMaker
from .judge import Contradiction, Judge
from .messages import MessageJudge
from .observations import add_checks
from .promises import add_promises
from .ranges import outside_of_ranges, told_of
from .random_programs import ProjectMaker
from .reports import write_report
from .shrink import shrink
from .witnesses import idle_witness

RUNS = 14
COMPARISONS = 3
RANGE_RUNS = 6


class TreeAttack:
    def __init__(self, engine, tally, features, dialects, differ):
        """`differ` compares with the other interpreter."""
        self.engine, self.tally, self.features, self.dialects, self.differ = engine, tally, features, dialects, differ

    def project(self, seed: int):
        rng = random.Random(f"program {seed}")
        dialect = self.dialects[seed % len(self.dialects)]
        project = ProjectMaker(rng, self.features, dialect).make()
        if "checks" in self.features:
            add_checks(project, rng)
        if "promises" in self.features:
            add_promises(project, rng, self.tally.counts)
        return project

    def batch(self, seeds, folder: Path):
        """Programs of one dialect at a time go to the engine together."""
        projects = {seed: self.project(seed) for seed in seeds}
        for seed, project in projects.items():
            write_project(project, folder / project.dialect / f"p{seed}")
        proofs, messages = {}, {}
        for dialect in sorted({p.dialect for p in projects.values()}):
            proofs.update(self.engine.prove(folder / dialect, dialect))
            messages.update(self.engine.messages(folder / dialect, dialect))
        for seed, project in projects.items():
            place = folder / project.dialect / f"p{seed}"
            found = proofs.get(str(place))
            self.tally.parts("trees", parts_of({file.name: file.text() for file in project.files}))
            if found is None or found.errors:
                self.tally.not_read("trees", seed, found.errors if found else "", {})
                continue
            self.tally.claims("trees", found)
            for contradiction in self.contradictions(project, found, messages.get(str(place), []), seed,
                                                     self.tally.counts)[:1]:
                self.report(seed, project, contradiction)
            if "differences" in self.features:
                self.compare(project, place, seed)
            if "ranges" in self.features:
                self.ranges(project, place, seed)

    def compare(self, project, folder, seed):
        """The machines with each other."""
        rng = random.Random(f"both {seed}")
        for _ in range(COMPARISONS):
            program = rng.choice(project.programs())
            inputs = InputMaker(project, program, rng).any()
            why = self.differ(project, program, inputs, self.tally.counts)
            if why:
                self.report(seed, project, Contradiction(why, "the interpreters differ", program.number, inputs, {}))
                break
            if not is_comparable(program, inputs):
                continue
            found = difference(project, folder, program, inputs, self.engine, self.tally.counts)
            if found:
                why, outcome = found
                self.report(seed, project, Contradiction(why, "the machines differ", program.number, inputs,
                                                         outcome.choices))
                break

    def ranges(self, project, folder, seed):
        """States of runs with what is told of them."""
        rng = random.Random(f"ranges {seed}")
        for program in rng.sample(project.programs(), min(2, len(project.programs()))):
            told = told_of(project, folder, program, self.engine)
            maker = InputMaker(project, program, rng)
            for number in range(RANGE_RUNS):
                inputs, choices = maker.any(), Choices(seed=f"{seed} {number}" if number % 2 else None)
                why = outside_of_ranges(project, told, program, inputs, choices, self.tally.counts)
                if why:
                    return self.report(seed, project, Contradiction(why, "ranges", program.number, inputs, choices.asked))

    def contradictions(self, project, proofs, messages, seed, counts):
        found = [Contradiction(f"{c.id}: {c.text}", "a row twice", c.program, InputMaker(project, project.programs()[0],
                               random.Random(0)).any(), {}, c) for c in rows_twice(proofs)]
        found += [Contradiction(what, "a verdict withdrawn", 1, InputMaker(project, project.programs()[0],
                                random.Random(0)).any(), {}) for what in proofs.withdrawn]
        said = MessageJudge(project, messages, counts)
        for program in project.programs():
            if not proofs.claims.get(program.number):
                continue
            rng = random.Random(f"inputs {seed} {program.number}")
            maker = InputMaker(project, program, rng)
            judge = Judge(project, proofs, counts)
            has_guard = any(c.kind == "guarded" for c in proofs.claims[program.number])
            for number in range(RUNS):
                inputs = maker.outside() if has_guard and number % 3 == 0 else maker.any()
                outcome = judge.run(program, inputs, Choices(seed=f"{seed} {number}" if number % 3 == 2 else None), rng)
                wrong = said.wrong(outcome) if program is project.programs()[0] else None
                if wrong:
                    message, why = wrong
                    judge.add(f"message {message.rule}", f"{message.file}:{message.line}: {message.text}; {why}")
                if judge.found:
                    found += judge.found
                    break
            for claim in proofs.claims[program.number]:
                if claim.verdict == "refuted" and claim.witness:
                    wrong = idle_witness(project, claim, counts)
                    if wrong:
                        found.append(wrong)
        return found

    def report(self, seed, project, contradiction):
        self.tally.counts["of these by rounding, perhaps"] += 1 if contradiction.rounds else 0
        known = self.tally.is_new("trees", contradiction.kind)
        if not known:
            return
        print(f"trees {seed}: {contradiction.kind}: {contradiction.what}", flush=True)
        if self.tally.shrinks:
            until = time.monotonic() + SHRINK_SECONDS
            project = shrink(project, lambda candidate: self.same(candidate, seed, contradiction) is not None,
                             lambda: time.monotonic() > until)
            contradiction = self.same(project, seed, contradiction) or contradiction
        if self.tally.folder:
            write_report(self.tally.folder, seed, known, project, contradiction)

    def same(self, project, seed, known):
        """The contradiction of this kind that a project still shows."""
        with tempfile.TemporaryDirectory(prefix="feedhold-attack-") as work:
            place = Path(work) / "p"
            write_project(project, place)
            program = next((p for p in project.programs() if p.number == known.program), None)
            if known.kind == "the interpreters differ":
                why = program and self.differ(project, program, known.inputs, collections.Counter())
                return replace(known, what=why) if why else None
            if known.kind == "the machines differ":
                found = program and is_comparable(program, known.inputs) and difference(project, place, program, known.inputs, self.engine, collections.Counter())
                return replace(known, what=found[0]) if found else None
            if known.kind == "ranges":
                why = program and outside_of_ranges(project, told_of(project, place, program, self.engine), program,
                                                    known.inputs, Choices(given=known.choices), collections.Counter())
                return replace(known, what=why) if why else None
            try:
                only = known.claim.kind if known.claim else None
                proofs = self.engine.prove(place, project.dialect, only).get(str(place))
                if proofs is None or proofs.errors:
                    return None
                messages = self.engine.messages(place, project.dialect).get(str(place), []) \
                    if known.kind.startswith("message") else []
                found = self.contradictions(project, proofs, messages, seed, collections.Counter())
            except (EngineFailed, ValueError):
                return None
            return next((c for c in found if c.kind == known.kind), None)
