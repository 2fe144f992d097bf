"""AXIS itself, on an X server without a monitor, with the USER_COMMAND_FILE that users have."""

import unittest

import numpy

import harness
from test_preview import ARC, nearest, program

#: AXIS is up when its pins are there and it answers
START = [["show", "axis"], ["wait_pin", "axisui.abort"], ["ask", "up", "notes"]]

FILES = ("screen_driver.py", "screen_probe.py")

#: how exactly the live plot is on the path of the joints, mm
TRAIL = 1e-5


def watch(steps, programs, ini=None, **options):
    changes = {("DISPLAY", "USER_COMMAND_FILE"): "./screen_probe.py", **(ini or {})}
    return harness.run([*START, *steps, ["ask", "notes", "notes"]], programs, display="screen_driver.py", files=FILES,
                       ini=changes, **options)


class Axis(unittest.TestCase):
    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        self.assertEqual(result.answers["notes"], [])


class OnTheScreen(Axis):
    """One program with shifts, turns and a scale, watched from its opening to its end."""

    result: harness.Result

    @classmethod
    def setUpClass(cls):
        cls.result = watch(
            [["ask", "drawn", "open", "PROGRAMS/part.ngc"], ["start", "PROGRAMS/part.ngc"], ["wait_paused"],
             ["ask", "relative", "display", 1], ["ask", "machine", "display", 0], ["note", "place"], ["resume"], ["finish"],
             ["sleep", 0.3], ["ask", "trail", "trail"]],
            program("T2 M6 G43", "G1 X1 Y1 Z1", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]",
                    "G1 X7 Y8 Z9", "G1 X0 Y0 Z0", "M0", "G1 X40", "G2 X40 Y20 R10", "G1 X0", "G4 P0.1",
                    "o<ascale> call [0.5] [0.5] [0.5]", "G3 X40 Y20 R30", "G49", "o<frame_refresh> call", "G1 X3 Y4 Z5",
                    "o<frame_off> call", "G1 X5"))

    def setUp(self):
        self.good(self.result)
        self.joints = numpy.array([self.result.commanded(joint) for joint in range(3)]).T

    def test_the_preview_is_where_the_joints_run(self):
        for place in self.result.answers["drawn"]:
            self.assertLess(nearest(self.joints, place).min(), ARC, place)

    def test_the_live_plot_ends_at_the_tip_of_the_tool(self):
        # without a tool now, that is where the axes are
        place = self.result.answers["trail"][-1]
        for value, joint in zip(place, self.joints[-1], strict=True):
            self.assertAlmostEqual(value, joint, delta=TRAIL)

    def test_the_live_plot_is_drawn_at_the_tip_of_a_turned_tool(self):
        # the tool, 20 mm long, stands in the frame: at its origin the plot is there, and the axes are elsewhere
        trail = numpy.array(self.result.answers["trail"])
        self.assertLess(numpy.abs(trail - (20, 30, 5)).max(axis=1).min(), TRAIL)
        self.assertGreater(nearest(self.joints, (20, 30, 5)).min(), 1)

    def test_relative_positions_are_those_of_the_program(self):
        lines = self.result.answers["relative"]
        self.assertEqual([float(line.split(":")[1]) for line in lines[:3]], [0.0, 0.0, 0.0])
        self.assertEqual(lines[-1], "FRAME X20.000 Y30.000 Z5.000 turned 36.762")

    def test_machine_positions_are_those_of_the_joints(self):
        lines = self.result.answers["machine"]
        shown = [float(line.split(":")[1]) for line in lines[:3]]
        for value, joint in zip(shown, self.result.answers["place"]["joints"][:3], strict=True):
            self.assertAlmostEqual(value, joint, delta=6e-4)


class Trail(Axis):
    def test_the_live_plot_is_on_the_path_of_the_joints(self):
        result = watch([["start", "PROGRAMS/part.ngc"], ["finish"], ["sleep", 0.3], ["ask", "trail", "trail"]],
                       program("G1 X10 Y5", "G4 P0.1", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]",
                               "G1 X0 Y0 Z0", "G4 P0.1", "G1 X40", "G4 P0.1", "G2 X40 Y20 R10", "o<amirror> call [1] [0] [0]",
                               "G1 X3 Y4 Z2", "G4 P0.1"))
        self.good(result)
        joints = numpy.array([result.commanded(joint) for joint in range(3)]).T
        trail = result.answers["trail"]
        self.assertGreater(len(trail), 20)
        for place in trail:
            self.assertLess(nearest(joints, place).min(), TRAIL, place)
        # where the machine rests the plot has its place
        points = numpy.array(trail)
        for rest in ((10, 5, 0), (20, 30, 5)):
            self.assertLess(numpy.abs(points - rest).max(axis=1).min(), 2e-6, rest)


class Limits(Axis):
    """The joints of the sample go from -500 to 500; a limit is told exactly where one is exceeded."""

    #: (lines of the program, letter and place that are told, None: nothing is)
    CASES = (
        (("o<trans> call [400] [0] [0]", "G1 X99.99999"), None),
        (("o<trans> call [400] [0] [0]", "G1 X100.00001"), ("X", "500.000")),
        # a quarter turn about Y: X of the program is -Z of the machine
        (("o<rot> call [0] [90] [0]", "G1 X499.99999"), None),
        (("o<rot> call [0] [90] [0]", "G1 X500.01"), ("Z", "-500.010")),
        (("o<scale> call [0.5] [1] [1]", "G1 X999.99999 Y-499.99999"), None),
        (("o<mirror> call [0] [1] [0]", "G1 Y500.5"), ("Y", "-500.500")),
        # in the middle of an arc, between the chords that are drawn
        (("G1 X450 Y-50", "G3 X450 Y50 I0 J49.99999"), None),
        (("G1 X450 Y-50.00002", "G3 X450 Y50.00002 I0 J50.00002"), ("X", "500.000")),
        (("o<rot> call [0] [0] [37]", "G1 X420 Y-80.00002", "G3 X420 Y80.00002 I0 J80.00002"), None),
        # the tool is turned with the frame: 20 mm along the machine's X
        (("T2 M6 G43", "o<rot> call [0] [90] [0]", "G1 Z479.99999"), None),
        (("T2 M6 G43", "o<rot> call [0] [90] [0]", "G1 Z480.00001"), ("X", "500.000")),
    )

    def test_a_limit_is_told_where_a_joint_exceeds_it(self):
        programs = {f"{number}.ngc": program(*lines)["part.ngc"] for number, (lines, _) in enumerate(self.CASES)}
        steps = []
        for number in range(len(self.CASES)):
            steps += [["ask", "drawn", "open", f"PROGRAMS/{number}.ngc"], ["ask", f"warned {number}", "warned"]]
        result = watch(steps, programs, record=False)
        self.good(result)
        for number, (lines, told) in enumerate(self.CASES):
            with self.subTest(lines=lines):
                warnings = result.answers[f"warned {number}"]
                if told is None:
                    self.assertEqual(warnings, [])
                else:
                    self.assertEqual(len(warnings), 1, warnings)
                    self.assertIn(f"takes {told[0]} of the machine to {told[1]}", warnings[0])


if __name__ == "__main__":
    unittest.main()
