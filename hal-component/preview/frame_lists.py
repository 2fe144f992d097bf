"""Drawing over a preview of LinuxCNC 2.9, which draws with OpenGL's fixed functions and display lists."""

from OpenGL import GL

from frame_map import Map
from frame_text import BOTTOM, LEFT, fitting, upright


def draw_triad(window, axes: Map, size: float):
    """A triad. window: rs274.glcanon.GlCanonDraw. axes: a frame, its shift in inches, as previews are drawn. size: inches."""
    letters = window.dlist(("axes", window.get_view()), gen=window.draw_axes)
    GL.glPushMatrix()
    # by columns
    GL.glMultMatrixd([value for column in zip(*upright(axes), strict=True) for value in column])
    GL.glScalef(size, size, size)
    GL.glCallList(letters)
    GL.glPopMatrix()


def draw_text(window, text: str):
    """Writes into the lower left corner, in as many lines as it takes. window: rs274.glcanon.GlCanonDraw."""
    _, height, letters = window.get_font_info()
    GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_CURRENT_BIT | GL.GL_TRANSFORM_BIT)
    for ability in (GL.GL_DEPTH_TEST, GL.GL_LIGHTING, GL.GL_BLEND):
        GL.glDisable(ability)
    GL.glMatrixMode(GL.GL_PROJECTION)
    GL.glPushMatrix()
    GL.glLoadIdentity()
    GL.glOrtho(0, window.winfo_width(), 0, window.winfo_height(), -1, 1)
    GL.glMatrixMode(GL.GL_MODELVIEW)
    GL.glPushMatrix()
    GL.glLoadIdentity()
    GL.glColor3f(*window.colors["overlay_foreground"])
    for number, line in enumerate(reversed(fitting(window, text))):
        GL.glRasterPos2i(LEFT, int(BOTTOM + number * height))
        for letter in line:
            GL.glCallList(letters + ord(letter))
    GL.glPopMatrix()
    GL.glMatrixMode(GL.GL_PROJECTION)
    GL.glPopMatrix()
    GL.glPopAttrib()
