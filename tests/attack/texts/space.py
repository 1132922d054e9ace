"""Whether a stroke breaks a clause on space, by trying points of the tool and of the region in plain numbers."""
import itertools
import math
import random
import re
from dataclasses import dataclass
from fractions import Fraction as F

from .contract import longest_tool, named_sides_of, of, places, reckoner_at
from .reckon import Reckoner, Unsaid

NEAR = 2e-6
NUMBER = r"(-?\d*\.?\d+|-?#\d+|\[[^ ]*\]|-\[[^ ]*\])?"
SIDE = re.compile(r"\b([XYZ])" + NUMBER + r"\.\." + NUMBER + r"(?=\s|$)")
HEIGHTS = (0.0, 0.3, 1.0, 2.0, 4.0, 9.0, 25.0, 200.0)


class Space:
    """The clauses of one program, with the numbers of one entry."""

    def __init__(self, text, entry, ask):
        self.reckoner = reckoner_at(entry, ask)
        self.tool, self.keep_in, self.keep_out, self.travel, self.limits, self.clearance = None, {}, {}, [], [], None
        self.machine = []
        for _, clause in text.clauses():
            words = clause.split()
            if words[0] == "@TOOL":
                self.tool = words[1], self.number(words[3]), self.number(words[5]) if len(words) > 5 else 0.0
            elif words[0] in ("@KEEPIN", "@KEEPOUT"):
                into = self.keep_in if words[0] == "@KEEPIN" else self.keep_out
                into.setdefault(words[1], []).append(self.part(clause, words))
            elif words[0] == "@TRAVEL":
                self.travel.append(self.box(clause))
            elif words[0] == "@MACHINE":
                self.machine = named_sides_of(clause, self.reckoner)
            elif words[0] == "@LIMIT":
                ends = re.search(NUMBER + r"\.\." + NUMBER + "$", words[2])
                self.limits.append((words[1], *(None if e is None else self.reckoner.whole(e) for e in ends.groups())))
            elif words[0] == "@CLEARANCE":
                self.clearance = self.number(words[1][1:])

    def number(self, text):
        return float(self.reckoner.whole(text))

    def box(self, clause):
        sides = []
        for letter, low, high in SIDE.findall(clause):
            sides.append(("XYZ".index(letter), self.number(low) if low else -math.inf,
                          self.number(high) if high else math.inf))
        return sides

    def at(self, clause, letter):
        return self.number(re.search(rf"\b{letter}({NUMBER[1:-2]})(?=\s|$)", clause)[1])

    def part(self, clause, words):
        """A function of a point: how deep it lies inside; below 0 it is outside."""
        shape = words[2]
        sides = self.box(clause)

        def slab(p):
            return min([min(p[i] - low, high - p[i]) for i, low, high in sides], default=math.inf)
        if shape == "BOX":
            return Part(slab, to_the_rim(lambda t: [near_box(t, sides)], sides))
        if shape == "CYLINDER":
            axis = "XYZ".index(words[words.index("AXIS") + 1]) if "AXIS" in words else 2
            plane = [i for i in range(3) if i != axis]
            centre = [self.at(clause, "XYZ"[i]) for i in plane]
            radius = self.number(words[words.index("RADIUS") + 1])

            def nearest(t):
                place = near_box(t, sides)
                for i, c in zip(plane, centre):
                    place[i] = c
                beside = list(place)
                beside[plane[0]] = min(max(t[plane[0]], centre[0] - radius), centre[0] + radius)
                return [place, beside]
            return Part(lambda p: min(slab(p), radius - math.hypot(*(p[i] - c for i, c in zip(plane, centre)))),
                        to_the_rim(nearest, sides))
        if shape == "SPHERE":
            centre = [self.at(clause, letter) for letter in "XYZ"]
            radius = self.number(words[words.index("RADIUS") + 1])
            return Part(lambda p: radius - math.dist(p, centre), lambda t: [centre])
        if shape == "POLYGON":
            corners = [(self.number(x), self.number(y)) for x, y in
                       re.findall(rf"X({NUMBER[1:-2]}) Y({NUMBER[1:-2]})", clause)]
            middle = [sum(c[i] for c in corners) / len(corners) for i in (0, 1)]
            return Part(lambda p: min(slab(p), inside_polygon(p[0], p[1], corners)),
                        to_the_rim(lambda t: [[*c, near_box(t, sides)[2]] for c in (middle, *corners)], sides))
        if shape == "WHERE":
            return Part(self.where(clause[clause.index("WHERE") + 5:]), lambda t: [])
        raise Unsaid(shape)

    def where(self, text):
        """Only inside or not: the depth is a small number."""
        locals_ = self.reckoner.read

        def holds(p):
            reckoner = Reckoner(locals_, self.reckoner.ask, lambda kind, letter: F(p["XYZ".index(letter)]))
            reckoner.kept = lambda value: value
            return 1e-3 if reckoner.whole(text) else -1e-3
        return holds

    # ---- tools ----

    def radius_at(self, height):
        kind, radius, corner = self.tool or ("FLAT", 0.0, 0.0)  # without a tool the tip is looked at
        if kind == "BALL" and height < radius:
            return math.sqrt(max(0.0, radius ** 2 - (radius - height) ** 2))
        if kind == "BULL" and height < corner:
            return radius - corner + math.sqrt(max(0.0, corner ** 2 - (corner - height) ** 2))
        return radius

    def body(self, tip, rng, aims=(), count=28):
        """Points of the tool whose tip is at `tip`, most on its skin; towards `aims` the nearest ones."""
        yield tip
        for aim in aims:
            level = max(0.0, aim[2] - tip[2])
            # From far below the level itself is but the rim; so it is under the rim of a rounded tool.
            for height in {level, level + 0.01, max(0.0, level - 0.01), *HEIGHTS[:4]}:
                far = math.dist(aim[:2], tip[:2])
                whole = self.radius_at(height) * (1 - 1e-12) / far if far else 0.0
                for part in {min(1.0, whole), whole}:
                    yield (tip[0] + part * (aim[0] - tip[0]), tip[1] + part * (aim[1] - tip[1]), tip[2] + height)
        for height in HEIGHTS:
            around = self.radius_at(height)
            for _ in range(max(1, count // len(HEIGHTS))):
                angle, part = rng.random() * 2 * math.pi, rng.choice((1, 1, 1, rng.random()))
                if rng.random() < 0.5:
                    angle = rng.randrange(8) * math.pi / 4
                r = around * part * (1 - 1e-12)
                yield (tip[0] + r * math.cos(angle), tip[1] + r * math.sin(angle), tip[2] + height)

    # ---- strokes ----

    @staticmethod
    def way(stroke, rng, pieces=10):
        points = [tuple(float(c) for c in p) for p in stroke.points]
        yield from (points[0], points[-1])
        for a, b in zip(points, points[1:]):
            if stroke.kind == "rapid":
                for corner in itertools.product(*zip(a, b)):
                    yield corner
                for _ in range(pieces):
                    yield tuple(p + (q - p) * rng.random() for p, q in zip(a, b))
            count = max(1, pieces * 3 // len(points)) if len(points) > 2 else max(pieces, min(80, int(math.dist(a, b) / 0.3)))
            for k in range(count + 1):
                yield tuple(p + (q - p) * k / count for p, q in zip(a, b))

    @staticmethod
    def nearest(stroke, parts):
        """Of each piece of the way the points that come nearest to what the parts aim at."""
        points = [tuple(float(c) for c in p) for p in stroke.points]
        for a, b in zip(points, points[1:]):
            length = math.dist(a, b) ** 2
            for aim in {tuple(aim) for part in parts for end in (a, b) for aim in part.aims(end)}:
                t = sum((q - p) * (c - p) for p, q, c in zip(a, b, aim)) / length if length else 0.0
                yield tuple(p + (q - p) * min(1.0, max(0.0, t)) for p, q in zip(a, b))
                if stroke.kind == "rapid":
                    yield tuple(min(max(c, min(p, q)), max(p, q)) for p, q, c in zip(a, b, aim))

    def breaks(self, kind, name, stroke, cut, rng, near=NEAR):
        """What the stroke does wrong against a claim of this kind, or None."""
        if kind == "limit":
            return self.limit(stroke)
        if kind == "travel" and name == "@MACHINE":
            for p in stroke.machine:
                if any(low is not None and p[i] < low - near or high is not None and p[i] > high + near
                       for i, low, high in self.machine):
                    return f"the axes are at {show(p)}"
            return None
        if kind == "travel":
            for p in self.way(stroke, rng) if stroke.kind != "rapid" else (stroke.points[0], stroke.points[-1]):
                for box in self.travel:
                    if any(not low - near <= float(p[i]) <= high + near for i, low, high in box):
                        return f"a point {show(p)} outside"
            return None
        if kind == "clearance":
            return self.too_low(stroke, cut, near)
        if kind == "keep-out":
            for tip in itertools.chain(self.way(stroke, rng), self.nearest(stroke, self.keep_out[name])):
                aims = [aim for part in self.keep_out[name] for aim in part.aims(tip)]
                for point in self.body(tip, rng, aims):
                    if any(part(point) > near for part in self.keep_out[name]):
                        return f"with the tip at {show(tip)} the tool's point {show(point)} is inside"
            return None
        if kind == "keep-in" and stroke.kind != "rapid":
            return self.leaves(self.keep_in[name], stroke, rng, near)
        return None

    def has_start_inside(self, text, entry, near=NEAR) -> bool:
        """The tool, or a longer one, is in a region to keep out of; where `@START` tells all, nothing is said of it."""
        if sum(len(places(clause.split()[1:], self.reckoner)) for _, clause in of(text, "@START")) == 3 or not self.tool:
            return False
        longest = longest_tool(text, self.reckoner)
        if longest is None and of(text, "@LENGTH"):
            return False
        tip = [float(c) for c in entry.place]
        tip[2] -= float(longest or 0)
        rng, parts = rng_of(*tip), [part for parts in self.keep_out.values() for part in parts]
        return any(part(point) > near for part in parts for point in self.body(tip, rng, part.aims(tip)))

    def leaves(self, parts, stroke, rng, near):
        for tip in self.way(stroke, rng):
            if all(part(tip) < -near for part in parts):
                return f"the tip {show(tip)} is outside"
            for x, y, z in self.body(tip, rng):
                if not any(self.in_or_above(part, x, y, z, near) for part in parts):
                    return f"with the tip at {show(tip)} the tool's point {show((x, y, z))} is outside"
        return None

    @staticmethod
    def in_or_above(part, x, y, z, near):
        """In the region or above some point of it: heights below are tried densely."""
        return part((x, y, z)) >= -near or any(part((x, y, z - d)) >= -near for d in BELOW)

    def too_low(self, stroke, cut, near):
        if stroke.kind != "rapid":
            return None
        a, b = (tuple(float(c) for c in p) for p in (stroke.points[0], stroke.points[-1]))
        if min(a[2], b[2]) >= self.clearance - near:
            return None
        if math.dist(a[:2], b[:2]) < near:
            if b[2] >= a[2] - near:
                return None
            depth = cut.get((round(a[0], 6), round(a[1], 6)))
            if depth is not None and depth <= b[2] + near:
                return None
        return f"rapid from {show(a)} to {show(b)}"

    def limit(self, stroke):
        if stroke.kind == "rapid":
            return None
        for letter, low, high in self.limits:
            value = stroke.feed if letter == "F" else stroke.speed
            if value is None:
                return f"{letter} is what it was before the program"
            if low is not None and value < low or high is not None and value > high:
                return f"{letter} is {value}"
        return None


@dataclass
class Part:
    """Of a region: how deep a point lies in it, and points of it that a tool at some place comes near to first."""

    depth: object
    aims: object

    def __call__(self, point):
        return self.depth(point)


def near_box(tip, sides):
    place = list(tip)
    for i, low, high in sides:
        place[i] = min(max(place[i], low), high)
    return place


def to_the_rim(aims, sides):
    """Also the top of the region above each aim: a rounded tool is wider there than at its tip."""
    tops = [high for i, _, high in sides if i == 2 and high < math.inf]
    return lambda tip: [*aims(tip), *([aim[0], aim[1], top] for aim in aims(tip) for top in tops)]


BELOW = tuple(0.05 * 1.35 ** k for k in range(30))


def inside_polygon(x, y, corners):
    """The distance from the nearest edge, below 0 outside."""
    inside, nearest = False, math.inf
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            inside = not inside
        length = (bx - ax) ** 2 + (by - ay) ** 2
        t = max(0.0, min(1.0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length))
        nearest = min(nearest, math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)))
    return nearest if inside else -nearest


def show(point):
    return " ".join(f"{axis}{float(value):.6g}" for axis, value in zip("XYZ", point))


def cut_depths(strokes):
    """For each stroke, how deep vertical cutting has gone at the places of before."""
    depths, result = {}, []
    for stroke in strokes:
        result.append(dict(depths))
        if stroke.kind != "rapid":
            for point in (stroke.points[0], stroke.points[-1]):
                key = round(float(point[0]), 6), round(float(point[1]), 6)
                depths[key] = min(depths.get(key, math.inf), float(point[2]))
        last = stroke.points[-1]
        here = round(float(last[0]), 6), round(float(last[1]), 6)
        depths = {here: depths[here]} if here in depths else {}
    return result


def rng_of(*seed):
    return random.Random(" ".join(map(str, seed)))
