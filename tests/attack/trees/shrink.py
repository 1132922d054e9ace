"""A smaller project that still shows what was found: blocks, clauses, programs, and parts of blocks go one by one."""
import copy

from . import contracts
from . import syntax


def smaller(project: syntax.Project):
    """Projects with something left out, the largest cuts first."""
    programs = project.programs()
    for program in programs[1:]:
        yield without_program(project, program.number)
    for program in programs:
        size = len(program.blocks)
        width = size // 2
        while width:
            for first in range(0, size, width):
                yield changed(project, program.number, lambda p, f=first, w=width: p.blocks.__delitem__(slice(f, f + w)))
            width //= 2
        for index in range(len(program.clauses)):
            yield changed(project, program.number, lambda p, i=index: p.clauses.__delitem__(i))
        for index, block in enumerate(program.blocks):
            for simpler in simpler_blocks(block):
                yield changed(project, program.number, lambda p, i=index, b=simpler: p.blocks.__setitem__(i, b))
    if len(project.files) > 1:
        yield syntax.Project(project.dialect, [syntax.SourceFile(project.files[0].name, copy.deepcopy(programs))])


def changed(project, number, change):
    result = copy.deepcopy(project)
    change(next(p for p in result.programs() if p.number == number))
    return result


def without_program(project, number):
    result = copy.deepcopy(project)
    for file in result.files:
        file.programs = [p for p in file.programs if p.number != number]
    result.files = [f for f in result.files if f.programs]
    return result


def simpler_blocks(block: syntax.Block):
    if block.skip:
        yield syntax.Block(block.statement, block.label)
    if block.label is not None:
        yield syntax.Block(block.statement, None, block.skip)
    for statement in simpler_statements(block.statement):
        yield syntax.Block(statement, block.label, block.skip)


def simpler_statements(statement):
    match statement:
        case syntax.Assign(target, value):
            for each in simpler_expressions(value):
                yield syntax.Assign(target, each)
        case syntax.IfThen(condition, inner):
            yield inner
            for each in simpler_statements(inner):
                yield syntax.IfThen(condition, each)
        case syntax.IfGoto(condition, target):
            yield syntax.Goto(target)
        case syntax.Call(kind, program, repeats, arguments):
            if repeats is not None:
                yield syntax.Call(kind, program, None, arguments)
            for i in range(len(arguments)):
                yield syntax.Call(kind, program, repeats, arguments[:i] + arguments[i + 1:])
        case syntax.Words(codes, words):
            for i in range(len(codes)):
                if len(codes) + len(words) > 1:
                    yield syntax.Words(codes[:i] + codes[i + 1:], words)
            for i in range(len(words)):
                if len(codes) + len(words) > 1:
                    yield syntax.Words(codes, words[:i] + words[i + 1:])


def simpler_expressions(expression):
    match expression:
        case syntax.Binary(operator, left, right):
            yield left
            yield right
            for each in simpler_expressions(left):
                yield syntax.Binary(operator, each, right)
            for each in simpler_expressions(right):
                yield syntax.Binary(operator, left, each)
        case syntax.Minus(operand) | syntax.Function(_, operand):
            yield operand


def shrink(project: syntax.Project, shows, is_late) -> syntax.Project:
    """`shows` tells of a project whether it still shows the same."""
    again = True
    while again:
        again = False
        for candidate in smaller(project):
            if is_late():
                return project
            if candidate.programs() and shows(candidate):
                project, again = candidate, True
                break
    return project
