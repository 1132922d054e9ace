"""Programs that go home and back: work offsets, tool lengths and a machine of which contracts tell ranges."""
import re
from fractions import Fraction as F

from .write_macro import shown
from .write_space import SpaceWriter, ceiling, floor

MODES = "(@MODAL G0 G17 G21 G40 G49 G54 G69 G80 G90 G94 G98)"


class SetUpWriter(SpaceWriter):
    def files(self) -> dict:
        rng = self.rng
        self.lines, self.arguments, self.feed, self.callee, self.inner = [], [], "F100.", False, []
        for number, low, high in rng.sample(((1, 1, 3), (2, F(1, 2), 2), (7, 20, 40)), rng.choice((0, 1, 2))):
            self.arguments.append((number, low, high, number == 1 or rng.random() < 0.3))
        self.set_up = self.clauses()
        for _ in range(rng.choice((2, 3, 4, 5))):
            self.pick(self.home, self.approach, self.approach, self.work, self.retract, self.zero_point, self.register,
                      self.other_units, self.in_loop, self.branch, self.called, self.mapped_home, self.drill)()
        files = self.whole([])
        return self.whole(self.regions(files))

    def clauses(self) -> list:
        x, y, z = self.pick(-400, -300), self.pick(-250, -200), self.pick(-450, -400)
        wide = self.pick(0, 0, 50, 100)

        def ends(low, far):
            return f"{low}..{low + far}" if far else f"{low}"
        zeros = [f"(@OFFSET G54 X{ends(x, wide)} Y{ends(y, wide // 2)} Z{ends(z, wide)})"]
        if self.rng.random() < 0.6:
            zeros.append(f"(@OFFSET G55 X{ends(x + 50, wide // 2)} Y{ends(y, wide // 2)} Z{ends(z, self.pick(0, 50))})")
        self.additional = "G154" if self.dialect.startswith("haas") else "G54.1"
        if self.rng.random() < 0.5:
            zeros.append(f"(@OFFSET {self.additional} P{self.pick(1, 2)} X{ends(x - 20, wide)} Y{ends(y, 0)} Z{ends(z, wide // 2)})")
        if not self.dialect.startswith("haas"):  # which has none
            zeros.append(f"(@OFFSET EXT X0 Y0 Z{self.pick('0', '0', '-1..1')})")
        low = self.pick(0, 50, 60)
        self.tools = [f"(@LENGTH H* {low}..{low + self.pick(1, 50, 100)})"]
        if self.rng.random() < 0.5:
            self.tools.insert(0, f"(@LENGTH H1 {self.pick('80..90', '75', '100..160')})")
        sides = [f"X-762..{self.pick(0, 0, 5)}", f"Y-406..{self.pick(0, 0, 2)}", f"Z{self.pick(-508, -500, -460)}..{self.pick(0, 0, 1)}"]
        kept = [side for side in sides if self.rng.random() < 0.85] or sides
        return [*zeros, *self.tools, f"(@MACHINE {' '.join(kept)}{self.pick('', ' HOME X0 Y0 Z0')})"]

    def whole(self, regions) -> dict:
        if not hasattr(self, "start"):
            self.start = self.pick([], [], ["(@START X0 Y0 Z300)"], ["(@START Z350)"])
        params = [f"(@PARAM #{n} {shown(low)}..{shown(high)}{' INT' if whole else ''})" for n, low, high, whole in self.arguments
                  if re.search(rf"#{n}(?!\\d)", "\n".join(self.lines))]
        text = "\n".join(["O1", *self.set_up, MODES, *self.start, *params, *regions, *self.lines, "M30"]) + "\n"
        if self.inner:
            text += "\n".join(["O2", *self.inner, "M99"]) + "\n"
        return {"O1.nc": text}

    # ---- pieces ----

    def tool(self) -> str:
        return f"H{self.pick(1, 1, 2, 3)}"

    def up(self) -> str:
        return self.pick("100.", "50.", "#7" if any(a[0] == 7 for a in self.arguments) else "80.", "20.")

    def home(self):
        self.add(*self.pick(("G91G28Z0", "G90"), ("G91G28Z0", "G28X0Y0", "G90"), ("G28Z250.",), ("G53Z0",), ("G53Z-10.",),
                            ("G53X-300.Y0",), ("G91G28X0Y0Z0", "G90"), ("G49G53Z0",), ("G49", "G53Z-20."), ("G53Z0H0",),
                            ("G28X10.Y10.Z200.",), ("G53Z0G49",)))

    def approach(self):
        self.add(*self.pick(("G91G28Z0", "G90"), ("G53Z0",), ()), f"G0{self.pick('G54', 'G54', 'G55', '')}X{self.length(-10, 40)}Y0",
                 self.pick(f"G43Z{self.up()}{self.tool()}", f"G43{self.tool()}Z{self.up()}", f"G43{self.tool()}", "G44Z50.H1",
                           f"G43Z{self.up()}{self.tool()}M8"), f"Z{self.up()}")

    def work(self):
        self.add(f"Z{self.pick('2.', '5.', '20.')}", f"G1Z-{self.pick('1.', '2.', '.5')}{self.feed}", f"X{self.length(-10, 10)}",
                 self.pick("G2X10.Y10.R20.", f"Y{self.length(-5, 5)}", "G91X5.", "G3X0Y10.R15."), "G90G0Z50.")

    def drill(self):
        self.add(f"G81X{self.length(-10, 10)}Z-2.R2.{self.feed}", self.pick("X5.", "G91X2.K2", "Y3.R5."), "G90G80", "G0Z50.")

    def retract(self):
        self.add(*self.pick(("G49Z300.",), ("G49", "Z320."), ("G43H0Z300.",), ("G0Z100.", "G91G28Z0", "G90"), ("G44H2Z200.",)))

    def zero_point(self):
        self.add(*self.pick(("G55",), ("G54",), ("G52X10.Z5.",), ("G52X0Z0",), ("G92Z60.",), ("G92X1.",), ("G10L2P1X-350.Y-250.Z-420.",),
                            ("G91G10L2P1X-1.Z1.", "G90"), ("#5223=#5223+1.",), ("#5221=-350.",), ("#5203=2.",), ("#100=5223", "#[#100]=-430."),
                            ("G10L2P2Z-430.", "G55"), ("G10L2P0Z1.",), ("G55X0", "G54X0"),
                            (f"{self.additional}P1",), (f"{self.additional}P2X0",), (f"{self.additional}P1", "#7001=#7001-5."),
                            ("#14023=-430.", f"{self.additional}P2"), ("#7003=#5223", f"{self.additional}P1X0Y0"),
                            ("#100=14021", "#[#100]=-350.", f"{self.additional}P2Y0")))
        if self.rng.random() < 0.5:
            self.add(f"G0X{self.length(-10, 10)}")

    def register(self):
        self.add(*self.pick(("#2201=#2201+5.", "#2001=0"), ("#2201=70.", "#2001=0"), ("#100=2202", "#[#100]=#[#100]-2."),
                            ("#11001=90.", "#10001=1.") if self.dialect.startswith("fanuc") else ("#2001=1.",), ("#2002=#2002+1.",)),
                 f"G43Z{self.up()}{self.tool()}")

    def other_units(self):
        self.add("G20", *self.pick(("G91G28Z0", "G90"), ("G53Z-.5",), ("G0X1.",), ("G52X.5",), ()), "G21",
                 f"G0X{self.length(-10, 10)}")

    def in_loop(self):
        self.add("#20=0", "WHILE[#20LT3]DO1", *self.pick((f"G43Z{self.up()}H1", "G91X2.", "G90"), ("#5223=#5223-1.", "G0Z300."),
                 ("G53Z-[#20*10]", "G53X-[#20+100]"), ("G91G28Z0", "G90", f"G43H1Z{self.up()}"), ("G43H[#20+1]Z90.",),
                 ("G52X[#20*5]", "G0X0"), (f"{self.additional}P[#20+1]", "G0X5."), (f"{self.additional}P2", "#14021=#14021+1."), ("G0G49Z300.", "G43H2Z50.")), "#20=#20+1", "END1")

    def branch(self):
        number = self.arguments[0][0] if self.arguments else 100
        self.add(f"IF[#{number}GT{self.pick(1, 2, 30)}]GOTO{self.mark()}", *self.pick(("G49Z300.",), (f"G43H2Z{self.up()}",), ("G53Z0",), ("G55",),
                 (f"{self.additional}P2",), ("G52Z5.",), ("#2201=#2201+1.",)), f"N{self.marks}G0X{self.length(-10, 10)}", self.pick("Z120.", "Y5.", "G53Z-1."))

    def mark(self) -> int:
        self.marks = getattr(self, "marks", 0) + 1
        return self.marks

    def called(self):
        """A program of the same contract, or one that changes what it finds."""
        if not self.inner:
            self.inner = self.pick([*self.set_up, MODES, "G0X5.", "G91G28Z0", "G90"], [*self.set_up, MODES, "G43H1Z60.", "G49G53Z0"],
                                   [*self.tools, MODES, "G43H2Z90.", "G0X1.", "G49Z300."],
                                   ["#5221=#5221-10."], ["G49", "G53Z0"], ["G52X10."], ["#2201=#2201+10.", "#2001=0"], ["G55"], [f"{self.additional}P2"],
                                   [*self.set_up, MODES, "(@TOOL FLAT RADIUS 1)", "(@KEEPOUT TABLE BOX Z..0)", "G0X9.", "G53Z0"])
        self.add(self.pick("M98P2", "G65P2"))

    def mapped_home(self):
        self.add(*self.pick(("G68X0Y0R90.", "G0X10.Y0", "G91G28Z0", "G90", "G69", "G0X0Y0"), ("G51.1X0", "G0X10.Y5.", "G50.1X0", "G0X0Y0"),
                            ("G52X0", "G53X-100.Y-100.")))

    # ---- regions ----

    def regions(self, files) -> list:
        found = super().regions(files)
        return [clause for clause in found if not clause.startswith(("(@TRAVEL", "(@LIMIT"))]

    def keep_out(self, strokes, box, radius):
        (x0, x1), (y0, y1), (z0, z1) = box
        gap = self.pick(0, 0, F(1, 4), F(-1, 4), 20)
        low = self.pick(z0, 0, sorted(float(s.points[-1][2]) for s in strokes)[len(strokes) // 3])
        return self.pick(
            [f"(@KEEPOUT TABLE BOX Z..{floor(low, gap)})"],
            [f"(@KEEPOUT VISE BOX X-60..60 Y{ceiling(y1 + radius, gap)}.. Z..{self.pick(5, 50)})"],
            [f"(@KEEPOUT VISE BOX X-60..60 Y-80..{floor(self.pick(y0, -5) - radius, gap)} Z-60..5)"],
            [f"(@KEEPOUT CLAMP CYLINDER AT X{self.pick(20, 30, -30)} Y{self.pick(0, 20, -20)} RADIUS 5 Z-20..{self.pick(5, 10, 40)})"],
            [f"(@KEEPOUT CLAMP BOX X{ceiling(self.pick(x1, 12) + radius, gap)}.. Z..{self.pick(5, 10, 100)})"])
