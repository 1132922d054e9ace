"""Runs of trees against what `feedhold ranges` tells."""
import random

from ranges import Moment, Told, Unknown, numbers_in
from .choices import Choices
from .files import file_of, line_of
from .inputs import is_allowed
from .machine import Machine
from .values import ControlAlarm, Unmodelled

FUEL = 600


class OutsideOfRanges(Exception):
    pass


def told_of(project, folder, program, engine) -> Told:
    answer = engine.ranges(folder / file_of(project, program.number).name, program.number, project.dialect)
    return Told(answer, numbers_in(file.text() for file in project.files))


def outside_of_ranges(project, told: Told, program, inputs, choices: Choices, counts):
    """What a state of the run is that is not told, or None."""
    if not is_allowed(program, inputs):
        return None
    told.start = None

    def look(machine, frame):
        if machine.arithmetic.rounds:
            return
        counts["states held against ranges"] += 1
        why = told.wrong(moment_of(project, machine, frame))
        if why:
            raise OutsideOfRanges(why)
    try:
        Machine(project, inputs, choices, FUEL, before_block=look, random=random.Random(0)).run(program)
    except OutsideOfRanges as why:
        return str(why)
    return None


def moment_of(project, machine, frame) -> Moment:
    chain = tuple((f.activation.program.number, line_of(project, f.activation.program.number, f.at))
                  for f in machine.frames[:-1])

    def read(number):
        try:
            return machine.read(number)
        except (ControlAlarm, Unmodelled):
            return Unknown
    tool, number = machine.tool, frame.activation.program.number
    place = list(tool.place.values()) if tool.zero_is_known else None
    return Moment(chain, number, line_of(project, number, frame.at), read, place, tool.modes, tool.registers,
                  tuple(call.program.number for call in machine.modal_calls))
