"""[DISPLAY]USER_COMMAND_FILE of gmoccapy in tests, see screen_probe.py."""

import os
import sys

sys.path[:0] = [os.path.abspath("../../preview"), os.path.abspath(".")]

import gmoccapy_screen

gmoccapy_screen.start(locals()["self"])
