"""Runs programs on their text, line by line, with a stack of open programs and no tree of any kind.

Written from the fact sheets of the controls.  What they leave open is asked of `switches`; what they do not say ends
the run by `Unsaid`, and claims are judged up to there.
"""
import re
from dataclasses import dataclass, field
from fractions import Fraction as F
from typing import Optional

from .path import LENGTHS, Tool
from .reckon import Model, Reckoner, Stop, Unsaid, away, to_increment

HEAD = re.compile(r"O(\d+)")
FRONT = re.compile(r"(/?)(?:N(\d+))?")
ARGUMENTS = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26)))
MACRO_LETTERS = {number: letter for letter, number in ARGUMENTS.items()}
ALARM_LIMIT = {"haas-ngc": 999, "mitsubishi-m700": 9999}


@dataclass
class Text:
    """One program, as lines of its file."""

    number: int
    file: str
    first: int  # line of the O word, from 1
    lines: list
    lengths: set = field(default_factory=set)  # numbers of H that some program names

    def line(self, at: int) -> int:
        return self.first + at

    def has(self, label: int) -> bool:
        return any((m := re.match(r"/?N(\d+)", each)) and int(m[1]) == label for each in self.lines)

    def clauses(self):
        return [(self.line(i), t[1:t.index(")")].strip()) for i, t in enumerate(self.lines) if t.startswith("(@")]


def texts_of(files: dict) -> dict:
    found = {}
    for name, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            head = HEAD.match(line)
            if head:
                current = found[int(head[1])] = Text(int(head[1]), name, number, [])
            current.lines.append(line)
    lengths = {int(n) for text in files.values() for line in text.splitlines() if not line.startswith("(")
               for n in re.findall(r"H(\d+)", line)} - {0}
    for text in found.values():
        text.lengths = lengths
    return found


@dataclass
class Start:
    locals: dict = field(default_factory=dict)
    cells: dict = field(default_factory=dict)
    modes: dict = field(default_factory=dict)
    place: dict = field(default_factory=dict)
    spindle: F = F(0)  # the length of its tool where none is in force
    skip: bool = False


@dataclass(eq=False)
class Visit:
    """One time that a program is entered; what judges need to know of it."""

    text: Text
    outer: Optional["Visit"]
    from_line: Optional[int]
    entry: object
    modal_at_entry: tuple
    lines: set = field(default_factory=set)
    held: set = field(default_factory=set)
    failed: set = field(default_factory=set)
    done: set = field(default_factory=set)
    written: dict = field(default_factory=dict)
    first_stroke: int = 0
    left: str = ""
    exit: object = None


@dataclass
class State:
    cells: dict
    locals: dict
    modes: dict
    place: tuple
    words: dict
    shifts: tuple
    modal: tuple
    machine: tuple


@dataclass
class Frame:
    visit: Visit
    locals: dict
    at: int = 0
    loops: dict = field(default_factory=dict)
    kind: str = ""
    passes_left: int = 0
    arguments: dict = field(default_factory=dict)
    fires: Optional[int] = None  # modal calls that may fire in here; None: all
    begins: int = 0


@dataclass
class Modal:
    text: Text
    repeats: int
    locals: dict


class Ended(Exception):
    def __init__(self, how, detail=None):
        super().__init__(how)
        self.how, self.detail = how, detail


class Run:
    def __init__(self, files: dict, dialect: str, start: Start, ask, fuel=1500, watch=None):
        self.texts, self.dialect, self.start, self.ask, self.fuel = texts_of(files), dialect, start, ask, fuel
        self.cells = {number: Model.held(value) for number, value in start.cells.items()}
        self.frames: list[Frame] = []
        self.visits: list[Visit] = []
        self.modal: list[Modal] = []
        self.reckoner = Reckoner(self.read, ask)
        self.tool = Tool(self, start.modes, start.place)
        self.seen, self.track, self.steps = {}, [], 0
        self.watch = watch
        self.end, self.detail, self.line, self.where, self.cycle = "", None, None, None, frozenset()
        self.lasting = []  # the visits that are open all along a cycle

    # ---- the run ----

    def go(self, number: int) -> "Run":
        try:
            self.enter(self.texts[number], {n: Model.held(v) for n, v in self.start.locals.items()}, "start", 0, {})
            while True:
                self.step()
        except Ended as end:
            self.end, self.detail = end.how, end.detail
        except Stop as stop:
            self.end, self.detail = "stop", stop.why
        except Unsaid as reason:
            self.end, self.detail = "unsaid", str(reason)
        if self.frames:
            frame = self.frames[-1]
            self.where, self.line = frame.visit, frame.visit.text.line(frame.at)
        return self

    def state(self) -> State:
        frame = self.frames[-1]
        return State(dict(self.cells), dict(frame.locals), dict(self.tool.modes), tuple(self.tool.work_place()),
                     dict(self.tool.words), self.tool.lasting(), tuple(m.text.number for m in self.modal),
                     tuple(self.tool.machine))

    def enter(self, text, locals_, kind, passes, arguments, fires=None, begin=0):
        outer = self.frames[-1] if self.frames else None
        if len(self.frames) > 4:
            raise Unsaid("levels")
        is_inside = kind == "M97"  # a part of the program that calls it
        visit = outer.visit if is_inside else \
            Visit(text, outer and outer.visit, outer and outer.visit.text.line(outer.at), None,
                  tuple(m.text.number for m in self.modal), first_stroke=len(self.tool.strokes))
        frame = Frame(visit, locals_, begin, kind=kind, passes_left=passes, arguments=arguments, fires=fires, begins=begin)
        self.frames.append(frame)
        if not is_inside:
            visit.entry = self.state()
            self.visits.append(visit)

    def step(self):
        self.steps += 1
        if self.steps > self.fuel:
            raise Ended("fuel")
        frame = self.frames[-1]
        lines = frame.visit.text.lines
        if frame.at >= len(lines):
            frame.at = len(lines) - 1
            if self.dialect == "haas-ngc":
                raise Unsaid("the text ends")
            raise Stop("text ends")
        text = re.sub(r"\([^)]*\)", "", lines[frame.at]).strip()
        if not text or HEAD.match(text):
            frame.at += 1
            return
        if self.watch:
            self.watch(self, frame)
        front = FRONT.match(text)
        if front[1] and self.start.skip:
            frame.at += 1
            return
        visit, line = frame.visit, frame.visit.text.line(frame.at)
        visit.lines.add(line)
        self.track.append((visit, line))
        self.statement(frame, text[front.end():], line)
        if self.frames[-1] is frame:
            visit.done.add(line)

    def statement(self, frame, text, line):
        if text.startswith("IF["):
            holds, at = self.condition(text, 2, frame, line)
            if not holds:
                frame.at += 1
            elif text.startswith("GOTO", at):
                self.jump(frame, text[at + 4:])
            else:
                self.assignment(frame, text[at + 4:])
        elif text.startswith("GOTO"):
            self.jump(frame, text[4:])
        elif text.startswith("WHILE["):
            holds, at = self.condition(text, 5, frame, line)
            self.do(frame, int(text[at + 2:]), holds)
        elif text.startswith("DO"):
            self.do(frame, int(text[2:]), True)
        elif text.startswith("END"):
            number = int(text[3:])
            if number not in frame.loops:
                raise Stop("no DO")
            frame.at = frame.loops[number]
            self.came_back()
        elif text.startswith("#"):
            self.assignment(frame, text)
        elif not text:
            frame.at += 1
        else:
            self.block(frame, self.split(text))

    def condition(self, text, at, frame, line):
        holds, end = self.reckoner.bracket(text, at)
        if not isinstance(holds, bool):
            if self.dialect != "haas-ngc":
                raise Unsaid("a number as a condition")
            holds = bool(holds)
        (frame.visit.held if holds else frame.visit.failed).add(line)
        return holds, end

    def do(self, frame, number, holds):
        if not holds:
            frame.loops.pop(number, None)
            frame.at = self.end_line(frame, frame.at, number) + 1
            return
        try:
            self.end_line(frame, frame.at, number)
        except Stop:
            if self.ask("a DO without END", ("stops", "goes on")) == "goes on":
                raise Unsaid("where a DO without END stops") from None
            raise
        frame.loops[number] = frame.at
        frame.at += 1

    def end_line(self, frame, at, number):
        lines = frame.visit.text.lines
        for place in range(at + 1, len(lines)):
            if re.fullmatch(rf"/?(N\d+)?END{number}", lines[place].strip()):
                return place
        raise Stop("no END")

    # ---- jumps ----

    def jump(self, frame, text):
        value = self.reckoner.whole(text)
        if value is None:
            raise Unsaid("GOTO vacant")
        self.go_to(frame, away(value, self.ask))

    def go_to(self, frame, label):
        lines = frame.visit.text.lines
        places = [(at <= frame.at, at) for at, each in enumerate(lines)
                  if (m := re.match(r"/?N(\d+)", each)) and int(m[1]) == label]
        if label < 1 or not places:
            raise Stop("no label")
        back, at = min(places)
        if frame.loops and self.ask("a jump leaves a loop", ("forgotten", "kept")) == "forgotten":
            frame.loops = {n: do for n, do in frame.loops.items() if do <= at <= self.end_line(frame, do, n)}
        frame.at = at
        if back:
            self.came_back()

    def came_back(self):
        """Looks whether all is as it was some time ago."""
        frames = tuple((f.visit.text.number, f.at, cells(f.locals), tuple(sorted(f.loops.items())), f.passes_left)
                       for f in self.frames)
        whole = frames, cells(self.cells), self.tool.key(), \
            tuple((m.text.number, m.repeats, cells(m.locals)) for m in self.modal)
        visits = [f.visit for f in self.frames]
        if whole in self.seen:
            begin, before = self.seen[whole]
            self.cycle = frozenset(self.track[begin:])
            self.lasting = [visit for visit in visits if any(visit is each for each in before)]
            raise Ended("endless")
        self.seen[whole] = len(self.track), visits

    # ---- variables ----

    def read(self, number):
        if number == 0:
            return None
        if 0 < number < 34:
            return self.frames[-1].locals.get(number)
        if is_common(number):
            return self.cells.get(number)
        cell, bit = cell_of(number, self.dialect)
        if bit is not None:
            return F(int(self.cells.get(cell) or 0) >> bit & 1)
        if cell is not None:
            self.of_length(cell)
            return self.cells.get(cell) or F(0)
        self.named(number)
        return self.tool.variable(number, len(self.modal))

    def assignment(self, frame, text):
        target, value = self.target(text)
        if target == 3000:
            self.alarm(value)
        self.write(target, value)
        frame.at += 1

    def target(self, text):
        """The number of the variable and the value, of `#5=..` and `#[..]=..`."""
        if text[1] == "[":
            index, at = self.reckoner.bracket(text, 1)
            if index is None:
                raise Unsaid("# of vacant")
            index = away(index, self.ask)
        else:
            at = text.index("=")
            index = int(text[1:at])
        return index, self.reckoner.whole(text[text.index("=", at) + 1:])

    def alarm(self, value):
        if value is None or value.denominator != 1 or not 0 <= value <= ALARM_LIMIT.get(self.dialect, 200):
            raise Unsaid("alarm number")
        raise Ended("alarm", int(value))

    def write(self, number, value):
        if number == 0:
            raise Stop("not to be written")
        if 0 < number < 34:
            self.frames[-1].locals[number] = value
            return
        self.named(number)
        if 4000 < number < 4023 or 5000 < number < 5004:
            raise Stop("not to be written")
        if not is_common(number):
            number_cell, bit = cell_of(number, self.dialect)
            if number_cell is None or value is None:
                raise Unsaid(f"#{number} written")
            if number_cell == 1132:
                value = self.outputs(value, bit)
            target = number_cell
            self.of_length(target, True)
        else:
            target = number
        self.cells[target] = value
        if 5200 < target < 5324 or 14000 < target < 14961:
            self.tool.moved_zero()
        for frame in self.frames:
            before = frame.visit.entry.cells.get(target)
            if value != (before if is_common(target) else before or 0):
                frame.visit.written.setdefault(number, (self.frames[-1].visit, self.line_now()))

    def of_length(self, cell, is_written=False):
        """In which units it is read, and when one in force changes, parameters decide."""
        number = next((cell - first for first in LENGTHS if first < cell <= first + 200), None)
        if number and (self.tool.factor != 1 or is_written and self.tool.has_length and self.tool.words["H"] == number):
            raise Unsaid("a register of lengths")

    def named(self, number):
        """Some Mitsubishi controls have #400 to #499, and options add others."""
        if number < 0 or 33 < number < 100 or 199 < number < 500:
            if self.dialect == "mitsubishi-m700" and number > 199:
                raise Unsaid("a variable by option")
            raise Stop("no variable")

    def line_now(self):
        return self.frames[-1].visit.text.line(self.frames[-1].at)

    def outputs(self, value, bit):
        if value.denominator != 1 or value < 0 or value >= (2 ** 31 if bit is None else 2):
            raise Unsaid("outputs")
        if bit is None:
            return value
        if bit == 31:
            raise Unsaid("the highest output")
        whole = int(self.cells.get(1132) or 0)
        return F(whole | 1 << bit if value else whole & ~(1 << bit))

    # ---- blocks of words ----

    def split(self, text):
        """Letters and the texts of their values."""
        words, at = [], 0
        while at < len(text):
            if not text[at].isalpha():
                raise Unsaid(f"no word: {text[at:]}")
            end = at + 1
            while end < len(text) and text[end] in "-#":
                end += 1
            if end < len(text) and text[end] == "[":
                end = Reckoner.closing(text, end) + 1
            else:
                while end < len(text) and text[end] in "0123456789.":
                    end += 1
            words.append((text[at], text[at + 1:end]))
            at = end
        return words

    def value(self, text):
        """Of a word; None where the word is as if it were not there."""
        alone = text.strip("-[]")
        if re.fullmatch(r"#\d+|#\[[^\]]*\]?", alone) and text[0] in "-[" and text.count("#") == 1:
            inner = self.reckoner.whole(alone if text[0] == "-" else text)
            if inner is None:
                how = self.ask("vacant behind a minus" if text[0] == "-" else "vacant in brackets", ("gone", "0"))
                return None if how == "gone" else F(0)
        return self.reckoner.whole(text)

    def block(self, frame, words):
        head = [letter + value for letter, value in words if letter in "GM" and value.replace(".", "").isdigit()]
        for code in ("G65", "G66", "M98", "M97", "M99"):
            if code in head:
                return self.calls(frame, code, [w for w in words if w[0] + w[1] != code])
        if "G67" in head:
            self.cancel(frame)
        if "M30" in head or "M2" in head or "M02" in head:
            for each in self.frames:
                each.visit.left, each.visit.exit = "end", self.state()
            raise Ended("end")
        values = {}
        for letter, text in words:
            if letter + text in head:
                continue
            with self.reckoner.in_word():
                value = self.value(text)
            if value is not None:
                values[letter] = to_increment(value) if Model.doubles and letter in "XYZIJKRQ" else value
        moved = self.tool.block([code for code in head if code != "G67"], values)
        frame.at += 1
        if moved:
            self.fire(frame, len(self.modal) if frame.fires is None else frame.fires)

    def calls(self, frame, code, words):
        values = dict(words)
        if code == "M99":
            return self.leave(frame, values.get("P"))
        number = self.value(values["P"])
        if number is None:
            raise Unsaid("a call of vacant")
        number = away(number, self.ask)
        repeats = self.value(values["L"]) if "L" in values else None
        repeats = 1 if repeats is None else away(repeats, self.ask)
        if not 1 <= repeats <= 9999:
            raise Unsaid("repeats")
        if code == "M97":
            inside = [at for at, each in enumerate(frame.visit.text.lines)
                      if (m := re.match(r"/?N(\d+)", each)) and int(m[1]) == number]
            if not inside:
                raise Stop("no label")
            return self.enter(frame.visit.text, frame.locals, "M97", repeats, {}, frame.fires, inside[0])
        if number not in self.texts:
            raise Unsaid("no such program")
        if code == "M98":
            return self.enter(self.texts[number], frame.locals, "M98", repeats, {}, frame.fires)
        arguments = self.passed(words)
        if code == "G65":
            return self.enter(self.texts[number], dict(arguments), "G65", repeats, arguments, frame.fires)
        if frame.fires is not None or len(self.modal) > 2:
            raise Unsaid("G66 within a modal call, or too many")
        self.modal.append(Modal(self.texts[number], repeats, dict(arguments)))
        frame.at += 1

    def passed(self, words):
        """Each I opens a set of the second way of arguments, and so does a J or K that does not go on."""
        found, at = {}, 3
        for letter, text in words:
            if letter in "GLNOP":
                continue
            value = self.value(text)
            if letter in "IJK":
                place = "IJK".index(letter)
                at += 1
                while (at - 4) % 3 != place:
                    at += 1
                number = at
            else:
                number = ARGUMENTS[letter]
            if value is not None:
                found[number] = value
        return found

    def cancel(self, frame):
        if frame.fires is not None:
            raise Unsaid("G67 within a modal call")
        if self.modal:
            self.modal.pop()
        elif self.ask("G67 alone", ("stops", "does nothing")) == "stops":
            raise Stop("G67 alone")

    def fire(self, frame, level):
        """The block of the movement is the place of the call, until all is done."""
        if not level:
            return
        call = self.modal[level - 1]
        frame.at -= 1
        self.enter(call.text, call.locals, "modal", call.repeats, {}, level - 1)

    def leave(self, frame, target_text):
        target = None if target_text is None else self.value(target_text)
        label = None if target is None else away(target, self.ask)
        if label is not None and (self.dialect == "haas-ngc" or frame.kind == "start" and
                                  self.ask("M99 P of a started program", ("jump", "return")) == "jump"):
            return self.go_to(frame, label)
        exit_ = self.state()
        if frame.kind == "start":
            frame.visit.left, frame.visit.exit = "return", exit_
            raise Ended("return")
        self.frames.pop()
        outer = self.frames[-1]
        if label is not None and not outer.visit.text.has(label):
            raise Stop("no label")
        if frame.kind != "M97":
            frame.visit.left, frame.visit.exit = "return", exit_
        outer.visit.done.add(outer.visit.text.line(outer.at))
        if label is not None:
            if frame.passes_left > 1 and self.ask("M99 P within repeats", ("leaves", "unsaid")) == "unsaid" or \
                    frame.passes_left > 1 and frame.kind == "modal":
                raise Unsaid("M99 P within repeats")
            return self.go_to(outer, label)
        if frame.passes_left > 1:
            self.again(frame)
        else:
            outer.at += 1

    def again(self, frame):
        locals_ = frame.locals
        if frame.kind == "G65" and self.dialect != "haas-ngc" and \
                self.ask("variables of a repeated G65", ("left", "as passed")) == "as passed":
            locals_ = dict(frame.arguments)
        self.enter(frame.visit.text, locals_, frame.kind, frame.passes_left - 1, frame.arguments, frame.fires, frame.begins)


def cells(values: dict) -> tuple:
    return tuple(sorted((n, v) for n, v in values.items() if v is not None))


def is_common(number: int) -> bool:
    return 100 <= number < 200 or 500 <= number < 1000


def cell_of(number: int, dialect: str):
    """(cell, bit) of what the control keeps: one number for all names of a cell."""
    if number == 1132:
        return 1132, None
    if 1100 <= number <= 1131:
        return 1132, number - 1100
    if dialect == "mitsubishi-m700" and not 5201 <= number <= 5323:
        return None, None  # which numbers are one offset is not known
    for low, high, other in ((2001, 2200, 10001), (2201, 2400, 11001), (7001, 7960, 14001)):
        if low <= number <= high:
            number += other - low
    for axis in range(3):
        if 2500 + 100 * axis <= number <= 2506 + 100 * axis:
            number = 5201 + 20 * (number % 100) + axis
    if 10001 <= number <= 10200 or 11001 <= number <= 11200 or \
            5201 <= number <= 5323 and (number - 5201) % 20 < 3 or 14001 <= number <= 14943 and (number - 14001) % 20 < 3:
        return number, None
    return None, None
