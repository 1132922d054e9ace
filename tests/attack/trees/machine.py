"""Runs the trees of syntax.py as the manuals say: blocks in order, jumps as a search of the text, calls as levels.

What the manuals leave open asks `choices`; what they do not say, or these tests do not need, raises Unmodelled, and
the run is judged up to there.
"""
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Optional

from . import contracts
from . import controls
from . import syntax
from .ends import OutOfFuel, ProgramEnd, Repeats, UserAlarm
from .motion import Tool
from .values import Arithmetic, ControlAlarm, Evaluator, Model, Unmodelled, least_increment, nearest, number_of


@dataclass
class Inputs:
    """All that a run begins with."""

    locals: dict = field(default_factory=dict)  # number to fraction; absent is vacant
    cells: dict = field(default_factory=dict)
    modes: dict = field(default_factory=dict)
    place: dict = field(default_factory=dict)  # in machine coordinates, which the run begins as those of work
    skip: Optional[bool] = None  # the switch; None: thrown now and then while the program runs


@dataclass(eq=False)
class Activation:
    """One time that a program runs, called or started."""

    program: syntax.Program
    parent: Optional["Activation"]
    called_from: Optional[int]  # index of the block in the parent
    entry_locals: dict
    entry_cells: dict
    entry_modes: dict
    entry_modal_calls: tuple
    entry_tool: object
    broken: tuple = ()  # the clauses of its contract that the call breaks
    visited: set = field(default_factory=set)  # indices of blocks
    taken: set = field(default_factory=set)  # those of them whose condition held
    refused: set = field(default_factory=set)  # those of them whose condition did not hold
    passed: set = field(default_factory=set)  # those that were executed to their end
    written: dict = field(default_factory=dict)  # cells that got another value than at entry, to the block
    moves: list = field(default_factory=list)
    ended: str = ""  # "", return, end
    exit_state: object = None
    children: list = field(default_factory=list)

    @property
    def is_standard(self) -> bool:
        """What every analysis of a program on its own assumes of the start."""
        return not self.entry_modal_calls and self.entry_tool.is_plain


@dataclass
class Frame:
    activation: Activation
    locals: dict
    at: int = 0
    loops: dict = field(default_factory=dict)  # number of DO to its block
    pass_of_call: tuple = (0, 0)


@dataclass
class ModalCall:
    program: syntax.Program
    repeats: int
    locals: dict
    arguments: dict


@dataclass
class Outcome:
    end: str  # return M30 alarm user-alarm fuel endless unmodelled
    activation: Optional[Activation] = None  # where it stopped
    block: Optional[int] = None
    alarm: object = None  # kind of the control's alarm, or the number
    reason: str = ""
    root: Optional[Activation] = None
    cells: dict = field(default_factory=dict)
    locals: dict = field(default_factory=dict)
    moves: list = field(default_factory=list)
    steps: int = 0
    rounds: bool = False
    inexact: bool = False
    cycle: frozenset = frozenset()  # of an endless run: the blocks of the cycle, with their activations
    lasting: frozenset = frozenset()  # the activations that are open all along it, and so never end
    choices: dict = field(default_factory=dict)


class Machine:
    def __init__(self, project, inputs: Inputs, choices, fuel=2000, before_block=None, random=None):
        self.control = controls.CONTROLS[project.dialect]
        self.programs = {program.number: program for program in project.programs()}
        self.inputs = inputs
        self.choices = choices
        self.fuel = fuel
        self.steps = 0
        self.before_block = before_block
        self.random = random
        self.arithmetic = Arithmetic(choices)
        self.cells = {number: Model.held(value) for number, value in inputs.cells.items()}
        place = {axis: Model.held(value) for axis, value in inputs.place.items()}
        self.tool = Tool(self.control, choices, dict(inputs.modes), place, self.cells)
        self.modal_calls: list[ModalCall] = []
        self.fires_below: Optional[int] = None  # inside of a modal macro: the calls outside of it
        self.frames: list[Frame] = []
        self.seen_state, self.seen_activations = None, ()
        self.next_look = 8
        self.since_look = set()  # blocks executed since a state was kept
        self.evaluator = Evaluator(self.arithmetic, self.read)

    # ---- a whole run ----

    def run(self, program: syntax.Program) -> Outcome:
        outcome = Outcome("")
        try:
            try:
                frame = self.enter(program, {n: Model.held(v) for n, v in self.inputs.locals.items()}, None, None)
                outcome.root = frame.activation
                self.follow(frame)
                outcome.end = "return"
            except ProgramEnd:
                outcome.end = "M30"
            except ControlAlarm as alarm:
                outcome.end, outcome.alarm = "alarm", alarm.kind
            except UserAlarm as alarm:
                outcome.end, outcome.alarm = "user-alarm", alarm.number
            except OutOfFuel:
                outcome.end = "fuel"
            except Repeats:
                outcome.end, outcome.cycle = "endless", frozenset(self.since_look)
                outcome.lasting = frozenset(self.seen_activations) & frozenset(f.activation for f in self.frames)
            except Unmodelled as reason:
                outcome.end, outcome.reason = "unmodelled", str(reason)
        except RecursionError:
            outcome.end, outcome.reason = "unmodelled", "recursion of the host"
        if self.frames:
            outcome.activation, outcome.block = self.frames[-1].activation, self.frames[-1].at
            outcome.locals = dict(self.frames[0].locals)
        outcome.cells, outcome.moves, outcome.steps = self.cells, self.tool.moves, self.steps
        outcome.rounds, outcome.inexact = self.arithmetic.rounds, self.arithmetic.inexact
        outcome.choices = dict(self.choices.asked)
        return outcome

    def enter(self, program, locals_, parent: Optional[Activation], called_from: Optional[int]) -> Frame:
        activation = Activation(program, parent, called_from, dict(locals_), dict(self.cells), dict(self.tool.modes),
                                tuple(call.program.number for call in self.modal_calls), self.tool.snapshot())
        frame = Frame(activation, locals_)
        self.frames.append(frame)
        if program.clauses:
            activation.broken = contracts.broken_at_entry(program.clauses, self.evaluator, self.tool.modes,
                                                          self.tool.coordinate)
        if parent is not None:
            parent.children.append(activation)
        return frame

    def follow(self, frame: Frame):
        """From frame.at to the M99; the target of M99 P, or None."""
        while True:
            blocks = frame.activation.program.blocks
            if frame.at >= len(blocks):
                frame.at = max(len(blocks) - 1, 0)
                raise ControlAlarm("end of record")
            target = self.execute(frame, blocks[frame.at])
            if target is not None:
                if self.is_there(target) and (len(self.frames) > 1 or not frame.activation.ended):
                    self.note_return(frame, "return")
                return target

    def is_there(self, target) -> bool:
        """Where M99 P names a number that the caller does not have, the control stops."""
        return target.number is None or len(self.frames) == 1 or \
            any(block.label == target.number for block in self.frames[-2].activation.program.blocks)

    def note_return(self, frame, how):
        activation = frame.activation
        activation.ended = how
        activation.exit_state = ExitState(dict(self.cells), dict(frame.locals), dict(self.tool.modes),
                                          tuple(call.program.number for call in self.modal_calls),
                                          self.tool.snapshot())

    # ---- one block ----

    def execute(self, frame: Frame, block: syntax.Block):
        """Moves frame.at on; returns a Target when the program is left."""
        self.steps += 1
        if self.steps > self.fuel:
            raise OutOfFuel
        if self.before_block:
            self.before_block(self, frame)
        if block.skip and self.is_skipped():
            frame.at += 1
            return None
        frame.activation.visited.add(frame.at)
        self.since_look.add((frame.activation, frame.at))
        here, activation = frame.at, frame.activation
        target = self.effect(frame, block.statement)
        if target is None or self.is_there(target):
            activation.passed.add(here)
        return target

    def holds(self, frame: Frame, condition) -> bool:
        holds = self.evaluator.holds(condition)
        (frame.activation.taken if holds else frame.activation.refused).add(frame.at)
        return holds

    def effect(self, frame: Frame, statement):
        match statement:
            case syntax.Assign(target, value):
                self.assign(target, value)
            case syntax.Alarm(number):
                self.alarm(number)
            case syntax.IfThen(condition, inner):
                if self.holds(frame, condition):
                    if isinstance(inner, syntax.Alarm):
                        self.alarm(inner.number)
                    else:
                        self.assign(inner.target, inner.value)
            case syntax.IfGoto(condition, target):
                if self.holds(frame, condition):
                    self.jump(frame, target)
                    return None
            case syntax.Goto(target):
                self.jump(frame, target)
                return None
            case syntax.While(condition, number):
                if condition is not None and not self.holds(frame, condition):
                    frame.loops.pop(number, None)
                    frame.at = self.end_of(frame, number)
                else:
                    self.look_for_end(frame, number)
                    frame.loops[number] = frame.at
            case syntax.End(number):
                if number not in frame.loops:
                    raise ControlAlarm("END without DO")
                frame.at = frame.loops[number]
                self.look_for_repetition()
                return None
            case syntax.Call():
                return self.call(frame, statement)
            case syntax.Return(target):
                return self.return_to(frame, target)
            case syntax.Words():
                return self.words(frame, statement)
            case syntax.Nothing():
                pass
        frame.at += 1
        return None

    def is_skipped(self) -> bool:
        if self.inputs.skip is not None:
            return self.inputs.skip
        return self.random.random() < 0.5

    def alarm(self, number):
        value = self.evaluator.value(number)
        if value is None or not 0 <= value <= self.control.last_alarm_number or value.denominator != 1:
            raise Unmodelled("number of an alarm")
        raise UserAlarm(int(value))

    # ---- jumps ----

    def jump(self, frame: Frame, target):
        value = self.evaluator.value(target)
        if value is None:
            raise Unmodelled("GOTO of a vacant value")
        self.go_to(frame, nearest(value, self.choices))

    def go_to(self, frame: Frame, number: int):
        if number <= 0:
            raise ControlAlarm("label")
        blocks = frame.activation.program.blocks
        order = list(range(frame.at + 1, len(blocks))) + list(range(frame.at + 1))
        for index in order:
            if blocks[index].label == number:
                break
        else:
            raise ControlAlarm("label")
        is_back = index <= frame.at
        frame.at = index
        if frame.loops and self.choices.choose("left-loop-is-forgotten", (True, False)):
            frame.loops = {n: do for n, do in frame.loops.items() if do <= index <= self.end_index(frame, do, n)}
        if is_back:
            self.look_for_repetition()

    def end_of(self, frame: Frame, number: int) -> int:
        index = self.end_index(frame, frame.at, number)
        if index is None:
            raise ControlAlarm("DO without END")
        return index

    def look_for_end(self, frame: Frame, number: int):
        """Without one the control stops; whether here or later is not said."""
        try:
            self.end_of(frame, number)
        except ControlAlarm:
            if self.choices.choose("do-without-end-stops-at-do", (True, False)):
                raise
            raise Unmodelled("where a DO without END stops") from None

    def end_index(self, frame: Frame, do: int, number: int) -> int:
        blocks = frame.activation.program.blocks
        for index in range(do + 1, len(blocks)):
            if blocks[index].statement == syntax.End(number):
                return index
        raise ControlAlarm("DO without END")

    def look_for_repetition(self):
        """After Brent: the state is kept at growing distances, and compared at every jump back."""
        if self.inputs.skip is None:
            return
        state = self.whole_state()
        if state == self.seen_state:
            raise Repeats
        if self.steps >= self.next_look:
            self.seen_state, self.next_look = state, self.steps * 2
            self.seen_activations = tuple(frame.activation for frame in self.frames)
            self.since_look = set()

    def whole_state(self):
        frames = tuple((f.activation.program.number, f.at, tuple(sorted(present(f.locals))), tuple(sorted(f.loops.items())),
                        f.pass_of_call) for f in self.frames)
        calls = tuple((c.program.number, c.repeats, tuple(sorted(present(c.locals)))) for c in self.modal_calls)
        return frames, calls, tuple(sorted(present(self.cells))), self.tool.key()

    # ---- variables ----

    def read(self, number: int):
        if number == 0 or number == 3100 and self.control.dialect == "fanuc-30i":
            return None
        if controls.is_local(number):
            return self.frames[-1].locals.get(number)
        if controls.is_common(number):
            return self.cells.get(number)
        if number in (1132,) or controls.is_bit_of_outputs(number):
            return self.outputs(number)
        cell = self.cell_of_offset(number)
        if cell is not None:
            return number_of(self.cells.get(cell))
        if 4001 <= number <= 4022 or number in (4109,) or 5001 <= number <= 5003:
            return self.tool.system_value(number, len(self.modal_calls))
        self.named(number)
        raise Unmodelled(f"#{number}")

    def named(self, number: int):
        """Some Mitsubishi controls have #400 to #499, and options add others."""
        if 200 <= number <= 499 and self.control.dialect == "mitsubishi-m700":
            raise Unmodelled("a variable by option")
        if 34 <= number <= 99 or 200 <= number <= 499 or number < 0:
            raise ControlAlarm("variable")

    def cell_of_offset(self, number: int):
        cell = controls.canonical(number)
        if not controls.is_offset(cell):
            return None
        if not self.control.fanuc_offsets and not controls.is_work_offset(number):
            raise Unmodelled("which numbers are one offset")
        return cell

    def outputs(self, number: int):
        whole = int(number_of(self.cells.get(controls.ALL_OUTPUTS)))
        return Fraction(whole if number == controls.ALL_OUTPUTS else whole >> (number - 1100) & 1)

    def assign(self, target: syntax.Variable, value):
        number = self.evaluator.index(target)
        self.write(number, self.evaluator.value(value))

    def write(self, number: int, value):
        if number == 0:
            raise ControlAlarm("write")
        if controls.is_local(number):
            self.frames[-1].locals[number] = value
            return
        self.named(number)
        if number == 3000:
            if value is None or not 0 <= value <= self.control.last_alarm_number or value.denominator != 1:
                raise Unmodelled("number of an alarm")
            raise UserAlarm(int(value))
        if 4001 <= number <= 4022 or 5001 <= number <= 5003:
            raise ControlAlarm("write")
        cell = number
        if not controls.is_common(number):
            if value is None:
                raise Unmodelled("a vacant value for the control")
            if number == controls.ALL_OUTPUTS or controls.is_bit_of_outputs(number):
                cell, value = controls.ALL_OUTPUTS, self.with_outputs(number, value)
            else:
                cell = self.cell_of_offset(number)
            if cell is None:
                raise Unmodelled(f"#{number}")
        if controls.is_work_offset(cell) and value != number_of(self.cells.get(cell)):
            self.tool.zero_is_known = False
        self.cells[cell] = value
        for frame in self.frames:
            if value != self.at_entry(frame.activation, cell):
                frame.activation.written.setdefault(number, (self.frames[-1].activation, self.frames[-1].at))

    @staticmethod
    def at_entry(activation, cell: int):
        value = activation.entry_cells.get(cell)
        return value if controls.is_common(cell) else number_of(value)

    def with_outputs(self, number: int, value):
        if value.denominator != 1 or not 0 <= value < 2 ** 31 or number != controls.ALL_OUTPUTS and value > 1:
            raise Unmodelled("a value for outputs")
        if number == controls.ALL_OUTPUTS:
            return value
        whole, bit = int(number_of(self.cells.get(controls.ALL_OUTPUTS))), 1 << (number - 1100)
        if bit >= 2 ** 31:
            raise Unmodelled("the sign of the outputs")
        return Fraction(whole | bit if value else whole & ~bit)

    # ---- words ----

    def words(self, frame: Frame, statement: syntax.Words):
        if "G67" in statement.codes:
            self.cancel_modal_call()
        for code in statement.codes:
            if code in ("M30", "M2", "M02"):
                for each in self.frames:
                    self.note_return(each, "end")
                raise ProgramEnd
        words = {}
        for letter, expression in statement.words:
            value = self.word_value(expression)
            if value is not None:
                words[letter] = least_increment(value) if letter in controls.AXES else value
        moved = self.tool.block(statement.codes, words, frame, self.frames)
        if moved and self.modal_calls:
            return self.fire_modal_calls(frame)
        frame.at += 1
        return None

    def word_value(self, expression):
        """Vacant words are as if they were not there; of `X-#1` not all manuals say so."""
        if isinstance(expression, syntax.Minus) and isinstance(expression.operand, syntax.Variable):
            value = self.evaluator.value(expression.operand)
            if value is None:
                return None if self.choices.choose("minus-vacant-word", ("dropped", "zero")) == "dropped" else \
                    number_of(None)
            return -value
        return self.evaluator.value(expression)

    # ---- calls ----

    def return_to(self, frame: Frame, target):
        number = None
        if target is not None:
            value = self.evaluator.value(target)
            number = None if value is None else nearest(value, self.choices)
        if number is not None and len(self.frames) == 1 and self.choices.choose("m99-p-of-a-main-program", (True, False)):
            self.go_to(frame, number)
            return None
        return Target(number)

    def program_of(self, expression):
        value = self.evaluator.value(expression)
        if value is None or nearest(value, self.choices) not in self.programs:
            raise Unmodelled("a program that is not there")
        return self.programs[nearest(value, self.choices)]

    def repeats_of(self, expression) -> int:
        value = None if expression is None else self.evaluator.value(expression)
        count = 1 if value is None else nearest(value, self.choices)
        if not 1 <= count <= 9999:
            raise Unmodelled("a number of repeats")
        return count

    def call(self, frame: Frame, call: syntax.Call):
        if call.kind == "M97":
            return self.call_local(frame, call)
        program, repeats = self.program_of(call.program), self.repeats_of(call.repeats)
        if call.kind == "M98":
            return self.repeat_call(frame, program, repeats, None)
        arguments = self.arguments(call.arguments)
        if call.kind == "G65":
            return self.repeat_call(frame, program, repeats, arguments)
        if self.fires_below is not None:
            raise Unmodelled("G66 inside of a modal macro")
        if len(self.modal_calls) > 2:
            raise Unmodelled("levels of modal calls")
        self.modal_calls.append(ModalCall(program, repeats, dict(arguments), arguments))
        frame.at += 1
        return None

    def arguments(self, words) -> dict:
        """I, J and K in turn fill sets; a letter that is not behind the last one begins the next set."""
        values, ijk_set, last = {}, 0, ""
        for letter, expression in words:
            value = self.word_value(expression)
            if letter in "IJK":
                if ijk_set == 0 or letter <= last:
                    ijk_set += 1
                last = letter
                number = 3 * ijk_set + 1 + "IJK".index(letter)
            else:
                number = controls.LETTER_TO_LOCAL[letter]
            if value is not None:
                values[number] = value
        return values

    def repeat_call(self, frame: Frame, program, repeats: int, arguments: Optional[dict], locals_=None):
        """M98 with arguments None; a modal call brings its own variables."""
        is_macro = arguments is not None
        if is_macro and locals_ is None:
            locals_ = dict(arguments)
        for number in range(repeats):
            if is_macro and number and not self.choices.choose("repeat-keeps-locals", self.control.repeats_keep_locals):
                locals_.clear()
                locals_.update(arguments)
            frame.pass_of_call = (number, repeats)
            self.check_depth()
            inner = self.enter(program, locals_ if is_macro else frame.locals, frame.activation, frame.at)
            target = self.follow(inner)
            self.frames.pop()
            if target.number is not None:
                if number + 1 < repeats and self.choices.choose("return-to-label-ends-repeats", (True, False)) is False:
                    raise Unmodelled("M99 P within repeats")
                frame.pass_of_call = (0, 0)
                self.go_to(frame, target.number)
                return None
        frame.pass_of_call = (0, 0)
        frame.at += 1
        return None

    def check_depth(self):
        if len(self.frames) > 4:
            raise Unmodelled("levels of calls")

    def cancel_modal_call(self):
        if self.fires_below is not None:
            raise Unmodelled("G67 inside of a modal macro")
        if self.modal_calls:
            self.modal_calls.pop()
        elif self.choices.choose("g67-alone-stops", (True, False)):
            raise ControlAlarm("G67 without G66")

    def fire_modal_calls(self, frame: Frame):
        """After a movement the last modal call; within it, the one before that."""
        outer = self.fires_below
        level = len(self.modal_calls) if outer is None else outer
        if level == 0:
            frame.at += 1
            return None
        if level > 1 and self.choices.choose("nested-modal-calls", ("last-first",)) != "last-first":
            raise Unmodelled("nested modal calls")
        call = self.modal_calls[level - 1]
        self.fires_below = level - 1
        try:
            self.modal_locals = call.locals
            return self.modal_repeats(frame, call)
        finally:
            self.fires_below = outer

    def modal_repeats(self, frame: Frame, call: ModalCall):
        for number in range(call.repeats):
            frame.pass_of_call = (number, call.repeats)
            self.check_depth()
            inner = self.enter(call.program, call.locals, frame.activation, frame.at)
            target = self.follow(inner)
            self.frames.pop()
            if target.number is not None:
                if number + 1 < call.repeats:
                    raise Unmodelled("M99 P within repeats")
                frame.pass_of_call = (0, 0)
                self.go_to(frame, target.number)
                return None
        frame.pass_of_call = (0, 0)
        frame.at += 1
        return None

    def call_local(self, frame: Frame, call: syntax.Call):
        raise Unmodelled("M97")


@dataclass
class Target:
    """Where M99 leads: a label of the caller, or the block behind the call."""

    number: Optional[int]


@dataclass
class ExitState:
    cells: dict
    locals: dict
    modes: dict
    modal_calls: tuple
    tool: object


def present(values: dict):
    return ((number, value) for number, value in values.items() if value is not None)
