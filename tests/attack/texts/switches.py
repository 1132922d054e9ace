"""What facts leave open: a question by name, answered the same way throughout a run."""
import itertools
import random


class Switches:
    def __init__(self, fixed=None, seed=None):
        self.fixed, self.answers, self.options = dict(fixed or {}), {}, {}
        self.dice = random.Random(seed) if seed is not None else None

    def __call__(self, name: str, options: tuple):
        self.options[name] = options
        if name not in self.answers:
            drawn = self.dice.choice(options) if self.dice else options[0]
            self.answers[name] = self.fixed.get(name, drawn)
        return self.answers[name]


def every_way(attempt, most=48):
    """`attempt(switches)` under every combination of answers to what it asks; yields what it returns."""
    tried, todo, options = set(), [()], {}
    while todo and len(tried) < most:
        fixed = todo.pop()
        if fixed in tried:
            continue
        tried.add(fixed)
        switches = Switches(fixed)
        yield attempt(switches)
        options.update(switches.options)
        names = sorted(options)
        for combination in itertools.islice(itertools.product(*(options[n] for n in names)), 512):
            setting = tuple(zip(names, combination))
            if setting not in tried and setting not in todo and len(todo) < most:
                todo.append(setting)
