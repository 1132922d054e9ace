"""Runs of texts against what `feedhold ranges` tells."""
from ranges import Moment, Told, Unknown, numbers_in
from . import contract
from .machine import Run
from .reckon import Stop, Unsaid

FUEL = 600


class OutsideOfRanges(Exception):
    pass


def told_of(files, folder, text, dialect, engine) -> Told:
    return Told(engine.ranges(folder / text.file, text.number, dialect), numbers_in(files.values()))


def outside_of_ranges(files, dialect, told: Told, number, start, ask, counts):
    """What a state of the run is that is not told, or None."""
    told.start = None

    def look(run, frame):
        if run.reckoner.rounded:
            return
        if told.start is None and contract.broken_at_entry(frame.visit.text, frame.visit.entry, ask):
            raise Unsaid("a call outside of the contract")
        counts["states held against ranges"] += 1
        why = told.wrong(moment_of(run, frame))
        if why:
            raise OutsideOfRanges(why)
    try:
        Run(files, dialect, start, ask, FUEL, watch=look).go(number)
    except OutsideOfRanges as why:
        return str(why)
    return None


def moment_of(run, frame) -> Moment:
    def read(number):
        try:
            return run.read(number)
        except (Stop, Unsaid):
            return Unknown
    tool, visit = run.tool, frame.visit
    place = tool.work_place() if tool.mapping.is_none and not tool.unsure else None
    return Moment(tuple((f.visit.text.number, f.visit.text.line(f.at)) for f in run.frames[:-1]), visit.text.number,
                  visit.text.line(frame.at), read, place, tool.modes, tool.words, tuple(m.text.number for m in run.modal))
