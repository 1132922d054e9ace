"""Macro programs whose claims hang on rounding: decimal steps, quotients, roots at their rim, incremental rows.

Each piece is what a shop writes, followed by a test that an exact reader believes in, and sometimes by one with a margin.
"""
import random
import re

DECIMALS = (".1", ".1", ".2", ".3", ".7", ".05", "1.1", "2.54", ".25", ".5", "1", ".01", "3.3")
RANGES = ("0..10", "0.1..5", "0.5..20", "1..20", "-10..10", "0..1", "0.05..2", "1..3")
MARGINS = ("0", ".0000001", ".0005", ".001", ".00000000001", ".0000000000000001", ".000499", ".000501", ".1")
RELATIONS = ("EQ", "NE", "GT", "GE", "LT", "LE")


class DecimalWriter:
    def __init__(self, rng: random.Random, dialect: str):
        self.rng, self.dialect = rng, dialect
        self.lines, self.ranges, self.label, self.alarm, self.local, self.common = [], {}, 10, 0, 10, 100

    def files(self) -> dict:
        callee = self.rng.random() < 0.2
        pieces = [self.row, self.row, self.quotient, self.whole_part, self.root, self.rim, self.incremental, self.pecks, self.pecks,
                  self.back_and_forth, self.angles, self.divided_circle, self.counted, self.word, self.power, self.choice,
                  self.remainder, self.nested, self.search, self.halving]
        for _ in range(self.pick(1, 1, 2, 3)):
            self.pick(*pieces)()
        text = self.text(1, callee)
        if callee:
            text += self.text(2, False, DecimalWriter(self.rng, self.dialect))
        return {"O1.nc": text}

    def text(self, number, calls, of=None):
        if of is not None:
            of.pick(of.row, of.quotient, of.root, of.pecks, of.word)()
            return of.text(number, False)
        if calls:
            self.add("G65P2" + "".join(letter + self.pick(".1", ".7", "2.", f"[#{n}/3]", f"[#{n}*.1]", f"[#{n}+.1]", f"#{n}")
                                       for n, letter in enumerate("ABC", 1)))
        self.lines.append("M99")
        text = "\n".join(self.lines)
        self.read = sorted(n for n in self.ranges if re.search(rf"#{n}\b", text))
        clauses = [f"(@PARAM #{n} {self.ranges[n]})" for n in self.read if self.rng.random() < 0.95]
        if {1, 2} <= set(self.read) and self.rng.random() < 0.35:
            clauses.append(f"(@REQUIRE #{self.pick('1 LE #2', '2 LE #1', '1 LT #2', '2 LT #1')})")
        return "\n".join([f"O{number}", *clauses, *self.promises(), *self.lines]) + "\n"

    def promises(self):
        if self.common == 100 or self.rng.random() < 0.5:
            return []
        one = f"#{self.rng.randint(100, self.common - 1)}"
        names = [f"#{n}" for n in self.read] or ["1"]
        other = self.pick(*names, self.number(), f"#{self.rng.randint(100, self.common - 1)}", "+".join(names), "POS[X]")
        return [f"(@ENSURE {one} {self.pick(*RELATIONS, 'EQ', 'EQ')} {other})"]

    # ---- words ----

    def pick(self, *options):
        return self.rng.choice(options)

    def add(self, line):
        self.lines.append(line)

    def number(self):
        return self.pick(*DECIMALS)

    def input(self, *ranges):
        number = self.pick(1, 2, 3)
        self.ranges.setdefault(number, self.pick(*(ranges or RANGES)))
        return f"#{number}"

    def term(self):
        return self.input() if self.rng.random() < 0.6 else self.number()

    def new(self):
        self.local += 1
        return f"#{self.local}" if self.local < 30 else "#30"

    def result(self):
        self.common += 1
        return f"#{self.common - 1}"

    def check(self, condition):
        self.alarm += 1
        self.add(f"IF[{condition}]THEN#3000={self.alarm}(WRONG)")

    def compare(self, one, other):
        """Tests that two numbers are the same, or in order."""
        margin = self.pick(*MARGINS)
        self.check(self.pick(f"{one}NE{other}", f"{one}GT{other}", f"{one}LT{other}", f"ABS[{one}-{other}]GT{margin}",
                             f"ABS[{one}-{other}]GE{margin}", f"{one}GT[{other}+{margin}]", f"{one}LT[{other}-{margin}]",
                             f"[{one}-{other}]GT{margin}", f"[{one}-{other}]NE0"))

    # ---- pieces ----

    def row(self):
        """Steps to a limit, with a count of them."""
        at, count, step = self.new(), self.new(), self.pick(self.number(), self.number(), f"[1/{self.pick(3, 7, 8, 10)}]")
        limit, times = self.pick("1", ".7", "2", "2.1", "1.1"), self.pick("1", "0")
        if self.rng.random() < 0.4:
            step = self.input("0.05..2", "0.1..5", "0.1..1", "1..3")
        if self.rng.random() < 0.3:
            limit = self.input("0..10", "1..20", "0.5..20")
        self.add(f"{at}={self.pick('0', '0', '.1')}")
        self.add(f"{count}={times}")
        if step.startswith("["):
            self.add(f"{self.new()}={step}")
            step = f"#{self.local}"
        if self.rng.random() < 0.8:
            self.add(f"WHILE[{at}{self.pick('LT', 'LT', 'LE', 'NE')}{limit}]DO1")
            self.add(f"{count}={count}+1")
            self.add(f"{at}={at}+{step}")
            if self.rng.random() < 0.4:
                self.check(f"{at}GT{self.pick(limit, f'[{limit}+{step}]', f'[{limit}+.001]', f'[{limit}+{step}+.0001]')}")
            self.add("END1")
        else:
            self.label += 10
            self.add(f"N{self.label}{count}={count}+1")
            self.add(f"{at}={at}{self.pick('+', '+', '-')}{step}")
            self.add(f"IF[ABS[{at}]LT{limit}]GOTO{self.label}")
        self.after_row(at, count, step, limit)
        self.add(f"{self.result()}={self.pick(at, count)}")

    def after_row(self, at, count, step, limit):
        for _ in range(self.pick(1, 2)):
            self.pick(lambda: self.check(f"{count}{self.pick('GT', 'NE', 'LT', 'GE')}{self.pick(7, 10, 11, 20, 21, 3, 4)}"),
                      lambda: self.compare(at, limit), lambda: self.compare(f"[{count}*{step}]", at),
                      lambda: self.check(f"{count}GT{self.pick('FUP', 'FIX', 'ROUND')}[{limit}/{step}]{self.pick('', '+1')}"))()

    def quotient(self):
        a, b, q, p = self.term(), self.pick(self.input("0.1..5", "1..20", "0.05..2"), "3", "7", ".1", "25.4"), self.new(), self.new()
        self.add(f"{q}={a}/{b}")
        self.add(f"{p}={q}*{b}")
        self.compare(p, a)
        self.add(f"{self.result()}={self.pick(p, q)}")

    def whole_part(self):
        a, b, k = self.input("0..10", "0.5..20", "-10..10"), self.pick(self.input("0.1..5", "0.05..2"), ".1", ".3", ".7"), self.new()
        inner = self.pick(f"{a}/{b}", f"{a}/{b}", f"{a}/{b}+.0005", f"{a}*10")
        self.add(f"{k}={self.pick('FIX', 'FUP', 'ROUND', 'FIX')}[{inner}]")
        rest = self.pick(f"{k}*{b}", f"[{k}+1]*{b}", f"[{k}-1]*{b}")
        self.add(f"{self.new()}={rest}")
        self.compare(f"#{self.local}", a)
        self.add(f"{self.result()}={a}-{k}*{b}")
        self.check(f"#{self.common - 1}{self.pick('LT0', 'GT', 'GE', 'LT-')}{b}".replace(f"LT0{b}", "LT0"))

    def root(self):
        a, b, r = self.input("0..10", "1..20"), self.input("0..10", "1..20", "0.1..5"), self.new()
        inside = self.pick(f"{a}*{a}-{b}*{b}", f"{a}/3*3-{a}", f"{a}-{b}", f"[{a}-{b}]*[{a}+{b}]", f"{a}*{a}+{b}*{b}",
                           f"1-[{b}/{a}]*[{b}/{a}]", f"{a}*{a}", f"ABS[{a}*{a}-{b}*{b}]")
        self.add(f"{r}=SQRT[{inside}]")
        self.compare(self.pick(r, f"[{r}*{r}]"), self.pick(a, f"[{a}*{a}]", f"[{inside}]", f"[{a}+{b}]"))
        self.add(f"{self.result()}={r}")

    def rim(self):
        a, b = self.input("0.1..5", "1..20", "0..1", "0.5..20"), self.input("0.1..5", "1..20", "0..1")
        inside = self.pick(f"{a}/{b}", f"{a}/SQRT[{a}*{a}+{b}*{b}]", f"{a}", f"SIN[{a}]", f"1-{a}/{b}", f"[{a}-{b}]/[{a}+{b}]",
                           f"{a}/3*3/{a}")
        angle = self.new()
        self.add(f"{angle}={self.pick('ACOS', 'ACOS', 'ASIN')}[{inside}]")
        self.check(f"{angle}{self.pick('GT90', 'LT0', 'GT180', 'GE90', 'LE0', 'GT90.0001')}")

    def incremental(self):
        """Rows of incremental words."""
        count, step, times = self.new(), self.new(), self.pick(3, 5, 10, 30)
        self.add(f"{step}={self.term()}/{self.pick(3, 7, 10, 8)}")
        self.add(self.pick("G90G0X0Y0", "G90G0X[#1]Y0", "G90G0X0Y0"))
        self.ranges.setdefault(1, self.pick(*RANGES))
        start, now = self.new(), self.new()
        self.add(f"{start}=#5001")
        self.add(f"{count}=0")
        self.add(f"WHILE[{count}LT{times}]DO1")
        self.add(f"{self.pick('G91', 'G91', 'G90')}X{self.pick(step, f'[{step}]', f'ROUND[{step}]', f'[{count}*{step}]')}")
        self.add(f"{count}={count}+1")
        self.add("END1")
        self.add(f"{now}=#5001")
        bound = self.pick(f".0005*{times}", f".001*{times}", ".001", ".0005", f".0006*{times}", f".0005*{times}+.000001")
        self.check(self.pick(f"ABS[{now}-{start}-{times}*{step}]GT[{bound}]", f"{now}NE[{start}+{times}*{step}]",
                             f"[{now}-{start}]GT[{times}*{step}+{bound}]", f"ABS[{now}-[{times}-1]*{step}]GT[{bound}]"))
        self.add(f"{self.result()}={now}-{times}*{step}")

    def pecks(self):
        depth, step, at, rest = self.input("0.5..20", "1..20", "0..10"), self.input("0.1..5", "0.05..2", "1..3"), self.new(), self.new()
        if depth == step:
            step = ".3"
        self.add(f"{at}=0")
        self.add(f"WHILE[{at}LT{depth}]DO1")
        if self.rng.random() < 0.5:
            self.add(f"{rest}={depth}-{at}")
            self.add(f"IF[{rest}GT{step}]THEN{rest}={step}")
            self.add(f"{at}={at}+{rest}")
        else:
            self.add(f"{at}={at}+{step}")
            self.add(f"IF[{at}GT{depth}]THEN{at}={depth}")
        if self.rng.random() < 0.4:
            self.add(f"G90G1Z-{at}F100")
        self.add("END1")
        self.compare(at, depth)
        self.add(f"{self.result()}={at}")

    def back_and_forth(self):
        a, b = self.term(), self.term()
        c = self.new()
        self.add(f"{c}={self.pick(f'[{a}+{b}]-{b}', f'[{a}-{b}]+{b}', f'[{a}*{b}]/{b}', f'{a}*25.4/25.4', f'{a}/25.4*25.4', f'[{a}*.1]*10', f'{a}+{b}-{a}', f'[{a}+{b}]/2', f'{a}+[{b}-{a}]*.3')}")
        self.compare(c, self.pick(a, b))
        self.check(f"{c}{self.pick('LT', 'GT')}{self.pick(a, b)}")
        self.add(f"{self.result()}={c}")

    def angles(self):
        a, s = self.input("0..10", "-10..10", "1..20"), self.new()
        angle = self.pick(a, f"{a}*9", f"{a}+90", f"45*{a}", f"360/{a}") if self.ranges[int(a[1:])][0] not in "0-" else a
        self.add(f"{s}=SIN[{angle}]*SIN[{angle}]+COS[{angle}]*COS[{angle}]")
        self.compare(s, "1")
        self.add(f"{self.new()}={self.pick('2.5', '10', self.number())}*{self.pick('SIN', 'COS')}[{angle}]")
        self.check(f"#{self.local}{self.pick('GT2.5', 'LT-2.5', 'GT10', 'LT0', 'GE10')}")

    def divided_circle(self):
        count, step, angle, made = self.pick(self.input("1..60 INT", "3..12 INT"), "7", "12", "3"), self.new(), self.new(), self.new()
        self.add(f"{step}=360/{count}")
        self.add(f"{angle}=0")
        self.add(f"{made}=0")
        self.add(f"WHILE[{self.pick(f'{angle}LT360', f'{made}LT{count}', f'{angle}LT359.999', f'{angle}LE[360-{step}/2]')}]DO2")
        self.add(f"{angle}={self.pick(f'{angle}+{step}', f'{angle}+{step}', f'[{made}+1]*{step}')}")
        self.add(f"{made}={made}+1")
        self.add("END2")
        self.check(self.pick(f"{made}NE{count}", f"{made}GT[{count}+1]", f"{angle}NE360", f"ABS[{angle}-360]GT{self.pick(*MARGINS)}"))
        self.add(f"{self.result()}={angle}")

    def counted(self):
        """A whole counter, and what is computed from it."""
        count, at, step, times = self.new(), self.new(), self.number(), self.pick("3", "10", self.input("1..20 INT", "0..10"))
        self.add(f"{count}=0")
        self.add(f"WHILE[{count}LT{times}]DO1")
        self.add(f"{count}={count}+1")
        self.add(f"{at}={count}*{step}")
        self.check(f"{at}{self.pick('GT', 'NE', 'GE')}[{times}*{step}]")
        self.add("END1")
        self.check(f"{count}{self.pick('NE', 'GT', 'LT')}{times}")
        self.compare(at, f"[{times}*{step}]")

    def word(self):
        """A coordinate, read back."""
        a = self.term()
        value = self.new()
        self.add(f"{value}={self.pick(a, f'{a}/3', f'{a}*.1', f'{a}+.0005', f'{a}*1.0001')}")
        self.add(f"G90G0X{self.pick(value, f'[{value}]', f'ROUND[{value}]', f'-{value}')}")
        self.add(f"{self.new()}=#5001")
        self.compare(f"#{self.local}", self.pick(value, a, f"[ROUND[{value}*1000]/1000]"))
        self.add(f"{self.result()}=#{self.local}")

    def power(self):
        a, b = self.input("0.1..5", "1..20", "0..1"), self.new()
        self.add(f"{b}={self.pick(f'{a}*{a}*{a}', f'EXP[LN[{a}+1]]-1', f'{a}*{a}/{a}', f'[{a}+1]*[{a}-1]')}")
        self.compare(b, self.pick(a, f"[{a}*{a}*{a}]", f"[{a}*{a}-1]"))
        self.add(f"{self.result()}={b}")

    def choice(self):
        a, b, m = self.term(), self.term(), self.new()
        self.add(f"{m}={a}")
        self.add(f"IF[{m}{self.pick('GT', 'LT')}{b}]THEN{m}={self.pick(b, f'[{b}+{a}]/2', f'{b}-.1')}")
        self.compare(m, self.pick(a, b))
        self.add(f"{self.result()}={m}")

    def remainder(self):
        a, b, m = self.input("0..10", "1..20", "-10..10"), self.pick("3", "2", "7"), self.new()
        self.add(f"{m}={self.pick(f'{a}MOD{b}', f'{a}-FIX[{a}]', f'{a}-ROUND[{a}]', f'{a}-{b}*FIX[{a}/{b}]', f'FUP[{a}]-{a}')}")
        self.check(f"{m}{self.pick('LT0', 'GE1', 'GT.5', f'GE{b}', f'GT{b}', 'LT-.5')}")
        self.add(f"{self.result()}={m}")

    def nested(self):
        """Rows and columns."""
        step, x, y, holes = self.pick(".1", ".3", "1/3", ".5"), self.new(), self.new(), self.new()
        self.add(f"{holes}=0")
        self.add(f"{y}=0")
        self.add(f"WHILE[{y}LT{self.pick('1', '.9', '2')}]DO1")
        self.add(f"{x}=0")
        self.add(f"WHILE[{x}{self.pick('LT', 'LE')}{self.pick('1', '.9', '.6')}]DO2")
        self.add(f"{holes}={holes}+1")
        self.add(f"{x}={x}+{step}")
        self.add("END2")
        self.add(f"{y}={y}+{self.pick('.5', '.3', '1')}")
        self.add("END1")
        self.check(f"{holes}{self.pick('GT', 'NE')}{self.pick(20, 22, 40, 12)}")
        self.check(f"{x}GT{self.pick('1', '1.1', '1.3', '1.5')}")

    def search(self):
        """By halves, to a tolerance."""
        low, high, middle, a = self.new(), self.new(), self.new(), self.input("1..20", "0..10")
        self.add(f"{low}=0")
        self.add(f"{high}={a}+{self.pick('1', '.1')}")
        self.add(f"WHILE[[{high}-{low}]GT{self.pick('.01', '.5', '.001')}]DO1")
        self.add(f"{middle}=[{low}+{high}]/2")
        self.add(f"IF[{middle}*{middle}GT{a}]GOTO{(label := 500 + len(self.lines))}")
        self.add(f"{low}={middle}")
        self.add(f"GOTO{label + 1}")
        self.add(f"N{label}{high}={middle}")
        self.add(f"N{label + 1}")
        self.add("END1")
        self.check(f"{low}{self.pick('GT', 'GE')}{high}")
        self.compare(f"[{low}*{low}]", a)
        self.add(f"{self.result()}={low}")

    def halving(self):
        """Steps that become smaller."""
        at, step, a = self.new(), self.new(), self.input("0.5..20", "1..20")
        self.add(f"{step}={a}")
        self.add(f"{at}=0")
        self.add(f"WHILE[{step}GT{self.pick('.1', '.01', '.3')}]DO1")
        self.add(f"{at}={at}+{step}")
        self.add(f"{step}={step}{self.pick('*.8', '/2', '*.7', '-.1', '/3')}")
        self.add("END1")
        self.compare(at, self.pick(f"[5*{a}]", f"[2*{a}]", f"[{a}*3]"))
        self.check(f"{step}{self.pick('LT0', 'LE0', 'GT.3')}")
        self.add(f"{self.result()}={at}")
