"""Switches frames at random on a running machine, by the pins of framekins: switcher.py SEED SWITCHES [table]

Ends without a frame. Prints how many commands took effect and how many were refused; the exit code is 1 if a command
was not answered, or a joint's command is not what it was.
"""

import math
import random
import sys
import time

import hal

#: s that an answer may take: some servo periods, which may come late where other tests have the processors
ANSWER_TIME = 60.0

TABLE = ["x-rot-point", "y-rot-point", "z-rot-point", "y-offset", "z-offset", "tool-offset"]


#: what a command's check is summed over, each times the root of a prime
CHECKED = {"command": 2, "value.1": 3, "value.2": 5, "value.3": 7, "work-offset.x": 11, "work-offset.y": 13,
           "work-offset.z": 17, "work-offset.rotation": 19}


class Switcher:
    def __init__(self, seed, table):
        self.random = random.Random(seed)
        self.table = table
        self.joints = [f"joint.{n}.pos-cmd" for n in range(5 if table else 3)]
        self.start = self.positions()
        self.number = int(hal.get_value("framekins.acknowledged"))

    def positions(self):
        return [hal.get_value(name) for name in self.joints]

    def set(self, pin, value):
        hal.set_p(f"framekins.{pin}", str(value))

    def send(self, code, values):
        """Hands over a command; returns why it was refused, 0 if it was not."""
        self.number = self.number % 99999 + 1
        for n, value in enumerate(values):
            self.set(f"value.{n + 1}", value)
        command = self.number * 1000 + code
        sent = {pin: command if pin == "command" else hal.get_value(f"framekins.{pin}") for pin in CHECKED}
        self.set("check", repr(math.fsum(math.sqrt(CHECKED[pin]) * value for pin, value in sent.items())))
        self.set("command", command)
        limit = time.monotonic() + ANSWER_TIME
        while hal.get_value("framekins.acknowledged") != self.number:
            if time.monotonic() > limit:
                raise TimeoutError(f"command {code} was not answered")
            time.sleep(0.0001)
        return hal.get_value("framekins.refusal")

    def anything(self):
        """A code with values: most of them make a frame, some do not."""
        r = self.random
        kind = r.choice([1, 2, 3, 4, 5, 6, 7, 8, 11, 12])
        if kind == 1:
            values = [r.uniform(-200, 200) for _ in range(3)]
        elif kind == 3:
            values = [r.uniform(-360, 360), r.randrange(3), 0]
        elif kind in (4, 5, 6):
            values = [r.uniform(-80, 80), r.uniform(-80, 80), r.randrange(2)]
        elif kind == 7:
            values = [r.choice([-1, 1]) * r.uniform(0.5, 2) for _ in range(3)]
        elif kind == 8:
            values = [r.randrange(2) for _ in range(3)]
        else:
            values = [r.uniform(-180, 180) for _ in range(3)]
        if kind == 12:
            for name in ("xx", "xy", "xz", "x", "yx", "yy", "yz", "y", "zx", "zy", "zz", "z"):
                self.set(f"map.{name}", r.uniform(-2, 2))
        return kind + (100 if kind < 9 and r.random() < 0.5 else 0), values

    def surroundings(self):
        """Work offset, tool, mirrored axes and the table: all of them are taken over at a switch."""
        r = self.random
        for axis in "xyz":
            self.set(f"work-offset.{axis}", r.uniform(-300, 300))
            self.set(f"tool-offset.{axis}", r.uniform(-100, 100))
        self.set("work-offset.rotation", r.uniform(-180, 180))
        for axis in "abcuvw":
            self.set(f"mirror.{axis}", r.randrange(2))
        if self.table:
            for pin in TABLE:
                self.set(pin, r.uniform(-200, 200))
            self.set("conventional-directions", r.randrange(2))
            self.set("tool-centre-point", r.randrange(2))

    def step(self):
        self.surroundings()
        return self.send(*self.anything())


def main():
    # reading pins takes a component
    component = hal.component("switcher")
    component.ready()
    switcher = Switcher(sys.argv[1], "table" in sys.argv[3:])
    made = refused = 0
    worst = 0.0
    while made < int(sys.argv[2]):
        if switcher.step():
            refused += 1
        else:
            made += 1
        worst = max(worst, *(abs(a - b) for a, b in zip(switcher.positions(), switcher.start, strict=True)))
    if switcher.table:
        switcher.set("tool-centre-point", 0)
    if switcher.send(9, [0, 0, 0]) != 0:
        raise RuntimeError("the frame could not be removed")
    print(f"switcher: {made} took effect, {refused} were refused, joints moved by {worst:.3g}", flush=True)
    return 1 if worst > 1e-9 else 0


if __name__ == "__main__":
    sys.exit(main())
