"""Random contours under cutter compensation, for LinuxCNC and for FANUC: the same blocks with the same entry."""
import math
import random

TURNS = (-109, 109)  # degrees
SMALL = 3  # LinuxCNC takes turns below 0.05 rad as none


class Contour:
    """`lines`: blocks behind the start-up block, which goes from `begin` to `entry` in the direction of the first one;
    `points`: where they end."""

    def __init__(self, seed, arcs, small_turns=True, digits=9):
        self.small_turns = small_turns
        self.digits = digits
        self.random = random.Random(seed)
        self.side = self.random.choice((41, 42))
        self.radius = round(self.random.choice((self.random.uniform(0.5, 6), self.random.uniform(5, 14))), 3)
        self.heading = math.radians(self.random.uniform(0, 360))
        self.at = self.counted(self.random.uniform(-50, 50), self.random.uniform(-50, 50))
        self.entry = self.at
        self.lines, self.points = [], []
        first = self.heading
        length = self.radius + self.random.uniform(2, 20)
        self.begin = self.counted(self.at[0] - length * math.cos(first), self.at[1] - length * math.sin(first))
        for index in range(6):
            if index:
                self.turn()
            if arcs and index and self.random.random() < 0.5:
                self.arc()
            else:
                self.line()
            self.between()
        self.leave = self.counted(self.at[0] + self.random.uniform(10, 20), self.at[1] + self.random.uniform(10, 20))

    def counted(self, x, y):
        """A point that a control reads as it is written: FANUC cuts off the digits that it does not count."""
        return round(x, self.digits), round(y, self.digits)

    def turn(self):
        kind = self.random.random()
        if kind < 0.2:
            return  # tangent
        turn = self.random.choice((-90, 90)) if kind < 0.4 else self.random.uniform(*TURNS)
        if self.small_turns or abs(turn) > SMALL:
            self.heading += math.radians(turn)

    def line(self):
        length = self.random.uniform(15, 60)
        self.at = self.counted(self.at[0] + length * math.cos(self.heading), self.at[1] + length * math.sin(self.heading))
        self.points.append(self.at)
        self.lines.append(f"G1 {written(self.at)}")

    def arc(self):
        way, radius = self.random.choice((1, -1)), self.random.uniform(8, 30)
        sweep = self.random.uniform(0.6, 4)
        toward = self.heading + way * math.pi / 2
        centre = (self.at[0] + radius * math.cos(toward), self.at[1] + radius * math.sin(toward))
        start, angle = self.at, toward + math.pi + way * sweep
        self.at = self.counted(centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))
        self.heading += way * sweep
        self.points.append(self.at)
        self.lines.append(f"G{3 if way > 0 else 2} {written(self.at)} I{centre[0] - start[0]:.9f} J{centre[1] - start[1]:.9f}")

    def between(self):
        """No more blocks without a move in the plane than every control foresees."""
        if self.random.random() < 0.2:
            self.lines.append(self.random.choice((f"G1 Z{self.random.uniform(-5, 5):.3f}", "M8", "S500")))

    def linuxcnc(self):
        return "\n".join([f"G21 G17 G90 G40 F100\nG0 {written(self.begin)}", f"G{self.side}.1 D{2 * self.radius}",
                          f"G1 {written(self.entry)}", *self.lines, f"G40\nG1 {written(self.leave)}", "M2", ""])

    def fanuc(self):
        return "\n".join([f"O1\nG21 G17 G90 G40 F100.\nG0 {written(self.begin)}", f"#13001={self.radius}",
                          f"G1 G{self.side} D1 {written(self.entry)}", *self.lines, f"G1 G40 {written(self.leave)}", "M30", ""])


def written(point):
    return f"X{point[0]:.9f} Y{point[1]:.9f}"
