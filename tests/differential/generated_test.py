"""Random programs in the machine of `feedhold run` and in LinuxCNC's interpreter: every canonical motion agrees."""
import collections
import importlib.util
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
SKIPPED = 77  # ctest's word for a test that could not run here
SEEDS = range(1, 1001)
FEWEST_ENDED = 950  # the others stop with an alarm, in both
FEWEST_MOVES = 20_000
# What the programs are about, and in how many of them at least it stands.
SUBJECTS = {
    "G90 and G91": (r"\bg90\b[\s\S]*\bg91\b", 200), "planes": (r"\bg1[89]\b", 200),
    "arcs by I, J, K": (r"g[23] [^r\n]*[ijk]-?[\d.]", 200), "arcs by R": (r"\bg[23] [^\n]*\br-?[\d.]", 100),
    "helices": (r"g17 g9[01] g[23] [^\n]*z", 50), "several turns": (r"\bg[23] [^\n]*\bp[23]\b", 20),
    **{cycle: (rf"\b{cycle}\b", 20) for cycle in ("g73", "g81", "g82", "g83", "g84", "g85", "g86", "g89")},
    "G98": (r"\bg98 .*g8\d", 100), "G99": (r"\bg99 .*g8\d", 100), "repeated cycles": (r"g8\d .* l[2-4]", 50),
    "branches": (r"o\d+ if", 200), "loops": (r"o\d+ (while|do|repeat)", 200), "breaks": (r"o\d+ (break|continue)", 50),
    "o-word calls": (r"o\S+ call", 100), "M98": (r"m98 p", 100), "offsets": (r"\bg(10 l2|92|52|54)\b", 200),
}


def available():
    return importlib.util.find_spec("gcode") is not None


class Generated(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        from ngc_programs import program
        cls.programs = {seed: program(seed) for seed in SEEDS}

    def test_every_motion_agrees(self):
        from comparison import Comparison
        from interpreter import Run
        moves, ended, differences = 0, 0, []
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "program.ngc"
            for seed, text in self.programs.items():
                path.write_text(text)
                comparison = Comparison(path, Run(path))
                moves += comparison.moves
                ended += not comparison.stopped
                if comparison.difference:
                    differences.append(f"ngc_programs.py {seed}: {comparison.difference}")
        self.assertEqual(differences, [])
        self.assertGreater(ended, FEWEST_ENDED)
        self.assertGreater(moves, FEWEST_MOVES)

    def test_programs_are_about_what_they_should_be(self):
        found = collections.Counter(name for text in self.programs.values() for name, (pattern, _) in SUBJECTS.items()
                                    if re.search(pattern, text, re.IGNORECASE))
        self.assertEqual({name: found[name] for name, (_, fewest) in SUBJECTS.items() if found[name] < fewest}, {})


if __name__ == "__main__":
    if not available() and not ORACLES:
        sys.exit(SKIPPED)
    unittest.main()
