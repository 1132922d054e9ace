"""How a run of the trees ends, other than by an alarm of the control."""


class UserAlarm(Exception):
    def __init__(self, number):
        super().__init__(number)
        self.number = number


class ProgramEnd(Exception):
    """M02, M30."""


class OutOfFuel(Exception):
    pass


class Repeats(Exception):
    """A state came back: the run would go on for ever."""
