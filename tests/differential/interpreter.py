"""LinuxCNC's own interpreter through its Python module `gcode` (package linuxcnc-uspace): the canonical tool path of a
program with all digits of its numbers, in inches."""
import json
import os
import sys
import tempfile
import time

# The module keeps a tool table of its own in $HOME and empties it when it starts.
home = tempfile.TemporaryDirectory(prefix="feedhold-interpreter-")
os.environ["HOME"] = home.name

LONGEST_RUN = 10
PLANES = {1: ("X", "Y", "Z"), 2: ("Y", "Z", "X"), 3: ("Z", "X", "Y")}
AXES = "XYZABCUVW"
# Offsets and positions that outlive a program, and that the module would keep from one program to the next.
STORED = [*range(5161, 5170), *range(5181, 5190), *range(5210, 5391)]


class Canon:
    """Takes down what the interpreter tells a machine to do."""

    def __init__(self, parameters):
        self.parameter_file = parameters
        self.moves = []
        self.plane = 1
        self.began = time.time()
        self.offsets = {"g5x": (0,) * 9, "g92": (0,) * 9, "tool": (0,) * 9}
        self.stands = None  # in machine coordinates

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *_, **__: None

    def next_line(self, state):
        self.line = state.sequence_number

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0x1FF  # all nine

    def get_block_delete(self):
        return 0

    def get_tool(self, number):
        return (number, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0)

    def check_abort(self):
        return time.time() - self.began > LONGEST_RUN

    def set_plane(self, plane):
        self.plane = plane

    def set_g5x_offset(self, _, *offset):
        self.offsets["g5x"] = offset

    def set_g92_offset(self, *offset):
        self.offsets["g92"] = offset

    def tool_offset(self, *offset):
        self.offsets["tool"] = offset

    def move(self, kind, point, *more):
        """Straight movements to where the machine stands are left out: they are none."""
        machine = [point[axis] + sum(offset[i] for offset in self.offsets.values()) for i, axis in enumerate(AXES)]
        stood, self.stands = self.stands, machine
        if more or not stood or max(abs(a - b) for a, b in zip(stood, machine)) > 1e-12:
            self.moves.append((kind, point, *more))

    def straight_traverse(self, *point):
        self.move("rapid", dict(zip(AXES, point)))

    def straight_feed(self, *point):
        self.move("feed", dict(zip(AXES, point)))

    def straight_probe(self, *point):
        self.move("probe", dict(zip(AXES, point)))

    def arc_feed(self, first, second, first_centre, second_centre, turns, normal, *others):
        axes = PLANES[self.plane]
        point = dict(zip(axes, (first, second, normal)))
        point.update(zip(AXES[3:], others))
        self.move("arc", point, {axes[0]: first_centre, axes[1]: second_centre}, turns)

    def dwell(self, time):
        if time:
            self.moves.append(("dwell", time))


class Run:
    """`units`: of the program before its own G20 or G21.  `error`: the interpreter's words; empty when it ended."""

    def __init__(self, path, units="g20"):
        import gcode  # here, so that HOME is set before
        handle, parameters = tempfile.mkstemp(suffix=".var")
        with os.fdopen(handle, "w") as file:
            file.writelines(f"{number}\t{1 if number == 5220 else 0}\n" for number in STORED)
        canon = Canon(parameters)
        try:
            result, self.line = gcode.parse(str(path), canon, units, "g49")
            self.error = gcode.strerror(result) if result >= gcode.MIN_ERROR else ""
        except KeyboardInterrupt:
            self.line, self.error = 0, "time limit"
        finally:
            for name in (parameters, parameters + ".bak"):
                if os.path.exists(name):
                    os.unlink(name)
        self.moves = canon.moves


if __name__ == "__main__":  # a process of its own for programs that may bring the module down
    run = Run(*sys.argv[1:])
    json.dump({"moves": run.moves, "error": run.error, "line": run.line}, sys.stdout)
