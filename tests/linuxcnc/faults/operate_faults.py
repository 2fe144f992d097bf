#!/usr/bin/python3
"""Stands where the screen stands, and does to LinuxCNC what must not harm it."""

import contextlib
import os
import random
import signal
import sys
import time

import hal
import linuxcnc

from driver import ERRORS, Failure, Operator, main, send, write_result

#: What the processes are called on their command lines.
PROCESSES = {"task": "milltask", "io": "io", "frame_guard": "frame_guard.py", "GUI": "operate_faults.py"}
#: Seconds of servo periods that the machine has for coming to rest.
REST = 4.0
#: The same for task, which may come late to all of it on a busy computer.
TASK = 60.0
#: Servo periods without motion that are a rest.
QUIET = 300


def processes(name):
    """The ids of a process by its name here: a LinuxCNC of a test has process ids of its own."""
    wanted, found = PROCESSES[name], []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/cmdline", "rb") as file:
                words = file.read().decode(errors="replace").split("\0")
        except OSError:
            continue
        if any(os.path.basename(word) == wanted for word in words[:3]) and int(entry) != 1:
            found.append(int(entry))
    if not found:
        raise Failure(f"{name} does not run")
    return found


def held():
    """Whether framekins, where it is loaded, holds the machine."""
    return hal.component_exists("framekins") and hal.get_value("framekins.hold")


class FaultOperator(Operator):
    def __init__(self):
        super().__init__()
        # pins can only be read by a component
        self.component = hal.component("operator")
        self.component.ready()

    def kill(self, name):
        if name == "GUI":
            # nobody is left to do it afterwards
            self.poll()
            write_result(self, None)
        for process in processes(name):
            # that of the heartbeat ends with frame_guard
            with contextlib.suppress(FileNotFoundError, ProcessLookupError):
                send(process, signal.SIGKILL)

    def suspend(self, name, seconds):
        """Stops a process for a while. A process of its own lets it go on: the GUI stops itself."""
        found = processes(name)
        if os.fork() == 0:
            time.sleep(0.05)
            for way, pause in ((signal.SIGSTOP, seconds), (signal.SIGCONT, 0)):
                for process in found:
                    send(process, way)
                time.sleep(pause)
            os._exit(0)
        time.sleep(0.1)

    def wait_for_rest(self, name="rest", seconds=30):
        """Keeps how long it took until no joint moved any more, s, and where it is then. On a busy computer periods come late
        and then in a hurry: the time is the shorter one of theirs and the clock's, as the guard is listened for."""
        pins = [f"joint.{joint}.motor-pos-cmd" for joint in range(self.status.joints)]
        began = hal.get_value("threadtest.0.count")
        clock = time.monotonic()
        last, since, took = None, began, 0.0
        while True:
            now, period = [hal.get_value(pin) for pin in pins], hal.get_value("threadtest.0.count")
            if now != last:
                last, since, took = now, period, time.monotonic() - clock
            elif period - since > QUIET:
                break
            if period - began > seconds * 1000:
                raise Failure(f"the machine does not come to rest in {seconds} s")
            self.after_periods(5)
        self.answers[name] = {"seconds": min((since - began) / 1000, took), "joints": last}

    def refused_mdi(self, text):
        """A line of MDI that must not move a joint."""
        pins = [f"joint.{joint}.motor-pos-cmd" for joint in range(self.status.joints)]
        before = [hal.get_value(pin) for pin in pins]
        self.command.mode(linuxcnc.MODE_MDI)
        self.command.wait_complete(2)
        self.command.mdi(text)
        self.after_periods(1500)
        after = [hal.get_value(pin) for pin in pins]
        self.answers["moved"] = max(abs(a - b) for a, b in zip(before, after, strict=True))

    def aborts(self, names, count, seed, folder):
        """Starts programs and aborts each at a random moment; where it rests then is kept as [name, from, rest]."""
        source, stops = random.Random(seed), self.answers.setdefault("stops", [])
        for number in range(count):
            name = source.choice(names)
            self.poll()
            begin = list(self.status.joint_position[:self.status.joints])
            # wherever in a program: moves of the first milliseconds, and of the last
            self.open(f"{folder}/{name}.ngc")
            self.command.auto(linuxcnc.AUTO_RUN, 0)
            self.wait_for("the program to start", self.was_heard)
            self.after_periods(source.randrange(1, 1500))
            self.abort()
            self.at_rest(f"abort {number}, of {name}")
            stops.append([name, begin, list(self.status.joint_position[:self.status.joints])])
            if number % 50 == 49:
                self.run(f"{folder}/trial.ngc")
                self.note("trial")
        errors = [text for kind, text in self.messages if kind in ERRORS]
        if errors:
            raise Failure(f"LinuxCNC says: {errors[0]}")

    def after_periods(self, count):
        """Waits by servo periods: a loaded computer runs late."""
        end = hal.get_value("threadtest.0.count") + count
        while hal.get_value("threadtest.0.count") < end:
            time.sleep(0.001)

    def at_rest(self, what):
        begin = hal.get_value("threadtest.0.count")
        still, last = 0, None
        while still < 20:
            self.after_periods(2)
            self.poll()
            now = self.status.joint_position
            idle = self.status.interp_state == linuxcnc.INTERP_IDLE and self.status.inpos and not self.status.queue
            # a command that comes while a frame is removed is refused
            stands = now == last
            still = still + 1 if idle and stands and not held() else 0
            last = now
            if hal.get_value("threadtest.0.count") > begin + round((TASK if stands else REST) * 1000):
                raise Failure(f"{what}: no rest, interpreter {self.status.interp_state}, queue {self.status.queue}")

    def off_and_on(self, times, folder, name, seed):
        """Turns the machine off in the middle of a program, and on again."""
        source = random.Random(seed)
        for number in range(times):
            self.start(f"{folder}/{name}.ngc")
            self.sleep(source.uniform(0.2, 1.2))
            source.choice((self.machine_off, self.estop))()
            self.sleep(0.2)
            self.on()
            self.run(f"{folder}/trial.ngc")
            self.note(f"trial {number}")


if __name__ == "__main__":
    sys.exit(main(FaultOperator))
