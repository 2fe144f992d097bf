"""A row of the outcome table: what an operator does in LinuxCNC, and what must be seen then."""

import importlib
import math
from itertools import pairwise

PERIOD = 1e-3
VELOCITY, ACCELERATION, JERK = 100.0, 1000.0, 20000.0
MICROMETRE = 1e-3
#: LinuxCNC's motion types
RAPID, FEED, ARC = 1, 2, 3


class Broken(Exception):
    """What was promised does not hold."""


class Row:
    """One promise of a planner. The docstring is the line of the table.

    `operate` runs beside LinuxCNC, with an Operator; `check` runs afterwards, with what was Seen, and returns in a few
    words what was measured, or (words, what of it should be small), or raises Broken.
    """

    section = ""
    #: errors shown to the operator are what the row is about
    errors_expected = False
    #: positions jump or stop at once because of what LinuxCNC itself does (emergency stop, machine off)
    interrupted = False
    #: axes that leave their limits by themselves in this row, such as by an external offset
    unchecked = ""
    #: between what of session.SETTINGS and the planner it is operated
    behind: tuple[str, ...] = ("plain", "framekins", "frame")

    def operate(self, op):
        raise NotImplementedError

    def check(self, seen):
        raise NotImplementedError

    @classmethod
    def name(cls):
        return cls.__name__

    @classmethod
    def promise(cls):
        assert cls.__doc__, f"{cls.__name__} does not say what it promises"
        return " ".join(cls.__doc__.split())


#: in the order of the table
MODULES = ("rows_identity", "rows_status", "rows_outputs", "rows_spindle", "rows_threads", "rows_operator", "rows_feed",
           "rows_modes", "rows_frames")

#: For rows without a frame: their machine's axes are looked at, or a program would have to go on otherwise with one.
WITHOUT_A_FRAME = ("plain", "framekins")


def all_rows(behind=None):
    """Every row, or those of a setting, in the order of the table."""
    rows = []
    for name in MODULES:
        module = importlib.import_module(name)
        rows += [value for value in vars(module).values()
                 if isinstance(value, type) and issubclass(value, Row) and value.__module__ == name]
    return [row for row in rows if behind is None or behind in row.behind]


def difference(values):
    return [(b - a) / PERIOD for a, b in pairwise(values)]


def peaks(values):
    """Greatest velocity, acceleration and jerk of one axis, by differences."""
    velocity = difference(values)
    acceleration = difference(velocity)
    jerk = difference(acceleration)
    return [max(map(abs, numbers), default=0.0) for numbers in (velocity, acceleration, jerk)]


def to_segment(point, start, end):
    """Distance of a point from the leg between two others."""
    direction = [e - s for s, e in zip(start, end, strict=True)]
    square = sum(d * d for d in direction)
    t = sum((p - s) * d for p, s, d in zip(point, start, direction, strict=True)) / square if square else 0.0
    t = min(1.0, max(0.0, t))
    return math.dist(point, [s + t * d for s, d in zip(start, direction, strict=True)])


def from_route(points, route):
    """Greatest distance of the points from a polyline."""
    return max(min(to_segment(point, a, b) for a, b in pairwise(route)) for point in points)


class Seen:
    """What was recorded while a row was operated."""

    def __init__(self, header, rows, kept, errors):
        self.header, self.rows, self.kept, self.errors = header, rows, kept, errors

    def column(self, name):
        index = self.header.index(name)
        return [row[index] for row in self.rows]

    def columns(self, *names):
        indices = [self.header.index(name) for name in names]
        return [tuple(row[i] for i in indices) for row in self.rows]

    def require(self, holds, text):
        if not holds:
            raise Broken(text)

    def near(self, value, wanted, tolerance, what):
        if not abs(value - wanted) <= tolerance:
            raise Broken(f"{what}: {value:.6g} instead of {wanted:.6g}")

    def during(self, line):
        """The seen of one line of the program."""
        index = self.header.index("line")
        return Seen(self.header, [row for row in self.rows if row[index] == line], self.kept, self.errors)

    def moving(self, *axes):
        """Positions of these axes from the first to the last period in which one of them moves."""
        points = self.columns(*axes)
        changes = [n for n in range(1, len(points)) if points[n] != points[n - 1]]
        return points[changes[0] - 1:changes[-1] + 1] if changes else []

    def rests(self, *axes):
        """How often these axes come to rest between their first and their last motion."""
        points = self.moving(*axes)
        still = [a == b for a, b in pairwise(points)]
        return sum(1 for before, now in pairwise(still) if now and not before)

    def speed(self, *axes):
        """Speed of these axes in each period."""
        points = self.columns(*axes)
        return [math.dist(a, b) / PERIOD for a, b in pairwise(points)]

    def top_speed(self, *axes):
        return max(self.speed(*axes), default=0.0)
