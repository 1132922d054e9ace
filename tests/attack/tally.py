"""What all attacks count, and what they find."""
import collections
import tempfile
import time
from pathlib import Path

from parts import all_parts

SHRINK_SECONDS = 20


class Tally:
    def __init__(self, folder, shrinks: bool, per_kind: int):
        self.folder, self.shrinks, self.per_kind = folder, shrinks, per_kind
        self.counts, self.kinds, self.with_part = collections.Counter(), collections.Counter(), collections.Counter()
        self.unread = {}

    def parts(self, attack: str, parts: set):
        self.counts[f"projects of {attack}"] += 1
        for part in parts:
            self.with_part[part] += 1

    def claims(self, attack: str, proofs):
        self.counts["programs"] += len(proofs.claims)
        self.counts["programs not followed"] += sum(1 for why in proofs.incomplete.values() if why)
        for claims in proofs.claims.values():
            for claim in claims:
                self.counts["claims"] += 1
                self.kinds[claim.kind, claim.verdict] += 1

    def not_read(self, attack: str, seed: int, why, files: dict):
        self.counts[f"projects of {attack} that were not read"] += 1
        self.unread.setdefault(attack, (seed, why))

    def is_new(self, attack: str, kind: str) -> int:
        """How many of the kind there are now; 0 when there have been enough."""
        self.counts["contradictions"] += 1
        self.kinds["contradiction", f"{attack}: {kind}"] += 1
        known = self.kinds["contradiction", f"{attack}: {kind}"]
        return known if known <= self.per_kind else 0

    def found(self, attack, seed, dialect, files, number, wrong, start, shows):
        """Of an attack on texts: made smaller line by line, and written."""
        if not self.is_new(attack, wrong.kind):
            return
        print(f"{attack} {seed}: {wrong.kind}: {wrong.what}", flush=True)
        if self.shrinks:
            with tempfile.TemporaryDirectory(prefix="feedhold-attack-") as work:
                files, smaller = fewer_lines(files, lambda each: shows(each, Path(work)), time.monotonic() + SHRINK_SECONDS)
                if smaller:
                    number, wrong, start = smaller[0], smaller[1], smaller[2]
        if self.folder:
            place = self.folder / f"{attack}-{''.join(c if c.isalnum() else '-' for c in wrong.kind)}-{seed}"
            place.mkdir(parents=True, exist_ok=True)
            for name, text in files.items():
                (place / name).write_text(text)
            (place / "REPORT.txt").write_text("\n".join([
                wrong.kind, wrong.what, f"dialect {dialect}, started at O{number}, start: {start}",
                *(f"--- {name}\n{text}" for name, text in files.items())]))

    def tell(self, seconds: float):
        counts = self.counts
        print(f"{counts['programs']} programs, {counts['claims']} claims, {counts['runs']} runs, "
              f"{counts['contradictions']} contradictions in {seconds:.0f} s")
        for (kind, verdict), count in sorted(self.kinds.items()):
            print(f"  {kind:22} {verdict:12} {count}")
        for name, count in sorted(counts.items()):
            print(f"  {name}: {count}")
        print("  projects with: " + ", ".join(f"{part} {self.with_part[part]}" for part in all_parts()))
        for attack, (seed, why) in self.unread.items():
            print(f"  {attack} {seed} was not read: {why}")


def fewer_lines(files: dict, shows, until: float):
    """The smallest project that still shows it, and what it shows."""
    best, shown, width = files, None, max((len(t.splitlines()) for t in files.values()), default=1) // 2
    while width >= 1 and time.monotonic() < until:
        progress = False
        for name in list(best):
            at = 0
            while at < len(best[name].splitlines()) and time.monotonic() < until:
                lines = best[name].splitlines()
                left = lines[:at] + lines[at + width:]
                candidate = {**best, name: "\n".join(left) + "\n"}
                if not left:
                    candidate.pop(name)
                found = shows(candidate) if candidate else None
                if found:
                    best, shown, progress = candidate, found, True
                else:
                    at += width
                if name not in best:
                    break
            if name not in best:
                continue
        if not progress:
            width //= 2
    return best, shown
