"""Rounds of o-words: `feedhold run` has to move as the machine here does, and `prove` must not claim otherwise."""
import random
from pathlib import Path

from parts import parts_of
from .claims import Wrong
from .compare import CLOSE
from .owords import OwordRun, OwordWriter


class OwordAttack:
    def __init__(self, engine, tally):
        self.engine, self.tally = engine, tally

    def batch(self, seeds, folder: Path):
        projects = {seed: OwordWriter(random.Random(f"owords {seed}"), "linuxcnc").files() for seed in seeds}
        for seed, files in projects.items():
            write(files, folder / f"p{seed}")
        proofs = self.engine.prove(folder, "linuxcnc")
        for seed, files in projects.items():
            self.tally.parts("owords", parts_of(files))
            found = proofs.get(str(folder / f"p{seed}"))
            if found:
                self.tally.claims("owords", found)
            wrong = self.wrong(files, folder / f"p{seed}", found)
            if wrong:
                self.tally.found("owords", seed, "linuxcnc", files, 0, wrong, "", self.shows(wrong.kind))

    def wrong(self, files, folder, proofs):
        run = OwordRun(files).go()
        self.tally.counts["runs"] += 1
        self.tally.counts["runs that end by " + run.end.split()[0]] += 1
        if run.end != "end":
            return None
        if run.reckoner.rounded:
            return None
        answer = self.engine.run([str(folder / "main.ngc"), "--dialect", "linuxcnc", "--fuel", "20000"])
        self.tally.counts["runs compared with `feedhold run`"] += 1
        if answer["notes"] or answer["end"] == "unmodelled":
            return None
        if answer["end"] not in ("M02", "M30"):
            return Wrong("feedhold run differs", f"one ends by M2, the other by {answer['end']} {answer['alarm']}")
        theirs = [tuple(m["to"][a] for a in "XYZ") for m in answer["moves"] if m["from"] != m["to"]]
        if len(theirs) != len(run.moves):
            return Wrong("feedhold run differs", f"one moves {len(run.moves)} times, the other {len(theirs)} times")
        for mine, other in zip(run.moves, theirs):
            if any(abs(p - q) > CLOSE for p, q in zip(mine, other)):
                return Wrong("feedhold run differs", f"a movement ends at {mine} in one and at {other} in the other")
        main = proofs.claims.get(0, []) if proofs else []
        stuck = [c for c in main if c.kind == "program-ends" and c.verdict == "refuted" and not c.witness["run"].count("--")]
        return Wrong("refuted: program-ends", f"{stuck[0].id}: its run ends", stuck[0]) if stuck else None

    def shows(self, kind):
        def again(files, work):
            if "main.ngc" not in files:
                return None
            write(files, work / "p")
            try:
                wrong = self.wrong(files, work / "p", None)
            except (KeyError, AttributeError, ValueError, IndexError, TypeError):
                return None
            return (0, wrong, "") if wrong and wrong.kind == kind else None
        return again


def write(files: dict, folder: Path):
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.ngc"):
        old.unlink()
    for name, text in files.items():
        (folder / name).write_text(text)
