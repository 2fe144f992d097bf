"""Cutter compensation in a frame that scales: LinuxCNC works with the tool's radius in the coordinates of the frame, so that
the scale takes it along. Mirrors and turns leave it what it is."""

import hal

#: ten times the number of G40: no compensation
OFF = 400

#: the axes of the plane in which that is, by ten times the number of G17, G18, G19
PLANES = {170: (0, 1), 180: (0, 2), 190: (1, 2)}

#: by how much the length of a direction in the plane may differ from 1
EXACT = 1e-6


def linear_map():
    """Rows of the frame in force, from directions of the work offset without its rotation to those of the machine."""
    return [[hal.get_value(f"framekins.frame.{row}{column}") for column in "xyz"] for row in "xyz"]


def keeps_lengths(rows, first, second):
    """Whether every direction between these two, which are at right angles and of length 1, keeps its length."""
    u, v = ([sum(a * b for a, b in zip(row, way, strict=True)) for row in rows] for way in (first, second))

    def product(one, other):
        return sum(a * b for a, b in zip(one, other, strict=True))

    return max(abs(product(u, u) - 1), abs(product(v, v) - 1), abs(product(u, v))) < EXACT


class Radius:
    """Whether a frame scales the tool's radius. framekins' pins are read once for each frame and plane."""

    def __init__(self):
        self.asked = None
        self.scaled = False

    def reason(self, now):
        """Why a move of this look has to be stopped, None if it need not."""
        if now.compensation == OFF or now.plane not in PLANES:
            return None
        asked = (now.acknowledged, now.plane, now.axes)
        if asked != self.asked:
            self.asked = asked
            self.scaled = not keeps_lengths(linear_map(), *(now.axes[k] for k in PLANES[now.plane]))
        if not self.scaled:
            return None
        return ("cutter compensation (G41, G42) in a frame that scales its plane: the tool's radius would be scaled as well. "
                "Write G40 and the path of the tool's centre, or translate the program by framepath filter --backend program")
