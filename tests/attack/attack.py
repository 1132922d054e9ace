#!/usr/bin/env python3
"""Random programs of all language parts against `feedhold`: what it claims of all runs is compared with runs.

Usage: attack.py FEEDHOLD [--seconds N | --programs N] [--first SEED] [--found FOLDER] [--without FEATURE]...
Prints counts; exits 1 when a run contradicts a claim, with a small program for each in FOLDER.
"""
import argparse
import collections
import random
import shutil
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.setrecursionlimit(5000)

import engine as engines  # noqa: E402
from choices import Choices  # noqa: E402
from differential import difference, is_comparable  # noqa: E402
from inputs import InputMaker  # noqa: E402
from judge import Contradiction, Judge  # noqa: E402
from observations import add_checks  # noqa: E402
from promises import add_promises  # noqa: E402
from random_programs import FEATURES, ProjectMaker  # noqa: E402
from reports import write_report  # noqa: E402
from shrink import shrink  # noqa: E402
from witnesses import idle_witness  # noqa: E402

BATCH = 12
RUNS = 14
COMPARISONS = 3
SHRINK_SECONDS = 20


class Attack:
    def __init__(self, options):
        self.engine = engines.Engine(options.feedhold)
        self.features = [f for f in FEATURES if f not in options.without]
        self.dialects = options.dialect or ["fanuc-30i", "fanuc-0i", "mitsubishi-m700"]
        self.found_folder = Path(options.found) if options.found else None
        self.counts = collections.Counter()
        self.kinds = collections.Counter()
        self.examples = {}
        self.shrinks = options.shrinks
        self.per_kind = options.per_kind

    def project(self, seed: int):
        rng = random.Random(f"program {seed}")
        dialect = self.dialects[seed % len(self.dialects)]
        project = ProjectMaker(rng, self.features, dialect).make()
        if "checks" in self.features:
            add_checks(project, rng)
        if "promises" in self.features:
            add_promises(project, rng, self.counts)
        return project

    def batch(self, seeds):
        """Programs of one dialect at a time go to the engine together."""
        projects = {seed: self.project(seed) for seed in seeds}
        with tempfile.TemporaryDirectory(prefix="feedhold-attack-") as work:
            folder = Path(work)
            for seed, project in projects.items():
                engines.write_project(project, folder / project.dialect / f"p{seed}")
            proofs = {}
            for dialect in sorted({p.dialect for p in projects.values()}):
                proofs.update(self.engine.prove(folder / dialect, dialect))
            for seed, project in projects.items():
                found = proofs.get(str(folder / project.dialect / f"p{seed}"))
                if found is None or found.errors:
                    self.counts["projects that were not read"] += 1
                    self.examples.setdefault("not read", (seed, project, found.errors if found else ""))
                    continue
                self.count(found)
                for contradiction in self.contradictions(project, found, seed, self.counts)[:1]:
                    self.report(seed, project, contradiction)
                if "differences" in self.features:
                    self.compare(project, folder / project.dialect / f"p{seed}", seed)

    def compare(self, project, folder, seed):
        """The two machines with each other."""
        rng = random.Random(f"both {seed}")
        for _ in range(COMPARISONS):
            program = rng.choice(project.programs())
            inputs = InputMaker(project, program, rng).any()
            if not is_comparable(program, inputs):
                continue
            found = difference(project, folder, program, inputs, self.engine, self.counts)
            if found:
                why, outcome = found
                self.report(seed, project, Contradiction(why, "the machines differ", program.number, inputs,
                                                         outcome.choices))
                break

    def count(self, proofs):
        self.counts["programs"] += len(proofs.claims)
        self.counts["programs not followed"] += sum(1 for why in proofs.incomplete.values() if why)
        for claims in proofs.claims.values():
            for claim in claims:
                self.counts["claims"] += 1
                self.kinds[claim.kind, claim.verdict] += 1

    def contradictions(self, project, proofs, seed, counts):
        found = []
        for program in project.programs():
            if not proofs.claims.get(program.number):
                continue
            rng = random.Random(f"inputs {seed} {program.number}")
            maker = InputMaker(project, program, rng)
            judge = Judge(project, proofs, counts)
            has_guard = any(c.kind == "guarded" for c in proofs.claims[program.number])
            for number in range(RUNS):
                inputs = maker.outside() if has_guard and number % 3 == 0 else maker.any()
                judge.run(program, inputs, Choices(seed=f"{seed} {number}" if number % 3 == 2 else None), rng)
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
        self.counts["contradictions"] += 1
        self.counts["of these by rounding, perhaps"] += 1 if contradiction.rounds else 0
        self.kinds["contradiction", contradiction.kind] += 1
        known = self.kinds["contradiction", contradiction.kind]
        if known > self.per_kind:
            return
        print(f"seed {seed}: {contradiction.kind}: {contradiction.what}", flush=True)
        if self.shrinks:
            until = time.monotonic() + SHRINK_SECONDS
            project = shrink(project, lambda candidate: self.same(candidate, seed, contradiction) is not None,
                             lambda: time.monotonic() > until)
            contradiction = self.same(project, seed, contradiction) or contradiction
        if self.found_folder:
            write_report(self.found_folder, seed, known, project, contradiction)

    def same(self, project, seed, known):
        """The contradiction of this kind that a project still shows."""
        with tempfile.TemporaryDirectory(prefix="feedhold-attack-") as work:
            engines.write_project(project, Path(work) / "p")
            if known.kind == "the machines differ":
                found = difference(project, Path(work) / "p", project.programs()[0], known.inputs, self.engine,
                                   collections.Counter())
                return found and replace(known, what=found[0])
            try:
                only = known.claim.kind if known.claim else None
                proofs = self.engine.prove(Path(work) / "p", project.dialect, only)
            except engines.EngineFailed:
                return None
            proofs = proofs.get(str(Path(work) / "p"))
            if proofs is None or proofs.errors:
                return None
            try:
                found = self.contradictions(project, proofs, seed, collections.Counter())
            except ValueError:
                return None
            return next((c for c in found if c.kind == known.kind), None)

    def tell(self, seconds: float):
        print(f"{self.counts['programs']} programs, {self.counts['claims']} claims, {self.counts['runs']} runs, "
              f"{self.counts['contradictions']} contradictions in {seconds:.0f} s")
        for (kind, verdict), count in sorted(self.kinds.items()):
            print(f"  {kind:22} {verdict:12} {count}")
        for name, count in sorted(self.counts.items()):
            print(f"  {name}: {count}")
        if "not read" in self.examples:
            seed, project, why = self.examples["not read"]
            print(f"seed {seed} was not read: {why}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("feedhold")
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--programs", type=int, default=60)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--found")
    parser.add_argument("--without", action="append", default=[], choices=FEATURES)
    parser.add_argument("--dialect", action="append")
    parser.add_argument("--no-shrink", dest="shrinks", action="store_false")
    parser.add_argument("--per-kind", type=int, default=1)
    options = parser.parse_args()
    attack, begin, seed = Attack(options), time.monotonic(), options.first
    while time.monotonic() - begin < options.seconds if options.seconds else seed < options.first + options.programs:
        attack.batch(range(seed, seed + BATCH))
        seed += BATCH
    attack.tell(time.monotonic() - begin)
    return 1 if attack.counts["contradictions"] else 0


if __name__ == "__main__":
    sys.exit(main())
