#!/usr/bin/python3
"""frame_guard: the HAL component that looks after programmable frames while LinuxCNC runs.

    loadusr -Wn frame-guard ./frame_guard.py

Reads the settings (frame_settings.py) and does not come up if one is wrong, so that LinuxCNC does not start. Then it

- shows the settings as pins, for the subroutines;
- has framekins remove the frame at the start and end of programs, as the settings say, leaves teleop mode where that
  keeps a frame, and makes the interpreter read its position anew afterwards;
- lives visibly (frame_heart.py): without it framekins stops the machine and takes no frame;
- stops moves that LinuxCNC would run through the frame although they are not meant so, and those that framekins would hold
  for ever.

The README beside this file tells what an operator sees of it.
"""

import os
import signal
import sys
import time

import hal
import linuxcnc

from frame_gone import GIVE_AGAIN, REMOVED, Overwritten, outputs_taken
from frame_heart import Heart
from frame_held import Held
from frame_look import Look
from frame_nets import missing_nets
from frame_offsets import SAME, differ
from frame_settings import Settings, SettingsError
from frame_stays import complaint, late_start, work_offset_changed
from frame_touched import HELD, LEFT, Touched

NAME = "frame-guard"

#: s between two looks at LinuxCNC's status
PERIOD = 0.005

#: non-modal codes whose moves are meant in machine coordinates, ten times the G number
MACHINE_MOVES = {530: "G53", 280: "G28", 300: "G30"}
TOOL_CHANGE_MOTION = 4
#: G38.2 to G38.5, none of which is meant in machine coordinates: the codes in force are those of the move before
PROBING_MOTION = 5

#: s that a frame may stay where it has to go and nothing moves, before the operator is told
PATIENCE = 1.0

#: s that LinuxCNC's task may take beyond three of its cycles until its status is up to date
SETTLING = 0.2

#: What the guard and framekins have for each other: pins of the guard, with framekins' and the kind of both. A look takes
#: only its own pins: those of others are read under HAL's lock, and a guard that is killed while it holds that would stop
#: every other process that wants it.
TOLD = {"release": ("release", hal.HAL_BIT), "releases-seen": ("releases-seen", hal.HAL_S32)}
WATCHED = {"releases": ("releases", hal.HAL_S32), "active": ("guard.active", hal.HAL_BIT),
           "parameters-pending": ("guard.parameters-pending", hal.HAL_BIT), "operations": ("guard.operations", hal.HAL_S32),
           "tool-length-matters": ("guard.tool-length-matters", hal.HAL_BIT),
           **{name: (f"guard.{name}", hal.HAL_FLOAT) for name in (
               "command", "acknowledged", "work-offset.x", "work-offset.y", "work-offset.z", "work-offset.rotation",
               "frame-tool-offset.x", "frame-tool-offset.y", "frame-tool-offset.z")}}


def has_begun(now, last):
    """Whether a program has started between two looks."""
    if last.idle:
        return True
    # a program waits and goes on by itself as well; a start is a command
    goes_on = last.interpreter == linuxcnc.INTERP_WAITING and now.interpreter == linuxcnc.INTERP_READING
    if not goes_on or now.serial == last.serial:
        return False
    # to resume or step may let LinuxCNC read on where it has read all; a start reads from the beginning
    return now.line != last.line or now.line == 0


def is_type_refused():
    """Whether the kinematics of inner= do not have the type that the pin says."""
    return hal.get_value("framekins.inner-refusal") != 0


class Guard:
    """Looks at LinuxCNC again and again, and acts."""

    def __init__(self, settings, pins, heart):
        """pins: release and releases-seen to write, and those of WATCHED to read."""
        self.settings = settings
        self.pins = pins
        self.heart = heart
        self.status = linuxcnc.stat()
        self.command = linuxcnc.command()
        self.last = None
        #: why the frame has to go, None if it may stay
        self.due = None
        #: that of the frame that goes now; None where framekins has removed it before the guard could ask
        self.reason = None
        #: since when the interpreter has been idle behind a program
        self.ended = None
        #: a frame command came since start-up: before that somebody set the pins by hand
        self.commanded = False
        #: an abort has left a frame suspended, and that was told
        self.told_suspended = False
        #: what nobody could be told yet
        self.unsaid = []
        #: the run that is being stopped, so that it is told only once
        self.stopped = False
        self.overwritten = Overwritten(settings.task_cycle)
        #: what was touched off in frames
        self.touched = Touched()
        #: the offsets when the frame had to go, None while it may stay
        self.offsets = None
        #: since when the frame should have gone, None if it need not; and whether that was told
        self.stays_since = None
        self.told = False
        #: when teleop was left for it last
        self.tried = 0.0
        self.status.poll()
        # what the one before has not done is done by whoever switches the machine on again
        pins["releases-seen"] = self.pins["releases"]
        inner = "framekins.inner-type" in {pin["NAME"] for pin in hal.get_info_pins()}
        self.held = Held(SETTLING + 3 * settings.task_cycle, inner)
        #: the HAL file has been looked at
        self.checked = False

    def look(self):
        return Look(self.status, self.pins)

    def check_nets(self):
        """Tells of what the HAL file has forgotten."""
        for text in missing_nets():
            self.tell(text)

    def step(self):
        """One look."""
        now, last = self.look(), self.last or self.look()
        if now.on and not self.checked:
            # now somebody is there to read it
            self.check_nets()
            self.checked = True
        self.speak()
        self.count_programs(now, last)
        self.follow_commands(now, last)
        self.find_due(now, last)
        self.follow_touch_off(now, last)
        if self.due and not now.has_frame:
            self.due = None
        if now.idle and not now.moving:
            self.stopped = False
        if now.has_frame and not now.idle and not self.stopped:
            self.check_run(now, last)
        held = self.held.reason(now.pending and now.moving and not now.idle, time.monotonic(), is_type_refused)
        if held and not self.stopped:
            self.stop(held)
        going = bool(self.due) and now.idle
        unread = now.releases != self.pins["releases-seen"]
        # framekins holds what has started, until it is stopped
        self.pins["release"] = going or (bool(self.due) and self.stopped)
        if not going and not unread:
            self.offsets = self.stays_since = None
            self.told = False
        else:
            self.offsets = self.offsets or now.offsets
        self.reason = self.due
        if going:
            self.remove(now)
        if self.pins["releases"] != self.pins["releases-seen"]:
            self.read_anew()
        later = self.look() if going or unread else now
        # a start that came meanwhile is one for the next look
        self.last = now if now.idle and not later.idle else later

    def count_programs(self, now, last):
        """Counts ends of programs: what subroutines keep for the next block is not for the next program. Only while none runs,
        or a program would see its own beginning."""
        # a short one may come and go between two looks, and leaves the number of the command that started it
        changed = not last.idle or now.serial != last.serial or now.mode != last.mode
        if now.idle and changed and (now.auto or last.auto):
            self.pins["programs-ended"] += 1

    def follow_commands(self, now, last):
        """Whether frames come by commands, and whether a program that runs has written over one."""
        if now.acknowledged != last.acknowledged:
            self.commanded = True
        runs = not now.idle and not last.idle and now.serial == last.serial
        zeroed = now.command == 0 != last.command and last.has_frame and self.settings.clear_on_abort
        self.overwritten.follow(runs, zeroed)

    def follow_touch_off(self, now, last):
        """Tells of offsets that were touched off in a frame when that goes, and stops a program that starts with one, once:
        where the same numbers are touched off again nothing tells of it."""
        if self.commanded and self.touched.follow(now):
            self.tell(LEFT)
        if self.touched.wrong and now.auto and not now.idle and has_begun(now, last) and not self.stopped:
            self.touched.wrong = False
            self.stop(HELD)

    def find_due(self, now, last):
        """Whether the frame has to be removed."""
        setting = self.settings
        if not now.has_frame:
            self.ended = None
            self.told_suspended = False
            return
        # o<frame_abort> sets the command to 0; a program's commands are never 0
        aborted = now.command == 0 and self.commanded
        if setting.clear_on_abort and (aborted or not now.on):
            self.due = "abort"
        self.tell_suspended(now.suspended and aborted and not setting.clear_on_abort)
        if now.idle and last.auto and (not last.idle or not last.has_frame):
            # a program has come to its end; a user interface may have chosen another mode already
            self.ended = time.monotonic()
        elif now.auto and now.idle and not last.auto and setting.clear_at_start:
            # the operator has chosen this mode
            self.due = "start"
        if self.ended is not None and setting.clear_at_end:
            # an abort looks like an end until o<frame_abort> has run
            patience = 0.0 if setting.clear_on_abort else 10 * setting.task_cycle + 0.1
            if aborted and not setting.clear_on_abort:
                self.ended = None
            elif time.monotonic() - self.ended >= patience:
                self.due, self.ended = self.due or "end", None

    def tell_suspended(self, left):
        """Tells once of a frame that an abort has left suspended."""
        if left and not self.told_suspended:
            self.tell("something was aborted while the frame was suspended, and it still is: o<frame_resume> call brings it back, "
                      "o<frame_off> call removes it. G90 may be in force in place of G91")
        self.told_suspended = left

    def check_run(self, now, last):
        """Stops a run that must not go on with this frame."""
        if now.auto and has_begun(now, last) and last.has_frame and last.acknowledged == now.acknowledged and \
                (self.settings.clear_at_start or self.due):
            self.due = self.due or "start"
            self.stop(late_start(now.active, self.stays_since is not None))
            return
        if not now.active or not now.moving or not now.coordinated or not now.steady:
            return
        if now.non_modal in MACHINE_MOVES and now.under_way and now.motion_type != PROBING_MOTION:
            code = MACHINE_MOVES[now.non_modal]
            self.stop(f"{code} would run through the active frame: use o<machine_move> call, or put {code} between "
                      "o<frame_suspend> call and o<frame_resume> call")
        elif now.motion_type == TOOL_CHANGE_MOTION:
            self.stop("the move to the tool change position would run through the active frame: remap M6 to "
                      "frame_tool_change, or call o<frame_suspend> before M6 and o<frame_resume> after it")
        elif not self.commanded:
            return  # a frame set on the pins by hand: what it was made for is not known
        elif now.runs and differ(now.work_offset, now.offset_made):
            self.stop(work_offset_changed(self.due is not None))
        elif now.tool_length_matters and differ(now.tool_offset, now.tool_made):
            self.stop("the tool offset has changed while a frame with a scale or a mirror is active, or one that tilts or "
                      "turns where the tool's length stays along the machine's axes: call o<frame_refresh> behind the change")

    def stop(self, reason):
        self.stopped = True
        self.command.abort()
        self.tell(reason)

    def tell(self, text):
        """Of an error."""
        self.say(self.command.error_msg, text)

    def say(self, send, text):
        """By error_msg or text_msg. LinuxCNC takes neither while the machine is off: it is said when that is on again."""
        self.unsaid.append((send, f"framepath: {text}"))
        self.speak()

    def speak(self):
        """Says what there is to say."""
        while self.unsaid and self.status.task_state == linuxcnc.STATE_ON:
            send, text = self.unsaid.pop(0)
            send(text)

    def wait(self, condition, seconds):
        """Whether the condition came true in time."""
        limit = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > limit:
                return False
            self.heart.get_on()
            time.sleep(0.001)
        return True

    def mode(self, mode):
        """Whether LinuxCNC is in this mode now. Somebody else may choose another one at any moment."""
        self.command.mode(mode)
        return self.wait(lambda: self.look().mode == mode, 0.2)

    def is_last_to_speak(self):
        """Whether nobody has given LinuxCNC a command behind the guard's last one."""
        return self.look().serial == self.command.serial

    def settle(self):
        """Waits until the position without the frame is in task's own status, where the interpreter reads it."""
        self.wait(self.is_up_to_date, SETTLING + 3 * self.settings.task_cycle)

    def is_up_to_date(self):
        """Whether task's status has motion's position of now."""
        self.status.poll()
        return all(abs(self.status.position[axis] - hal.get_value(f"axis.{letter}.pos-cmd")) < SAME
                   for axis, letter in enumerate("xyzabcuvw") if self.status.axis_mask >> axis & 1)

    def is_gone(self):
        """Whether there is no frame any more, nor one that a command would bring back."""
        return not self.pins["active"] and self.pins["operations"] == 0

    def remove(self, before):
        """The frame has to go and no program runs: framekins removes it as soon as motion stands outside of teleop, and forgets
        one that is suspended at once."""
        gone = self.wait(self.is_gone, 0.02)
        if not gone and before.on and before.teleop and not before.moving and self.may_try():
            # a change in teleop would make the joints jump: leave it for a moment, in the mode that the operator has chosen
            self.command.teleop_enable(0)
            gone = self.wait(self.is_gone, 0.2)
            if gone:
                self.read_anew()
            now = self.look()
            if now.mode == linuxcnc.MODE_MANUAL and not now.teleop:
                self.command.teleop_enable(1)
        if gone:
            self.pins["release"] = False
            if self.due == "start":
                self.say(self.command.text_msg, "the frame is removed, programs start without one")
            self.due = None
        elif not before.moving:
            self.complain(complaint())

    def may_try(self):
        """Whether teleop mode is to be left now: where that did not help for a while, only once a second."""
        now = time.monotonic()
        if self.told and now - self.tried < PATIENCE:
            return False
        self.tried = now
        return True

    def complain(self, text):
        """Tells once of what does not get done although nothing is in its way."""
        self.stays_since = self.stays_since or time.monotonic()
        if not self.told and time.monotonic() - self.stays_since > PATIENCE:
            self.told = True
            self.tell(text)

    def read_anew(self):
        """Makes the interpreter read its position without the frame. Until then framekins holds the machine."""
        releases = self.pins["releases"]
        self.settle()
        # held as the machine is, what has begun can wait; an abort may still be on its way to the status
        ended = self.wait(lambda: self.look().idle, SETTLING + 3 * self.settings.task_cycle)
        overwritten = self.overwritten.take(ended)
        why = outputs_taken(self.settings.analog_output) if overwritten else GIVE_AGAIN
        if self.reason in {None, "abort"} and not overwritten:
            self.say(self.command.text_msg, REMOVED)
        if not ended:
            self.stop(why)
            self.wait(lambda: self.look().idle, 1.0)
        elif overwritten:
            self.tell(why)
        now = self.look()
        if now.on and now.auto:
            # to go to AUTO once more reads it, too: in any other mode what somebody gives in MDI meanwhile would be lost by
            # going back
            self.command.mode(linuxcnc.MODE_AUTO)
        else:
            self.command.task_plan_synch()
        ours = self.command.serial
        self.wait(lambda: self.command.wait_complete(0.02) != -1, 1.0)
        if ours != now.serial + 1:
            self.tell_overtaken()
        self.put_offsets_back()
        self.pins["releases-seen"] = releases

    def tell_overtaken(self):
        """Of a command by somebody else that came between the last look and the guard's own: what still runs was planned from
        the position in the frame, and to go to AUTO has ended it."""
        now = self.look()
        if not now.idle:
            self.stop(GIVE_AGAIN)
            self.wait(lambda: self.look().idle, 1.0)
        elif now.auto:
            self.tell(GIVE_AGAIN)

    def put_offsets_back(self):
        """Offsets that were set while the frame had to go belong to positions in it."""
        now, before = self.look(), self.offsets
        if before is None:
            return
        if now.offsets.was_shifted_since(before):
            self.tell("G92 or G52 was set while a frame had to go, from a position in the frame: set it again")
        if now.offsets.was_set_since(before):
            words = before.command(self.status, self.settings.units_per_mm)
            if now.on:
                back = now.mode
                if back == linuxcnc.MODE_MDI or self.mode(linuxcnc.MODE_MDI):
                    self.command.mdi(words)
                    self.wait(lambda: not self.look().offsets.was_set_since(before), 1.0)
                    # unless somebody has given a command meanwhile, which another mode would end
                    if back != linuxcnc.MODE_MDI and self.is_last_to_speak():
                        self.mode(back)
            done = not self.look().offsets.was_set_since(before)
            self.tell("a work offset was set while a frame had to go, from a position in the frame: "
                      + ("it is put back, touch off again" if done else f"give {words} in MDI, then touch off again"))
        self.offsets = self.look().offsets


def make_component(settings):
    """The settings as pins, and those of the guard."""
    component = hal.component(NAME)
    for pin, kind, value in (
            ("analog-output", hal.HAL_S32, settings.analog_output),
            ("units-per-mm", hal.HAL_FLOAT, settings.units_per_mm),
            ("axes", hal.HAL_S32, settings.axes),
            ("tool-change-moves", hal.HAL_BIT, settings.tool_change_moves),
            ("programs-ended", hal.HAL_S32, 0),
            ("type-output", hal.HAL_S32, settings.type_output),
            ("rots-convention", hal.HAL_S32, int(settings.rots_convention == "k2"))):
        component.newpin(pin, kind, hal.HAL_OUT)
        component[pin] = value
    for direction, pins in ((hal.HAL_OUT, TOLD), (hal.HAL_IN, WATCHED)):
        for pin, (_, kind) in pins.items():
            component.newpin(pin, kind, direction)
    return component


def link_to_framekins():
    """Links the pins that the guard and framekins have for each other: no HAL file can forget these. None, or what is
    wrong."""
    for pin, (theirs, kind) in {"heartbeat": ("heartbeat", hal.HAL_U32), **TOLD, **WATCHED}.items():
        signal_name = f"{NAME}-{pin}"
        if signal_name not in {found["NAME"] for found in hal.get_info_signals()}:
            hal.new_sig(signal_name, kind)
        hal.connect(f"{NAME}.{pin}", signal_name)
        if hal.connect(f"framekins.{theirs}", signal_name):
            return f"framekins.{theirs} is linked in a HAL file, and frame_guard links it itself: take that net away"
    return None


def set_up_framekins(settings):
    """Tells framekins of the settings that are its own. None, or what is wrong."""
    pins = {pin["NAME"] for pin in hal.get_info_pins()}
    if "framekins.active" not in pins:
        return ("framekins is not loaded: write [KINS]KINEMATICS = framekins coordinates=..., and load frame_guard "
                "behind it")
    if "framekins.guard.tool-length-matters" not in pins:
        return "the framekins that is installed is older than frame_guard: install both from one version of framepath"
    own = {"release-on-abort": ("CLEAR_ON_ABORT", settings.clear_on_abort)}
    if settings.tool_length == "machine":
        # otherwise the pin is the HAL file's
        own["tool-length-machine"] = ("TOOL_LENGTH = machine", True)
    for pin, (key, value) in own.items():
        try:
            hal.set_p(f"framekins.{pin}", str(int(value)))
        except RuntimeError:
            return f"framekins.{pin} is linked in a HAL file, and [FRAMEPATH]{key} sets it: take that net away"
    return None


def extra_joints():
    """How many joints motion has beside those of the kinematics: only they have this pin."""
    return sum(pin["NAME"].startswith("joint.") and pin["NAME"].endswith(".posthome-cmd") for pin in hal.get_info_pins())


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
    heart = Heart(NAME)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    component = make_component(settings)
    problem = settings.joint_problem(extra_joints()) or set_up_framekins(settings) or link_to_framekins()
    if problem:
        print(f"frame_guard: {problem}", file=sys.stderr)
        return 1
    component.ready()
    guard = None
    while True:
        heart.get_on()
        try:
            guard = guard or Guard(settings, component, heart)
            guard.step()
        except linuxcnc.error:
            pass  # LinuxCNC's task is not up yet, or has ended
        time.sleep(PERIOD)


if __name__ == "__main__":
    sys.exit(main())
