#!/usr/bin/python3
"""frame_guard: the HAL component that looks after programmable frames while LinuxCNC runs.

    loadusr -Wn frame-guard ./frame_guard.py

Reads the settings (frame_settings.py) and does not come up if one is wrong, so that LinuxCNC does not start. Then it

- shows the settings as pins, for the subroutines;
- removes the frame at the start and end of programs, on aborts and resets, as the settings say, and makes the
  interpreter read its position anew afterwards;
- stops moves that LinuxCNC would run through the frame although they are not meant so.

The README beside this file tells what an operator sees of it.
"""

import math
import os
import signal
import sys
import time

import hal
import linuxcnc

from frame_settings import Settings, SettingsError

NAME = "frame-guard"

#: s between two looks at LinuxCNC's status
PERIOD = 0.005

#: codes of framekins.command; what changes lengths makes the tool's length matter
CLEAR = 9
LENGTH_CODES = {7, 8, 107, 108, 12}
FRESH_CODES = {1, 2, 3, 4, 5, 6, 9}
NUMBER_STEP = 1000
LAST_NUMBER = 99999

#: non-modal codes whose moves are meant in machine coordinates, ten times the G number
MACHINE_MOVES = {530: "G53", 280: "G28", 300: "G30"}
TOOL_CHANGE_MOTION = 4

#: offsets that differ by less are equal, machine units or degrees
SAME = 1e-6


class Look:
    """LinuxCNC's state at one moment."""

    def __init__(self, status):
        status.poll()
        self.on = status.task_state == linuxcnc.STATE_ON
        self.mode = status.task_mode
        self.auto = status.task_mode == linuxcnc.MODE_AUTO
        self.interpreter = status.interp_state
        self.idle = status.interp_state == linuxcnc.INTERP_IDLE
        self.moving = not status.inpos or status.queue > 0
        self.teleop = status.motion_mode == linuxcnc.TRAJ_MODE_TELEOP
        self.coordinated = status.motion_mode == linuxcnc.TRAJ_MODE_COORD
        self.non_modal = status.gcodes[2]
        self.motion_type = status.motion_type
        self.tool_offset = tuple(status.tool_offset[:3])
        # G92 turns with the work offset; the same sum as in frame_send.ngc
        turned = turn(status.rotation_xy, status.g92_offset)
        self.work_offset = (*(a + b for a, b in zip(status.g5x_offset, turned)), status.rotation_xy)
        self.active = bool(hal.get_value("framekins.active"))
        self.command = hal.get_value("framekins.command")
        self.acknowledged = hal.get_value("framekins.acknowledged")


def turn(degrees, offset):
    """X Y Z turned about Z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c * offset[0] - s * offset[1], s * offset[0] + c * offset[1], offset[2]


def differ(one, other):
    return any(abs(a - b) > SAME for a, b in zip(one, other))


class Guard:
    """Looks at LinuxCNC again and again, and acts."""

    def __init__(self, settings):
        self.settings = settings
        self.status = linuxcnc.stat()
        self.command = linuxcnc.command()
        self.last = None
        #: why the frame has to go, None if it may stay
        self.due = None
        #: since when the interpreter has been idle behind a program
        self.ended = None
        #: a frame command came since start-up: before that somebody set the pins by hand
        self.commanded = False
        #: the frame changes lengths, so that the tool's length matters
        self.changes_lengths = False
        #: the run that is being stopped, so that it is told only once
        self.stopped = False

    def step(self):
        """One look."""
        now, last = Look(self.status), self.last or Look(self.status)
        self.follow_commands(now, last)
        self.find_due(now, last)
        if self.due and not now.active:
            self.due = None
        if now.idle and not now.moving:
            self.stopped = False
        if now.active and not now.idle and not self.stopped:
            self.check_run(now, last)
        if self.due and self.can_clear(now):
            self.clear(now)
            now = Look(self.status)
        self.last = now

    def follow_commands(self, now, last):
        """Keeps what the frame was made with."""
        if now.acknowledged == last.acknowledged:
            return
        self.commanded = True
        code = int(now.command) % NUMBER_STEP
        missed = now.acknowledged not in (last.acknowledged + 1, 1)
        if code in LENGTH_CODES or missed or self.settings.tool_length == "machine":
            self.changes_lengths = True
        elif code in FRESH_CODES:
            self.changes_lengths = False

    def find_due(self, now, last):
        """Whether the frame has to be removed."""
        setting = self.settings
        if not now.active:
            self.ended = None
            return
        # o<on_abort> sets the command to 0; a program's commands are never 0
        aborted = now.command == 0 and self.commanded
        if setting.clear_on_abort and (aborted or not now.on):
            self.due = "abort"
        if now.auto and now.idle and not (last.auto and last.idle):
            # either a program has come to its end, or the operator has chosen this mode
            if last.auto:
                self.ended = time.monotonic()
            elif setting.clear_at_start:
                self.due = "start"
        if self.ended is not None and setting.clear_at_end:
            # an abort looks like an end until o<on_abort> has run
            patience = 0.0 if setting.clear_on_abort else 10 * setting.task_cycle + 0.1
            if aborted and not setting.clear_on_abort:
                self.ended = None
            elif time.monotonic() - self.ended >= patience:
                self.due, self.ended = "end", None

    def check_run(self, now, last):
        """Stops a run that must not go on with this frame."""
        begun = now.auto and (last.idle or (last.interpreter == linuxcnc.INTERP_WAITING
                                            and now.interpreter == linuxcnc.INTERP_READING))
        if begun and last.active and last.acknowledged == now.acknowledged and \
                (self.settings.clear_at_start or self.due):
            self.due = self.due or "start"
            self.stop("a frame was still active when the program started: it is removed now, "
                      "start the program again")
            return
        if not now.moving or not now.coordinated:
            return
        if now.non_modal in MACHINE_MOVES:
            code = MACHINE_MOVES[now.non_modal]
            self.stop(f"{code} would run through the active frame: use o<machine_move> call, or put {code} between "
                      "o<frame_suspend> call and o<frame_resume> call")
        elif now.motion_type == TOOL_CHANGE_MOTION:
            self.stop("the move to the tool change position would run through the active frame: remap M6 to "
                      "frame_tool_change, or call o<frame_suspend> before M6 and o<frame_resume> after it")
        elif not self.commanded:
            return  # a frame set on the pins by hand: what it was made for is not known
        elif differ(now.work_offset, [hal.get_value(f"framekins.work-offset.{k}")
                                      for k in ("x", "y", "z", "rotation")]):
            self.stop("the work offset has changed while a frame is active: call o<frame_refresh> behind the change")
        elif self.changes_lengths and differ(now.tool_offset, [hal.get_value(f"framekins.frame-tool-offset.{k}")
                                                               for k in ("x", "y", "z")]):
            self.stop("the tool offset has changed while a frame with a scale or a mirror is active: "
                      "call o<frame_refresh> behind the change")

    def stop(self, reason):
        self.stopped = True
        self.command.abort()
        self.tell(reason)

    def tell(self, text):
        self.command.error_msg(f"framepath: {text}")

    def can_clear(self, now):
        # framekins refuses in motion and in teleop: there the frame stays until the operator leaves that mode
        return now.idle and not now.moving and not now.teleop

    def wait(self, condition, seconds):
        """Whether the condition came true in time."""
        limit = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > limit:
                return False
            time.sleep(0.001)
        return True

    def mode(self, mode):
        """Whether LinuxCNC is in this mode now."""
        self.command.mode(mode)
        return self.wait(lambda: Look(self.status).mode == mode, 1.0)

    def clear(self, before):
        """Removes the frame, with the interpreter idle, and has the position read anew.

        In AUTO with the machine on, LinuxCNC accepts nothing but a start; in MDI no program can start meanwhile.
        """
        through_mdi = before.on and before.auto
        if through_mdi and not self.mode(linuxcnc.MODE_MDI):
            return  # a program was faster; check_run finds it
        number = before.acknowledged + 1 if before.acknowledged < LAST_NUMBER else 1
        self.command.set_analog_output(self.settings.analog_output, number * NUMBER_STEP + CLEAR)
        answered = self.wait(lambda: hal.get_value("framekins.acknowledged") == number, 0.5)
        removed = answered and not hal.get_value("framekins.active")
        # the position without the frame has to arrive in task's own status before the interpreter reads it there
        time.sleep(3 * self.settings.task_cycle + 0.005)
        if not Look(self.status).idle:
            self.stop("a command was given while the frame was being removed: give it again")
            self.wait(lambda: Look(self.status).idle, 1.0)
        if through_mdi:
            self.mode(linuxcnc.MODE_AUTO)
        else:
            self.command.task_plan_synch()
            self.command.wait_complete(1.0)
        if removed:
            if self.due == "start":
                self.command.text_msg("framepath: the frame is removed, programs start without one")
            self.due = None


def make_component(settings):
    """The settings as pins."""
    component = hal.component(NAME)
    for pin, kind, value in (
            ("analog-output", hal.HAL_S32, settings.analog_output),
            ("units-per-mm", hal.HAL_FLOAT, settings.units_per_mm),
            ("rots-convention", hal.HAL_S32, int(settings.rots_convention == "k2"))):
        component.newpin(pin, kind, hal.HAL_OUT)
        component[pin] = value
    return component


def set_up_framekins(settings):
    """Tells framekins of the settings that are its own. None, or what is wrong."""
    pins = {pin["NAME"] for pin in hal.get_info_pins()}
    if "framekins.active" not in pins:
        return ("framekins is not loaded: write [KINS]KINEMATICS = framekins coordinates=..., and load frame_guard "
                "behind it")
    machine = settings.tool_length == "machine"
    if "framekins.tool-length-machine" in pins:
        hal.set_p("framekins.tool-length-machine", str(int(machine)))
    elif machine:
        return "[FRAMEPATH]TOOL_LENGTH = machine: the framekins that is installed cannot do that"
    return None


def main():
    path = os.environ.get("INI_FILE_NAME")
    if not path:
        print("frame_guard: INI_FILE_NAME is not set: load it from a HAL file of LinuxCNC", file=sys.stderr)
        return 1
    try:
        settings = Settings(path)
    except (SettingsError, OSError) as error:
        print(f"frame_guard: {error}", file=sys.stderr)
        return 1
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    component = make_component(settings)
    problem = set_up_framekins(settings)
    if problem:
        print(f"frame_guard: {problem}", file=sys.stderr)
        return 1
    component.ready()
    guard = None
    while True:
        try:
            guard = guard or Guard(settings)
            guard.step()
        except linuxcnc.error:
            pass  # LinuxCNC's task is not up yet, or has ended
        time.sleep(PERIOD)


if __name__ == "__main__":
    sys.exit(main())
