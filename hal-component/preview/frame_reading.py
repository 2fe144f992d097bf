"""What windows have in common that read programs by themselves and say nothing of limits: gmoccapy's and those of qtvcp."""

import hal_glib

from frame_window import FrameWindow


class ReadingWindow(FrameWindow):
    """A window whose `load` reads a program."""

    def __init__(self, window, state, ini, tell):
        """tell(text): tells the operator."""
        super().__init__(window, state, ini)
        self.tell = tell
        if not window.is_foam():
            window.logger = self.replace_trail(window.logger, window.get_geometry())
        self.stock_load = window.load
        window.load = self.load

    def load(self, filename=None):
        """Reads a program, and tells which limits of joints it exceeds."""
        before = self.window.canon
        self.stock_load(filename)
        if self.window.canon is not before:
            for text in self.warnings() or ():
                self.tell(text)


def show_machine_positions(window: FrameWindow):
    """Positions of the machine's own axes in all displays that LinuxCNC's GStat tells of positions. window: one of the
    screen."""
    stock = hal_glib.GStat.get_position

    def get_position(status):
        position, *others = stock(status)
        return window.machine_position(status.stat, position), *others

    hal_glib.GStat.get_position = get_position
