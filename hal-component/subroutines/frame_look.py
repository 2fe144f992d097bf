"""LinuxCNC's state and the frame's at one moment, as frame_guard sees them."""

import math

import linuxcnc

from frame_offsets import SAME, Offsets

#: pins of the guard that say which frame is in force, and by which command
FRAME = ("active", "operations", "acknowledged", "tool-length-matters", "work-offset.x", "work-offset.y", "work-offset.z",
         "work-offset.rotation", "frame-tool-offset.x", "frame-tool-offset.y", "frame-tool-offset.z")


class Look:
    """One look."""

    def __init__(self, status, pins):
        """pins: the guard's own, WATCHED in frame_guard.py."""
        before = of_frame(pins)
        status.poll()
        frame = of_frame(pins)
        #: the status and the frame are of one moment: framekins has taken no command between the two
        self.steady = frame == before
        self.on = status.task_state == linuxcnc.STATE_ON
        self.mode = status.task_mode
        self.auto = status.task_mode == linuxcnc.MODE_AUTO
        self.interpreter = status.interp_state
        self.idle = status.interp_state == linuxcnc.INTERP_IDLE
        #: changes with each command to LinuxCNC
        self.serial = status.echo_serial_number
        #: the line of the program that was read last, 0 behind its end and before its first
        self.line = status.read_line
        self.teleop = status.motion_mode == linuxcnc.TRAJ_MODE_TELEOP
        # a jog in teleop is in position all the while
        jogging = self.teleop and any(axis["velocity"] for axis in status.axis)
        self.moving = not status.inpos or status.queue > 0 or jogging
        self.coordinated = status.motion_mode == linuxcnc.TRAJ_MODE_COORD
        self.non_modal = status.gcodes[2]
        #: a move has begun: while one waits, the codes in force may be those of the one before
        self.under_way = status.current_vel != 0
        self.motion_type = status.motion_type
        # what is left of the move: nothing at all before it begins
        to_go = [abs(way) > SAME for way in status.dtg]
        #: it is not one of rotary axes alone, which neither the work offset nor a frame leads elsewhere
        self.runs = any(to_go[:3] + to_go[6:])
        self.tool_offset = tuple(status.tool_offset[:3])
        # G92 turns with the work offset; the same sum as in frame_send.ngc, of X Y Z
        turned = turn(status.rotation_xy, status.g92_offset)
        self.work_offset = (*(a + b for a, b in zip(status.g5x_offset[:3], turned, strict=True)), status.rotation_xy)
        self.active = frame["active"]
        #: a frame is taken off for a while, and a command would bring it back
        self.suspended = not self.active and frame["operations"] > 0
        self.has_frame = self.active or self.suspended
        #: framekins holds the machine for what has changed on its pins
        self.pending = pins["parameters-pending"]
        self.command = pins["command"]
        self.acknowledged = frame["acknowledged"]
        #: how often framekins has removed a frame by itself
        self.releases = pins["releases"]
        self.offsets = Offsets(status)
        #: what the frame in force was made with
        self.offset_made = tuple(frame[f"work-offset.{k}"] for k in ("x", "y", "z", "rotation"))
        self.tool_made = tuple(frame[f"frame-tool-offset.{k}"] for k in "xyz")
        self.tool_length_matters = frame["tool-length-matters"]


def of_frame(pins):
    """What framekins tells of its frame now."""
    return {name: pins[name] for name in FRAME}


def turn(degrees, offset):
    """X Y Z turned about Z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c * offset[0] - s * offset[1], s * offset[0] + c * offset[1], offset[2]
