"""Drawing over a preview of LinuxCNC 2.10, which draws a scene of parts with shaders. 2.9 has none of it: frame_lists.py."""

import numpy
from OpenGL import GL
from rs274 import glcanon_scene

from frame_map import Map
from frame_text import BOTTOM, LEFT, fitting, upright


def draw_triad(window, axes: Map, size: float):
    """A triad. window: rs274.glcanon.GlCanonDraw. axes: a frame, its shift in inches, as previews are drawn. size: inches."""
    with window.mv.push():
        window.mv.mult(numpy.array(upright(axes)))
        window.mv.scale(size, size, size)
        glcanon_scene.AxesPart().draw_axes(window.frame_context())


def draw_text(window, text: str):
    """Writes into the lower left corner, in as many lines as it takes. window: rs274.glcanon.GlCanonDraw."""
    _, height, letters = window.get_font_info()
    colour = (*window.colors["overlay_foreground"], 1.0)
    screen = window.winfo_width(), window.winfo_height()
    # as the position display of the scene: nothing that was drawn hides it
    GL.glDisable(GL.GL_DEPTH_TEST)
    GL.glDepthMask(GL.GL_FALSE)
    for number, line in enumerate(reversed(fitting(window, text))):
        letters.draw_string(line, LEFT, int(BOTTOM + number * height), colour, screen)
    GL.glDepthMask(GL.GL_TRUE)
    GL.glEnable(GL.GL_DEPTH_TEST)
