"""The origins and directions of frames in a preview."""

import math

from OpenGL import GL

from frame_map import Map


def draw_triad(axes: Map, size: float, letters: int):
    """A triad. axes: a frame, its shift in inches, as previews are drawn. size: in inches. letters: the display list of a triad
    at the origin."""
    columns = [[row[axis] for row in axes] for axis in range(3)]
    # a scale is no longer triad
    scaled = [[part / math.hypot(*column) for part in column] for column in columns]
    GL.glPushMatrix()
    GL.glMultMatrixd([*scaled[0], 0, *scaled[1], 0, *scaled[2], 0, *(row[3] for row in axes), 1])
    GL.glScalef(size, size, size)
    GL.glCallList(letters)
    GL.glPopMatrix()
