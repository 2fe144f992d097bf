#!/usr/bin/python3
"""The operator of driver.py, who looks at previews as well: LinuxCNC's own interpreter reads the program for a canon as AXIS
has it, with the frames of hal-component/preview."""

import gc
import os
import shutil
import sys
import time

import gcode
import linuxcnc
from rs274.glcanon import GLCanon
from rs274.interpret import StatMixin

import driver
from canon_moves import keep_moves

sys.path.insert(0, os.path.abspath("../../preview"))

import frame_state
from frame_canon import FrameRules, framed
from frame_screen import turns_tool

LETTERS = "XYZABCUVW"
MM_PER_INCH = 25.4

#: chords that a preview makes of half a circle, as many as AXIS does at most
CHORDS = 128


class Canon(GLCanon, StatMixin):
    """What AXIS hands to the interpreter, without its windows."""

    def __init__(self, status, parameter_file):
        GLCanon.__init__(self, {"dwell": (1, 1, 1), "m1xx": (1, 1, 1)}, "XYZ")
        StatMixin.__init__(self, status, 0)
        self.arcdivision = CHORDS
        self.parameter_file = parameter_file

    def change_tool(self, idx):
        GLCanon.change_tool(self, idx)
        StatMixin.change_tool(self, idx)


def start_codes(status, startup):
    """What AXIS has the interpreter read in front of a program: modes, tool and place of the machine."""
    codes = [startup, "G21" if status.linear_units == 1 else "G20", "G90", f"T{status.tool_in_spindle} M6"]
    used = [axis for axis in range(9) if status.axis_mask >> axis & 1]
    codes += [f"G53 G0 {LETTERS[axis]}{status.position[axis]:.8f}" for axis in used]
    codes += [f"G{code * 0.1:.1f}" for code in status.gcodes[3:] if code != -1]
    codes.append("G43.1 " + " ".join(f"{LETTERS[axis]}{status.tool_offset[axis]:.8f}" for axis in used))
    return codes + [f"M{code}" for code in status.mcodes[2:] if code != -1]


class Viewer(driver.Operator):
    """Keeps what a screen would draw."""

    def __init__(self):
        super().__init__()
        self.state = None

    def canon_class(self, with_frames):
        if not with_frames:
            return Canon
        self.state = self.state or frame_state.FrameState()
        # LinuxCNC shows the operator what a screen says
        rules = FrameRules(frame_state.k2(), lambda: turns_tool(self.state, linuxcnc.ini(os.environ["INI_FILE_NAME"])),
                           self.state.answer, self.command.error_msg)
        return framed(Canon, rules)

    def load(self, program, with_frames=True):
        """A canon that has seen the program, and how many seconds that took."""
        self.poll()
        found = linuxcnc.ini(os.environ["INI_FILE_NAME"])
        parameters = os.path.abspath("preview.var")
        kept = found.find("RS274NGC", "PARAMETER_FILE")
        self.command.task_plan_synch()
        self.command.wait_complete()
        if os.path.exists(kept):
            shutil.copy(kept, parameters)
        canon = self.canon_class(with_frames)(self.status, parameters)
        codes = start_codes(self.status, found.find("RS274NGC", "RS274NGC_STARTUP_CODE"))
        # what the last preview has left; and time of the processor, so that other work of this computer does not count
        gc.collect()
        begun = time.process_time()
        result, line = gcode.parse(program, canon, codes)
        seconds = time.process_time() - begun
        if result > gcode.MIN_ERROR:
            raise driver.Failure(f"the preview ends in line {line}: {gcode.strerror(result)}")
        canon.calc_extents()
        return canon, seconds

    def preview(self, name, program, with_frames=True):
        """Keeps the moves of a preview as [kind, line, start, end, tool], in machine units."""
        canon, _ = self.load(program, with_frames)
        unit = MM_PER_INCH * self.status.linear_units

        def scaled(place):
            return [value * unit for value in place[:3]] + list(place[3:])

        moves = [[kind, line, scaled(start), scaled(end), scaled(tool)] for kind, line, start, end, tool in canon.kept_moves]
        self.answers[name] = {"moves": moves, "frames": [[[*row[:3], row[3] * unit] for row in axes]
                                                         for axes in getattr(canon, "frames_seen", ())]}

    def time_previews(self, name, program, times):
        """Keeps the seconds of previews without and with the hook, in turn."""
        self.answers[name] = [[self.load(program, with_frames)[1] for with_frames in (False, True)] for _ in range(times)]


if __name__ == "__main__":
    keep_moves()
    sys.exit(driver.main(Viewer))
