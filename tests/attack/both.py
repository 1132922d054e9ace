"""The two interpreters with each other, on a program of the first generator: where they differ, one of them is wrong."""
import random

from texts.compare import Summary, of_run, unlike
from texts.machine import Run, Start
from texts.switches import every_way
from trees.choices import Choices
from trees.files import file_of, line_of
from trees.machine import Machine
from trees.witnesses import all_choices

ENDS = {"return": "return", "M30": "end", "alarm": "stop", "user-alarm": "alarm", "endless": "endless", "fuel": "fuel"}
FUEL = 1500


def of_trees(project, outcome) -> Summary:
    number = outcome.activation.program.number
    variables = {n: v for n, v in outcome.cells.items() if n < 1000}
    if outcome.end == "return":
        variables.update(outcome.locals)
    moves = [tuple(map(float, m.coordinates)) for m in outcome.moves if m.start != m.end]
    return Summary(ENDS[outcome.end], line_of(project, number, outcome.block), file_of(project, number).name, outcome.alarm,
                   variables, moves)


def interpreters_differ(project, program, inputs, counts):
    """What differs under every answer to what is left open; None when they agree under one."""
    if inputs.skip is None:
        return None
    files = {file.name: file.text() for file in project.files}
    start = Start(dict(inputs.locals), dict(inputs.cells), dict(inputs.modes), dict(inputs.place), inputs.skip)
    second = []
    for run in every_way(lambda ask: Run(files, project.dialect, start, ask, FUEL).go(program.number)):
        if run.end == "unsaid" or run.tool.shift() != run.tool.origin:
            return None
        second.append(of_run(run))
    asked, tried, first = {}, [], None
    while True:
        rest = [c for c in all_choices(asked) if c not in tried]
        if not rest:
            return first
        tried.append(rest[0])
        outcome = Machine(project, inputs, Choices(given=rest[0]), FUEL, random=random.Random(0)).run(program)
        if outcome.end == "unmodelled" or outcome.inexact:
            return None
        asked.update(outcome.choices)
        counts["runs of both interpreters"] += 1
        one = of_trees(project, outcome)
        differences = [unlike(one, other) for other in second]
        if None in differences:
            return None
        first = first or differences[0]
