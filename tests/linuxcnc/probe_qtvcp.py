"""[DISPLAY]USER_COMMAND_FILE of qtdragon in tests, see screen_probe.py."""

import os
import sys

sys.path[:0] = [os.path.abspath("../../preview"), os.path.abspath(".")]

import qtvcp_screen

qtvcp_screen.start(locals()["self"])
