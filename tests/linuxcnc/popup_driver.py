#!/usr/bin/python3
"""screen_driver.py with a keyboard (the X server's test extension)."""

import ctypes
import os
import subprocess
import sys
import time

import screen_driver

#: s between two presses of a key
PATIENCE = 2


class Typist(screen_driver.Screen):
    """The steps of a screen, and those that want a key."""

    def dismiss(self):
        """Presses Return until AXIS is up, for which a popup has to go."""
        pressed = 0.0

        def is_up():
            nonlocal pressed
            if time.monotonic() - pressed > PATIENCE:
                pressed = time.monotonic()
                self.press("Return")
            shown = subprocess.run(["halcmd", "show", "comp", "axisui"], capture_output=True, text=True, check=False)
            return " ready" in shown.stdout

        self.wait_for("AXIS", is_up, 60)

    def press(self, key):
        """Presses and releases a key of this name."""
        xlib, test = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        xlib.XOpenDisplay.restype = ctypes.c_void_p
        display = ctypes.c_void_p(xlib.XOpenDisplay(os.environ["DISPLAY"].encode()))
        xlib.XStringToKeysym.restype = ctypes.c_ulong
        code = xlib.XKeysymToKeycode(display, ctypes.c_ulong(xlib.XStringToKeysym(key.encode())))
        for is_pressed in (1, 0):
            test.XTestFakeKeyEvent(display, code, is_pressed, 0)
        xlib.XCloseDisplay(display)


if __name__ == "__main__":
    sys.exit(screen_driver.main(Typist))
