"""A module of handlers (-u) for the panel of gladevcp in tests: pins say what of it is shown."""

import hal
from gi.repository import GLib

#: ms between two looks
PERIOD = 100

#: of the lamps of rotary axes
LAMPS = ("limit.a", "limit.c")


def get_handlers(component, builder, _options):
    """gladevcp asks for this when all widgets are there."""
    for lamp in LAMPS:
        for pin in ("shown", "hidden"):
            component.newpin(f"{pin}.{lamp}", hal.HAL_BIT, hal.HAL_OUT)

    def look():
        for lamp in LAMPS:
            is_shown = builder.get_object(lamp).get_visible()
            component[f"shown.{lamp}"], component[f"hidden.{lamp}"] = is_shown, not is_shown
        return True

    GLib.timeout_add(PERIOD, look)
    return []
