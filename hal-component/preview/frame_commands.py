"""What the frame commands of a program make of the frame: the same as framekins does with them.

Angles are in degrees, lengths in any unit. The codes are those that o<frame_send> hands to framekins.
"""

import math
from dataclasses import dataclass

import numpy

from frame_map import Map, about, diagonal, identity, product, shift

#: added to the code of a command that acts in the frame there is
ADDITIVE = 100

TRANSLATE, ROTATE, ROTATE_IN_PLANE, ROTS_XY, ROTS_ZX, ROTS_YZ, SCALE, MIRROR = range(1, 9)
REMOVE, DROP_SCALES, RESUME = 9, 10, 11
SUSPEND, ASK, REFRESH = 13, 14, 15

#: subroutines of the operations
NAMES = {TRANSLATE: "trans", ROTATE: "rot", ROTATE_IN_PLANE: "rot_rpl", ROTS_XY: "rots_xy", ROTS_ZX: "rots_zx",
         ROTS_YZ: "rots_yz", SCALE: "scale", MIRROR: "mirror"}

#: of two solid angles: the axes of the first and of the second rotation
SOLID_ANGLES = {ROTS_XY: (1, 0), ROTS_ZX: (0, 2), ROTS_YZ: (2, 1)}

#: what framekins takes: scales in any direction, the greatest over the smallest, shifts in machine units
SCALES = (1e-3, 1e3)
MOST_UNEQUAL = 100.0
MOST_SHIFT = 1e6

#: rounding must not refuse what stands exactly on a bound
BOUND = 1e-9


class FrameRefused(Exception):
    """A frame that framekins would refuse, so that the program would stop here."""


@dataclass(frozen=True)
class Operation:
    """One frame command."""

    map: Map
    #: which of X Y Z are mirrored
    mirrored: tuple[bool, bool, bool] = (False, False, False)
    is_scale: bool = False


@dataclass(frozen=True)
class Frame:
    """A frame in force, about a work offset."""

    #: from the tip of the tool as it would be without the frame to where it is, in the machine's X Y Z
    tip: Map
    #: how the tool's length stands in the machine
    tool: Map
    #: the origin and the directions of the program's X Y Z, in the machine's
    axes: Map


def described(code: int, values) -> str:
    """A command as a program calls it."""
    name = NAMES.get(code % ADDITIVE, str(code))
    return f"o<{'a' if code > ADDITIVE else ''}{name}> with " + ", ".join(f"{value:g}" for value in values)


def operation(code: int, values, k2: bool) -> Operation:
    """The operation of a code. FrameRefused if there is none with these values."""
    a, b, c = values
    if code == TRANSLATE:
        return Operation(shift(values))
    if code == ROTATE:
        return Operation(product(about(2, c), about(1, b), about(0, a)))
    if code == ROTATE_IN_PLANE and b in (0, 1, 2):
        return Operation(about(int(b), a))
    if code in SOLID_ANGLES:
        return Operation(solid_angles(*SOLID_ANGLES[code], a, b, k2))
    if code == SCALE:
        if 0 in values:
            raise FrameRefused("a scale factor is 0")
        return Operation(diagonal(values), (a < 0, b < 0, c < 0), True)
    if code == MIRROR:
        mirrored = (a != 0, b != 0, c != 0)
        return Operation(diagonal([-1.0 if one else 1.0 for one in mirrored]), mirrored)
    raise FrameRefused(f"unknown command {code}")


def solid_angles(first_axis: int, second_axis: int, leading: float, trailing: float, k2: bool) -> Map:
    """ROTS: about one axis, then about another as it is then, so that the plane meets two others at these angles."""
    first, formed = (trailing, leading) if k2 else (leading, trailing)
    if first % 180 == 90 and formed % 180:
        raise FrameRefused("no plane meets two others at these angles")
    run = math.cos(math.radians(formed))
    rise = math.sin(math.radians(formed)) * math.cos(math.radians(first))
    second = math.degrees(math.atan(rise / run)) if run else math.copysign(90.0, rise)
    return product(about(first_axis, first), about(second_axis, second))


class FrameList:
    """The commands that are in force."""

    def __init__(self, k2: bool, unit: float):
        """k2: the other convention of ROTS, [FRAMEPATH]ROTS_CONVENTION. unit: machine units in the unit of all lengths."""
        self.k2 = k2
        self.unit = unit
        self.operations: tuple[Operation, ...] = ()
        self.suspended = False

    def take(self, code: int, values):
        """One command. FrameRefused: the list is as it was."""
        before = self.operations
        if code not in (ASK, REFRESH):
            self.suspended = code == SUSPEND
        if code == REMOVE:
            self.operations = ()
        elif code == DROP_SCALES:
            self.operations = tuple(one for one in before if not one.is_scale)
        elif code not in (RESUME, SUSPEND, ASK, REFRESH):
            added = operation(code % ADDITIVE, values, self.k2)
            self.operations = (*before, added) if code > ADDITIVE else (added,)
        try:
            self._check()
        except FrameRefused:
            self.operations = before
            raise

    def map(self) -> Map:
        """All operations as one map, in the coordinates of the work offset."""
        return product(identity(), *(one.map for one in self.operations))

    def frame(self, work: Map, turns_tool: bool) -> Frame | None:
        """The frame about a work offset, None if there is none. turns_tool: the tool's length follows it."""
        if self.suspended or not self.operations:
            return None
        axes = product(work, self.map())
        back = _inverse_of_work(work)
        return Frame(product(axes, back), product(work, self._rotation(), back) if turns_tool else identity(), axes)

    def _check(self):
        """FrameRefused for what framekins does not take."""
        whole = self.map()
        for one in (whole, *(operation.map for operation in self.operations[-1:])):
            if any(abs(row[3]) * self.unit > MOST_SHIFT for row in one):
                raise FrameRefused(f"a shift is larger than a machine ({MOST_SHIFT:.0f})")
        scales = numpy.linalg.svd([row[:3] for row in whole], compute_uv=False)
        greatest, smallest = float(scales[0]), float(scales[2])
        if greatest > MOST_UNEQUAL * smallest * (1 + BOUND):
            raise FrameRefused("its scales are too unequal (100 to 1)")
        if smallest < SCALES[0] * (1 - BOUND) or greatest > SCALES[1] * (1 + BOUND):
            raise FrameRefused("it enlarges or shrinks more than a thousandfold")

    def _rotation(self) -> Map:
        """Where a tool points that follows the frame: the columns of the map made orthogonal, those of mirrored axes turned
        back."""
        mirrored = [sum(one.mirrored[axis] for one in self.operations) % 2 for axis in range(3)]
        x, y = (_column(self.map(), axis) for axis in range(2))
        x = _unit(x)
        y = _unit([b - _dot(x, y) * a for a, b in zip(x, y, strict=True)])
        x, y = ([-part for part in one] if flipped else one for one, flipped in zip((x, y), mirrored, strict=False))
        z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
        return [[*row, 0.0] for row in zip(x, y, z, strict=True)]


def work_map(offset, degrees: float, shifted) -> Map:
    """A work offset, its rotation about Z and G92, as a map to the machine's X Y Z."""
    return product(shift(offset), about(2, degrees), shift(shifted))


def _inverse_of_work(work: Map) -> Map:
    """The way back: a work offset turns and shifts, so that its rows are the columns of the way back."""
    columns = [_column(work, axis) for axis in range(3)]
    origin = [row[3] for row in work]
    return [[*column, -_dot(column, origin)] for column in columns]


def _column(of: Map, axis: int) -> list[float]:
    return [row[axis] for row in of]


def _dot(one, other) -> float:
    return sum(a * b for a, b in zip(one, other, strict=True))


def _unit(vector) -> list[float]:
    size = math.sqrt(_dot(vector, vector))
    return [part / size for part in vector]
