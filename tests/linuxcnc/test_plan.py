"""`framepath plan` against a real LinuxCNC with blendtp: time, and the position in every servo cycle.

A plan of each of the ten programs (ten_programs.py) with the arrivals that were recorded has to have the same
positions, however busy the computer is; and the plan as users get it, with a move in each cycle, the same time. Where
only the second fails, and moves did come late, the program is run again.
"""

import csv
import json
import math
import os
import re
import subprocess
import tempfile
import unittest
from typing import ClassVar

import pytest

import harness
from ten_programs import ATTEMPTS, AXES, PROGRAMS, PROMPT, motion, program, record

INI = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")
PERIOD = 1e-3
#: mm
SAME = 1e-9


def plan(*arguments, check=True):
    done = subprocess.run([harness.TOOL, "plan", *arguments], capture_output=True, text=True, check=False)
    if check and done.returncode:
        raise AssertionError(done.stderr)
    return done


class AgainstLinuxCnc(unittest.TestCase):
    #: {name: text}, what they run on, and what it is recorded with
    programs, ini, axes = PROGRAMS, INI, AXES
    machine: ClassVar[dict] = {}
    #: Cycles by which moves are late (Recording.late) from which on it may matter how those of earlier programs came.
    steady = math.inf
    #: Such up to which a program takes the time that was planned.
    prompt = PROMPT
    #: mm, and cycles from the first motion to the last
    same, same_cycles = SAME, 1

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    def planned(self, name, *options):
        """The position in each cycle, and how many there are from the first motion to the last."""
        program, table = self.file(name + ".ngc", self.programs[name]), os.path.join(self.folder, name + ".csv")
        figures = json.loads(plan(program, "--ini", self.ini, "--json", "--csv", table, *options).stdout)["programs"][0]
        with open(table, encoding="utf-8") as rows:
            positions = [tuple(float(row[f"axis.{axis}"]) for axis in self.axes) for row in csv.DictReader(rows)]
        first, last = motion(positions)
        # the plan also counts a cycle with less than what a recording shows
        self.assertLessEqual(figures["cycles"] - (last - first + 1), 2)
        # the first row is the start
        return positions[1:], last - first + 1

    def with_the_same_arrivals(self, name, recording):
        """Cycles, and how far any position is from the recorded one."""
        positions, cycles = self.planned(name, "--arrivals", self.file(name + ".txt", recording.arrivals()))
        compared = positions[:recording.end + 1]
        if len(compared) <= recording.end:
            return cycles, math.inf
        return cycles, max(math.dist(a, b) for a, b in zip(compared, recording.positions[:recording.end + 1], strict=True))

    def recorded_with(self):
        return self.machine

    def test_times_and_positions(self):
        left, planned = list(self.programs), {}
        for _ in range(ATTEMPTS):
            late = []
            for name, recording in record(left, self.programs, self.axes, **self.recorded_with()).items():
                same, away = self.with_the_same_arrivals(name, recording)
                if name not in planned:
                    planned[name] = self.planned(name)[1]
                off = planned[name] - recording.cycles
                found = (f"{name:10} LinuxCNC {recording.cycles * PERIOD:8.3f} s, planned {off:+d} cycles; with the same "
                         f"arrivals {same - recording.cycles:+d} cycles, positions within {away:.2g} mm; moves up "
                         f"to {recording.late()} cycles late")
                print(found, flush=True)
                if not away < self.same and recording.late() >= self.steady:
                    late.append(name)
                    continue
                with self.subTest("the same arrivals", program=name):
                    self.assertLessEqual(abs(same - recording.cycles), self.same_cycles, found)
                    self.assertLess(away, self.same, found)
                if abs(off) > max(3, 0.002 * recording.cycles):
                    self.assertGreater(recording.late(), self.prompt, f"{name} takes another time than planned, "
                                       "although its moves came promptly")
                    late.append(name)
            left = late
            if not left:
                return
        self.skipTest(f"the computer is too busy: the moves of {left} came late, {ATTEMPTS} times")


def at_once(hal):
    """The lathe with a spindle that has its commanded speed at once, as that of a plan has."""
    ramped = re.compile(r"((loadrt (limit3|near)|addf spindle-(ramp|near)|net spindle-(at-speed|command|speed)) "
                        r"|setp spindle-).*\n")
    direct = "net spindle-speed spindle.0.speed-out-rps => spindle-encoder.velocity-cmd spindle.0.speed-in\n"
    return ramped.sub("", hal) + direct


#: The spindle is at its speed, and the planner knows it, when the next move comes: from then on the time at which it was told
#: does not matter.
KNOWN = "G4 P.4"
LATHE = program(
    "G7 G18 G64 P.02", "G43.1 X3 Z2", "G0 X40 Z5", "G96 D2500 S240 M3", KNOWN, "G95 F.08", "G0 X34 Z0", "G1 X-.8", "G0 Z2 X30",
    "G0 X26", "G1 Z-6 F.25", "X31", "G0 Z2", "S100", KNOWN, "G0 X14", "G1 X20 Z-1 F.12", "Z-4", "G2 X24 Z-6 I2", "G1 X30",
    "G92 X36", KNOWN, "G1 Z-8", "G92.1", "G20", "S600", KNOWN, "G1 X1.5 F.01", "G21 G97 S800", KNOWN, "G1 Z-3 F.2",
    "G94 F600 X20", "M5",
    "G49")


@pytest.mark.thorough
class ConstantSurfaceSpeed(AgainstLinuxCnc):
    """Feed per turn of a spindle that follows the diameter (G96), with offsets of work and tool, in metres and in feet."""
    programs, axes = {"lathe": LATHE}, "xz"
    ini = os.path.join(harness.SAMPLES, "configs", "framepath-lathe", "framepath-lathe.ini")
    #: A rapid goes on from where the turns of the spindle have taken the machine, which are counted from another angle: 1e-13 mm
    #: beside, on the same plan, the search for the speed of a period may end with another value. It is .0005 mm late at most.
    same = 1e-3
    machine: ClassVar[dict] = {"sample": "framepath-lathe", "joints": 2, "edit_hal": at_once}


#: Full circles end where they begin: no axis shows that their F is one of length.
INCHES = {
    "inches": program("G20", "G64 P.002 Q.001 F100", "G1 X1", "X2 Y.2", "X2.01 Y.21", "X2.02 Y.215", "G3 X3 Y.2 R1", "F40",
                      "G2 J.5", "G18 G3 I.25", "G17 G0 X0 Y0"),
    "metric": program("F1500 G64 P.05", "G1 X20", "X40 Y5", "G2 X60 I10", "G3 J5", "G20", "G1 X3 Y1 F80", "G0 X0 Y0"),
}


@pytest.mark.thorough
class Inches(AgainstLinuxCnc):
    """A machine in inches, with programs in both units."""
    programs = INCHES
    ini = os.path.join(harness.SAMPLES, "configs", "framepath-inch", "framepath-inch.ini")
    #: The limits go through millimetres: their last digit may be another one, and with it where the search for the speed of a
    #: period ends.
    same = 1e-5
    machine: ClassVar[dict] = {"sample": "framepath-inch"}


class Refusals(unittest.TestCase):
    def test_what_the_interpreter_refuses_is_passed_on(self):
        with tempfile.NamedTemporaryFile("w", suffix=".ngc") as file:
            file.write("G21 F100\nG1 X1\nG1 X2 Q?\nM2\n")
            file.flush()
            done = plan(file.name, "--ini", INI, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(f"{file.name}:3: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
