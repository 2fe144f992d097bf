"""Arcs in a frame: chords that a screen draws."""

import math

import numpy

from frame_map import Map

#: of LinuxCNC's planes (1 XY, 2 YZ, 3 ZX): first and second axis, and the one along which a helix rises
PLANES = {1: (0, 1, 2), 2: (1, 2, 0), 3: (2, 0, 1)}

#: an arc that ends as close to its start is a full circle, of its radius
CLOSED = 1e-6

#: chords of the shortest arc
LEAST = 3


class Arc:
    """An arc or a helix in coordinates of the program."""

    def __init__(self, plane: int, start, end, centre, turns: int):
        """start: X Y Z. end: first and second axis of the plane, and the one along it; centre: the first two. turns: how many
        are begun, negative clockwise."""
        first, second, along = PLANES[plane]
        self.axes = (first, second, along)
        self.centre = centre
        self.end = end
        self.from_centre = (start[first] - centre[0], start[second] - centre[1])
        self.height = start[along]
        begin = math.atan2(self.from_centre[1], self.from_centre[0])
        way = math.atan2(end[1] - centre[1], end[0] - centre[0]) - begin
        radius = math.hypot(*self.from_centre)
        closed = math.hypot(start[first] - end[0], start[second] - end[1]) < CLOSED * radius
        sense = 1 if turns > 0 else -1
        #: the angle that it runs through, radians
        self.sweep = sense * ((0.0 if closed else way * sense % math.tau) or math.tau)
        self.sweep += sense * math.tau * (abs(turns) - 1)

    def chords(self, out: Map, most: int, other_start, other_end):
        """Ends of chords behind the map `out`, tuples of nine axes. most: chords of half a circle. The six other axes go from
        `other_start` to `other_end`."""
        count = max(LEAST, int(most * abs(self.sweep) / math.pi))
        part = numpy.arange(1, count + 1) / count
        angle = self.sweep * part
        c, s = numpy.cos(angle), numpy.sin(angle)
        x, y = self.from_centre
        places = numpy.empty((count, 3))
        first, second, along = self.axes
        places[:, first] = self.centre[0] + c * x - s * y
        places[:, second] = self.centre[1] + s * x + c * y
        places[:, along] = self.height + part * (self.end[2] - self.height)
        # not where rounding and a radius that is not quite the same bring it
        places[-1, [first, second, along]] = self.end
        matrix = numpy.array(out)
        others = numpy.outer(1 - part, other_start) + numpy.outer(part, other_end)
        return [tuple(place) for place in numpy.hstack([places @ matrix[:, :3].T + matrix[:, 3], others]).tolist()]
