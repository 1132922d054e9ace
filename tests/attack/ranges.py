"""What `feedhold ranges` tells before each block, against the states that a run has there."""
import re
from dataclasses import dataclass

GROUPS = {"motion": 1, "plane": 2, "distance": 3, "feed mode": 5, "units": 6, "cutter compensation": 7, "tool length": 8,
          "canned cycle": 9, "return level": 10, "scaling": 11, "spindle mode": 13, "work offset": 14, "rotation": 16,
          "mirror": 22}
WORDS = ("F", "S", "T", "H", "D")
VARIABLE = re.compile(r"#(\d+)(?: of O\d+)?$")
CALLED = re.compile(r"P(\d+)")
CLOSE = 1e-9


class Unknown:
    """In place of a value that the interpreter cannot tell."""


@dataclass
class Moment:
    """Before a block."""

    chain: tuple  # (program, line) of the open calls, the outermost first
    program: int
    line: int
    read: object  # of a number: a fraction, None where it is vacant, or Unknown
    place: object  # X, Y, Z in work coordinates; None where they are not known
    modes: dict  # group to code
    words: dict  # None: as at the start
    modal: tuple  # programs that are called after each movement


class Told:
    """The answer for one program that is started; `numbers` are the variables that the texts name."""

    def __init__(self, answer: dict, numbers: set):
        self.is_whole = answer["complete"] and not answer["gaveUp"] and not answer["unmodelled"]
        self.contexts = {}
        names = set(numbers)
        for context in answer["contexts"]:
            chain = tuple((int(c["program"][1:]), c["line"]) for c in context["calls"])
            blocks = {}
            for block in context["blocks"]:
                blocks.setdefault(block["line"], []).append(block)
                names |= {int(m[1]) for v in block["variables"] if (m := VARIABLE.match(v["name"]))}
            self.contexts.setdefault(int(context["program"]["program"][1:]), []).append((chain, blocks))
        self.numbers = sorted(names)
        self.start = None
        self.is_exact = True  # until a movement ends between two least increments, to which words are rounded

    def wrong(self, moment: Moment):
        """Why the state is none that is told; the first moment is the start."""
        if self.start is None:
            self.start, self.is_exact = Kept(moment, self.numbers), True
        if moment.place and any((c * 1000).denominator != 1 for c in moment.place):
            self.is_exact = False
        if not self.is_exact:
            return None
        contexts = self.contexts.get(moment.program, [])
        exact = [each for chain, each in contexts if chain == moment.chain] or [each for _, each in contexts]
        blocks = [b for each in exact for b in each.get(moment.line, [])] or \
            [b for _, each in contexts for b in each.get(moment.line, [])]
        if not blocks:
            return f"a run comes to line {moment.line} of O{moment.program}" if self.is_whole else None
        reasons = [self.outside(block, moment) for block in blocks]
        return None if None in reasons else f"before line {moment.line} of O{moment.program}: {reasons[0]}"

    # ---- one block ----

    def outside(self, block, moment):
        return self.variables(block, moment) or self.positions(block, moment) or self.modes(block, moment) or \
            self.words(block, moment) or self.modal_calls(block, moment)

    def variables(self, block, moment):
        told = {int(m[1]): v for v in block["variables"] if (m := VARIABLE.match(v["name"]))}
        for number, fact in told.items():
            why = self.misfit(fact, moment.read(number), moment)
            if why:
                return f"#{number} is {why}"
        for number in self.numbers:
            if number in told or not has_one_number(number) or block["otherVariablesUnknown"]:
                continue
            now, then = moment.read(number), self.start.values[number]
            if Unknown not in (now, then) and now != then:
                return f"#{number} is {now}, not as at the start: {then}"
        return None

    def positions(self, block, moment):
        if moment.place is None:
            return None
        told = {fact["name"]: fact for fact in block["positions"]}
        for index, axis in enumerate("XYZ"):
            now, then = moment.place[index], self.start.place and self.start.place[index]
            why = self.misfit(told[axis], now, moment) if axis in told else \
                f"{now}, not as at the start: {then}" if then is not None and now != then else None
            if why:
                return f"{axis} is {why}"
        return None

    def modes(self, block, moment):
        told = {fact["name"]: fact for fact in block["modes"]}
        for name, group in GROUPS.items():
            if group not in moment.modes:
                continue
            now, then, fact = moment.modes[group], self.start.modes[group], told.get(name)
            codes = [re.sub(r"^([GM])0+(?=\d)", r"\1", code) for code in fact["codes"]] if fact else []
            if now not in codes and not ((fact is None or fact["asAtStart"]) and now == then):
                return f"{now} is in force, and not one of {codes}"
        return None

    def words(self, block, moment):
        told = {fact["name"]: fact for fact in block["settings"]}
        for letter in WORDS:
            now, fact = moment.words[letter], told.get(letter)
            if fact is None:
                why = f"{now}, not as at the start" if now is not None else None
            elif now is None:
                why = f"as at the start, not {fact['text']}" if fact["vacant"] == "no" and "values" in fact.get("number", {}) \
                    and not fact.get("equals") else None
            else:
                why = self.misfit(fact, now, moment)
            if why:
                return f"{letter} is {why}"
        return None

    @staticmethod
    def modal_calls(block, moment):
        called = [CALLED.search(text) for text in block["modalCalls"]]
        if block["otherModalCalls"] or None in called or [int(m[1]) for m in called] == list(moment.modal):
            return None
        return f"the modal calls are {moment.modal}, not {block['modalCalls']}"

    # ---- one value ----

    def misfit(self, fact, value, moment):
        if value is Unknown:
            return None
        told, number = f"{value}, not {fact['text']}", fact.get("number")
        if value is None:
            if fact["vacant"] == "no":
                return told
        elif number is None or not lies_in(number, float(value)):
            return told
        relation = fact.get("equals")
        other = self.named(relation, moment) if relation else Unknown
        if other is Unknown:
            return None
        if relation["plus"] == 0 and (other is None) != (value is None):
            return told + f" (that is {other})"
        if value is not None and not near(float(value), float(other or 0) + relation["plus"]):
            return told + f" (that is {other})"
        return None

    def named(self, relation, moment):
        variable, at = VARIABLE.match(relation["name"]), relation["name"]
        is_start = relation["when"] == "start"
        if variable:
            return self.start.values.get(int(variable[1]), Unknown) if is_start else moment.read(int(variable[1]))
        place = self.start.place if is_start else moment.place
        return place["XYZ".index(at)] if at in ("X", "Y", "Z") and place is not None else Unknown


class Kept:
    """What was at the start."""

    def __init__(self, moment: Moment, numbers):
        self.values = {number: moment.read(number) for number in numbers}
        self.place = None if moment.place is None else list(moment.place)
        self.modes = dict(moment.modes)


def has_one_number(number: int) -> bool:
    """What is written by other numbers is told by one of them."""
    return 100 <= number < 1000 or 1100 <= number < 1132 or 5201 <= number <= 5326


def near(a: float, b: float) -> bool:
    return abs(a - b) <= CLOSE * (1 + abs(a))


def lies_in(number: dict, value: float) -> bool:
    slack = CLOSE * (1 + abs(value))
    if number["min"] is not None and value < number["min"] - slack or number["max"] is not None and value > number["max"] + slack:
        return False
    if "values" in number:
        return any(near(value, each) for each in number["values"])
    if "grid" in number:
        steps = (value - number["grid"]["from"]) / number["grid"]["step"]
        return near(steps, round(steps))
    return True


def numbers_in(texts) -> set:
    """Of variables that keep what is written to them."""
    found = {int(n) for text in texts for n in re.findall(r"#(\d+)", text)}
    return {n for n in found if 0 < n < 3000 or n > 5200}
