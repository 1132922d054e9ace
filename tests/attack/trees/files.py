"""Projects as files, and inputs as the words of a command."""
import re
from fractions import Fraction
from pathlib import Path
from typing import Optional

from . import controls
from . import syntax
from .machine import Inputs


def write_project(project: syntax.Project, folder: Path):
    folder.mkdir(parents=True, exist_ok=True)
    for file in project.files:
        (folder / file.name).write_text(file.text())


def file_of(project: syntax.Project, program: int) -> syntax.SourceFile:
    return next(file for file in project.files for each in file.programs if each.number == program)


def line_of(project: syntax.Project, program: int, block: int) -> int:
    line = 1
    for each in file_of(project, program).programs:
        if each.number == program:
            return line + each.first_block_line + block
        line += len(each.lines())
    raise ValueError(program)


def run_arguments(project: syntax.Project, folder: Path, program: int, inputs: Inputs) -> list:
    arguments = [str(folder / file_of(project, program).name), "--program", f"O{program}", "--dialect", project.dialect]
    for number, value in sorted(inputs.locals.items()):
        letter = controls.LOCAL_TO_LETTER.get(number)
        if value is not None and letter:
            arguments += ["--arg", f"{letter}={written(value)}"]
        elif value is not None:
            arguments += ["--var", f"{number}={written(value)}"]
    for number, value in sorted(inputs.cells.items()):
        if value is not None:
            arguments += ["--var", f"{number}={written(value)}"]
    if inputs.place:
        arguments += ["--start", *(f"{axis}{written(value)}" for axis, value in inputs.place.items())]
    if inputs.skip:
        arguments.append("--block-skip")
    return arguments


def written(value: Fraction) -> str:
    if value.denominator == 1:
        return str(int(value))
    try:
        return syntax.decimal(value)
    except ValueError:
        return repr(float(value))


ARGUMENT = re.compile(r"([A-Z])(-?[0-9.]+)")


def witness_inputs(witness: dict) -> Optional[Inputs]:
    """From the call and the command that shows it."""
    inputs = Inputs(skip="--block-skip" in witness["run"])
    words = witness["run"].split()
    if "--modal" in words:  # this interpreter starts as after power-on, or as the contract says
        return None
    for option, word in zip(words, words[1:]):
        if option == "--arg":
            letter, value = word.split("=")
            inputs.locals[controls.LETTER_TO_LOCAL[letter]] = Fraction(value)
        elif option == "--var":
            name, value = word.strip('"').split("=")
            if not name.isdigit():
                return None
            cells = inputs.locals if controls.is_local(int(name)) else inputs.cells
            number = int(name)
            if controls.is_bit_of_outputs(number):
                return None
            cells[number if controls.is_local(number) else cell_of(number)] = Fraction(value)
        elif option == "--start":
            match = ARGUMENT.fullmatch(word)
            if not match:
                return None
            inputs.place[match[1]] = Fraction(match[2])
    return inputs


def cell_of(number: int) -> int:
    return number if controls.is_common(number) else controls.canonical(number)
