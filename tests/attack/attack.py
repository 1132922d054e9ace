#!/usr/bin/env python3
"""Random programs of all language parts against `feedhold`: what it claims of all runs is compared with runs.

Usage: attack.py FEEDHOLD [--seconds N | --programs N] [--first SEED] [--found FOLDER] [--without FEATURE]...
                 [--corpus FOLDER [--calls N]] [--only trees|texts|space|set-up|decimals|owords]... [--arithmetic exact|control]
Prints counts; exits 1 when a run contradicts a claim, with a small program for each in FOLDER.
"""
import argparse
import sys
import tempfile
import time
import traceback
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.setrecursionlimit(5000)

from both import interpreters_differ  # noqa: E402
from corpus_calls import CorpusCalls  # noqa: E402
from engine import Engine  # noqa: E402
from tally import Tally  # noqa: E402
from texts.attack import TextAttack  # noqa: E402
from texts.reckon import Model as TextModel  # noqa: E402
from texts.oword_attack import OwordAttack  # noqa: E402
from texts.write_decimal import DecimalWriter  # noqa: E402
from texts.write_macro import MacroWriter  # noqa: E402
from texts.write_set_up import SetUpWriter  # noqa: E402
from texts.write_space import SpaceWriter  # noqa: E402
from trees.attack import TreeAttack  # noqa: E402
from trees.random_programs import FEATURES  # noqa: E402
from trees.values import Model as TreeModel  # noqa: E402

BATCH = 8


def attacks_of(options, engine, tally):
    fanuc = ["fanuc-30i", "fanuc-0i", "mitsubishi-m700"]
    chosen = options.dialect
    return {
        "trees": TreeAttack(engine, tally, [f for f in FEATURES if f not in options.without], chosen or fanuc,
                            interpreters_differ),
        "texts": TextAttack("texts", engine, tally, partial(MacroWriter, without=options.without),
                            chosen or fanuc + ["haas-ngc"]),
        "space": TextAttack("space", engine, tally, SpaceWriter, chosen or ["fanuc-30i"]),
        "set-up": TextAttack("set-up", engine, tally, SetUpWriter,
                             chosen or ["fanuc-30i", "fanuc-0i", "haas-ngc", "mitsubishi-m700"], range_runs=0),
        "decimals": TextAttack("decimals", engine, tally, DecimalWriter, chosen or fanuc, runs=80, range_runs=0),
        "owords": OwordAttack(engine, tally),
    }


def use(engine, arithmetic):
    """Claims and interpreters are about the same numbers."""
    engine.arithmetic = arithmetic
    TextModel.doubles = TreeModel.doubles = arithmetic == "control"


def one_batch(attack, seeds, tally):
    with tempfile.TemporaryDirectory(prefix="feedhold-attack-") as work:
        try:
            attack.batch(seeds, Path(work))
        except Exception:  # one batch is lost, and it is a failure
            tally.counts["batches that broke off"] += 1
            print(f"batch {seeds[0]}:", file=sys.stderr)
            traceback.print_exc()


def of_corpus(options, engine, tally) -> int:
    use(engine, "control")
    begin = time.monotonic()
    try:
        CorpusCalls(engine, tally, (options.dialect or ["fanuc-30i"])[0], options.calls).run(options.corpus)
    except KeyboardInterrupt:  # what there is so far is told
        print("interrupted", file=sys.stderr)
    tally.tell(time.monotonic() - begin)
    return 1 if tally.counts["contradictions"] else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("feedhold")
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--programs", type=int, default=60, help="projects of each attack")
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--found", type=Path)
    parser.add_argument("--without", action="append", default=[], choices=FEATURES)
    parser.add_argument("--only", action="append", choices=("trees", "texts", "space", "set-up", "decimals", "owords"))
    parser.add_argument("--arithmetic", choices=("exact", "control"), help="of claims; by default one, then the other")
    parser.add_argument("--dialect", action="append")
    parser.add_argument("--no-shrink", dest="shrinks", action="store_false")
    parser.add_argument("--per-kind", type=int, default=1)
    parser.add_argument("--corpus", type=Path, help="the proved programs of a folder on random calls, and nothing else")
    parser.add_argument("--calls", type=int, default=100, help="of each program of --corpus")
    options = parser.parse_args()
    tally = Tally(options.found, options.shrinks, options.per_kind)
    engine = Engine(options.feedhold)
    if options.corpus:
        return of_corpus(options, engine, tally)
    attacks = attacks_of(options, engine, tally)
    attacks = [attack for name, attack in attacks.items() if not options.only or name in options.only]
    begin, seed = time.monotonic(), options.first
    try:
        while time.monotonic() - begin < options.seconds if options.seconds else seed < options.first + options.programs:
            seeds = range(seed, seed + BATCH if options.seconds else min(seed + BATCH, options.first + options.programs))
            use(engine, options.arithmetic or ("exact", "control")[(seed - options.first) // BATCH % 2])
            for attack in attacks:
                one_batch(attack, seeds, tally)
            seed += BATCH
    except KeyboardInterrupt:  # what there is so far is told
        print(f"interrupted at {seed}", file=sys.stderr)
    tally.tell(time.monotonic() - begin)
    return 1 if tally.counts["contradictions"] or tally.counts["batches that broke off"] else 0


if __name__ == "__main__":
    sys.exit(main())
