"""Where the tool goes: modes, zero points, mappings, cycles and arcs, as lines of points."""
import math
from dataclasses import dataclass
from fractions import Fraction as F

from .reckon import Model, Unsaid

XYZ = "XYZ"
GROUPS = {}
for _number, _codes in ((1, "G0 G1 G2 G3"), (2, "G17 G18 G19"), (3, "G90 G91"), (5, "G94 G95"), (6, "G20 G21"),
                        (7, "G40"), (8, "G43 G44 G49"), (9, "G73 G80 G81 G82 G83 G84 G85 G86 G89"), (10, "G98 G99"),
                        (11, "G50 G51"), (13, "G96 G97"), (14, "G54 G55 G56 G57 G58 G59 G54.1 G154"), (15, "G61 G64"),
                        (16, "G68 G69"), (22, "G50.1 G51.1")):
    for _code in _codes.split():
        GROUPS[_code] = _number
AT_POWER_ON = {1: "G0", 2: "G17", 3: "G90", 5: "G94", 6: "G21", 7: "G40", 8: "G49", 9: "G80", 10: "G98", 11: "G50",
               13: "G97", 14: "G54", 15: "G64", 16: "G69", 22: "G50.1"}
SETTERS = {"G4", "G10", "G28", "G52", "G53", "G92", "G50", "G51", "G68", "G69", "G50.1", "G51.1"}
PLANES = {"G17": (0, 1, "I", "J"), "G18": (2, 0, "K", "I"), "G19": (1, 2, "J", "K")}
OTHER_UNITS = {"G20": F(10, 254), "G21": F(254, 10)}
LENGTHS = (10000, 11000)  # wear and geometry, in whichever order
OFFSETS = {"G54": 5221, "G55": 5241, "G56": 5261, "G57": 5281, "G58": 5301, "G59": 5321}
ADDITIONAL = ("G54.1", "G154")  # of FANUC and Mitsubishi, of Haas


def additional_offset(number) -> int:
    """The cell of X of `G54.1 P`: #14001 is #7001, too."""
    if F(number).denominator != 1 or not 1 <= number <= 48:
        raise Unsaid("P of an additional work offset")
    return 14001 + 20 * (int(number) - 1)


def offset_of_code(code, number) -> int:
    return additional_offset(number) if code in ADDITIONAL else OFFSETS[code]


@dataclass
class Stroke:
    kind: str  # rapid, feed or hole: the stroke of a cycle
    points: list  # of the tip, in the work coordinates and units of the start
    machine: list  # the same points, as the axes stand
    feed: object
    speed: object
    visit: object
    line: int
    work: tuple  # the end, in the work coordinates then in force
    levels: tuple  # (visit, line) of all open programs


class Mapping:
    """Scaled, then turned, then mirrored."""

    def __init__(self):
        self.scale = None  # centre, factor
        self.turn = None  # centre, cosine, sine
        self.mirror = {}  # index to place

    @property
    def is_none(self):
        return self.scale is None and self.turn is None and not self.mirror

    def out(self, point):
        point = list(point)
        if self.scale:
            centre, factor = self.scale
            point = [c + (p - c) * factor for p, c in zip(point, centre)]
        if self.turn:
            (a, b), cosine, sine = self.turn
            x, y = point[0] - a, point[1] - b
            point[0], point[1] = a + x * cosine - y * sine, b + x * sine + y * cosine
        for index, place in self.mirror.items():
            point[index] = 2 * place - point[index]
        return point

    def back(self, point):
        point = list(point)
        for index, place in self.mirror.items():
            point[index] = 2 * place - point[index]
        if self.turn:
            (a, b), cosine, sine = self.turn
            x, y = point[0] - a, point[1] - b
            point[0], point[1] = a + x * cosine + y * sine, b - x * sine + y * cosine
        if self.scale:
            centre, factor = self.scale
            point = [c + (p - c) / factor for p, c in zip(point, centre)]
        return point


class Tool:
    def __init__(self, run, modes, place):
        self.run, self.ask = run, run.ask
        self.modes = {**AT_POWER_ON, **modes}
        self.words = dict.fromkeys(("F", "S", "T", "H", "D", "P", "spindle"))
        self.local, self.preset = [F(0)] * 3, [F(0)] * 3
        self.mapping = Mapping()
        self.unsure = set()  # axes that a change of the mapping left open
        self.cycle = {}
        self.level = F(0)
        self.length = F(0)  # in force
        self.is_lifted = False  # it has changed, and no word has said since where Z is
        self.is_home = False  # a home move or G53 may have taken it away
        self.factor = F(1)  # units now for one of the start
        self.origin = self.shift()
        self.machine = [F(place.get(a, 0)) + s for a, s in zip(XYZ, self.origin)]
        self.told = self.work_place()
        self.strokes: list[Stroke] = []

    # ---- places ----

    def shift(self):
        first = offset_of_code(self.modes[14], self.words["P"])
        cells = self.run.cells
        return [(cells.get(5201 + i) or F(0)) + (cells.get(first + i) or F(0)) + self.local[i] + self.preset[i] +
                (self.length if i == 2 else 0) for i in range(3)]

    def work_place(self):
        return [m - s for m, s in zip(self.machine, self.shift())]

    def key(self):
        return (tuple(self.machine), tuple(sorted(self.modes.items())), tuple(self.words.items()), tuple(self.told),
                tuple(sorted(self.cycle.items())), self.is_lifted, self.is_home, self.factor, self.lasting())

    def lasting(self):
        """Besides codes and words, what a return may leave behind."""
        return (tuple(self.local), tuple(self.preset), tuple(sorted(self.cycle.items())) if self.modes[9] != "G80" else (),
                repr(self.mapping.__dict__), self.length)

    def variable(self, number, modal_calls):
        if 5001 <= number <= 5003:
            if not self.mapping.is_none or self.shift() != self.origin:
                raise Unsaid("place under a mapping or behind another zero point")
            return self.work_place()[number - 5001]
        if number == 4109:
            if self.words["F"] is None:
                raise Unsaid("F of before")
            return self.words["F"]
        if number == 4012:
            return F(66 if modal_calls else 67)
        if 4001 <= number <= 4022 and number - 4000 in self.modes:
            return F(self.modes[number - 4000][1:])
        if number == 3100:
            return None
        raise Unsaid(f"#{number}")

    # ---- blocks ----

    def block(self, codes, words):
        once = [code for code in codes if code in SETTERS]
        if any(code in ADDITIONAL for code in codes):
            if "P" not in words:
                raise Unsaid("an additional work offset without P")
            self.words["P"] = words["P"]
        for code in codes:
            self.one_code(code)
        for letter in "FSTHD":
            if letter in words:
                self.words[letter] = words[letter]
        self.take_length(codes, words)
        for code in once:
            if getattr(self, "do_" + code.lower().replace(".", "_"))(words):
                return any(axis in words for axis in XYZ) and code in ("G28", "G53")
        if self.modes[14] and any(code in OFFSETS or code in ADDITIONAL for code in codes):
            self.moved_zero()
        axes = [axis for axis in XYZ if axis in words]
        if self.modes[9] != "G80":
            return self.hole(words, axes)
        if not axes and not (self.modes[1] in ("G2", "G3") and {"I", "J", "K", "R"} & set(words)):
            return False
        return self.move(words, axes)

    def one_code(self, code):
        group = GROUPS.get(code)
        if group == 1 and self.modes[9] != "G80":
            self.modes[9] = "G80"
            self.cycle = {}
        if group == 6 and code != self.modes[6]:
            self.convert(OTHER_UNITS[code])
        if group == 9:
            if code == "G80":
                self.cycle = {}
            elif self.modes[9] == "G80":
                self.level = self.told[2]
        if group is not None:
            self.modes[group] = code
        elif code in ("M3", "M5"):
            self.words["spindle"] = code
        elif code not in SETTERS and code not in ("M6", "M8", "M9"):
            raise Unsaid(code)

    def convert(self, ratio):
        """All that the control keeps is in the new units; whether lengths in memory are, is a parameter's matter."""
        self.plain()
        self.factor *= ratio
        self.machine, self.local, self.preset, self.told = \
            ([each * ratio for each in those] for those in (self.machine, self.local, self.preset, self.told))
        self.length, self.level = self.length * ratio, self.level * ratio
        self.cycle = {letter: value * ratio for letter, value in self.cycle.items()}
        cells = self.run.cells
        cells.update({n: value * ratio for n, value in cells.items() if (5200 < n < 5324 or 14000 < n < 14961) and value is not None})

    # ---- tool length ----

    def take_length(self, codes, words):
        """G43, G44 and G49: the axes stand, and the coordinate changes."""
        code = next((code for code in codes if GROUPS.get(code) == 8), None)
        if code is None:
            if "H" in words and self.modes[8] != "G49":
                raise Unsaid("H by itself")
            return
        self.plain()
        length = F(0) if code == "G49" else self.length_of(self.words["H"]) * (1 if code == "G43" else -1)
        self.is_lifted |= length != self.length
        self.length, self.is_home = length, False
        self.told = self.work_place()

    def length_of(self, number):
        if number is None or number.denominator != 1 or not 0 <= number <= 200 or self.factor != 1:
            raise Unsaid("which length")
        return sum((self.run.cells.get(first + int(number)) or F(0) for first in LENGTHS), F(0)) if number else F(0)

    @property
    def has_length(self):
        return self.modes[8] != "G49" and self.words["H"] != 0

    def name_height(self, relative):
        """A word says where Z is."""
        if self.is_home and self.modes[8] != "G49":
            raise Unsaid("a length behind a home move")
        if self.is_lifted and relative:
            raise Unsaid("incremental behind a change of the length")
        self.is_lifted = False

    def target(self, words):
        relative = self.modes[3] == "G91"
        if "Z" in words:
            self.name_height(relative)
        point = list(self.told)
        for index, axis in enumerate(XYZ):
            if axis in words:
                if relative and index in self.unsure:
                    raise Unsaid("incremental behind a change of the mapping")
                point[index] = Model.held(words[axis] + (point[index] if relative else 0))
                self.unsure.discard(index)
        return point

    def move(self, words, axes):
        code = self.modes[1]
        if code in ("G2", "G3"):
            return self.arc(words, axes)
        if code not in ("G0", "G1"):
            raise Unsaid(code)
        if code == "G1" and self.words["F"] is not None and self.words["F"] <= 0:
            raise Unsaid("F 0")
        begin = list(self.machine)
        self.to(self.target(words), "rapid" if code == "G0" else "feed")
        return True  # a modal call follows a block that names an axis, whatever the distance: docs/soundness.md assumes it

    def to(self, told, kind, between=()):
        """By the points in `between`, all as the program tells them."""
        shift = self.shift()
        points = [list(self.machine)] + [[a + s for a, s in zip(self.mapping.out(p), shift)] for p in (*between, told)]
        self.machine = points[-1]
        self.told = list(told)
        self.record(kind, points)

    def record(self, kind, points):
        frames = self.run.frames
        axes = [[a / self.factor for a in point] for point in points]
        below = self.length / self.factor if self.has_length else self.run.start.spindle
        tip = [o + b for o, b in zip(self.origin, (0, 0, below))]
        here = [[a - t for a, t in zip(point, tip)] for point in axes]
        self.strokes.append(Stroke(kind, here, axes, self.words["F"], self.words["S"], frames[-1].visit,
                                   frames[-1].visit.text.line(frames[-1].at), tuple(self.work_place()),
                                   tuple((f.visit, f.visit.text.line(f.at)) for f in frames)))

    # ---- arcs ----

    def arc(self, words, axes):
        u, v, first, second = PLANES[self.modes[2]]
        begin, end = list(self.told), self.target(words)
        if self.unsure or self.words["F"] is not None and self.words["F"] <= 0:
            raise Unsaid("an arc from an unknown place")
        sign = -1 if self.modes[1] == "G2" else 1
        a, b = (float(begin[u]), float(begin[v])), (float(end[u]), float(end[v]))
        if "R" in words:
            if a == b:
                return False
            centre = self.centre_of_radius(a, b, float(words["R"]), sign)
        elif first in words or second in words:
            centre = a[0] + float(words.get(first, 0)), a[1] + float(words.get(second, 0))
        else:
            raise Unsaid("an arc without centre")
        radius, other = math.dist(a, centre), math.dist(b, centre)
        if radius < 1e-6 or abs(radius - other) > 1e-6:
            raise Unsaid("an arc whose ends do not fit")
        angle = math.atan2(a[1] - centre[1], a[0] - centre[0])
        sweep = (math.atan2(b[1] - centre[1], b[0] - centre[0]) - angle) * sign % (2 * math.pi)
        if sweep < 1e-9 or begin[u] == end[u] and begin[v] == end[v]:
            sweep = 2 * math.pi
        between = []
        w = 3 - u - v
        pieces = 48
        for k in range(1, pieces):
            at = angle + sign * sweep * k / pieces
            point = [F(0)] * 3
            point[u] = F(centre[0] + radius * math.cos(at)).limit_denominator(10 ** 10)
            point[v] = F(centre[1] + radius * math.sin(at)).limit_denominator(10 ** 10)
            point[w] = begin[w] + (end[w] - begin[w]) * k / pieces
            between.append(point)
        self.to(end, "feed", between)
        return True

    @staticmethod
    def centre_of_radius(a, b, radius, sign):
        half = math.dist(a, b) / 2
        if abs(radius) < half + 1e-7:
            raise Unsaid("R below half the chord, or as much")
        away = math.sqrt(radius * radius - half * half)
        if (radius > 0) == (sign > 0):  # to the left of the chord
            away = -away
        dx, dy = (b[0] - a[0]) / (2 * half), (b[1] - a[1]) / (2 * half)
        return (a[0] + b[0]) / 2 + dy * away, (a[1] + b[1]) / 2 - dx * away

    # ---- cycles ----

    def hole(self, words, axes):
        if self.modes[2] != "G17" or self.unsure or self.is_lifted or self.is_home and self.modes[8] != "G49":
            raise Unsaid("a cycle in another plane, or from an unknown height")
        if not axes and "R" not in words:
            return False
        relative = self.modes[3] == "G91"
        if "R" in words:
            self.cycle["R"] = words["R"] + (self.level if relative else 0)
        if "Z" in words:
            if relative and "R" not in self.cycle:
                raise Unsaid("a cycle without R")
            self.cycle["Z"] = words["Z"] + (self.cycle["R"] if relative else 0)
        if "Q" in words:
            self.cycle["Q"] = words["Q"]
        if "R" not in self.cycle or "Z" not in self.cycle:
            raise Unsaid("a cycle without R or Z")
        if self.cycle["Z"] > self.cycle["R"] or self.words["F"] is not None and self.words["F"] <= 0:
            raise Unsaid("a cycle upwards")
        times = words.get("K", words.get("L", F(1)))
        if times.denominator != 1 or not 0 <= times <= 20:
            raise Unsaid("K of a cycle")
        flat = {a: words[a] for a in "XY" if a in words}
        for _ in range(int(times)):
            self.one_hole(flat)
        return times > 0

    def one_hole(self, words):
        code, top, bottom = self.modes[9], self.cycle["R"], self.cycle["Z"]
        place = self.target(words)
        self.to(place, "rapid")

        def at(height):
            return [place[0], place[1], height]
        self.to(at(top), "rapid")
        step = self.cycle.get("Q", F(0))
        if code in ("G83", "G73"):
            if step <= 0:
                raise Unsaid("pecks without Q")
            height = top
            while height - step > bottom:
                height -= step
                self.to(at(height), "hole")
                if code == "G83":
                    self.to(at(top), "rapid")
        self.to(at(bottom), "hole")
        if code in ("G84", "G85", "G89"):
            self.to(at(top), "hole")
        self.to(at(self.level if self.modes[10] == "G98" else top), "rapid")

    # ---- what a block does once ----

    def do_g4(self, words):
        return True

    def plain(self):
        if not self.mapping.is_none or self.unsure:
            raise Unsaid("a zero point under a mapping")

    def moved_zero(self):
        self.plain()
        self.told = self.work_place()

    def do_g52(self, words):
        if self.run.dialect == "haas-ngc":
            raise Unsaid("one offset for G52 and G92")
        for index, axis in enumerate(XYZ):
            if axis in words:
                self.local[index] = words[axis]
        self.moved_zero()
        return True

    def do_g92(self, words):
        self.plain()
        if self.run.dialect == "haas-ngc":
            raise Unsaid("one offset for G52 and G92")
        if any(self.local):
            raise Unsaid("G92 under G52")
        now = self.work_place()
        for index, axis in enumerate(XYZ):
            if axis in words:
                self.preset[index] += now[index] - words[axis]
        self.moved_zero()
        return True

    def do_g10(self, words):
        if words.get("L") != 2 or words.get("P") not in range(7):
            raise Unsaid("G10")
        first = 5201 + 20 * int(words["P"])
        for index, axis in enumerate(XYZ):
            if axis in words:
                old = self.run.cells.get(first + index) or F(0) if self.modes[3] == "G91" else F(0)
                self.run.write(first + index, old + words[axis])
        self.moved_zero()
        return True

    def do_g53(self, words):
        self.plain()
        if self.modes[3] == "G91" or self.run.dialect != "fanuc-30i" and self.modes[1] != "G0":
            raise Unsaid("G53")
        begin = list(self.machine)
        for index, axis in enumerate(XYZ):
            if axis in words:
                self.machine[index] = words[axis]
        if "Z" in words:
            self.is_lifted, self.is_home = False, True
        self.told = self.work_place()
        self.record("rapid", [begin, list(self.machine)])
        return True

    def do_g28(self, words):
        self.plain()
        axes = [i for i, axis in enumerate(XYZ) if axis in words]
        self.to(self.target(words), "rapid")
        begin = list(self.machine)
        for index in axes:
            self.machine[index] = F(0)
        self.is_home |= 2 in axes
        self.told = self.work_place()
        self.record("rapid", [begin, list(self.machine)])
        return True

    # ---- mappings ----

    def remap(self, axes):
        now = self.work_place()
        if self.mapping.is_none:
            self.told = now
            self.unsure |= set(axes)
            return
        how = self.ask("an axis that is not told behind a new mapping", ("as mapped", "as it stands"))
        self.told = self.mapping.back(now) if how == "as mapped" else now
        self.unsure |= set(axes)

    def settled(self, words, axes, letters="XYZ"):
        """The centre, from words or from where the tool is."""
        self.plain()
        return [words.get(letter, place) for letter, place in zip(letters, self.work_place())]

    def do_g68(self, words):
        if self.modes[2] != "G17" or "R" not in words or self.modes[3] == "G91":
            raise Unsaid("G68")
        centre = self.settled(words, (0, 1))
        turn = words["R"] % 360
        exact = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}.get(turn)
        cosine, sine = exact or (F(f(math.radians(turn))).limit_denominator(10 ** 10) for f in (math.cos, math.sin))
        self.mapping.turn = (centre[0], centre[1]), cosine, sine
        self.remap((0, 1))
        return True

    def do_g69(self, words):
        if self.mapping.turn:
            self.mapping.turn = None
            self.remap((0, 1))
        return False

    def do_g51(self, words):
        if "P" not in words or words["P"] <= 0 or self.modes[3] == "G91":
            raise Unsaid("G51")
        self.mapping.scale = self.settled(words, (0, 1, 2)), words["P"]
        self.remap((0, 1, 2))
        return True

    def do_g50(self, words):
        if self.mapping.scale:
            self.mapping.scale = None
            self.remap((0, 1, 2))
        return False

    def do_g51_1(self, words):
        if self.modes[3] == "G91":
            raise Unsaid("G51.1")
        self.plain()
        for index, axis in enumerate(XYZ):
            if axis in words:
                self.mapping.mirror[index] = words[axis]
        self.remap(tuple(self.mapping.mirror))
        return True

    def do_g50_1(self, words):
        axes = [i for i, a in enumerate(XYZ) if a in words]
        gone = [i for i in axes if self.mapping.mirror.pop(i, None) is not None]
        if gone:
            self.remap(gone)
        return True
