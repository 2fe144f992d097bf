"""AXIS itself, on an X server without a monitor, with the USER_COMMAND_FILE that users have."""

import unittest

import pytest

import screen_checks
from test_preview import ARC, program

pytestmark = pytest.mark.thorough

#: with a program that AXIS opens by itself, where a test has one
AXIS = screen_checks.Screen(["axis", "PROGRAMS/part.ngc"], "probe_axis.py")


class OnTheScreen(screen_checks.OnTheScreen):
    screen = AXIS
    before = (["ask", "drawn at start", "drawn"],)

    def test_what_axis_opens_by_itself_has_its_frames(self):
        places = self.result.answers["drawn at start"]
        self.assertEqual(len(places), len(self.result.answers["drawn"]))
        for place, other in zip(places, self.result.answers["drawn"], strict=True):
            self.assertLess(max(abs(one - two) for one, two in zip(place, other, strict=True)), ARC)


class Trail(screen_checks.TrailOnATable):
    screen = AXIS


class Limits(unittest.TestCase):
    """The joints of the sample go from -500 to 500; a limit is told exactly where one is exceeded."""

    #: (lines of the program, letter and place that are told, None: nothing is)
    CASES = (
        (("M0",), None),
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
        result = AXIS.watch(steps, programs, record=False)
        screen_checks.good(self, result)
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
