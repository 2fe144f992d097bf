"""G61, G61.1 and G64."""

import math
from itertools import pairwise

from row import MICROMETRE, PERIOD, Row, from_route, to_segment

SECTION = "Path modes"
CORNERS = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (25.0, 10.0), (25.0, 0.0)]
LINES = [f"G1 X{x} Y{y}" for x, y in CORNERS[1:]]


def nearest(seen, corner):
    points = seen.moving("x", "y")
    return min(to_segment(corner, a, b) for a, b in pairwise(points))


class ExactStop(Row):
    """G61.1 comes to rest at the end of every move"""

    section = SECTION

    def operate(self, op):
        op.go("G61.1", *LINES, "G1 X30 Y0", "G1 X35 Y0")

    def check(self, seen):
        points, speeds = seen.columns("x", "y"), seen.speed("x", "y")
        for corner in [*CORNERS[1:], (30.0, 0.0)]:
            there = [speed for point, speed in zip(points, speeds, strict=False)
                     if abs(point[0] - corner[0]) + abs(point[1] - corner[1]) < 0.002]
            seen.require(there and min(there) < 3, f"no rest at {corner}")


class ExactPath(Row):
    """G61 goes through every point, and passes where the path is tangent"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(6, "G61", "G1 X10", "G1 X20", "G3 X20 Y20 R10", "G1 X10", "G1 X0", "G1 Y10")

    def check(self, seen):
        off = max(nearest(seen, corner) for corner in ((10, 0), (20, 0), (20, 20), (10, 20), (0, 20)))
        seen.require(off < MICROMETRE, f"misses a point by {off:.3f} mm")
        inner = [speed for (x, y), speed in zip(seen.columns("x", "y"), seen.speed("x", "y"), strict=False)
                 if 5 < x < 19 and abs(y) < 1e-3]
        seen.require(min(inner) > 20, f"{min(inner):.1f} mm/s where the path is straight")
        return f"slowest {min(inner):.0f} of 50 mm/s where the path is straight"


class Tolerance(Row):
    """G64 P keeps within P, in lines and arcs, without a rest"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(9, "G64 P0.1", *LINES, "G2 X45 Y0 R10", "G1 X40 Y-10", "G3 X20 Y-10 R10", "G1 X20.5 Y-10.5", "G1 X0 Y-10")

    def check(self, seen):
        away = from_route([p for p in seen.columns("x", "y") if p[0] < 25 and p[1] >= 0], CORNERS)
        missed = max(nearest(seen, corner) for corner in CORNERS[1:4])
        seen.require(away < 0.101 and missed < 0.101, f"{max(away, missed):.3f} mm from the program, P is 0.1")
        for point in ((35, 10), (30, 0)):
            miss = nearest(seen, point)
            seen.require(miss < 0.101, f"{miss:.3f} mm from the top of an arc")
        rests = seen.rests("x", "y")
        seen.require(rests == 0, f"{rests} rests")
        time = len(seen.moving("x", "y")) * PERIOD
        return f"{missed:.3f} mm, {time:.3f} s", time


class WithoutTolerance(Row):
    """G64 without P cuts a corner by half of a move at most"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(4, "G64", *LINES)

    def check(self, seen):
        cut = max(nearest(seen, corner) for corner in CORNERS[1:4])
        for a, b in pairwise(CORNERS):
            middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            off = nearest(seen, middle)
            seen.require(off < 0.01, f"the middle of a move is missed by {off:.2f} mm")
        return f"corners cut by {cut:.2f} mm"


class DepthWithoutTolerance(Row):
    """G64 without P goes to the end of a line that leads straight back, as in a hole"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(6, "G64", "G1 X10 F3000", "G1 X2", "G0 X20", "G0 X8", "G1 X8.5 F600", "G0 X0")

    def check(self, seen):
        places = seen.column("x")
        missed = max(min(abs(x - turn) for x in places) for turn in (10, 2, 20, 8, 8.5))
        seen.require(missed < 0.01, f"turns {missed:.3f} mm before the end of a line")
        return f"turns {missed * 1000:.1f} micrometres before the end of a line at most"


class ChangesOnTheWay(Row):
    """The path mode may change from move to move"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(6, "G64 P0.5", "G1 X10", "G1 Y10", "G61.1", "G1 X20", "G1 Y0", "G64 P0.2", "G1 X30", "G1 Y10")

    def check(self, seen):
        off = [nearest(seen, corner) for corner in ((10, 0), (20, 10), (20, 0), (30, 0))]
        wanted = (0.501, 0.001, 0.001, 0.201)
        seen.require(all(a < b for a, b in zip(off, wanted, strict=True)), f"{off}")
        return "cut by " + ", ".join(f"{value:.2f}" for value in off)


class RotaryTolerance(Row):
    """G64 P keeps corners with a rotary axis within P, and without a rest"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(4, "G64 P0.1", "G1 X20 F3000", "G1 X40 B10", "G1 X60 B0", "G1 X80")

    def check(self, seen):
        route = [(0, 0), (20, 0), (40, 10), (60, 0), (80, 0)]
        away = from_route(seen.moving("x", "b"), route)
        points = seen.moving("x", "b")
        missed = max(min(to_segment(corner, a, b) for a, b in pairwise(points)) for corner in route)
        seen.require(max(away, missed) < 0.101, f"{max(away, missed):.3f} mm or degrees from the program, P is 0.1")
        rests = seen.rests("x", "b")
        seen.require(rests == 0, f"{rests} rests")
        return f"{max(away, missed):.3f}, {len(points) * PERIOD:.2f} s"


class DenseCode(Row):
    """Moves of 0.2 mm run at their feed"""

    section = SECTION

    def operate(self, op):
        lines = [f"G1 X{0.2 * n:.4f} Y{8 * (1 - math.cos(0.02 * n)):.4f}" for n in range(1, 201)]
        op.go_loaded(200, "G64 P0.02 Q0 F4800", *lines)

    def check(self, seen):
        middle = [speed for x, speed in zip(seen.column("x"), seen.speed("x", "y"), strict=False) if 10 < x < 32]
        mean = sum(middle) / len(middle)
        seen.require(mean > 72, f"{mean:.0f} mm/s for 80 in the mean")
        return f"{mean:.1f} mm/s for 80", 1 / mean
