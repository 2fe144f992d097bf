"""Frames in a preview: what LinuxCNC's interpreter reads of a program is drawn where the machine will run it.

A screen reads a program with an interpreter of its own, which calls a "canon" object for each move. In a preview
o<frame_send> tells that object of each frame command by a debug message, since there is no motion to tell:

    framepath frame CODE A B C      the command, lengths in mm; A, B, C away from 0 by 1, see below
    framepath position              the interpreter has read its position anew

In between the canon says at which world position the interpreter is behind the command (`answer`), no joint having moved.
The interpreter takes it over by a G28 to there, which is not drawn.

A canon has the tip of the tool in inches of the machine's X Y Z (`lo`) and the tool's length with it (`xo`, `yo`, `zo`).
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from frame_arc import Arc
from frame_commands import Frame, FrameList, FrameRefused, described, work_map
from frame_map import Map, Point, applied, inverse, product, shift, turned

MM_PER_INCH = 25.4

#: how many triads are drawn of a program
MOST_TRIADS = 64

#: numbers below 0.0001 are written as 0 in messages of the interpreter: all of them come with 1 added to their size
AWAY = 1.0


def number(word: str) -> float:
    """A number of a message."""
    value = float(word)
    return value + AWAY if value < 0 else value - AWAY


class FrameRules:
    """What a preview has to know beside the program."""

    def __init__(self, k2, turns_tool, answer, tell):
        """k2: the other convention of ROTS. turns_tool(): the tool's length follows a frame. answer(position): tells the
        interpreter its world position, three numbers in machine units, or takes it back with None. tell(text): tells the
        operator."""
        self.k2 = k2
        self.turns_tool = turns_tool
        self.answer = answer
        self.tell = tell


if TYPE_CHECKING:
    #: rs274.glcanon.GLCanon, which has no types
    Canon: Any
else:
    Canon = object


class FrameCanon(Canon):
    """What a canon class does about frames, in front of the class of a screen."""

    rules: FrameRules
    #: LinuxCNC 2.10 can hand over moves in blocks: here they come one by one
    use_move_batches = False
    #: the frame in force
    frame: Frame | None = None
    #: from the interpreter's coordinates behind its offsets to the tip as it is drawn; None without a frame
    frame_out: Map | None = None
    #: the tool's length along its own axes
    frame_tool: Point = (0.0, 0.0, 0.0)
    #: the tool's length that the frame was made with
    frame_made_with: Point = (0.0, 0.0, 0.0)
    lo: tuple[float, ...]
    rotate_and_translate: Callable[..., tuple[float, ...]]

    def __init__(self, *args, **words):
        super().__init__(*args, **words)
        self.frame_list = FrameList(self.rules.k2, self.frame_units())
        #: origins and directions of the frames of the program
        self.frames_seen = []
        self.frame_refused = False
        #: what `frame_reach` needs of each arc
        self.frame_arcs = []
        #: ends of rapids that are not drawn, as positions of the axes
        self.frame_hidden = []

    def message(self, text):
        words = text.split()
        if words[:2] == ["framepath", "frame"]:
            self.frame_command(int(words[2]), [number(word) for word in words[3:6]])
        elif words[:2] == ["framepath", "position"]:
            self.frame_answered()
        else:
            super().message(text)

    def frame_command(self, code, values):
        """A frame command of the program: no joint moves, the position in the program is another."""
        axes = self.frame_axes()
        try:
            # lengths are those of shifts, of which the canon wants inches
            inches = [value / MM_PER_INCH for value in values] if code % 100 == 1 else values
            self.frame_list.take(code, inches)
        except FrameRefused as refused:
            self.frame_refuse(f"{described(code, values)} would be refused, {refused}")
        self.frame = self.frame_list.frame(self.frame_work(), self.rules.turns_tool())
        self.frame_made_with = self.frame_tool
        if self.frame and len(self.frames_seen) < MOST_TRIADS and self.frame.axes not in self.frames_seen:
            self.frames_seen.append(self.frame.axes)
        self.frame_place(axes)
        # nothing is drawn until the interpreter has gone to its new position
        self.suppress += 1
        self.rules.answer(self.frame_world(axes))

    def frame_answered(self):
        self.suppress -= 1
        self.rules.answer(None)

    def frame_refuse(self, reason):
        """The machine would stop here: nothing more is drawn. reason: begins a sentence."""
        if not self.frame_refused:
            self.frame_refused = True
            self.suppress += 1
            self.rules.tell(f"{reason}: the preview ends here")

    def frame_units(self):
        """Machine units in an inch."""
        return MM_PER_INCH * self.get_external_length_units()

    def frame_work(self):
        """From coordinates of the program to those behind the work offset."""
        return work_map(*self.frame_offsets())

    def frame_offsets(self):
        """What makes up the work offset in force."""
        return ((self.g5x_offset_x, self.g5x_offset_y, self.g5x_offset_z), self.rotation_xy,
                (self.g92_offset_x, self.g92_offset_y, self.g92_offset_z))

    def frame_axes(self):
        """Where the machine's axes are, inches."""
        return tuple(tip + tool for tip, tool in zip(self.lo, (self.xo, self.yo, self.zo), strict=False))

    def frame_place(self, axes):
        """Tip and tool for axes that are there, with the frame and the tool of now."""
        tool = self.frame_tool
        if self.frame is None:
            self.frame_out = None
        else:
            tool = turned(self.frame.tool, self.frame_tool)
            # a tool that was changed in the frame moves the axes as framekins does: with the map of the frame
            since = [now - then for now, then in zip(self.frame_tool, self.frame_made_with, strict=True)]
            by = [a + b - c for a, b, c in zip(turned(self.frame.tip, since), turned(self.frame.tool, self.frame_made_with),
                                               tool, strict=True)]
            self.frame_out = product(shift(by), self.frame.tip)
        self.frame_map()
        self.xo, self.yo, self.zo = tool
        self.lo = (*(axis - part for axis, part in zip(axes, tool, strict=True)), *self.lo[3:])

    def frame_world(self, axes):
        """The world position for axes, in machine units: what LinuxCNC has as its position."""
        tip = self.lo[:3]
        if self.frame_out is not None:
            tip = applied(inverse(self.frame_out), tip)
        return tuple((part + tool) * self.frame_units() for part, tool in zip(tip, self.frame_tool, strict=True))

    def frame_map(self):
        """What stands in for rotate_and_translate in a frame; without one moves are read as ever."""
        self.__dict__.pop("rotate_and_translate", None)
        if self.frame_out is not None:
            others = self.rotate_and_translate(*(0.0,) * 9)[3:]
            self.rotate_and_translate = mapped(product(self.frame_out, self.frame_work()), others)

    def set_g5x_offset(self, *offset):
        super().set_g5x_offset(*offset)
        self.frame_map()

    def set_g92_offset(self, *offset):
        super().set_g92_offset(*offset)
        self.frame_map()

    def set_xy_rotation(self, degrees):
        super().set_xy_rotation(degrees)
        self.frame_map()

    def straight_traverse(self, *place):
        super().straight_traverse(*place)
        if self.first_move and self.suppress <= 0:
            self.frame_hidden.append(self.frame_axes())

    def arc_feed(self, first, second, first_centre, second_centre, turns, along, *others):
        if self.suppress > 0:
            return
        kept = (self.frame_out, self.frame_offsets(), self.plane, self.lo, (first, second, along),
                (first_centre, second_centre), turns, (self.xo, self.yo, self.zo))
        self.frame_arcs.append(kept)
        if self.frame_out is None:
            super().arc_feed(first, second, first_centre, second_centre, turns, along, *others)
            return
        arc, out, _ = arc_of(*kept)
        end = super().rotate_and_translate(0, 0, 0, *others)[3:]
        self.straight_arcsegments(arc.chords(out, self.arcdivision, self.lo[3:], end))

    def frame_reach(self):
        """The least and the greatest position of the machine's X Y Z in the program, inches: chords of arcs stay inside. None
        if it does not move."""
        ends = list(self.frame_hidden)
        if self.frame_draws():
            ends += [self.min_extents_notool, self.max_extents_notool]
        if not ends:
            return None
        least, greatest = ([side(values) for values in zip(*ends, strict=True)] for side in (min, max))
        for kept in self.frame_arcs:
            arc, out, tool = arc_of(*kept)
            for axis, (low, high) in enumerate(arc.reach(out)):
                least[axis] = min(least[axis], low + tool[axis])
                greatest[axis] = max(greatest[axis], high + tool[axis])
        return least, greatest

    def frame_draws(self):
        """The program draws something."""
        record = getattr(self, "program_geometry", None)
        if record is not None:
            # 2.10's extents are 0 without a move
            return not record.is_empty
        # as far apart as can be, the wrong way round
        return self.min_extents_notool[0] <= self.max_extents_notool[0]

    def tool_offset(self, xo, yo, zo, *others):
        axes = self.frame_axes()
        super().tool_offset(xo, yo, zo, *others)
        self.frame_tool = (xo, yo, zo)
        self.frame_place(axes)


def mapped(out: Map, others):
    """A function from nine axes of a program to where they are drawn: X Y Z behind the map `out`, to the six others `others` is
    added."""
    # written out, since a program has many moves
    (xx, xy, xz, x0), (yx, yy, yz, y0), (zx, zy, zz, z0) = out
    a0, b0, c0, u0, v0, w0 = others

    def without_others(x, y, z, *rest):
        return (xx * x + xy * y + xz * z + x0, yx * x + yy * y + yz * z + y0, zx * x + zy * y + zz * z + z0, *rest)

    def where(x, y, z, a, b, c, u, v, w):
        return (xx * x + xy * y + xz * z + x0, yx * x + yy * y + yz * z + y0, zx * x + zy * y + zz * z + z0,
                a + a0, b + b0, c + c0, u + u0, v + v0, w + w0)

    return where if any(others) else without_others


def arc_of(frame_out, work, plane, start, end, centre, turns, tool):
    """An arc of a preview as (in the program's coordinates, their map to the tip, the tool's length)."""
    out = work_map(*work)
    if frame_out is not None:
        out = product(frame_out, out)
    return Arc(plane, applied(inverse(out), start[:3]), end, centre, turns), out, tool


def framed(base, rules: FrameRules):
    """The canon class `base` of a screen, with frames."""
    return type(f"Framed{base.__name__}", (FrameCanon, base), {"rules": rules})
