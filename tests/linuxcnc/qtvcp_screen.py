"""qtdragon for screen_probe.py."""

from PyQt5.QtCore import QTimer
from qtvcp.core import Status

import qtvcp_frames
import screen_probe

#: kinds of positions of the displays of qtvcp
ABSOLUTE, RELATIVE = 0, 1


def start(handler):
    """Installs what users have, and answers questions."""
    # its utilities may have a preview, too
    frames = next(window for window in qtvcp_frames.install(handler) if window.window is handler.w.gcodegraphics)

    def show(relative):
        # named by their axes in 2.9, by their joints in 2.10
        displays = [getattr(handler.w, f"dro_axis_{letter}", None) or handler.w[f"dro_axis_{joint}"]
                    for joint, letter in enumerate("xyz")]
        for display in displays:
            display.reference_type = RELATIVE if relative else ABSOLUTE
            display.update(None, *Status().get_position(), Status().stat.joint_actual_position)
        return [float(display.text()) for display in displays]

    probe = screen_probe.Probe(frames, lambda program: frames.window.load_program(None, program), show)
    Status().connect("error", lambda _, kind, text: probe.told.append(text))
    handler.probe_timer = QTimer()
    handler.probe_timer.timeout.connect(probe.look)
    handler.probe_timer.start(screen_probe.PERIOD)
