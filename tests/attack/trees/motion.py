"""The tool: modal codes, words in force, coordinates and movements."""
from dataclasses import dataclass
from fractions import Fraction

from . import controls
from .values import Model, Unmodelled

AXES = controls.AXES


@dataclass(frozen=True)
class Move:
    kind: str  # rapid feed
    start: tuple
    end: tuple
    coordinates: tuple  # the end, in the work coordinates then in force
    feed: object
    program: int
    block: int
    levels: tuple  # of the open programs, the block of each that led here


@dataclass(frozen=True)
class Snapshot:
    place: tuple
    coordinates: tuple
    registers: tuple
    is_plain: bool


class Tool:
    def __init__(self, control, choices, modes: dict, place: dict, cells: dict):
        self.control = control
        self.choices = choices
        self.modes = {**controls.POWER_ON, **modes}
        self.cells = cells
        self.place = {axis: Fraction(place.get(axis, 0)) for axis in AXES}
        self.registers = dict.fromkeys(("F", "S", "T", "H", "D", "spindle"))
        self.moves = []
        self.zero_is_known = True  # until an offset gets another value

    def coordinate(self, axis: str) -> Fraction:
        """In the work coordinate system in force."""
        if not self.zero_is_known:
            raise Unmodelled("another zero point")
        return self.place[axis]

    def snapshot(self) -> Snapshot:
        return Snapshot(tuple(self.place[a] for a in AXES), tuple(self.place[a] for a in AXES) if self.zero_is_known else None,
                        tuple(sorted(self.registers.items())), True)

    def key(self):
        return (tuple(self.place.values()), tuple(sorted(self.modes.items())),
                tuple((k, v) for k, v in sorted(self.registers.items())))

    def system_value(self, number: int, modal_calls: int):
        if 5001 <= number <= 5003:
            return self.coordinate(AXES[number - 5001])
        if number == 4109:
            if self.registers["F"] is None:
                raise Unmodelled("F of before")
            return self.registers["F"]
        group = number - 4000
        if group == 12:
            return Fraction(66 if modal_calls else 67)
        code = self.modes.get(group)
        if code is None:
            raise Unmodelled(f"group {group}")
        return Fraction(code[1:])

    def block(self, codes, words: dict, frame, frames) -> bool:
        """Codes first, then the movement; tells whether axes were commanded."""
        for code in codes:
            group = controls.GROUP_OF.get(code)
            if group is not None:
                self.modes[group] = code
            elif code in ("M3", "M5"):
                self.registers["spindle"] = code
            elif code not in ("M8", "M9", "G67"):
                raise Unmodelled(code)
        for letter in "FSTHD":
            if letter in words:
                self.registers[letter] = words[letter]
        axes = [axis for axis in AXES if axis in words]
        if not axes:
            return False
        if self.modes[9] != "G80" or self.modes[1] not in ("G0", "G1"):
            raise Unmodelled("arcs and cycles")
        if self.modes[14] != "G54" and any(c.startswith("G5") for c in codes):
            raise Unmodelled("a change of the zero point")
        return self.move_to(axes, words, frame, frames)

    def move_to(self, axes, words, frame, frames) -> bool:
        start = {axis: self.coordinate(axis) for axis in AXES}
        for axis in axes:
            self.place[axis] = Model.held((self.place[axis] if self.modes[3] == "G91" else 0) + words[axis])
        kind = "rapid" if self.modes[1] == "G0" else "feed"
        if kind == "feed" and self.registers["F"] is not None and self.registers["F"] <= 0:
            raise Unmodelled("F 0")
        move = Move(kind, tuple(start.values()), tuple(self.place.values()),
                    tuple(self.coordinate(a) for a in AXES), self.registers["F"],
                    frame.activation.program.number, frame.at,
                    tuple((f.activation.program.number, f.at) for f in frames))
        self.moves.append(move)
        for each in frames:
            each.activation.moves.append(move)
        if start == self.place:
            return self.choices.choose("no-distance-is-a-movement", (True, False))
        return True
