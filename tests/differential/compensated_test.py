"""Cutter compensation in the machine of `feedhold run` and in LinuxCNC's interpreter, on random contours: by the rules of
LinuxCNC every move agrees.  By those of FANUC all that does not lie at an outer corner agrees, and there the path leaves
and reaches the points square to both blocks as it should."""
import math
import sys
import tempfile
import unittest
from pathlib import Path

from compensated_paths import Contour
from generated_test import ORACLES, SKIPPED, available

SEEDS = range(1, 601)
FEWEST_ENDED = 500  # in the others the tool does not fit somewhere, for both
FEWEST_CORNERS = {"inner": 300, "outer": 300, "tangent": 200, "acute": 100}
INCREMENT = 4  # digits of the finest increment system of FANUC that lengths are counted in here, IS-C
NEAR = 2e-4  # mm; two increments
STRAIGHT_ON = 2e-5  # rad: what two ends that are counted turn a line of 15 mm


def modules():
    """The interpreter's module brings an `interpreter` of its own: ours and what needs it is imported before."""
    import comparison
    return comparison, comparison.Run


def folder_file(name):
    folder = tempfile.TemporaryDirectory()
    return folder, Path(folder.name) / name


class LinuxCnc(unittest.TestCase):
    def test_every_move_agrees(self):
        comparison, run = modules()
        ended, differences = 0, []
        folder, path = folder_file("program.ngc")
        with folder:
            for seed in SEEDS:
                path.write_text(Contour(seed, arcs=seed % 2 == 0).linuxcnc())
                both = comparison.Comparison(path, run(path))
                ended += not both.stopped
                if both.difference:
                    differences.append(f"compensated_paths.py {seed}: {both.difference}")
        self.assertEqual(differences, [])
        self.assertGreater(ended, FEWEST_ENDED)


class Fanuc(unittest.TestCase):
    def test_path_follows_from_that_of_linuxcnc(self):
        comparison, run = modules()
        corners, differences = dict.fromkeys(FEWEST_CORNERS, 0), []
        folder, path = folder_file("program.ngc")
        with folder:
            for seed in SEEDS:
                contour = Contour(seed, arcs=False, small_turns=False, digits=INCREMENT)
                path.write_text(contour.linuxcnc())
                theirs = run(path)
                if theirs.error:
                    continue
                path.write_text(contour.fanuc())
                expected = expected_points(theirs.moves, contour, corners)
                actual = points_of_fanuc(comparison, path)
                if not same_points(expected, actual):
                    differences.append(f"compensated_paths.py {seed}: expected {expected}, was {actual}")
        self.assertEqual(differences, [])
        self.assertEqual({name: count for name, count in corners.items() if count < FEWEST_CORNERS[name]}, {})


def points_of_fanuc(comparison, path):
    report = comparison.report_of(path, "--increment-system", "IS-C", dialect="fanuc-30i")
    return report["alarm"] or [(move["to"]["X"], move["to"]["Y"]) for move in comparison.moves_of_tool(report)][1:]


def expected_points(moves, contour, corners):
    """Where LinuxCNC goes, with FANUC's vectors in place of the arc at each outer corner."""
    points = [((move[1]["X"] * 25.4, move[1]["Y"] * 25.4), move) for move in moves[1:]]
    result = []
    for index, (point, move) in enumerate(points):
        if move[0] != "arc":
            result.append(point)
            continue
        corner = tuple(move[2][axis] * 25.4 for axis in "XY")
        before, behind = (tuple(each[i] - corner[i] for i in range(2)) for each in (points[index - 1][0], point))
        while math.dist(result[-1], points[index - 1][0]) < NEAR:  # a move up or down may lie between
            result.pop()
        result += [(corner[0] + v[0], corner[1] + v[1]) for v in vectors_of_fanuc(before, behind, contour, corners)]
    # The end of a contour that goes on: what is left is a corner without an arc.
    plain = len(contour.points) - 1 - sum(move[0] == "arc" for _, move in points)
    turns = [turn_at(contour, i) for i in range(len(contour.points) - 1)]
    corners["tangent"] += sum(abs(turn) < STRAIGHT_ON for turn in turns)
    corners["inner"] += plain - sum(abs(turn) < STRAIGHT_ON for turn in turns)
    return without_repeats(result)


def turn_at(contour, index):
    a, b, c = ([contour.entry, *contour.points][index + k] for k in range(3))
    u, v = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
    return math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])


def vectors_of_fanuc(before, behind, contour, corners):
    """From the offsets square to both blocks: one where the offset lines cross up to a turn of 90 degrees, else two."""
    radius = contour.radius
    cosine = (before[0] * behind[0] + before[1] * behind[1]) / radius ** 2
    if cosine >= 0:
        corners["outer"] += 1
        return [tuple((before[i] + behind[i]) / (1 + cosine) for i in range(2))]
    corners["acute"] += 1
    sign = -1 if contour.side == 42 else 1
    along = [tuple(radius * x for x in (sign * n[1] / radius, -sign * n[0] / radius)) for n in (before, behind)]
    return [(before[0] + along[0][0], before[1] + along[0][1]), (behind[0] - along[1][0], behind[1] - along[1][1])]


def without_repeats(points):
    return [point for index, point in enumerate(points)
            if not index or math.dist(point, points[index - 1]) > NEAR]


def same_points(expected, actual):
    if not isinstance(actual, list):
        return False
    actual = without_repeats(actual)
    return len(expected) == len(actual) and all(math.dist(a, b) < NEAR * 25 for a, b in zip(expected, actual))


if __name__ == "__main__":
    if not available() and not ORACLES:
        sys.exit(SKIPPED)
    unittest.main()
