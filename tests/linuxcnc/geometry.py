"""Shapes written down by hand, and how far recorded points are from them."""

import math


class Line:
    def __init__(self, start, end):
        self.start, self.end = start, end

    def nearest(self, point):
        """(distance of the point from the line, place on it from 0 to 1)"""
        direction = [e - s for s, e in zip(self.start, self.end, strict=True)]
        length = sum(d * d for d in direction)
        if length == 0:
            return math.dist(point, self.start), 1.0
        t = sum((p - s) * d for p, s, d in zip(point, self.start, direction, strict=True)) / length
        t = min(1.0, max(0.0, t))
        return math.dist(point, [s + t * d for s, d in zip(self.start, direction, strict=True)]), t


class Arc:
    """Centre, two perpendicular radius vectors (to the start, and a quarter turn on), and the angle in degrees."""

    def __init__(self, centre, u, v, degrees):
        self.centre, self.u, self.v, self.sweep = centre, u, v, math.radians(degrees)
        self.start, self.end = self.at(0.0), self.at(1.0)

    def at(self, t):
        a = self.sweep * t
        return [c + math.cos(a) * u + math.sin(a) * v for c, u, v in zip(self.centre, self.u, self.v, strict=True)]

    def nearest(self, point):
        relative = [p - c for p, c in zip(point, self.centre, strict=True)]
        x = sum(r * u for r, u in zip(relative, self.u, strict=True))
        y = sum(r * v for r, v in zip(relative, self.v, strict=True))
        angle = math.atan2(y, x) % (2 * math.pi)
        beyond = angle - self.sweep
        # beyond an end: the nearer one
        t = angle / self.sweep if beyond <= 0 else float(beyond < 2 * math.pi - angle)
        return math.dist(point, self.at(t)), t


class Frame:
    """p -> origin + x e1 + y e2 + z e3, for writing expected shapes in the coordinates of a program."""

    def __init__(self, origin=(0.0, 0.0, 0.0), x=(1.0, 0.0, 0.0), y=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0)):
        self.origin, self.axes = origin, (x, y, z)

    @staticmethod
    def turned(origin, degrees):
        """Turned about Z."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        return Frame(origin, (c, s, 0.0), (-s, c, 0.0))

    def vector(self, v):
        return [sum(v[k] * self.axes[k][i] for k in range(3)) for i in range(3)]

    def point(self, p):
        return [o + d for o, d in zip(self.origin, self.vector(p), strict=True)]

    def line(self, start, end):
        return Line(self.point(start), self.point(end))

    def arc(self, centre, u, v, degrees):
        return Arc(self.point(centre), self.vector(u), self.vector(v), degrees)


def chained(first, *points):
    """Lines through the points, one after the other."""
    shapes, last = [], first
    for point in points:
        shapes.append(Line(last, point))
        last = point
    return shapes


def follow(points, shapes, corner=5e-6):
    """Goes through the recorded points in order of time, and along the shapes in their order.

    Returns (greatest distance of a point from the shape it belongs to, greatest distance of the recorded points from a
    shape's end): a shape left out, or taken in another order, shows as a large distance.
    """
    worst, missed, n = 0.0, 0.0, 0
    nearest_end = math.inf
    for point in points:
        while n + 1 < len(shapes):
            here, _ = shapes[n].nearest(point)
            nearest_end = min(nearest_end, math.dist(point, shapes[n].end))
            there, _ = shapes[n + 1].nearest(point)
            # on to the next shape when this one has been run to its end and the point lies better on the next
            if there < here and nearest_end < corner:
                missed = max(missed, nearest_end)
                nearest_end = math.inf
                n += 1
            else:
                break
        worst = max(worst, shapes[n].nearest(point)[0])
    if n + 1 < len(shapes):
        return math.inf, math.inf
    missed = max(missed, min(math.dist(point, shapes[-1].end) for point in points[-200:]))
    return worst, missed
