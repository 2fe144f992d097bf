"""The samples that have a program of their own: they run it, each on its machine."""

import math
import os
import unittest
from itertools import pairwise
from typing import ClassVar

import pytest

import harness
from contract.row import MICROMETRE, peaks
from part_programs import convert

#: The thread of the lathe's program: its pitch, and where in Z the spindle is in step and the thread not yet at its end, mm;
#: how far a pass goes along for a millimetre in; its passes.
PITCH, STEADY, FLANK, PASSES = 1.5, (-13.0, 2.0), math.tan(math.radians(29.5)), 7
#: The line of the plate's program at which its holes begin.
HOLES = 38
#: The spindle's turns for the recorder, in millionths of a turn.
TURNS = """
loadrt mult2 names=turns-scale
loadrt conv_float_s32 names=turns-out
addf turns-scale servo-thread
addf turns-out servo-thread
setp turns-scale.in1 1000000
net spindle-turns => turns-scale.in0
net turns-scaled turns-scale.out => turns-out.in
"""


def own_program(sample, name):
    with open(os.path.join(harness.SAMPLES, "configs", sample, name), encoding="utf-8") as file:
        return {"part.ngc": file.read()}


class Sample(unittest.TestCase):
    sample = program = axes = ""
    joints = 3
    #: of each axis: velocity, acceleration, jerk
    limits: ClassVar[dict[str, tuple[float, float, float]]] = {}

    @classmethod
    def run_program(cls, **options):
        return harness.run([["note", "homed"], ["run", "PROGRAMS/part.ngc"], ["note", "end"]],
                           own_program(cls.sample, cls.program), sample=cls.sample, joints=cls.joints, axes=cls.axes, **options)

    def good(self, result):
        """It has run to its end, and nobody was told of anything."""
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.messages, [], result.log)

    def running(self, result, *names):
        """Columns from the beginning of the program on."""
        first = next(n for n, line in enumerate(result.column("line")) if line > 0)
        return result.columns(*names)[first:]

    def kept(self, result):
        """The joints keep the limits of their axes."""
        for name, limits in self.limits.items():
            found = peaks([row[0] for row in self.running(result, name)])
            for what, peak, limit, much in zip(("velocity", "acceleration", "jerk"), found, limits, (1.001, 1.001, 1.05),
                                               strict=True):
                self.assertLess(peak, limit * much, f"{what} of {name}")

    def reach(self, result, joint):
        column = result.column(f"joint.{joint}")
        return min(column), max(column)


@pytest.mark.thorough
class Lathe(Sample):
    sample, program, axes, joints = "framepath-lathe", "thread.ngc", "xz", 2
    limits: ClassVar = dict.fromkeys(("joint.0", "joint.1"), (100, 1000, 20000))

    def test_a_shaft_is_turned_and_its_thread_follows_the_spindle(self):
        result = self.run_program(hal=TURNS, integers={"turns": "turns-out.out"})
        self.good(result)
        self.kept(result)
        # diameters: faced to, from X40; under G64 corners are cut, and swing out, by .01
        least, greatest = self.reach(result, 0)
        self.assertAlmostEqual(least, -0.4, delta=0.01)
        self.assertAlmostEqual(greatest, 20, delta=0.01)
        self.assertLess(self.off_the_groove(result), MICROMETRE)

    def test_frames_shift_by_a_radius_in_calls_and_by_a_diameter_in_codes(self):
        lines = ["G7 G18 G21 G61.1 G90 G94 F3000"]
        for shift in ("o<trans> call [10] [0] [0]", "G77.1 X10", "G8 G77.1 X10", "G77"):
            lines += [shift, "G1 X0", "G4 P.2"]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join([*lines, "M2"]) + "\n"}, sample=self.sample,
                             joints=self.joints, axes=self.axes)
        self.good(result)
        places = result.column("joint.0")
        rests = [now for before, now in pairwise(places[n] for n in range(0, len(places), 50)) if before == now]
        stands = [place for n, place in enumerate(rests) if not n or rests[n - 1] != place]
        self.assertEqual([round(place, 6) for place in stands], [0, 10, 5, 10, 0])

    def test_what_the_filter_writes_runs_in_radii_and_leaves_diameters_behind(self):
        ini = os.path.join(harness.SAMPLES, "configs", self.sample, f"{self.sample}.ini")
        run: list[list[object]] = [["run", "PROGRAMS/part.ngc"]]
        # the tool change keeps the interpreter from the end of the program while Z goes
        abort: list[list[object]] = [["start", "PROGRAMS/part.ngc"], ["sleep", 3], ["abort"]]
        for end, steps in (("M30\n", run), ("F60\nG1 Z-100\nT1 M6\nM30\n", abort)):
            code, output, complaints = convert("G18 G90 G71 DIAMON F3000\nG0 X40 Z0\nG1 X30\n" + end, "sinumerik", "auto",
                                               ["--ini", ini])
            self.assertEqual(code, 0, complaints)
            with self.subTest(end):
                result = harness.run([*steps, ["sleep", 0.5], ["mdi", "G90 G0 X10"]], {"part.ngc": output},
                                     sample=self.sample, joints=self.joints, axes=self.axes)
                self.assertIsNone(result.failure, result.log)
                self.assertAlmostEqual(self.reach(result, 0)[1], 20, delta=1e-4)
                self.assertAlmostEqual(result.column("joint.0")[-1], 5, delta=1e-6)

    def off_the_groove(self, result):
        """How far Z is from where the first pass has it at the same angle of the spindle, at most, mm. Each pass begins farther
        along, for it goes in along a flank of the thread."""
        places, passes = [], 0
        for (z, turns, x), (after, turned, _) in pairwise(result.columns("joint.1", "turns", "joint.0")):
            in_step = abs(z - after - PITCH * (turned - turns) * 1e-6) < 1e-6
            if in_step and after < z and STEADY[0] < z < STEADY[1]:
                places.append(z + PITCH * turns * 1e-6 - x * FLANK)
                passes += z > 0 >= after
        self.assertEqual(passes, PASSES)
        off = [place - places[0] for place in places]
        return max(abs(distance - PITCH * round(distance / PITCH)) for distance in off)


@pytest.mark.thorough
class Gantry(Sample):
    sample, program, axes, joints = "framepath-gantry", "sheet.ngc", "xyz", 4
    limits: ClassVar = {"joint.0": (200, 800, 16000), "joint.1": (200, 800, 16000), "joint.2": (200, 800, 16000),
              "joint.3": (100, 500, 10000)}

    result: harness.Result

    @classmethod
    def setUpClass(cls):
        cls.result = cls.run_program()

    def test_a_portal_is_made_square_and_its_sides_stay_together(self):
        result = self.result
        self.good(result)
        self.kept(result)
        for name in ("homed", "end"):
            for place in result.answers[name]["joints"][:4]:
                self.assertAlmostEqual(place, 0, delta=1e-6)
        # the second side stood .3 mm ahead, which motor positions show and joint positions do not
        first, second = result.column("joint.1"), result.column("joint.2")
        self.assertEqual((first[0], second[0]), (0, 0))
        self.assertAlmostEqual(first[-1] - second[-1], 0.3, delta=0.05)
        apart = first[-1] - second[-1]
        sides = self.running(result, "joint.1", "joint.2")
        self.assertLess(max(abs(left - right - apart) for left, right in sides), 1e-6)

    def test_each_part_lies_in_its_frame(self):
        result = self.result
        self.good(result)
        end = result.rows[-1]
        x, y = (result.header.index(name) for name in ("joint.0", "joint.1"))
        places = [(row[x] - end[x], row[y] - end[y]) for row in result.rows]
        # middles of sides of the part, where nothing is rounded: behind each frame
        for along, across in ((110, 0), (0, 80), (60, 120), (140, 60)):
            cosine, sine = math.cos(math.radians(20)), math.sin(math.radians(20))
            for corner in ((60 + along, 80 + across), (370 - along, 290 - across),
                           (420 + cosine * along - sine * across, 80 + sine * along + cosine * across),
                           (360 - along, 320 + across)):
                off = min(math.dist(corner, place) for place in places)
                self.assertLess(off, 0.2, f"{along} {across} at {corner}")


@pytest.mark.thorough
class Inches(Sample):
    sample, program, axes = "framepath-inch", "plate.ngc", "xyz"
    limits: ClassVar = {f"joint.{joint}": (4, 40, 800) for joint in range(3)}

    def test_a_plate_in_inches(self):
        result = self.run_program()
        self.good(result)
        self.kept(result)
        # the outside of 4 by 3 inches with a cutter of a quarter, and its corners are cut by a thousandth at most
        for joint, (least, greatest) in ((0, (-0.4, 4.125)), (1, (-0.125, 3.125))):
            found = self.reach(result, joint)
            self.assertAlmostEqual(found[0], least, delta=1e-3)
            self.assertAlmostEqual(found[1], greatest, delta=1e-3)
        # the end of the slot behind its frame: 30 degrees about the middle of the plate
        tip = (2 + 0.875 * math.cos(math.radians(30)), 1.5 + 0.875 * math.sin(math.radians(30)))
        off = min(math.dist(tip, place) for place in result.columns("joint.0", "joint.1"))
        self.assertLess(off, 2e-3)
        # holes with a drill .8 inch long: joint 2 is where the spindle is
        self.assertAlmostEqual(self.reach(result, 2)[0], -0.125, delta=1e-3)
        drilling = self.running(result, "line", "joint.2")
        drilled = [place for line, place in drilling if line >= HOLES]
        self.assertEqual(sum(before > 0.40001 >= now for before, now in pairwise(drilled)), 4)


if __name__ == "__main__":
    unittest.main()
