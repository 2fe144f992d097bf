"""Frames in gmoccapy. `install` replaces some of its widgets' own names; frame_gmoccapy.py calls it."""

import gremlin
import linuxcnc
from gi.repository import GLib

from frame_canon import framed
from frame_reading import ReadingWindow, show_machine_positions
from frame_window import follow

#: ms until gmoccapy is up, behind which a program that it has opened by itself is read again
UP = 200


def install(screen):
    """Makes gmoccapy follow frames. screen: itself. None if that cannot be, and the operator was told why."""
    def tell(text):
        screen._show_error((linuxcnc.OPERATOR_ERROR, text))

    found = follow(screen.get_ini_info.inifile, tell)
    if found is None:
        return None
    state, rules = found
    return GmoccapyFrames(screen, state, rules, tell)


class GmoccapyFrames(ReadingWindow):
    """gmoccapy's window with frames."""

    def __init__(self, screen, state, rules, tell):
        super().__init__(screen.widgets.gremlin, state, screen.get_ini_info.inifile, tell)
        #: the program that gmoccapy opens by itself has been read again
        self.is_up = False
        gremlin.StatCanon = framed(gremlin.StatCanon, rules)
        show_machine_positions(self)
        GLib.timeout_add(UP, self.read_again)

    def read_again(self):
        """gmoccapy has opened a program before it knew of frames."""
        if self.window.canon:
            self.window.reloadfile(None)
        self.is_up = True
        return False
