"""CYCLE800 of Sinumerik programs in a real LinuxCNC, on the sample machine with a tilting rotary table."""

import unittest

import pytest

import harness
from part_programs import filtered
from test_machines import RUN, SAMPLE, TOOL_CENTRE_POINT

TILT = 'CYCLE800({fr},"TC",0,57,10,20,0,20,-35,50,0,0,0,-1)'
BACK = 'CYCLE800({fr},"TC",0,57,0,0,0,0,0,0,0,0,0,-1)'

#: where the sample retracts to
TOP = 90.0

MACHINE = {"sample": SAMPLE, "joints": 5, "axes": "xyzac"}


def translated(lines, before=()):
    program = "\n".join([*lines, "M30", ""])
    return "\n".join([*before, filtered(program, "sinumerik", "kinematics", ["--retract-z", str(TOP)])])


class Swivel(unittest.TestCase):
    def run_program(self, *lines, before=TOOL_CENTRE_POINT, machine=MACHINE):
        return harness.run([RUN, ["note", "end"]], {"part.ngc": translated(lines, ["G21", *before])}, **machine)

    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def near(self, found, expected):
        for a, b in zip(found[:len(expected)], expected, strict=True):
            self.assertAlmostEqual(a, b, places=6, msg=f"{found} instead of {expected}")

    def is_at_the_top(self, rows, turning):
        """That the tool was up in the first period in which the table turns. One period may end the way up and begin that:
        a sixth of what 20000 mm/s3 make of a period, behind motion's interpolator, is .0006 micrometres."""
        self.assertAlmostEqual(rows[turning][2], TOP, delta=1e-6)
        self.assertAlmostEqual(rows[turning - 1][2], TOP, delta=1e-3)

    def test_it_swivels_back_to_zero(self):
        for before in ((), ("T2 M6 D1",)):
            with self.subTest(before):
                length = 20.0 if before else 0.0
                result = self.run_program(*before, "G0 X0 Y0 Z60", TILT.format(fr=0), "G0 X7 Y4 Z30", "G1 Z1 F3000", "Z30",
                                          BACK.format(fr=0), "G0 X5 Y6 Z50")
                self.good(result)
                tilted = max(abs(a) for a, in result.columns("joint.3"))
                self.assertGreater(tilted, 20, "the table was not tilted")
                self.near(result.answers["end"]["joints"], [5, 6, 50 + length, 0, 0])

    def test_it_retracts_along_the_tool_before_the_table_turns(self):
        result = self.run_program("G0 X0 Y0 Z60", TILT.format(fr=1), "G0 X7 Y4 Z30", "G1 Z1 F3000", BACK.format(fr=1),
                                  "G0 X5 Y6 Z50")
        self.good(result)
        self.near(result.answers["end"]["joints"], [5, 6, 50, 0, 0])
        rows = result.columns("joint.0", "joint.1", "joint.2", "joint.3", "joint.4")
        angles = [abs(row[3]) for row in rows]
        # the last time the table stood tilted, and the way up before
        top = max(n for n, angle in enumerate(angles) if angle > max(angles) - 1e-9)
        self.is_at_the_top(rows, top + 1)
        way = [rows[top]]
        for row in reversed(rows[:top]):
            if row[2] > way[-1][2] or row[3] != way[0][3]:
                break
            way.append(row)
        self.assertGreater(TOP - way[-1][2], 20)
        for joint in (0, 1, 4):
            places = [row[joint] for row in way]
            self.assertLess(max(places) - min(places), 1e-6)
        # and before the table turned for the first time
        first = min(n for n, angle in enumerate(angles) if angle > 1e-9)
        self.is_at_the_top(rows, first)

    @pytest.mark.thorough
    def test_of_a_table_that_was_turned_by_hand_it_retracts_along_the_tool(self):
        result = self.run_program("G0 Z60", TILT.format(fr=0), "G0 X0 Y0 Z30", "A0", BACK.format(fr=1), "G0 X5 Y6 Z50")
        self.good(result)
        rows = result.columns("joint.0", "joint.1", "joint.2", "joint.3", "joint.4")
        # with A turned back, and C not yet, Z alone goes up, however the frame lies
        way = [row for row in rows if abs(row[3]) < 1e-9 and abs(row[4]) > 1 and row[2] < TOP - 1e-6]
        self.assertGreater(len(way), 50)
        for row in way:
            self.near(row[:2], way[0][:2])
        self.assertGreater(way[-1][2] - way[0][2], 20)
        self.near(result.answers["end"]["joints"], [5, 6, 50, 0, 0])

    def test_a_machine_without_a_table_has_nothing_to_turn(self):
        result = self.run_program("G0 X1", BACK.format(fr=1), "G0 X5", before=(), machine={})
        self.good(result)
        self.near(result.answers["end"]["joints"], [5, 0, TOP])


if __name__ == "__main__":
    unittest.main()
