"""Ten programs, five of them LinuxCNC's own, and how they are run and recorded in one real LinuxCNC.

They run one after the other; between them the machine goes back to where each begins. Along with the positions it is
recorded in which cycle each move reached the planner (arrivals.c).
"""

import math
import os
import re
import tempfile

import harness

NCFILES = "/usr/share/linuxcnc/ncfiles"
AXES = "xyz"
#: how often a program is run whose moves came late
ATTEMPTS = 3
#: cycles by which moves may come later than one in each cycle, as a plan has them, and change the time of no program: where
#: the computer is busy the densest of them takes .3 % longer with moves that come by fives, and 4 % with twenty at a time
PROMPT = 1
#: decimals of a recorded position, mm
DIGITS = 12
HEAD = "G21 G17 G90 G94 G54 G40 G49"


def sample(name, lines, feed):
    """The first lines of one of LinuxCNC's programs, faster: it is run in real time."""
    with open(os.path.join(NCFILES, name + ".ngc"), encoding="latin-1") as file:
        text = [next(file, "").rstrip() for _ in range(lines)]
    # stops and tool changes ask the operator
    stop = r"(?i)\bM0\b|M6\b|\bM2\b|\bM30\b|%"
    kept = [re.sub(r"\([^)]*\)?", "", line) for line in text if not re.search(stop, line)]
    # an F in a name is none
    faster = [re.sub(r"(?i)(?<![a-z_<#])F\s*(\[[^]]*\]|#<\w+>|[\d.]+)", f"F{feed}", line) for line in kept]
    return [*faster, "M5 M9"]


def program(*lines):
    return "\n".join(["G61.1", HEAD, *lines, "M2"]) + "\n"


def lines(points):
    return ["G1 " + " ".join(f"{axis.upper()}{place:.6f}" for axis, place in zip(AXES, point, strict=True)) for point in points]


def curve(count, step):
    return [(20 * math.sin(step * n / 20), 12 * (1 - math.cos(step * n / 9)), 2 * math.sin(step * n / 5))
            for n in range(1, count + 1)]


PROGRAMS = {
    "3D_Chips": program(*sample("3D_Chips", 120, 6000)),
    "tort": program("F3000", *sample("tort", 20, 5000)),
    "arcspiral": program(*sample("arcspiral", 60, 220)),
    "cds": program(*sample("cds", 22, 220)),
    "spiral": program(*(line.replace("800", "50") for line in sample("spiral", 13, 220))),
    "stops": program("F4000", "G1 X30 Y5", "X10 Y20 Z-4", "G0 X40", "G2 X20 Y0 I-20 J0", "G1 X1 Y0 Z0"),
    "corners": program("G64 P0.05 F5000", *lines([(8 * n, 12 * (n % 2), 0) for n in range(1, 13)])),
    "dense": program("G64 P0.01 Q0 F4000", *lines(curve(1300, 0.2))),
    "merged": program("G64 P0.03 Q0.02 F4000", *lines(curve(300, 0.25))),
    "modes": program("G64 P0.1 F3000", "G1 X20 Y5", "G3 X30 Y15 J10", "G61", "G1 X40 Y15 Z3", "G18 G2 X50 Z3 I5",
                     "G17 G64", "G1 X60 Y20", "X50 Y30", "G0 X0 Y0 Z0", "G20", "G1 F100 X0.5", "G21"),
}


def motion(positions):
    """The first and the last cycle in which anything moves by what the recording shows."""
    shown = [tuple(round(place, DIGITS) for place in position) for position in positions]
    changes = [n for n in range(1, len(shown)) if shown[n] != shown[n - 1]]
    return changes[0], changes[-1]


class Recording:
    """A program as it ran, from the servo cycle in which its first move came."""

    def __init__(self, result, number, axes=AXES):
        rows = result.columns("program", "moves", "scale", *(f"axis.{axis}" for axis in axes))
        rows = [row[1:] for row in rows if row[0] == number]
        before = rows[0][0]
        start = [tuple(row[2:]) for row in rows if row[0] == before][-1]
        rows = [row for row in rows if row[0] > before]
        #: moves that have come, and what all feeds are multiplied by
        self.supply = [(moves - before, scale / 1e6) for moves, scale, *_ in rows]
        self.positions = [tuple(row[2:]) for row in rows]
        # a planner may move in the very cycle in which the first move came
        first, last = motion([start, *self.positions])
        self.cycles = last - first + 1
        #: the last cycle in which anything moves
        self.end = last - 1

    def arrivals(self):
        """What --arrivals reads."""
        changes = [n for n in range(len(self.supply)) if n == 0 or self.supply[n] != self.supply[n - 1]]
        return "".join(f"{n} {self.supply[n][0]} {self.supply[n][1]:g}\n" for n in changes)

    def late(self):
        """By how many cycles a move came later, at most, than if one had come in each cycle."""
        come = [moves for moves, _ in self.supply]
        return max(min(cycle, come[-1]) - moves for cycle, moves in enumerate(come, 1))


def record(names, programs=None, axes=AXES, **machine):
    """{name: Recording} of programs, these ten unless others are given, from one LinuxCNC.

    machine: what differs from the sample (ini, configuration; harness.run).
    """
    programs = programs or PROGRAMS
    steps = [["mdi", "G0 X1"]]
    home = " ".join(f"{axis.upper()}0" for axis in axes)
    for number, name in enumerate(names, 1):
        steps += [["mdi", f"G61.1 G21 G90 G54 G53 G0 {home}"], ["halcmd", "sets", "record-program", str(number)],
                  ["run", f"PROGRAMS/{name}.ngc"], ["halcmd", "sets", "record-program", "0"]]
    with tempfile.TemporaryDirectory() as modules:
        # shows when a move reaches the planner
        harness.modules_with("arrivals", modules)
        result = harness.run(steps, {f"{name}.ngc": programs[name] for name in names}, modules=modules,
                             hal="loadrt arrivals\naddf arrivals servo-thread\n" + machine.pop("hal", ""),
                             integers={"moves": "arrivals.moves", "scale": "arrivals.scale", "program": ""},
                             axes=axes, **machine)
    if result.failure or result.errors:
        raise AssertionError(f"{result.failure} {result.errors}\n{result.log}")
    return {name: Recording(result, number, axes) for number, name in enumerate(names, 1)}
