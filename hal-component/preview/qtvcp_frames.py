"""Frames in qtdragon and other screens of qtvcp. `install` replaces some names of their widgets; frame_qtvcp.py calls it."""

import linuxcnc
import qt5_graphics
from qtvcp.core import Info, Status

from frame_canon import framed
from frame_reading import ReadingWindow, show_machine_positions
from frame_window import follow


def tell(text):
    """Tells the operator, as LinuxCNC's own errors are told."""
    Status().emit("error", linuxcnc.OPERATOR_ERROR, text)


def install(handler):
    """Makes all previews of a screen follow frames. handler: of the screen. None if that cannot be, and the operator was told
    why."""
    ini = Info().INI
    found = follow(ini, tell)
    if found is None:
        return None
    state, rules = found
    qt5_graphics.StatCanon = framed(qt5_graphics.StatCanon, rules)
    windows = [ReadingWindow(window, state, ini, tell) for window in handler.w.findChildren(qt5_graphics.Lcnc_3dGraphics)]
    if windows:
        show_machine_positions(windows[0])
    return windows
