#!/usr/bin/python3
"""Carries out rows of the outcome table with a turned frame: in each program, and in each line of MDI."""

import sys

import linuxcnc

import framed
from driver import main
from operate import PATIENCE, RowOperator

ACTIVE = "framekins.active"


class FramedOperator(RowOperator):
    """Operates as others do, in a frame; places are those of the frame."""

    #: sets the frame, and all that the others begin with
    header = "o<framed> call"

    def pin(self, name, value):
        super().pin(framed.PINS.get(name, name), value)

    def place(self):
        """From the joints, which are where they are whether the frame is on or not."""
        self.poll()
        joints = list(self.status.joint_position[:5])
        return [*framed.in_frame(joints[:3]), *joints[3:]]

    def machine_place(self):
        self.poll()
        return list(self.status.joint_position[:3])

    def without_frame(self):
        """Waits until it is gone, and frame_guard has told the interpreter and has come back from MDI."""
        self.until("no frame", lambda: not (self.get(ACTIVE) or self.get("framekins.releasing") or self.get("framekins.hold")))
        self.sleep(0.1)

    def set_frame(self):
        """As a person does it who goes on in MDI: an abort has taken the frame off."""
        self.until("the end of a frame", lambda: not (self.get("framekins.releasing") or self.get("framekins.hold")))
        if not self.get(ACTIVE):
            self.mdi("o<frame> call", PATIENCE)

    def say(self, text):
        self.set_frame()
        super().say(text)

    def mdi_start(self, text):
        self.set_frame()
        super().mdi_start(text)

    def open(self, program):
        """A moment later than others: until the frame of before is gone, which AUTO takes off."""
        self.mode(linuxcnc.MODE_AUTO)
        self.without_frame()
        super().open(program)

    def switch_mode(self, name):
        super().switch_mode(name)
        if name == "mdi":
            self.set_frame()

    def step(self):
        """The lines that set the frame are nothing that a row counts."""
        while not self.get(ACTIVE):
            super().step()
            self.sleep(0.02)
        super().step()

    def recover(self):
        self.command.abort()
        self.command.wait_complete(1)
        self.without_frame()
        super().recover()


if __name__ == "__main__":
    sys.exit(main(FramedOperator))
