"""What is drawn over a preview, as far as it does not depend on how LinuxCNC draws."""

import math
import textwrap

from frame_map import Map

#: points from the left and from the bottom: above, some screens lay something over it
LEFT, BOTTOM = 15, 10


def fitting(window, text: str) -> list[str]:
    """A text as lines that are not longer than the window. window: rs274.glcanon.GlCanonDraw."""
    return textwrap.wrap(text, max(1, int((window.winfo_width() - LEFT) / window.get_font_info()[0])))


def upright(axes: Map) -> Map:
    """A frame as a matrix of four rows, its directions of length 1: a scale is no longer triad."""
    lengths = [math.hypot(*(row[axis] for row in axes)) for axis in range(3)]
    return [*([*(row[axis] / lengths[axis] for axis in range(3)), row[3]] for row in axes), [0.0, 0.0, 0.0, 1.0]]
