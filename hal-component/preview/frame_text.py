"""A line of text over a preview."""

from OpenGL import GL

#: points from the left and from the top, as position displays are
LEFT, TOP = 15, 5


def draw_text(window, text: str):
    """Writes into the upper left corner. window: rs274.glcanon.GlCanonDraw."""
    _, height, letters = window.get_font_info()
    GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_CURRENT_BIT | GL.GL_TRANSFORM_BIT)
    GL.glDisable(GL.GL_DEPTH_TEST)
    GL.glMatrixMode(GL.GL_PROJECTION)
    GL.glPushMatrix()
    GL.glLoadIdentity()
    GL.glOrtho(0, window.winfo_width(), 0, window.winfo_height(), -1, 1)
    GL.glMatrixMode(GL.GL_MODELVIEW)
    GL.glPushMatrix()
    GL.glLoadIdentity()
    GL.glColor3f(*window.colors["overlay_foreground"])
    GL.glRasterPos2i(LEFT, int(window.winfo_height() - height - TOP))
    for letter in text:
        GL.glCallList(letters + ord(letter))
    GL.glPopMatrix()
    GL.glMatrixMode(GL.GL_PROJECTION)
    GL.glPopMatrix()
    GL.glPopAttrib()
