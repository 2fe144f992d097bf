#!/usr/bin/python3
"""Stands where the screen stands, and carries out rows of the outcome table one behind the other in one LinuxCNC."""

import os
import sys
import time

import hal
import linuxcnc

from delays import Witness
from driver import ERRORS, Failure, Operator, main, write_result
from row import PERIOD, Broken, all_rows

HEADER = "G21 G17 G40 G49 G54 G80 G90 G94 F3000"
#: A wait that takes longer than this hangs, seconds of servo periods.
PATIENCE = 20
#: The same by the clock on the wall, where the servo thread does not run.
LAST_PATIENCE = 120


class RowOperator(Operator):
    """Adds to the Operator what the rows need, above all a way back to the same state after each of them."""

    #: the first line of a program
    header = HEADER

    def __init__(self):
        super().__init__()
        self.component = hal.component("operator")
        self.component.newpin("row", hal.HAL_S32, hal.HAL_OUT)
        self.component.ready()
        hal.connect("operator.row", "row")
        self.changed = {}
        self.kept = {}
        self.programs = 0
        self.answers["rows"] = {}

    def pin(self, name, value):
        """Sets a pin that no signal drives; it gets its value back after the row."""
        self.changed.setdefault(name, hal.get_value(name))
        hal.set_p(name, str(value))

    def get(self, name):
        return hal.get_value(name)

    def keep(self, name, value):
        self.kept[name] = value

    def place(self):
        self.poll()
        return list(self.status.position[:5])

    def until(self, what, condition, timeout=PATIENCE):
        self.wait_for(what, condition, timeout)

    def wait_for(self, what, condition, timeout=None):
        """As for any Operator, but so many seconds of servo periods: a loaded machine runs late."""
        end = self.period() + round((timeout or PATIENCE) / PERIOD)
        super().wait_for(what, lambda: condition() or self.period() > end, LAST_PATIENCE)
        if self.period() > end and not condition():
            raise Failure(f"timed out waiting for {what}")

    @staticmethod
    def period():
        """Servo periods so far."""
        return hal.get_value("threadtest.0.count")

    def write(self, lines):
        self.programs += 1
        path = os.path.join(os.environ["KEEP"], "programs", f"part-{self.programs}.ngc")
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join([self.header, *lines, "M2"]) + "\n")
        return path

    def go(self, *lines):
        """Runs a program to its end. Its first line is line 2: line 1 is the header."""
        self.begin(*lines)
        self.finish(PATIENCE)

    def go_loaded(self, count, *lines):
        """The same with so many moves queued before the first one runs, so that a slow supply plays no part. How many servo
        periods it took from the first of them to the last."""
        self.feed_override(0)
        self.rapid_override(0)
        self.begin(*lines)
        self.until("a move", lambda: self.status.queue > 0)
        first = self.period()
        self.until(f"{count} moves", lambda: self.status.queue >= count)
        taken = self.period() - first
        self.feed_override(1)
        self.rapid_override(1)
        self.finish(PATIENCE)
        return taken

    def sleep(self, seconds):
        """Waits by the servo periods that are run: a loaded machine without a real-time kernel runs late."""
        end = self.period() + round(seconds / PERIOD)
        limit = time.monotonic() + LAST_PATIENCE
        while True:
            left = end - self.period()
            if left <= 0:
                break
            if time.monotonic() > limit:
                raise Failure("the servo thread does not run")
            time.sleep(min(max(0.5 * left * PERIOD, 0.001), 0.02))
        self.poll()

    def begin(self, *lines):
        self.start(self.write(lines))

    def wait_read(self):
        """Waits until the interpreter has read the program to its end; motion may be far behind."""
        self.until("the whole program to be read", lambda: self.status.interp_state != linuxcnc.INTERP_READING)

    def say(self, text):
        """A line of MDI, to its end."""
        self.mdi(text, PATIENCE)

    def stopped(self, quiet=0.06):
        """Waits until every axis has stood for so many seconds of servo periods."""
        last, since = None, 0
        limit = self.period() + round(PATIENCE / PERIOD)
        while True:
            self.poll()
            period = self.period()
            now = tuple(self.get(f"axis.{axis}.pos-cmd") for axis in "xyzab")
            if now != last:
                last, since = now, self.period()
            elif period - since >= round(quiet / PERIOD):
                return
            if period > limit:
                raise Failure("the axes do not come to rest")
            time.sleep(0.004)

    def heard_since(self, count):
        return [text for kind, text in self.messages[count:] if kind in ERRORS]

    def recover(self):
        """Back to rest at the origin with nothing left of what was done, however it ended."""
        self.command.abort()
        self.command.wait_complete(1)
        for name, value in self.changed.items():
            hal.set_p(name, str(value))
        self.changed = {}
        for scale in (self.command.feedrate, self.command.rapidrate):
            scale(1.0)
        self.command.maxvel(100.0)
        self.on()
        self.poll()
        if not all(self.status.homed[:self.status.joints]):
            self.home()
        self.stopped()
        self.mode(linuxcnc.MODE_MDI)
        self.command.wait_complete(1)
        self.mdi("o<reset> call", PATIENCE)
        at = self.place()
        if any(abs(value) > 1e-6 for value in at):
            raise Failure(f"recovered at {at}")

    def rows(self, names):
        """Carries out rows of the table; what comes of each is written at once."""
        known = {row.name(): row for row in all_rows()}
        outcomes = self.answers["rows"]
        witness = Witness(os.path.join(os.environ["KEEP"], "delays.txt"))
        self.recover()
        for number, name in enumerate(names, 1):
            self.poll()
            heard = len(self.messages)
            self.kept = {}
            outcome = outcomes[name] = {"number": number, "failure": "LinuxCNC did not answer any more", "kept": {},
                                        "errors": [], "recovered": False, "delay": 0.0}
            write_result(self, None)
            self.component["row"] = number
            started = time.monotonic()
            try:
                known[name]().operate(self)
                outcome["failure"] = None
            except (Failure, Broken) as failure:
                outcome["failure"] = str(failure)
            self.sleep(0.03)
            self.component["row"] = 0
            outcome["delay"] = witness.longest(started)
            outcome["kept"], outcome["errors"] = self.kept, self.heard_since(heard)
            operated = time.monotonic()
            try:
                self.recover()
                outcome["recovered"] = True
                outcome["seconds"] = [round(operated - started, 2), round(time.monotonic() - operated, 2)]
            except Failure as failure:
                said = "; ".join(self.heard_since(heard))
                outcome["failure"] = f"{outcome['failure'] or 'done'}, and then: {failure} ({said})"
                return


if __name__ == "__main__":
    sys.exit(main(RowOperator))
