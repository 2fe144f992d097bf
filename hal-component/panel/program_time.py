#!/usr/bin/python3
"""Says when the program will end, from what `framepath plan --times PROGRAM.times` has written beside the program.

A HAL component, loaded by operator.hal. Its inputs are blendtp's pins of where the machine is;
it puts out when the program ends, on blendtp's clock, and blendtp counts down to that (man blendtp). Where there are no
times of the program it says nothing, and blendtp shows the time of what is queued.
"""

import contextlib
import os
import sys
import time

import hal
import linuxcnc

from time_table import TimesError, TimeTable

NAME = "program-time"

#: s between two looks
PERIOD = 0.02

#: how often pins are read until they are of one servo period; one is much longer than that takes
TRIES = 20

INPUTS = {"clock": hal.HAL_FLOAT, "number": hal.HAL_U32, "line": hal.HAL_S32, "stands": hal.HAL_BIT, "to-go": hal.HAL_FLOAT}


class Follower:
    """A program that runs, along its table."""

    def __init__(self, table, number):
        """number: that of the move that begins the program."""
        self.table = table
        self.base = number
        #: on blendtp's clock
        self.ends_at = None

    def follow(self, clock, number, line, stands, to_go):
        """When the program ends; None if that is not known."""
        move = (number - self.base) & 0xffffffff
        if not stands and not self.table.has(move, line):
            # what has begun elsewhere has other moves before, or is another part of the program
            there = self.table.nearest(line, move)
            if there is None:
                self.ends_at = None
                return None
            self.base = number - there
            move = there
        if self.ends_at is None and stands:
            # the move that ran before the program may have ended since it was last looked at
            return None
        begin, end = (clock + self.table.total - when for when in self.table.find(move, to_go, stands))
        self.ends_at = begin if self.ends_at is None else min(max(self.ends_at, end), begin)
        return self.ends_at


class ProgramTime:
    """The component."""

    def __init__(self):
        self.pins = hal.component(NAME)
        for name, kind in INPUTS.items():
            self.pins.newpin(name, kind, hal.HAL_IN)
        self.pins.newpin("ends-at", hal.HAL_FLOAT, hal.HAL_OUT)
        self.pins.newpin("said-at", hal.HAL_FLOAT, hal.HAL_OUT)
        self.pins.ready()
        self.status = linuxcnc.stat()
        self.table, self.known, self.follower = None, None, None
        self.number = 0

    def place(self):
        """The inputs of one servo period; None if that was not to be had."""
        for _ in range(TRIES):
            values = [self.pins[name] for name in INPUTS]
            if self.pins["clock"] == values[0]:
                return values
        return None

    def look(self):
        """Once in each PERIOD."""
        self.status.poll()
        runs = self.status.task_mode == linuxcnc.MODE_AUTO and self.status.interp_state != linuxcnc.INTERP_IDLE
        values = self.place()
        if values is None:
            return
        ends_at = None
        if not runs:
            self.number, self.follower = values[1], None
            self.take_table(self.status.file)
        elif self.table:
            self.follower = self.follower or Follower(self.table, self.number)
            ends_at = self.follower.follow(*values)
        self.pins["ends-at"] = ends_at or 0.0
        self.pins["said-at"] = values[0]

    def take_table(self, program):
        """Reads the times of a program where they, or it, have changed."""
        path = f"{program}.times"
        known = program, changed_at(program), changed_at(path)
        if known == self.known:
            return
        self.table, self.known = None, known
        if known[1] is None or known[2] is None:
            return
        try:
            self.table = TimeTable.read(path, program)
        except (TimesError, OSError, UnicodeDecodeError) as error:
            print(f"{NAME}: no time of the whole program is shown: {error}", file=sys.stderr, flush=True)


def changed_at(path):
    """When a file was changed; None if there is none."""
    try:
        return os.stat(path).st_mtime_ns if path else None
    except OSError:
        return None


def main():
    component = ProgramTime()
    while True:
        # LinuxCNC is not up yet, or not any more: HAL ends this process
        with contextlib.suppress(linuxcnc.error):
            component.look()
        time.sleep(PERIOD)


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        main()
