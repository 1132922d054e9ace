"""What the manuals leave open: one switch each, the same throughout a run, as a parameter of a machine is."""
import random


class Choices:
    """Answers questions by name; remembers which ones a run asked."""

    def __init__(self, seed=None, given=None):
        self._random = random.Random(seed) if seed is not None else None
        self.given = dict(given or {})
        self.asked = {}

    def choose(self, name: str, options: tuple):
        if name not in self.asked:
            if name in self.given:
                answer = self.given[name]
            elif self._random is not None:
                answer = self._random.choice(options)
            else:
                answer = options[0]
            self.asked[name] = answer
        return self.asked[name]


def settings_of(asked: dict, options: dict, most: int = 64):
    """All answers to the questions that were asked, the usual ones first; some of them when there are many."""
    settings = [{}]
    for name in sorted(asked):
        settings = [{**each, name: answer} for each in settings for answer in options[name]]
        if len(settings) > most:
            settings = settings[:most]
    return settings
