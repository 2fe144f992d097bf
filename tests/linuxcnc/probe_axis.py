"""[DISPLAY]USER_COMMAND_FILE of AXIS in tests, see screen_probe.py."""

import os
import sys

sys.path[:0] = [os.path.abspath("../../preview"), os.path.abspath(".")]

import axis_frames
import screen_probe

AXIS = globals()


def read(program):
    AXIS["open_file_guts"](program, False, False)


def show(relative):
    AXIS["vars"].coord_type.set(relative)
    AXIS["vars"].metric.set(1)
    return [float(line.split(":")[1]) for line in AXIS["o"].posstrs()[2][:3]]


def hear(kind, text):
    PROBE.told.append(text)
    STOCK_ADD(kind, text)


def look():
    if FRAMES.is_up:
        PROBE.look()
    AXIS["root_window"].after(screen_probe.PERIOD, look)


FRAMES = axis_frames.install(AXIS)
PROBE = screen_probe.Probe(FRAMES, read, show)
STOCK_ADD = AXIS["notifications"].add
AXIS["notifications"].add = hear
AXIS["root_window"].after(screen_probe.PERIOD, look)
