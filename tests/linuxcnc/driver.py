#!/usr/bin/python3
"""Stands where the operator's screen stands: LinuxCNC starts it as [DISPLAY]DISPLAY.

It takes the machine out of estop, homes it, carries out the steps of a scenario, and writes what happened as JSON.
A scenario is a list of steps, each a list of a name and its arguments; the names are the methods of Operator below.
"""

import json
import os
import platform
import random
import signal
import subprocess
import sys
import time
import traceback

import linuxcnc

TIMEOUT = float(os.environ.get("FRAMEPATH_TIMEOUT", "120"))

#: kinds of messages that are errors
ERRORS = (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR)
#: Stops of frame_guard after which its heart has to be heard again.
STOPS_BETWEEN_BEATS = 6
#: numbers of the system calls in which a process sleeps: nanosleep, clock_nanosleep, select, pselect6, poll, ppoll
ASLEEP = {"x86_64": ("35", "230", "23", "270", "7", "271"), "aarch64": ("101", "115", "72", "73")}[platform.machine()]


class Failure(Exception):
    """A step that did not do what it was asked to."""


def send(process, way):
    """Sends a process a signal; one that stops or ends it reaches it asleep. LinuxCNC's status has a lock, and who is
    stopped while he holds it leaves task and every screen waiting, whatever our modules do."""
    limit = time.monotonic() + 10
    while way != signal.SIGCONT and process != os.getpid():
        os.kill(process, signal.SIGSTOP)
        while read(f"/proc/{process}/stat").rpartition(")")[2].split()[0] != "T":
            if time.monotonic() > limit:
                raise Failure(f"process {process} does not stop")
        if read(f"/proc/{process}/syscall").split()[0] in ASLEEP:
            break
        os.kill(process, signal.SIGCONT)
        if time.monotonic() > limit:
            raise Failure(f"process {process} is never asleep")
        time.sleep(random.uniform(0.0005, 0.002))
    os.kill(process, way)


def guard_process():
    shown = subprocess.run(["halcmd", "-s", "show", "comp"], check=True, capture_output=True, text=True).stdout
    words = next(line.split() for line in shown.splitlines() if "frame-guard" in line.split())
    return next(int(word) for word in words[words.index("frame-guard") + 1:] if word.isdigit())


def value_of(name):
    """What a pin reads, as text."""
    return subprocess.run(["halcmd", "getp", name], check=True, capture_output=True, text=True).stdout.strip()


def read(path):
    with open(path, encoding="ascii", errors="replace") as file:
        return file.read()


class Operator:
    """What a person does at the screen, one method for each kind of step."""

    def __init__(self):
        self.command = linuxcnc.command()
        self.status = linuxcnc.stat()
        self.errors = linuxcnc.error_channel()
        self.messages = []
        self.answers = {}
        #: how many messages `forget` has put aside
        self.heard = 0

    def poll(self):
        """Reads the status, and keeps every message that LinuxCNC has for the operator."""
        self.status.poll()
        while True:
            message = self.errors.poll()
            if not message:
                return
            kind, text = message
            self.messages.append([kind, text.strip()])

    def wait_for(self, what, condition, timeout=None):
        """Waits until the condition holds; a Failure names `what` if it never does."""
        limit = time.monotonic() + (timeout or TIMEOUT)
        while True:
            self.poll()
            if condition():
                return
            if time.monotonic() > limit:
                raise Failure(f"timed out waiting for {what}")
            time.sleep(0.004)

    def insist(self, what, command, condition):
        """Repeats a command until it took effect: early ones get lost while LinuxCNC's parts come up."""
        limit = time.monotonic() + 30
        while True:
            command()
            self.command.wait_complete(0.2)
            self.poll()
            if condition():
                return
            if time.monotonic() > limit:
                raise Failure(f"timed out: {what}")
            time.sleep(0.02)

    def mode(self, mode):
        self.insist("mode", lambda: self.command.mode(mode), lambda: self.status.task_mode == mode)

    def on(self):
        """Out of estop, and the machine on."""
        self.insist("estop reset", lambda: self.command.state(linuxcnc.STATE_ESTOP_RESET),
                    lambda: self.status.task_state != linuxcnc.STATE_ESTOP)
        self.insist("machine on", lambda: self.command.state(linuxcnc.STATE_ON),
                    lambda: self.status.task_state == linuxcnc.STATE_ON)

    def home(self):
        """Homes all joints and leaves the machine in coordinated motion."""
        self.mode(linuxcnc.MODE_MANUAL)
        self.command.teleop_enable(0)
        self.command.wait_complete()
        self.command.home(-1)
        joints = self.status.joints
        self.wait_for("homing", lambda: all(self.status.homed[:joints]), 30)
        self.command.teleop_enable(1)
        self.command.wait_complete()

    def open(self, program):
        self.mode(linuxcnc.MODE_AUTO)
        self.command.program_open(program)
        self.command.wait_complete()

    def start(self, program, line=0):
        """Opens a program and starts it, without waiting for its end."""
        self.open(program)
        self.command.auto(linuxcnc.AUTO_RUN, line)
        self.wait_for("the program to start", self.was_heard)

    def was_heard(self):
        """Whether the task controller has begun with the last command: from then on the status tells of it. What is
        short may be over when the status is read."""
        return self.status.echo_serial_number >= self.command.serial

    def finish(self, timeout=None):
        """Waits until the interpreter is idle and motion has ended."""
        self.wait_for("the end of the program", lambda: self.status.interp_state == linuxcnc.INTERP_IDLE
                      and self.status.inpos and self.status.queue == 0 and self.joints_stand(), timeout)
        time.sleep(0.05)
        self.poll()

    def joints_stand(self):
        """LinuxCNC interpolates between planner and joints: they stand some periods after motion is in position."""
        return all(abs(joint["velocity"]) < 1e-9 for joint in self.status.joint[:self.status.joints])

    def run(self, program, timeout=None):
        self.start(program)
        self.finish(timeout)

    def mdi(self, text, timeout=None):
        self.mode(linuxcnc.MODE_MDI)
        self.command.mdi(text)
        self.command.wait_complete(timeout or TIMEOUT)
        self.finish(timeout)

    def mdi_start(self, text):
        """Sends a line of MDI and does not wait for its end."""
        self.mode(linuxcnc.MODE_MDI)
        self.command.mdi(text)

    def pause(self):
        self.command.auto(linuxcnc.AUTO_PAUSE)

    def resume(self):
        self.command.auto(linuxcnc.AUTO_RESUME)

    def step(self):
        self.command.auto(linuxcnc.AUTO_STEP)

    def reverse(self):
        self.command.auto(linuxcnc.AUTO_REVERSE)

    def forward(self):
        self.command.auto(linuxcnc.AUTO_FORWARD)

    def abort(self):
        self.command.abort()
        self.command.wait_complete()

    def feed_override(self, scale):
        self.command.feedrate(scale)

    def rapid_override(self, scale):
        self.command.rapidrate(scale)

    def max_velocity(self, velocity):
        self.command.maxvel(velocity)

    def teleop(self, on):
        """World mode (teleop) for jogging, or joint mode."""
        self.mode(linuxcnc.MODE_MANUAL)
        self.command.teleop_enable(1 if on else 0)
        self.wait_for("teleop", lambda: (self.status.motion_mode == linuxcnc.TRAJ_MODE_TELEOP) == bool(on), 5)

    def jog(self, axis, velocity, distance):
        self.command.jog(linuxcnc.JOG_INCREMENT, False, axis, velocity, distance)

    def machine_off(self):
        self.command.state(linuxcnc.STATE_OFF)
        self.command.wait_complete()

    def sleep(self, seconds):
        limit = time.monotonic() + seconds
        while time.monotonic() < limit:
            self.poll()
            time.sleep(0.005)

    def wait_line(self, line, timeout=None):
        """Waits until motion is at this line of the program or behind it."""
        self.wait_for(f"line {line}", lambda: self.status.motion_line >= line, timeout)

    def wait_place(self, joint, place, timeout=None):
        """Waits until a joint is at this place or beyond."""
        self.wait_for(f"joint {joint} at {place}", lambda: self.status.joint_actual_position[joint] >= place, timeout)

    def wait_queue(self, count):
        """Waits until motion's queue has so many moves."""
        self.wait_for(f"{count} moves", lambda: self.status.queue >= count)

    def wait_moving(self):
        self.wait_for("motion", lambda: self.status.current_vel > 0, 10)

    def wait_standing(self):
        self.wait_for("standstill", lambda: self.status.current_vel == 0, 10)

    def setp(self, pin, value):
        subprocess.run(["halcmd", "setp", pin, str(value)], check=True)

    def force(self, pin, value):
        """Takes a pin off its signal and sets it."""
        self.halcmd("unlinkp", pin)
        self.setp(pin, value)

    def halcmd(self, *arguments):
        subprocess.run(["halcmd", *arguments], check=True)

    def halcmd_refuses(self, *arguments):
        if subprocess.run(["halcmd", *arguments], check=False).returncode == 0:
            raise Failure(f"halcmd takes {' '.join(arguments)}")

    def getp(self, name, pin):
        """Keeps the value of a pin under a name of the scenario's choice."""
        self.answers[name] = subprocess.run(["halcmd", "getp", pin], check=True, capture_output=True,
                                            text=True).stdout.strip()

    def note(self, name):
        """Keeps position and state under a name of the scenario's choice."""
        self.poll()
        self.answers[name] = {
            "position": list(self.status.position),
            "joints": list(self.status.joint_position),
            "interp_state": self.status.interp_state,
            "task_state": self.status.task_state,
            "queue": self.status.queue,
            "motion_id": self.status.motion_id,
            "paused": bool(self.status.paused),
            "inpos": bool(self.status.inpos),
            "g5x_offset": list(self.status.g5x_offset),
        }

    def cycle_start(self):
        """Starts the program that is open, whatever the mode is, and waits for nothing."""
        self.command.auto(linuxcnc.AUTO_RUN, 0)

    def start_at_once(self):
        """What a screen does when the operator starts from MDI: mode and start, one behind the other."""
        self.command.mode(linuxcnc.MODE_AUTO)
        self.command.wait_complete()
        self.command.auto(linuxcnc.AUTO_RUN, 0)

    def home_again(self, joint):
        """Homes one joint with whatever frame is active."""
        self.teleop(False)
        self.command.home(joint)
        self.wait_for("homing", lambda: not self.status.joint[joint]["homing"] and self.status.homed[joint], 20)
        self.sleep(0.1)

    def estop(self):
        self.command.state(linuxcnc.STATE_ESTOP)
        self.command.wait_complete()

    def switch_mode(self, name):
        """manual, mdi or auto."""
        self.mode({"manual": linuxcnc.MODE_MANUAL, "mdi": linuxcnc.MODE_MDI, "auto": linuxcnc.MODE_AUTO}[name])

    def jog_along(self, axis, velocity, distance):
        """Jogs one axis of the active frame by a distance in teleop, and waits until it stands."""
        self.teleop(True)
        before = self.status.position[axis]
        self.jog(axis, velocity, distance)
        self.wait_for("the jog", lambda: abs(self.status.position[axis] - before - distance) < 1e-4, 20)
        self.sleep(0.1)

    def run_to_idle(self, program):
        """Runs a program, and returns the moment its interpreter is idle."""
        self.start(program)
        limit = time.monotonic() + TIMEOUT
        while self.status.interp_state != linuxcnc.INTERP_IDLE:
            if time.monotonic() > limit:
                raise Failure("timed out waiting for the end of the program")
            time.sleep(0.0005)
            self.poll()

    def run_as_a_screen(self, program):
        """Runs a program as AXIS does: the moment it has ended, manual mode is asked for."""
        self.run_to_idle(program)
        self.command.mode(linuxcnc.MODE_MANUAL)

    def mdi_behind(self, program, seconds, line):
        """Gives a line of MDI so many seconds behind a program's end, once, and waits until that is over or lost."""
        self.run_to_idle(program)
        time.sleep(seconds)
        self.command.mode(linuxcnc.MODE_MDI)
        self.command.wait_complete()
        self.command.mdi(line)
        self.command.wait_complete(5)
        self.sleep(0.4)
        self.finish()

    def jog_behind(self, program, seconds, axis, velocity, distance):
        """Jogs an axis so many seconds behind a program's end, once."""
        self.run_to_idle(program)
        time.sleep(seconds)
        self.command.mode(linuxcnc.MODE_MANUAL)
        self.command.wait_complete()
        self.command.teleop_enable(1)
        self.command.wait_complete()
        self.jog(axis, velocity, distance)
        self.sleep(0.4)

    def touch_off(self, words):
        """Touch Off as a screen does it: G10 L20 for the work offset in force, and manual mode again."""
        self.mdi(f"G10 L20 P0 {words}")
        self.mode(linuxcnc.MODE_MANUAL)

    def guard(self, name):
        """Sends frame_guard a signal: KILL, STOP, CONT."""
        send(guard_process(), getattr(signal, f"SIG{name}"))

    def stop_guard_often(self, times):
        """Stops frame_guard at any moment; each time HAL has to answer others meanwhile."""
        process = guard_process()
        for number in range(times):
            if number % STOPS_BETWEEN_BEATS == 0:
                # its heart misses the beats in which it stands; where it stands in all of a second, the machine is held
                beat = value_of("framekins.heartbeat")
                self.wait_for("a heartbeat", lambda last=beat: value_of("framekins.heartbeat") != last)
            time.sleep(random.uniform(0, 0.007))
            os.kill(process, signal.SIGSTOP)
            try:
                subprocess.run(["halcmd", "getp", "framekins.active"], check=True, capture_output=True, timeout=1)
            except subprocess.TimeoutExpired as error:
                raise Failure("HAL does not answer while frame_guard is stopped") from error
            finally:
                os.kill(process, signal.SIGCONT)

    def task(self, name):
        """Sends the task controller a signal; here it is the only one."""
        for process in (folder for folder in os.listdir("/proc") if folder.isdigit()):
            with open(f"/proc/{process}/comm", encoding="ascii", errors="replace") as file:
                if file.read().strip() == "milltask":
                    send(int(process), getattr(signal, f"SIG{name}"))

    def expect(self, name, value, timeout=None):
        """Waits until a pin reads as this text."""
        self.wait_for(f"{name} = {value}", lambda: value_of(name) == value, timeout)

    def forget(self):
        """What has been said so far does not count for the next `recall`."""
        self.poll()
        self.heard = len(self.messages)

    def recall(self, name):
        """Keeps the errors since `forget` under a name, and takes them off the errors of the scenario."""
        self.poll()
        self.answers[name] = [text for kind, text in self.messages[self.heard:] if kind in ERRORS]
        self.messages[self.heard:] = [[kind, text] for kind, text in self.messages[self.heard:] if kind not in ERRORS]


def write_result(operator, failure):
    errors = [text for kind, text in operator.messages if kind in ERRORS]
    result = {"failure": failure, "errors": errors, "messages": operator.messages, "answers": operator.answers}
    with open(os.environ["FRAMEPATH_RESULT"], "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)


def main(operator_type=Operator):
    with open(os.environ["FRAMEPATH_SCENARIO"], encoding="utf-8") as file:
        steps = json.load(file)
    operator = operator_type()
    failure = None
    try:
        for name, *arguments in steps:
            getattr(operator, name)(*arguments)
    except Exception as error:  # every failure belongs into the result, whatever it is
        failure = f"step {name} {arguments}: {error}"
        if not isinstance(error, Failure):
            traceback.print_exc()
    # A moment of standstill at the end of the recording.
    operator.sleep(0.1)
    write_result(operator, failure)


if __name__ == "__main__":
    sys.exit(main())
