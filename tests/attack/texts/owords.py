"""LinuxCNC's o-words: programs whose loops and calls lie in several files, and a machine that runs their lines.

After the manual of LinuxCNC: `#1` to `#30` and `#<name>` belong to a call, other numbers to all; variables begin as 0; each call
has counters of its own for `repeat`.
"""
import re
from fractions import Fraction as F

from .reckon import Reckoner, Stop, Unsaid, away
from .switches import Switches
from .write_macro import point, shown

LINE = re.compile(r"o(\d+|<\w+>) (\w+)\s*(.*)")
NAMED = re.compile(r"#<(\w+)>")
BEHIND = {"repeat": "endrepeat", "while": "endwhile", "if": "endif"}
FUEL = 4000


class OwordWriter:
    """`repeat` within `repeat`, across calls and files; `while`, `if`, recursion that ends, and values that come back."""

    def __init__(self, rng, dialect):
        self.rng, self.number = rng, 100

    def files(self) -> dict:
        names = self.rng.sample(("drill", "row", "step", "deep"), self.rng.choice((1, 2, 3)))
        bodies = {}
        for index, name in enumerate(names):
            lines = [f"o<{name}> sub", "#<n>=1", *self.body(names[index + 1:], 3, True)]
            if self.rng.random() < 0.2:
                self.number += 10
                lines += [f"o{self.number} if [#1 GT 1]", f"o<{name}> call [#1-1] [{shown(self.rng.choice((1, 2)))}]",
                          f"o{self.number} endif"]
            bodies[name] = [*lines, f"o<{name}> endsub"]
        main = ["G90 G21 G0 X0 Y0 Z5", "#<n>=2", *self.body(names, 4, False), "M2"]
        files, first = {}, []
        for name, lines in bodies.items():
            if self.rng.random() < 0.6:
                files[f"{name}.ngc"] = "\n".join(lines) + "\n"
            else:
                first += lines
        return {"main.ngc": "\n".join(first + main) + "\n", **files}

    def body(self, names, size, is_sub):
        lines = []
        for _ in range(self.rng.choice(range(1, size + 1))):
            lines += self.piece(names, size, is_sub)
        return lines

    def value(self, is_sub):
        return self.rng.choice(("1", "2", "0.5", "#100", "#101", "#<n>", "[#100+1]") + (("#1", "#2", "#1") if is_sub else ()))

    def piece(self, names, size, is_sub):
        rng = self.rng
        self.number += 10
        own, roll = self.number, rng.random()
        inner = self.body(names, size - 2, is_sub) if size > 2 else self.move(is_sub)
        if roll < 0.25:
            return [f"o{own} repeat [{rng.choice(('2', '3', '1', '0', '#1' if is_sub else '2'))}]", *inner, f"o{own} endrepeat"]
        if roll < 0.5 and names:
            return [f"o<{rng.choice(names)}> call [{self.value(is_sub)}] [{self.value(is_sub)}]"]
        if roll < 0.6:
            count = f"#<k{own}>"
            return [f"{count}=0", f"o{own} while [{count} LT {rng.choice((2, 3))}]", *inner, f"{count}=[{count}+1]",
                    f"o{own} endwhile"]
        if roll < 0.7:
            return [f"o{own} if [{self.value(is_sub)} {rng.choice(('GT', 'LE', 'EQ', 'NE'))} {rng.choice((0, 1, 2))}]", *inner,
                    *([f"o{own} else", *self.move(is_sub)] if rng.random() < 0.5 else []), f"o{own} endif"]
        if roll < 0.85:
            return [f"{rng.choice(('#100', '#101', '#<n>'))}=[{self.value(is_sub)}{rng.choice('+-')}{self.value(is_sub)}]"]
        return self.move(is_sub)

    def move(self, is_sub):
        axis = self.rng.choice("XYZ")
        return self.rng.choice(([f"G91 G1 {axis}{point(self.rng.choice((1, 2, -1)))} F100", "G90"],
                                [f"G0 {axis}[{self.value(is_sub)}]"]))


class OwordRun:
    """Frames are dicts; a position is a file and a line in it."""

    def __init__(self, files: dict):
        self.files = {name: text.splitlines() for name, text in files.items()}
        self.subs = {}
        for name, lines in self.files.items():
            for at, line in enumerate(lines):
                match = LINE.match(line)
                if match and match[2] == "sub":
                    self.subs.setdefault(match[1], (name, at))
        self.names, self.shared, self.stack = {}, {}, []
        self.place, self.modes, self.moves = [F(0)] * 3, {"G0": True, "G90": True}, []
        self.reckoner = Reckoner(self.read, Switches())
        self.end, self.rounded = "", False

    def go(self):
        self.stack = [dict(file="main.ngc", at=0, own={}, counters={})]
        for _ in range(FUEL):
            try:
                self.step(self.stack[-1])
            except (Stop, Unsaid) as reason:
                self.end = f"unsaid {reason}"
            if self.end:
                return self
        self.end = "fuel"
        return self

    # ---- variables ----

    def numbered(self, text):
        return NAMED.sub(lambda m: f"#{90000 + self.names.setdefault(m[1], len(self.names))}", text)

    def cells(self, number):
        return self.stack[-1]["own"] if number <= 30 or number >= 90000 else self.shared

    def read(self, number):
        if number >= 90000 and number not in self.cells(number):
            raise Unsaid("a name without a value")
        return self.cells(number).get(number, F(0))

    def value(self, text):
        return self.reckoner.whole(self.numbered(text))

    # ---- lines ----

    def step(self, frame):
        lines = self.files[frame["file"]]
        if frame["at"] >= len(lines):
            raise Unsaid("the end of a file")
        line = lines[frame["at"]]
        match = LINE.match(line)
        if match:
            return getattr(self, "o_" + match[2])(frame, match[1], match[3])
        frame["at"] += 1
        if line.startswith("#"):
            target, value = self.numbered(line).split("=", 1)
            number = int(target[1:])
            value = self.value(value)
            self.cells(number)[number] = value
        elif line == "M2":
            self.end = "end"
        else:
            self.words(line.split())

    def words(self, words):
        target = list(self.place)
        for word in words:
            if word in ("G90", "G91"):
                self.modes["G90"] = word == "G90"
            elif word[0] in "XYZ":
                index = "XYZ".index(word[0])
                target[index] = self.value(word[1:].rstrip(".")) + (0 if self.modes["G90"] else self.place[index])
        if target != self.place:
            self.place = target
            self.moves.append(tuple(float(c) for c in target))

    def find(self, frame, label, *words):
        for at in range(frame["at"] + 1, len(self.files[frame["file"]])):
            match = LINE.match(self.files[frame["file"]][at])
            if match and match[1] == label and match[2] in words:
                return at, match[2]
        raise Unsaid("no end")

    def find_back(self, frame, label, word):
        for at in range(frame["at"] - 1, -1, -1):
            match = LINE.match(self.files[frame["file"]][at])
            if match and match[1] == label and match[2] == word:
                return at
        raise Unsaid("no beginning")

    def o_sub(self, frame, label, rest):
        frame["at"] = self.find(frame, label, "endsub")[0] + 1

    def o_call(self, frame, label, rest):
        if label not in self.subs or len(self.stack) > 9:
            raise Unsaid("levels of calls")
        if self.subs[label][0] not in (frame["file"], label.strip("<>") + ".ngc"):
            raise Unsaid("a sub of a third file")
        arguments = [self.value(part) for part in re.findall(r"\[.*?\](?=\s|$)", rest)]
        frame["at"] += 1
        file, at = self.subs[label]
        self.stack.append(dict(file=file, at=at + 1, own=dict(enumerate(arguments, 1)), counters={}))

    def o_endsub(self, frame, label, rest):
        self.stack.pop()

    def o_repeat(self, frame, label, rest):
        count = away(self.value(rest), Switches())
        if count > 0:
            frame["counters"][label] = count
            frame["at"] += 1
        else:
            frame["at"] = self.find(frame, label, "endrepeat")[0] + 1

    def o_endrepeat(self, frame, label, rest):
        frame["counters"][label] -= 1
        frame["at"] = self.find_back(frame, label, "repeat") + 1 if frame["counters"][label] > 0 else frame["at"] + 1

    def o_while(self, frame, label, rest):
        if self.value(rest):
            frame["at"] += 1
        else:
            frame["at"] = self.find(frame, label, "endwhile")[0] + 1

    def o_endwhile(self, frame, label, rest):
        frame["at"] = self.find_back(frame, label, "while")

    def o_if(self, frame, label, rest):
        frame["at"] = (frame["at"] if self.value(rest) else self.find(frame, label, "else", "endif")[0]) + 1

    def o_else(self, frame, label, rest):
        frame["at"] = self.find(frame, label, "endif")[0] + 1

    def o_endif(self, frame, label, rest):
        frame["at"] += 1
