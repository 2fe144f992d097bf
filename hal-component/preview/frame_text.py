"""Text over a preview."""

import textwrap

from OpenGL import GL

#: points from the left and from the bottom: above, some screens lay something over it
LEFT, BOTTOM = 15, 10


def fitting(window, text: str) -> list[str]:
    """A text as lines that are not longer than the window. window: rs274.glcanon.GlCanonDraw."""
    return textwrap.wrap(text, max(1, int((window.winfo_width() - LEFT) / window.get_font_info()[0])))


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
