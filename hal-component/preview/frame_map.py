"""Affine maps of space as three rows of four numbers, the last of each the shift.

Plain lists: a program has few frames, and numpy takes longer for three numbers than this does.
"""

import math

Map = list[list[float]]
Point = tuple[float, float, float]


def identity() -> Map:
    """The map that changes nothing."""
    return diagonal((1.0, 1.0, 1.0))


def diagonal(factors) -> Map:
    """A factor for each of X Y Z."""
    return [[factor if column == row else 0.0 for column in range(4)] for row, factor in enumerate(factors)]


def shift(by) -> Map:
    """A shift of X Y Z."""
    return [[*row[:3], part] for row, part in zip(identity(), by, strict=True)]


def about(axis: int, degrees: float) -> Map:
    """A right-handed rotation about X (0), Y (1) or Z (2)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned = identity()
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turned[first][first] = turned[second][second] = c
    turned[first][second], turned[second][first] = -s, s
    return turned


def product(*maps: Map) -> Map:
    """The maps as one, the last of them first."""
    result, *inner = maps
    for one in inner:
        result = [[sum(row[k] * one[k][column] for k in range(3)) + (row[3] if column == 3 else 0.0) for column in range(4)]
                  for row in result]
    return result


def inverse(of: Map) -> Map:
    """The way back. ZeroDivisionError if the map flattens space."""
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = of
    size = determinant(of)
    back = [[(e * i - f * h) / size, (c * h - b * i) / size, (b * f - c * e) / size, 0.0],
            [(f * g - d * i) / size, (a * i - c * g) / size, (c * d - a * f) / size, 0.0],
            [(d * h - e * g) / size, (b * g - a * h) / size, (a * e - b * d) / size, 0.0]]
    return [[*row[:3], -part] for row, part in zip(back, applied(back, [row[3] for row in of]), strict=True)]


def determinant(of: Map) -> float:
    """By how much a volume grows, negative if left and right are exchanged."""
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = of
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def applied(to: Map, point) -> Point:
    """Where the map takes a point."""
    x, y, z = point
    return tuple(row[0] * x + row[1] * y + row[2] * z + row[3] for row in to)  # type: ignore[return-value]


def turned(by: Map, vector) -> Point:
    """What the map without its shift makes of a vector."""
    x, y, z = vector
    return tuple(row[0] * x + row[1] * y + row[2] * z for row in by)  # type: ignore[return-value]
