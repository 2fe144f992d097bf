"""What must hold in the recording of a soak: the limits, and the numbers and the path of a reverse run."""

import math

from row import ACCELERATION, JERK, VELOCITY, difference

#: What the limits of a period allow: all of them; velocity and acceleration (LinuxCNC's own jogs); nothing (emergency
#: stop and machine off, where LinuxCNC drops the motion). PROGRAM and above are ALL: a random program, each with a number.
INTERRUPTED, ALL, JOGGING, PROGRAM = 0, 1, 2, 3
KINDS = ("velocity", "acceleration", "jerk")
#: What they may exceed their limits by: differences of positions recorded in nanometres.
SHARES = (1.001, 1.002, 1.06)
#: A way back may be off the way there by this, mm or degrees: both are polylines through their periods.
OFF_THE_WAY = 2e-3
#: Points of the way there that are closer than this are one.
SPACING = 1e-4


class Peaks:
    """Greatest velocity, acceleration and jerk over their limits, and where."""

    def __init__(self, result):
        #: number of the program in which a limit was exceeded, if in one
        self.program = None
        self.share, self.place = [0.0, 0.0, 0.0], [("", 0.0, 0)] * 3
        states = result.column("row")
        for axis in "xyzab":
            values = result.column(axis)
            limits = (VELOCITY, ACCELERATION, JERK)
            # a tenth of what Y is able to do is for external offsets
            factor = 0.9 if axis == "y" else 1.0
            order = values
            for degree, of_most in enumerate(limits):
                order = difference(order)
                limit = of_most * (factor if degree < 2 else 1.0)
                for n, value in enumerate(order):
                    if abs(value) > self.share[degree] * limit and self.counts(states, n, degree):
                        self.share[degree] = abs(value) / limit
                        self.place[degree] = (axis, result.rows[n][0], states[n] - PROGRAM)

    @staticmethod
    def counts(states, n, degree):
        # around a change of the state the difference belongs to both
        window = states[max(0, n - 40):n + 45]
        if degree == 2:
            return all(state == ALL or state >= PROGRAM for state in window)
        return INTERRUPTED not in window

    def failure(self):
        for what, share, allowed, place in zip(KINDS, self.share, SHARES, self.place, strict=True):
            if share > allowed:
                self.program = place[2]
                return f"{what} is {share:.4f} of its limit: axis {place[0]} at {place[1]:.3f} s"
        return None


class WayThere:
    """The way that a program has run, and where on it the machine is."""

    def __init__(self, point):
        self.points, self.lengths = [point], [0.0]
        self.last, self.index, self.length = point, 0, 0.0
        #: whether the machine goes on from the end of it
        self.at_end = True

    def project(self, point, index):
        """How far a point is off one leg, and the length of the way up to there."""
        start, end = self.points[index], self.points[index + 1]
        direction = [e - s for s, e in zip(start, end, strict=True)]
        square = sum(d * d for d in direction)
        t = min(1.0, max(0.0, sum((p - s) * d for p, s, d in zip(point, start, direction, strict=True)) / square))
        return (math.dist(point, [s + t * d for s, d in zip(start, direction, strict=True)]),
                self.lengths[index] + t * (self.lengths[index + 1] - self.lengths[index]))

    def follow(self, point, backwards):
        """How far a point is off the way: nothing where it goes on from the end of it."""
        step = math.dist(point, self.last)
        self.last = point
        if not backwards and self.at_end:
            self.append(point)
            return 0.0
        if len(self.points) < 2:
            return step
        if self.at_end:
            self.at_end, self.index, self.length = False, len(self.points) - 2, self.lengths[-1]
        way = -1 if backwards else 1
        expected, reach = self.length + way * step, 1.5 * step + 0.02
        index = min(max(self.index - 2 * way, 0), len(self.points) - 2)
        # where nothing of the way is within reach
        best = (math.inf, math.inf, index, self.length)
        while 0 <= index < len(self.points) - 1:
            if min(abs(self.lengths[n] - self.length) for n in (index, index + 1)) > reach and abs(index - self.index) > 2:
                break
            off, length = self.project(point, index)
            # where it runs back over itself, the place that continues the last one
            found = (off + 0.05 * abs(length - expected), off, index, length)
            best = min(best, found)
            index += way
        _, off, self.index, self.length = best
        # not sooner, or the way would go back and forth there
        if not backwards and self.lengths[-1] - self.length <= 2 * SPACING:
            self.at_end = True
            self.append(point)
            return 0.0
        return off

    def append(self, point):
        length = math.dist(point, self.points[-1])
        if length > SPACING:
            self.points.append(point)
            self.lengths.append(self.lengths[-1] + length)


class Reverse:
    """Whether reverse runs went back over the way that was run, with the numbers of the moves in order."""

    def __init__(self, result):
        #: greatest distance from the way there, mm or degrees; length of all ways back; what went wrong
        self.off, self.length, self.wrong = 0.0, 0.0, None
        #: number of the program in which it went wrong
        self.program = None
        place = [result.header.index(name) for name in "xyzab"]
        state, line, backwards = (result.header.index(name) for name in ("row", "line", "reverse"))
        way, last, before, program = WayThere([]), 0, [], None
        for n, row in enumerate(result.rows):
            if row[state] < PROGRAM:
                program = None
                continue
            point = [row[i] for i in place]
            if row[state] != program:
                program, way, last, before = row[state], WayThere(point), 0, point
                continue
            if point != before:
                off = way.follow(point, row[backwards])
                if row[backwards]:
                    self.length += math.dist(point, before)
                if off > self.off:
                    self.off = off
                    if off > OFF_THE_WAY:
                        self.fail(row, program, f"{off:.4f} off the way that was run, line {row[line]}, period {n}")
                before = point
            # 0 is nothing to do
            if row[line]:
                if last and (row[line] > last if row[backwards] else row[line] < last):
                    way_of_it = "backwards" if row[backwards] else "forward"
                    self.fail(row, program, f"line {row[line]} follows on {last}, {way_of_it}")
                last = row[line]

    def fail(self, row, state, text):
        if not self.wrong:
            self.wrong, self.program = f"{text}, at {row[0]:.3f} s", int(state) - PROGRAM

    def failure(self):
        return self.wrong
