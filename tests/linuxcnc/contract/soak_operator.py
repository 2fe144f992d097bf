#!/usr/bin/python3
"""Stands where the screen stands: runs random programs, and interferes as an operator does, until the time is over."""

import random
import sys
import time

import hal
import linuxcnc

from driver import ERRORS, Failure, main, write_result
from operate import RowOperator
from random_program import RandomProgram
from row import PERIOD
from soak_checks import ALL, INTERRUPTED, JOGGING, PROGRAM

#: Said by LinuxCNC's interpreter at the end of a program that was stepped, also with its own planner; and by ours where
#: a reverse run is asked for without a move behind, or behind a thread or an indexer, or a turn in motion. A running program
#: keeps its mode.
EXPECTED = ("Can't switch mode while mode is AUTO", "File ended with no percent sign",
            "Must be in MDI mode to issue MDI command", "blendtp: there is no way back from here",
            "blendtp: the run is not turned, since the machine moves")
#: Seconds of servo periods that the machine has for coming to rest, and a program for its end once nothing interferes.
REST, END = 4.0, 90.0
#: The same for task to hear of a command on a busy computer.
HEARD = 60.0


class SoakOperator(RowOperator):
    def soak(self, seed, seconds):
        self.source = random.Random(seed)
        self.answers.update(programs=0, completed=0, aborted=0, actions=0, reversed=0, turned=0, no_way_back=0, log=[])
        self.recover()
        limit = time.monotonic() + seconds
        while time.monotonic() < limit:
            program = RandomProgram(self.source, self.place())
            self.actions: list[list] = []
            self.answers["programs"] += 1
            self.answers["log"].append({"program": program.lines, "actions": self.actions})
            write_result(self, "LinuxCNC did not answer any more")
            self.one_program(program)
        self.component["row"] = INTERRUPTED

    def did(self, *action):
        self.answers["actions"] += 1
        self.actions.append([round(time.monotonic() - self.began, 3), *action])

    def without_errors(self):
        self.poll()
        for kind, text in self.messages:
            if kind in ERRORS and not text.startswith(EXPECTED):
                raise Failure(f"LinuxCNC says: {text}")
        del self.messages[:]

    def one_program(self, program):
        self.component["row"] = PROGRAM + self.answers["programs"]
        self.began = time.monotonic()
        self.backwards = False
        stepping = self.source.random() < 0.1
        self.open(self.write(program.lines))
        if stepping:
            self.did("step")
            self.step()
        else:
            # a short program may be over before its start is seen
            self.cycle_start()
        self.wait_for("the command", self.was_heard)
        ended = self.interfere(stepping)
        if ended == "aborted":
            self.answers["aborted"] += 1
            self.idle()
        else:
            self.undo()
            self.at_the_end(END)
            self.without_errors()
            off = max(abs(a - b) for a, b in zip(self.place(), program.place, strict=True))
            if off > 1e-5:
                at = self.place()
                self.sleep(1.0)
                raise Failure(f"the program ends at {at} instead of {program.place}; a second later at {self.place()}, "
                              f"interpreter {self.status.interp_state}, queue {self.status.queue}, line "
                              f"{self.status.read_line} read, {self.status.motion_line} in motion")
            self.answers["completed"] += 1
            self.component["row"] = ALL
        self.without_errors()
        if self.source.random() < 0.25:
            self.jog_somewhere()
        if max(abs(value) for value in self.place()) > 150 or self.source.random() < 0.1:
            self.recover()

    def at_the_end(self, patience):
        """Waits until nothing is left to do, for some time: on a loaded machine the status comes late."""
        since = self.period()
        limit = since + round(patience / PERIOD)
        while self.period() - since < round(0.25 / PERIOD):
            self.sleep(0.02)
            if not (self.status.interp_state == linuxcnc.INTERP_IDLE and self.status.inpos and self.status.queue == 0):
                since = self.period()
            if self.period() > limit:
                raise Failure(f"no end after {patience} s: interpreter {self.status.interp_state}, in position "
                              f"{self.status.inpos}, queue {self.status.queue}, paused {self.status.paused}")

    def undo(self):
        """Takes back whatever holds or slows the machine."""
        for name, value in self.changed.items():
            hal.set_p(name, str(value))
        self.changed = {}
        self.command.feedrate(1.0)
        self.command.rapidrate(1.0)
        self.command.maxvel(100.0)
        if self.backwards:
            self.turn(False)
        limit = self.period() + round(HEARD / PERIOD)
        # a step that is under way has to end before the program can go on
        while True:
            self.poll()
            # LinuxCNC's task goes on with a program that was aborted if it is resumed with an idle interpreter
            if self.status.interp_state == linuxcnc.INTERP_IDLE or not (self.status.paused or self.status.task_paused):
                return
            self.command.auto(linuxcnc.AUTO_RESUME)
            self.sleep(0.05)
            if self.period() > limit:
                raise Failure("a pause does not end")

    def turn(self, backwards):
        """Has a paused program run backwards, or forward again: at rest, as LinuxCNC wants it."""
        self.pause()
        self.stopped()
        self.without_errors()
        if self.status.interp_state == linuxcnc.INTERP_IDLE:
            return
        self.did("reverse" if backwards else "forward")
        self.ask_for(backwards)
        if backwards and not self.backwards:
            self.answers["no_way_back"] += 1
        elif self.backwards and not backwards:
            raise Failure(f"does not turn forward again, queue {self.status.queue}")

    def ask_for(self, backwards):
        """Gives the command for a direction, and keeps the direction that came of it."""
        (self.reverse if backwards else self.forward)()
        self.wait_for("the command", self.was_heard)
        self.sleep(0.05)
        before, self.backwards = self.backwards, bool(self.get("motion.tp-reverse"))
        if self.backwards != before:
            self.answers["reversed" if self.backwards else "turned"] += 1

    def interfere(self, stepping):
        """Random actions, for some time or until the program has ended."""
        source, paused = self.source, stepping
        limit = time.monotonic() + source.uniform(0.2, 6)
        while time.monotonic() < limit:
            self.sleep(source.choice((0.003, 0.02, 0.1, 0.3)) * source.uniform(0.3, 2))
            if self.status.interp_state == linuxcnc.INTERP_IDLE and self.status.inpos:
                return "ended"
            action = source.choices(("pause", "step", "feed", "rapid", "slider", "hold", "adaptive", "limits", "turn",
                                     "turn in motion", "mode", "abort", "off", "nothing"),
                                    (3, 2, 3, 1, 1, 1, 1, 0.5, 1.5, 0.3, 0.4, 0.7, 0.2, 4))[0]
            if action == "pause":
                paused = not paused
                self.did("pause" if paused else "resume")
                if paused:
                    self.pause()
                else:
                    self.resume()
            elif action == "step" and paused:
                self.did("step")
                self.step()
            elif action == "feed":
                scale = source.choice((0, 0.05, 0.3, 0.8, 1, 1.2, 2))
                self.did("feed override", scale)
                self.feed_override(scale)
            elif action == "rapid":
                scale = source.choice((0.02, 0.5, 1))
                self.did("rapid override", scale)
                self.rapid_override(scale)
            elif action == "slider":
                velocity = source.choice((2, 20, 60, 100))
                self.did("slider", velocity)
                self.max_velocity(velocity)
            elif action == "hold":
                name, value = source.choice(("motion.feed-hold", "motion.feed-inhibit")), source.choice((0, 1))
                self.did(name, value)
                self.pin(name, value)
            elif action == "adaptive":
                scale = source.choice((0, 0.2, 0.7, 1))
                self.did("adaptive feed", scale)
                self.pin("motion.adaptive-feed", scale)
            elif action == "limits":
                axis = source.choice("xyz")
                self.did("limits", axis)
                self.pin(f"ini.{axis}.max_velocity", source.choice((30, 70, 90)))
                self.pin(f"ini.{axis}.max_acceleration", source.choice((300, 700, 900)))
            elif action == "turn":
                self.turn(not self.backwards)
                paused = paused and source.random() < 0.3
                if not paused:
                    self.did("resume")
                    self.resume()
                if self.backwards:
                    self.sleep(source.uniform(0, 0.8))
            elif action == "turn in motion":
                # is refused unless the machine stands
                self.did(action)
                self.ask_for(not self.backwards)
            elif action == "mode":
                # is refused unless the program is over
                name, mode = source.choice((("manual", linuxcnc.MODE_MANUAL), ("mdi", linuxcnc.MODE_MDI)))
                self.did("mode", name)
                self.command.mode(mode)
                self.wait_for("the command", self.was_heard)
                self.sleep(0.02)
                if self.status.task_mode != linuxcnc.MODE_AUTO:
                    if self.status.interp_state != linuxcnc.INTERP_IDLE:
                        raise Failure(f"mode {name} while a program runs")
                    self.mode(linuxcnc.MODE_AUTO)
                    return "ended"
            elif action == "abort":
                self.did("abort")
                self.abort()
                return "aborted"
            elif action == "off":
                self.did("off")
                self.component["row"] = INTERRUPTED
                source.choice((self.machine_off, self.estop))()
                self.sleep(0.05)
                self.on()
                return "aborted"
        return "over"

    def idle(self):
        """After an abort: at rest, with an idle interpreter, whatever held the machine."""
        self.at_the_end(REST)
        self.stopped()
        self.backwards = bool(self.get("motion.tp-reverse"))
        if self.backwards:
            raise Failure("an abort leaves the machine running backwards")
        self.undo()
        if self.component["row"] >= PROGRAM:
            self.component["row"] = ALL
        if self.source.random() < 0.5:
            mode = self.source.choice(("manual", "mdi", "auto"))
            self.did("mode", mode)
            self.switch_mode(mode)
        if self.component["row"] == INTERRUPTED or self.source.random() < 0.3:
            self.recover()
        else:
            # what the program left behind must not decide the next one
            self.say("o<settings> call")

    def jog_somewhere(self):
        axis, way = self.source.choice((0, 1, 2)), self.source.uniform(1, 8)
        # towards the middle
        way = -way if self.place()[axis] > 0 else way
        self.did("jog", axis, way)
        self.component["row"] = JOGGING
        self.jog_along(axis, self.source.uniform(10, 80), way)
        self.stopped()


if __name__ == "__main__":
    sys.exit(main(SoakOperator))
