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

    def reach(self, out: Map):
        """The least and the greatest of X, of Y and of Z behind the map `out`, at the ends and in between."""
        first, second, along = self.axes
        x, y = self.from_centre
        centre = [0.0, 0.0, 0.0]
        centre[first], centre[second] = self.centre
        rise = self.end[2] - self.height
        for row in out:
            middle = row[3] + row[first] * centre[first] + row[second] * centre[second] + row[along] * self.height
            # middle + c cos(angle) + s sin(angle) + slope angle, over the angle from the start on
            c, s = row[first] * x + row[second] * y, row[second] * x - row[first] * y
            slope = row[along] * rise / self.sweep
            values = [middle + c * math.cos(angle) + s * math.sin(angle) + slope * angle
                      for angle in self._turning(c, s, slope)]
            yield min(values), max(values)

    def _turning(self, c, s, slope):
        """The ends, and the angles at which s cos(angle) - c sin(angle) + slope is 0."""
        angles = [0.0, self.sweep]
        size = math.hypot(c, s)
        if size > abs(slope):
            middle, half = math.atan2(s, c), math.asin(slope / size)
            low, high = min(0.0, self.sweep), max(0.0, self.sweep)
            for root in (middle + half, middle + math.pi - half):
                angle = low + (root - low) % math.tau
                while angle < high:
                    angles.append(angle)
                    angle += math.tau
        return angles

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
