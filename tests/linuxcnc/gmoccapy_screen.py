"""gmoccapy for screen_probe.py."""

from gi.repository import GLib

import gmoccapy_frames
import screen_probe


def start(screen):
    """Installs what users have, and answers questions."""
    frames = gmoccapy_frames.install(screen)

    def show(relative):
        displays = [screen.dro_dic[f"Combi_DRO_{joint}"].get_position() for joint in range(3)]
        return [rel if relative else absolute for absolute, rel, _ in displays]

    probe = screen_probe.Probe(frames, lambda program: frames.window.fileloaded(None, program), show,
                               # until then gmoccapy takes back another mode that somebody else has switched to
                               screen.widgets.rbt_auto.get_sensitive,
                               lambda: screen.widgets.ntb_preview.set_current_page(-1))
    stock_add = screen.notification.add_message

    def hear(text, *icon):
        probe.told.append(text)
        return stock_add(text, *icon)

    def look():
        if frames.is_up:
            probe.look()
        return True

    screen.notification.add_message = hear
    GLib.timeout_add(screen_probe.PERIOD, look)
