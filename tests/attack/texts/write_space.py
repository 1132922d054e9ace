"""Programs that move: patterns under zero points and mappings, with regions that lie near where the tool was seen."""
import math
import random
import re
from fractions import Fraction as F

from .machine import Run, texts_of
from .starts import Starts
from .switches import Switches
from .write_macro import point, shown

START_CODES = "(@MODAL G90 G0 G17 G21 G40 G49 G80 G94 G98 G54)"
TRIES = 8


class SpaceWriter:
    def __init__(self, rng: random.Random, dialect: str):
        self.rng, self.dialect = rng, dialect

    def pick(self, *options):
        return self.rng.choice(options)

    def files(self) -> dict:
        rng = self.rng
        self.lines, self.callee, self.arguments = [], rng.random() < 0.25, []
        for number, low, high in rng.sample(((1, 1, 4), (2, F(1, 2), 2), (7, 2, 5), (18, -3, 3)), rng.choice((0, 1, 2, 3))):
            self.arguments.append((number, low, high, rng.random() < 0.3))
        self.feed = self.pick("F100.", "F250.")
        for _ in range(rng.choice((1, 2, 3, 4))):
            self.pick(self.lines_of_moves, self.arcs, self.holes, self.rows, self.mapped, self.shifted, self.home, self.slot,
                      self.pocket, self.called)()
        files = self.whole([])
        return self.whole(self.regions(files))

    def whole(self, regions) -> dict:
        units = START_CODES.replace("G21", "G20") if self.rng_units() else START_CODES
        clauses = [units, "(@START X0 Y0 Z10)"]
        for number, low, high, whole in self.arguments:
            if not re.search(rf"#{number}(?!\d)", "\n".join(self.lines)):
                continue
            clauses.append(f"(@PARAM #{number} {shown(low)}..{shown(high)}{' INT' if whole and F(low).denominator == 1 else ''})")
        body = ["O1", *clauses, *regions, *self.lines, "M99"]
        text = "\n".join(body) + "\n"
        if "P2" in text:
            text += "O2\nG91G1Z-1." + self.feed + "\nX1.\nZ1.\nG90\nM99\n"
        return {"O1.nc": text}

    def rng_units(self):
        return self.feed == "F250."

    # ---- numbers ----

    def length(self, low, high):
        """A coordinate as text."""
        roll = self.rng.random()
        if self.arguments and roll < 0.35:
            number = self.rng.choice(self.arguments)[0]
            return self.pick(f"#{number}", f"-#{number}", f"[#{number}+{self.pick(1, 2)}]", f"[#{number}*{self.pick(2, '.5')}]",
                             f"[{self.pick(3, 5)}-#{number}]")
        return point(F(self.rng.randint(low * 2, high * 2), 2))

    def xy(self):
        return f"X{self.length(-10, 10)}Y{self.length(-10, 10)}"

    def down(self):
        return f"Z{self.pick(point(-1), point(-2), point(F(-1, 2)), '-#2' if any(a[0] == 2 for a in self.arguments) else '-1.5')}"

    def add(self, *lines):
        self.lines += lines

    # ---- pieces ----

    def lines_of_moves(self):
        self.add(f"G0{self.xy()}", f"Z{self.pick('2.', '1.', '5.')}", f"G1{self.down()}{self.feed}")
        for _ in range(self.pick(1, 2, 3)):
            self.add(self.xy() if self.rng.random() < 0.7 else f"{self.pick('X', 'Y')}{self.length(-10, 10)}")
        self.add("G0Z10.")

    def arcs(self):
        plane = self.pick("G17", "G17", "G18", "G19")
        x, y, r = self.rng.randint(-8, 8), self.rng.randint(-8, 8), self.pick(1, 2, 3, F(5, 2))
        self.add(f"G0X{point(x)}Y{point(y)}Z5.", f"G1Z-1.{self.feed}" if plane == "G17" else f"G1Z2.{self.feed}")
        code = self.pick("G2", "G3")
        if plane == "G17":
            kind = self.pick("I", "R", "R", "helix", "whole", "P")
            if kind == "I":
                self.add(f"{code}X{point(x + 2 * r)}I{point(r)}")
            elif kind == "whole":
                self.add(f"{code}X{point(x)}Y{point(y)}I{point(r)}")
            elif kind == "helix":
                self.add(f"{code}X{point(x)}Y{point(y)}Z-3.J{point(r)}")
            elif kind == "P" and any(a[0] == 7 for a in self.arguments):
                self.add(f"G91{code}X#7Y#7R#7", "G90")
            else:
                self.add(f"{code}X{point(x + r)}Y{point(y + r)}R{point(self.pick(r, -r, 2 * r, -2 * r))}")
        elif plane == "G18":
            self.add(f"G18{code}X{point(x + 2 * r)}I{point(r)}" if self.rng.random() < 0.5 else
                     f"G18{code}X{point(x + r)}Z{point(2 + r)}R{point(r)}")
        else:
            self.add(f"G19{code}Y{point(y + 2 * r)}J{point(r)}" if self.rng.random() < 0.5 else
                     f"G19{code}Y{point(y + r)}Z{point(2 + r)}R{point(self.pick(r, 2 * r))}")
        if plane != "G17":
            self.add("G17")
        self.add("G0Z10.")

    def holes(self):
        code = self.pick("G81", "G82", "G83", "G73", "G85", "G84", "G89")
        words = f"{self.down()}R{self.pick('1.', '2.', '.5')}{self.feed}" + ("Q.75" if code in ("G83", "G73") else "") + \
            ("P100" if code in ("G82", "G89") else "")
        self.add(f"{self.pick('G98', 'G99', '')}{code}{self.xy()}{words}")
        for _ in range(self.pick(0, 1, 2)):
            self.add(self.pick(self.xy(), f"X{self.length(-10, 10)}", "G91X2.K2", f"{self.xy()}R1.5"))
            if self.lines[-1].startswith("G91"):
                self.add("G90")
        self.add("G80", "G98", "G0Z10.")

    def rows(self):
        """A counter and an incremental movement."""
        last = self.pick("3", "4", "#1" if any(a[0] == 1 for a in self.arguments) else "3")
        self.add(f"G0{self.xy()}", "Z2.", "#20=0", f"WHILE[#20LT{last}]DO1", f"G1{self.down()}{self.feed}", "G0Z2.",
                 f"G91{self.pick('X', 'Y')}{self.pick('2.', '1.5', '-2.')}", "G90", "#20=#20+1", "END1", "G0Z10.")

    def slot(self):
        """Down by steps, as deep as #21."""
        self.add(f"G0{self.xy()}", "Z1.", "#21=0", "WHILE[#21LT3]DO1", f"#21=#21+{self.pick('1', '.5', '2')}",
                 f"G1Z-#21{self.feed}", f"X{self.length(-10, 10)}", "G0Z1.", "END1", "G0Z10.")

    def pocket(self):
        self.add("G0X0Y0", "Z1.", f"G1Z-1.{self.feed}", "#22=1", "WHILE[#22LE3]DO2", "X#22Y#22", "X-#22", "Y-#22", "X#22", "Y#22",
                 "#22=#22+1", "END2", "G0Z10.")

    def mapped(self):
        on, off = self.pick(("G51.1X0", "G50.1X0"), ("G51.1Y2.", "G50.1Y0"), ("G51.1X1.Y0", "G50.1X0Y0"), ("G68X0Y0R90.", "G69"),
                            ("G68X1.Y1.R30.", "G69"), ("G68X0Y0R180.", "G69"), ("G51X0Y0Z0P2.", "G50"), ("G51X0Y0Z0P.5", "G50"))
        self.add("G0X0Y0", on)
        self.pick(self.lines_of_moves, self.holes, self.arcs, self.rows)()
        self.add(off)
        if self.rng.random() < 0.7:
            self.add("G90G0X0Y0Z10.")

    def shifted(self):
        on, off = self.pick(("G52X2.Y1.", "G52X0Y0"), ("G52Z-1.", "G52Z0"), ("G92X1.", None), ("G10L2P1X1.Y0Z0", None),
                            ("G55", "G54"), ("#5221=1.", None), ("G91G10L2P1X1.", None), ("G92X0Y0Z5.", None))
        self.add(on, *(["G90"] if on.startswith("G91") else []))
        self.pick(self.lines_of_moves, self.holes, self.arcs)()
        if off:
            self.add(off)

    def home(self):
        self.add(*self.pick(("G91G28Z0", "G90"), ("G28Z10.",), ("G53Z0",), ("G91G28X0Y0", "G90"), ("G53X0Y0",), ("G28X0Y0Z10.",)))

    def called(self):
        self.add(f"G0{self.xy()}", "Z1.", self.pick("M98P2", "G65P2", "M98P2L2"), "G0Z10.")

    # ---- regions ----

    def regions(self, files) -> list:
        """Most seem to hold: they lie beside, or around, all that a few runs have shown."""
        rng, strokes = self.rng, []
        text = texts_of(files)[1]
        for _ in range(TRIES):
            run = Run(files, self.dialect, Starts(files, text, rng).any(), Switches(), 3000).go(1)
            strokes += run.tool.strokes
        if not strokes:
            return []
        radius = self.pick(F(1, 2), 1, 2)
        tool = f"(@TOOL {self.pick('FLAT', 'FLAT', 'BALL', 'DRILL')} RADIUS {shown(radius)})" if rng.random() < 0.8 else \
            f"(@TOOL BULL RADIUS {shown(radius)} CORNER {shown(F(radius) / 4)})"
        found = [tool]
        cuts = box_of([s for s in strokes if s.kind != "rapid"])
        everything = box_of(strokes)
        for _ in range(rng.choice((1, 2, 3))):
            kind = rng.random()
            if kind < 0.35:
                found += self.keep_out(strokes, everything, float(radius))
            elif kind < 0.6 and cuts:
                found += self.keep_in(cuts, float(radius))
            elif kind < 0.75:
                slack = self.pick(0, 0, F(-1, 2), 1)
                found.append("(@TRAVEL " + " ".join(f"{a}{floor(everything[i][0], slack)}..{ceiling(everything[i][1], slack)}"
                                                    for i, a in enumerate("XYZ") if rng.random() < 0.8) + ")")
                found[-1] = found[-1] if ".." in found[-1] else "(@TRAVEL X-100..100)"
            elif kind < 0.88:
                found.append(f"(@LIMIT F {self.pick('1..100', '100..250', '0.5..', '..249', '1..1000')})")
            else:
                lows = [float(min(s.points[0][2], s.points[-1][2])) for s in strokes if s.kind == "rapid"]
                found.append(f"(@CLEARANCE Z{floor(self.pick(min(lows), sorted(lows)[len(lows) // 2]), 0)})" if lows else "")
        once = {clause.split()[0] if clause.startswith(("(@LIMIT", "(@TRAVEL", "(@CLEAR")) else clause: clause for clause in found}
        return [clause for clause in once.values() if clause]

    def keep_in(self, box, radius):
        slack = self.pick(0, 0, F(1, 2), F(-1, 4))
        (x0, x1), (y0, y1), (z0, _) = box
        x0, x1, y0, y1 = x0 - radius, x1 + radius, y0 - radius, y1 + radius
        sides = f"X{floor(x0, slack)}..{ceiling(x1, slack)} Y{floor(y0, slack)}..{ceiling(y1, slack)}"
        shape = self.rng.random()
        if shape < 0.5:
            return [f"(@KEEPIN POCKET BOX {sides} Z{floor(z0, slack)}..)"]
        if shape < 0.65:
            middle = shown(F(round(x0 + x1), 2))
            return [f"(@KEEPIN POCKET BOX X{floor(x0, slack)}..{middle} Y{floor(y0, slack)}..{ceiling(y1, slack)} Z{floor(z0, 0)}..)",
                    f"(@KEEPIN POCKET BOX X{middle}..{ceiling(x1, slack)} Y{floor(y0, slack)}..{ceiling(y1, slack)} Z{floor(z0, 1)}..)"]
        around = math.hypot(x1 - x0, y1 - y0) / 2
        x, y = shown(F(round(x0 + x1), 2)), shown(F(round(y0 + y1), 2))
        if shape < 0.85:
            return [f"(@KEEPIN POCKET CYLINDER AT X{x} Y{y} RADIUS {ceiling(around, slack)} Z{floor(z0, 0)}..)"]
        return [f"(@KEEPIN POCKET WHERE [[X-{x}]*[X-{x}]+[Y-{y}]*[Y-{y}] LE {int((around + 1) ** 2) + 1}] AND [Z GE {floor(z0, 0)}])"
                .replace("--", "+")]

    def keep_out(self, strokes, box, radius):
        """Beside or below the way, or somewhere that one of the points is near."""
        rng = self.rng
        (x0, x1), (y0, y1), (z0, _) = box
        place = rng.random()
        gap = self.pick(0, 0, F(1, 4), F(-1, 4))
        if place < 0.2:
            sides = f"X{ceiling(x1 + radius, gap)}..{ceiling(x1 + radius, 5)} Y{floor(y0, 9)}..{ceiling(y1, 9)} Z..{self.pick(0, 5, 20)}"
            return [f"(@KEEPOUT VISE BOX {sides})"]
        if place < 0.3:
            return [f"(@KEEPOUT TABLE BOX Z..{floor(z0, gap)})"]
        stroke = rng.choice(strokes)
        near = rng.choice(stroke.points)
        angle, far = rng.random() * 2 * math.pi, radius + rng.choice((1.5, 3, 5))
        x, y = (F(round(2 * (float(near[i]) + far * f(angle))), 2) for i, f in ((0, math.cos), (1, math.sin)))
        top = self.pick(shown(F(round(2 * float(near[2])), 2)), "0", "5", "-1", "1.5")
        if place < 0.55:
            return [f"(@KEEPOUT CLAMP CYLINDER AT X{shown(x)} Y{shown(y)} RADIUS {self.pick('1', '1.5', '2')} Z-20..{top})"] * 1 + \
                ([f"(@KEEPOUT CLAMP BOX X{shown(x + 4)}..{shown(x + 6)} Y{shown(y)}..{shown(y + 2)} Z-20..{top})"]
                 if rng.random() < 0.3 else [])
        if place < 0.65:
            return [f"(@KEEPOUT CLAMP SPHERE AT X{shown(x)} Y{shown(y)} Z{top} RADIUS 1.5)"]
        if place < 0.75:
            return [f"(@KEEPOUT CLAMP POLYGON X{shown(x)} Y{shown(y)} / X{shown(x + 3)} Y{shown(y)} / X{shown(x + 1)} "
                    f"Y{shown(y + 2)} Z-20..{top})"]
        if place < 0.82:
            return [f"(@KEEPOUT CLAMP CYLINDER AXIS X AT Y{shown(y)} Z{top} RADIUS 1 X{shown(x)}..{shown(x + 3)})"]
        return [f"(@KEEPOUT CLAMP BOX X{shown(x)}..{shown(x + self.pick(1, 2, 3))} Y{shown(y)}..{shown(y + 2)} Z-20..{top})"]


def box_of(strokes):
    points = [[float(c) for c in p] for s in strokes for p in s.points]
    return [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)] if points else None


def floor(value, slack) -> str:
    return shown(F(math.floor((float(value) - float(slack)) * 4), 4))


def ceiling(value, slack) -> str:
    return shown(F(math.ceil((float(value) + float(slack)) * 4), 4))
