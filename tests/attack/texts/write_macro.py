"""Macro programs written as text, from pieces that shops write: guards, counters, dispatchers, tables, searches.

Shares nothing with the generator of trees; where that one mixes statements, this one mixes pieces with a purpose.
"""
import random
import re
from fractions import Fraction as F

LOCALS = (1, 2, 3, 7, 8, 18, 24, 26)
COMMONS = (100, 101, 105, 501, 510)
PAIRS = ((2001, 10001), (2202, 11002), (5221, 2501), (5222, 2601), (7001, 14001), (1132, 1100), (1132, 1102))
OUTPUTS = PAIRS[-2:]


def shown(value) -> str:
    value = F(value)
    if value.denominator == 1:
        return str(value.numerator)
    text = f"{float(value):.6f}".rstrip("0")
    return text


def point(value) -> str:
    text = shown(value)
    return text if "." in text else text + "."


class MacroWriter:
    def __init__(self, rng: random.Random, dialect: str, without=()):
        self.rng, self.dialect, self.without = rng, dialect, without

    def files(self) -> dict:
        rng = self.rng
        count = rng.choice((1, 2, 2, 3))
        bodies = {n: self.program(n, [m for m in range(n + 1, count + 1)] + ([n] if rng.random() < 0.05 else []))
                  for n in range(1, count + 1)}
        if count > 1 and rng.random() < 0.35:
            return {f"O{n}.nc": "\n".join(lines) + "\n" for n, lines in bodies.items()}
        return {"O1.nc": "\n".join(line for lines in bodies.values() for line in lines) + "\n"}

    # ---- one program ----

    def program(self, number, callees):
        rng = self.rng
        self.label, self.callees, self.lines, self.loops, self.subs = 100, callees, [], [], []
        self.main = number == 1
        for _ in range(rng.choice((2, 3, 4, 5))):
            self.piece()
        if self.modal and rng.random() < 0.7:
            self.lines.append("G67")
        self.modal = False
        self.lines.append(rng.choice(("M30", "M99", "M30")) if self.main else
                          "M99P200" if rng.random() < 0.08 and "return-to-label" not in self.without else "M99")
        for label, lines in self.subs:
            self.lines += [f"N{label}{lines[0]}", *lines[1:], "M99"]
        clauses = self.clauses()
        return [f"O{number}", *clauses, *self.lines]

    modal = False

    def new_label(self):
        self.label += 10
        return self.label

    def pick(self, *options):
        return self.rng.choice(options)

    def local(self):
        return f"#{self.rng.choice(LOCALS)}"

    def common(self):
        return f"#{self.rng.choice(COMMONS)}"

    def any(self):
        return self.local() if self.rng.random() < 0.6 else self.common()

    def number(self):
        return shown(self.pick(0, 1, 1, 2, 3, 5, F(1, 2), F(1, 4), F(3, 2), 10))

    def term(self):
        roll = self.rng.random()
        if roll < 0.45:
            return self.any()
        if roll < 0.75:
            return self.number()
        if roll < 0.82:
            return f"[{self.any()}{self.pick('+', '-', '*')}{self.number()}]"
        if roll < 0.86:
            return f"{self.pick('ABS', 'FIX', 'FUP', 'ROUND')}[{self.any()}{self.pick('+', '/')}{self.pick('2', '4', '.5')}]"
        if roll < 0.89:
            return f"#[{self.pick('100', '500')}+{self.local()}]"
        if roll < 0.91 and self.pairs():
            return f"#{self.pick(*self.pick(*self.pairs()))}"
        if roll < 0.93:
            return f"[{self.any()}{self.pick('AND', 'OR', 'XOR', 'MOD')}{self.pick('1', '3', '6')}]"
        return self.pick("#4001", "#4003", "#5001", "#5003", "#4109") if roll < 0.97 else "#0"

    def value(self):
        return self.term() if self.rng.random() < 0.5 else f"{self.term()}{self.pick('+', '+', '-', '*')}{self.term()}"

    def condition(self):
        if self.rng.random() < 0.2:
            return f"{self.any()}{self.pick('EQ', 'NE')}#0"
        return f"{self.term()}{self.pick('EQ', 'NE', 'GT', 'GE', 'LT', 'LE')}{self.term()}"

    def add(self, line, may_skip=True):
        self.lines.append(("/" if may_skip and self.rng.random() < 0.03 else "") + line)

    # ---- pieces ----

    def piece(self):
        pieces = [self.guard, self.counted, self.searched, self.dispatch, self.pair, self.table, self.alarm, self.moves,
                  self.plain, self.plain, self.quotient, self.backwards]
        if self.callees:
            pieces += [self.call] * 5
        if self.dialect == "haas-ngc":
            pieces += [self.subprogram] * 2
        self.rng.choice(pieces)()

    def plain(self):
        for _ in range(self.pick(1, 2)):
            self.add(f"{self.any()}={self.value()}")

    def guard(self):
        """Sets what is vacant, or goes to an alarm."""
        each = self.local()
        if self.rng.random() < 0.5:
            self.add(f"IF[{each}EQ#0]THEN{each}={self.number()}", False)
        else:
            label = self.new_label()
            self.add(f"IF[{each}{self.pick('NE#0', 'GT0', 'LE5', 'GE1')}]GOTO{label}", False)
            self.add(f"#3000={self.pick(1, 2, 3)}(WRONG)", False)
            self.add(f"N{label}{self.any()}={self.value()}", False)

    def counted(self):
        use = next((n for n in (1, 2, 3) if n not in self.loops), None)
        if use is None:
            return self.plain()
        count, limit = self.any(), self.pick(self.number(), "3", "4", self.any())
        down = self.rng.random() < 0.3
        self.add(f"{count}={limit if down else self.pick('0', '1')}", False)
        end = "0" if down else limit
        if self.rng.random() < 0.85:
            self.add(f"WHILE[{count}{self.pick('GT', 'GE') if down else self.pick('LT', 'LE', 'NE')}{end}]DO{use}", False)
            out = None
        else:
            self.add(f"DO{use}", False)
            out = self.new_label()
            self.add(f"IF[{count}{'LE' if down else 'GE'}{end}]GOTO{out}", False)
        self.loops.append(use)
        for _ in range(self.pick(1, 1, 2)):
            self.piece() if self.rng.random() < 0.4 else self.plain() if self.rng.random() < 0.5 else self.moves()
        self.loops.pop()
        self.add(f"{count}={count}{'-' if down else '+'}{self.pick('1', '1', '.5')}", False)
        self.add(f"END{use}", False)
        if out:
            self.add(f"N{out}", False)

    def backwards(self):
        label, count = self.new_label(), self.local()
        self.add(f"{count}={self.number()}", False)
        self.add(f"N{label}{self.any()}={self.value()}", False)
        self.add(f"{count}={count}{self.pick('+', '+', '-')}{self.pick('1', '.5', self.any())}", False)
        self.add(f"IF[{count}{self.pick('LT', 'LE', 'NE')}{self.pick('3', '5', self.any())}]GOTO{label}", False)

    def searched(self):
        """The first of some variables that is set."""
        index, out = self.local(), self.new_label()
        self.add(f"{index}=0", False)
        use = next((n for n in (1, 2, 3) if n not in self.loops), 3)
        self.add(f"WHILE[{index}LT3]DO{use}", False)
        self.add(f"IF[#[100+{index}]{self.pick('EQ#0', 'GT1', 'NE0')}]GOTO{out}", False)
        self.add(f"{index}={index}+1", False)
        self.add(f"END{use}", False)
        self.add(f"N{out}{self.common()}={index}", False)

    def dispatch(self):
        base, end = self.new_label(), self.new_label()
        self.add(f"GOTO[{base}+{self.any()}]" if self.rng.random() < 0.7 else f"GOTO{self.any()}", False)
        for offset in range(3):
            self.add(f"N{base + offset}{self.any()}={self.value()}", False)
            if self.rng.random() < 0.5:
                self.add(f"GOTO{end}", False)
        self.add(f"N{end}", False)

    def pair(self):
        """Writes a cell by one number and reads it by the other."""
        if not self.pairs():
            return self.plain()
        one, other = self.rng.sample(self.pick(*self.pairs()), 2)
        bit = one < 1132 and one >= 1100
        self.add(f"#{one}={self.pick('0', '1') if bit or one == 1132 else self.pick(self.number(), self.local())}", False)
        self.add(f"IF[#{other}{self.pick('EQ', 'NE', 'GT')}{self.pick('0', '1', '2')}]THEN{self.common()}={self.number()}", False)
        if self.rng.random() < 0.4:
            self.add(f"IF[#{other}{self.pick('EQ', 'NE')}#{one}]THEN#3000=9(NOT ONE CELL)", False)

    def pairs(self):
        if self.dialect == "haas-ngc" or "system" in self.without:
            return ()
        return OUTPUTS if self.dialect == "mitsubishi-m700" else PAIRS

    def table(self):
        self.add(f"#[{self.pick('100', '500')}+{self.pick(self.local(), '1', '[' + self.local() + 'MOD3]')}]={self.value()}")
        self.add(f"{self.local()}=#[{self.pick('100', '500')}+{self.pick(self.local(), '1')}]")

    def alarm(self):
        self.add(f"IF[{self.condition()}]THEN#3000={self.pick(4, 5, 6)}(STOP)", False)

    def quotient(self):
        self.add(f"{self.any()}={self.value()}/{self.pick(self.any(), '[' + self.any() + '-' + self.number() + ']')}")

    def moves(self):
        code = self.pick("", "", "G0", "G1", "G91", "G90", "G90G1", "G91G0", "G17", "G98")
        words = "".join(axis + self.pick(point(self.pick(1, 2, F(5, 2), 0)), self.any(), f"[{self.value()}]", f"-{self.local()}")
                        for axis in "XYZ" if self.rng.random() < 0.45)
        self.add(code + words + self.pick("", "", "F100.", "F50.", "S2", "H1", "T2", "M3") or "M8")

    def call(self):
        number = self.rng.choice(self.callees)
        repeats = self.pick("", "", "", "L2", "L3", f"L{self.local()}")
        roll = self.rng.random()
        if roll < 0.3:
            return self.add(f"M98P{number}{repeats}", False)
        words = "".join(letter + self.pick(point(self.pick(0, 1, 2, F(1, 2))), self.any(), f"[{self.value()}]", f"-{self.local()}")
                        for letter in self.pick("AB", "ABC", "AD", "IJ", "KI", "AXZ", "RQ", "", "BB", *(() if "letters-of-codes" in self.without else ("FAM", "HSE"))))
        if roll < 0.7 or self.dialect == "haas-ngc" or "modal-calls" in self.without or \
                not self.main and "modal-in-callee" in self.without:
            return self.add(f"G65P{number}{repeats}{words}", False)
        self.add(f"G66P{number}{repeats}{words}", False)
        self.modal = True
        for _ in range(self.pick(1, 1, 2)):
            self.moves()
        if self.rng.random() < 0.6:
            self.add("G67", False)
            self.modal = False

    def subprogram(self):
        label = self.new_label()
        self.add(f"M97P{label}{self.pick('', 'L2', 'L3')}", False)
        self.subs.append((label, [f"{self.any()}={self.value()}" for _ in range(self.pick(1, 2))]))

    # ---- clauses ----

    def clauses(self):
        rng, text = self.rng, "\n".join(self.lines)
        found = []
        reads = {int(n) for n in re.findall(r"#(\d+)(?![\d=])", text)}
        used = [n for n in LOCALS if n in reads]
        for number in rng.sample(used, min(len(used), rng.choice((0, 1, 2, 3)))):
            low = self.pick(0, 1, -1, F(1, 2))
            high = low + self.pick(1, 2, 3)
            found.append(f"(@PARAM #{number} " + self.pick(
                f"{shown(low)}..{shown(high)}", f"{int(low)}..{int(high)} INT", "IN 1,2,4", f"{shown(low)}..",
                f"{shown(low)}..{shown(high)} OPTIONAL") + ")")
        if len(found) > 1 and rng.random() < 0.3:
            one, other = (c.split()[1] for c in found[:2])
            found.append(f"(@REQUIRE {one} {self.pick('LE', 'NE', 'LT')} {other})")
        for number in COMMONS:
            if number in reads and rng.random() < 0.2:
                found.append(f"(@GLOBAL #{number} 0..{self.pick(1, 3)})")
        if rng.random() < 0.2:
            found.append(f"(@MODAL {self.pick('G90', 'G91', 'G90 G0', 'G17 G90')})")
        if rng.random() < 0.1:
            found.append(f"(@START X{self.pick(0, 1)} Z5)")
        for _ in range(0 if "promises" in self.without else rng.choice((0, 1, 1, 2))):
            found.append(f"({self.promise(text)})")
        found = list(dict.fromkeys(found))
        if rng.random() < 0.15 and "guarded" not in self.without and self.guard_entry(found):
            excepted = [word for word in ("MODAL", "START") if any("@" + word in c for c in found) and rng.random() < 0.6]
            found.append(f"(@GUARDED{' EXCEPT ' * bool(excepted)}{' '.join(excepted)})")
        return found

    def guard_entry(self, clauses) -> bool:
        """Alarms for the calls that the clauses exclude, most of the time all of them."""
        conditions = [each for clause in clauses for each in self.excluded(clause.strip("()").split())]
        conditions = [each for each in conditions if self.rng.random() < 0.96]
        self.lines[:0] = [f"IF[{each}]THEN#3000={90 + index % 8}(GUARD)" for index, each in enumerate(conditions)]
        return bool(conditions)

    def excluded(self, words):
        """Conditions of which one holds where the clause does not."""
        head, number = words[0], words[1]
        if head in ("@PARAM", "@GLOBAL"):
            if "OPTIONAL" not in words:
                yield f"{number}EQ#0"
            if words[2] == "IN":
                yield "[" + "*".join(f"[{number}-{value}]" for value in words[3].split(",")) + "]NE0"
                return
            low, high = words[2].split("..")
            yield from ([f"{number}LT{low}"] if low else []) + ([f"{number}GT{high}"] if high else [])
            if "INT" in words:
                yield f"{number}NEFIX[{number}]"
        elif head == "@REQUIRE":
            yield number + {"LE": "GT", "NE": "EQ", "LT": "GE"}[words[2]] + words[3]
        elif head == "@MODAL" and self.rng.random() < 0.5:
            yield from (f"#400{dict(G0=1, G17=2, G90=3, G91=3)[code]}NE{code[1:]}" for code in words[1:])
        elif head == "@START" and self.rng.random() < 0.5:
            yield from (f"#500{'XYZ'.index(place[0]) + 1}NE{place[1:]}" for place in words[1:])

    def promise(self, text):
        written = [n for n in COMMONS if f"#{n}=" in text]
        roll = self.rng.random()
        if roll < 0.25:
            return "@ASSIGNS " + (" ".join(f"#{n}" for n in written) if written and self.rng.random() < 0.7 else "NOTHING")
        if roll < 0.4:
            return "@ENSURE MODAL PRESERVED" + self.pick("", "", " EXCEPT F", " EXCEPT F S", " EXCEPT F S T D H")
        if roll < 0.5:
            return f"@ENSURE {self.pick('G90', 'G91', 'G0', 'G17')}"
        if roll < 0.65 and "#3000=" in text:
            number = text.split("#3000=")[1].split("(")[0]
            line = next(l for l in text.splitlines() if f"#3000={number}(" in l)
            if line.startswith("IF[") and "#[" not in line:
                condition = line[3:line.index("]THEN")]
                for word in ("EQ", "NE", "GT", "GE", "LT", "LE"):
                    condition = condition.replace(word, f" {word} ")
                if not any(c in condition for c in "[]+-*/") and "#4" not in condition and "#5001" not in condition \
                        and "#5003" not in condition and max((len(w) for w in condition.split())) < 5:
                    return f"@ALARM {number} {self.pick('IF', 'IFF')} {condition}"
        named = [n for n in COMMONS if f"#{n}" in text]
        if roll < 0.85 and named:
            number = self.rng.choice(named)
            return f"@ENSURE #{number} {self.pick('EQ OLD[#%d]' % number, 'EQ OLD[#%d]+1' % number, 'GE 0', 'LE 5', 'NE #0')}"
        return f"@ENSURE POS[{self.pick('X', 'Z')}] {self.pick('EQ ENTRY[Z]', 'GE 0', 'EQ 0')}"
