"""Part programs in continuous path mode: corners within the tolerance, holes as deep as they are programmed."""

import math
import unittest

import pytest

import harness
from part_programs import convert

RUN = ["run", "PROGRAMS/part.ngc"]

HEAD = "G0 X0 Y0 Z0\nF3000\n"

SQUARE = "G1 X20\nY20\nX0\nY0\nM30\n"
CORNERS = [(20.0, 0.0), (20.0, 20.0), (0.0, 20.0)]


@pytest.mark.thorough
class PathModes(unittest.TestCase):
    def rows(self, program, dialect, backend="program"):
        """Where X Y Z were in each servo cycle."""
        code, output, complaints = convert(program, dialect, backend)
        self.assertEqual(code, 0, complaints)
        result = harness.run([RUN], {"part.ngc": output})
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        return result.columns("joint.0", "joint.1", "joint.2")

    def test_corners_are_rounded_within_the_tolerance_in_force(self):
        for dialect, begin, tolerance in (("sinumerik", "CYCLE832(0.01,_FINISH,1)\nG642\n", 0.01), ("sinumerik", "G64\n", 0.01),
                                          ("sinumerik", "CTOL=0.1\nG645\n", 0.1), ("fagor", "G05\n", 0.01),
                                          ("isg", "G261\n", 0.01)):
            with self.subTest(dialect=dialect, begin=begin):
                rows = self.rows(begin + HEAD + SQUARE, dialect)
                missed = [min(math.dist(row[:2], corner) for row in rows) for corner in CORNERS]
                # an arc of the tolerance is cut off, and not much less: it is rounded
                self.assertLess(max(missed), 1.01 * tolerance + 1e-4, missed)
                self.assertGreater(min(missed), 0.2 * tolerance, missed)

    def test_corners_keep_the_tolerance_whatever_the_scale(self):
        square = "G1 X5\nY5\nX0\nY0\nM30\n"
        for backend in ("program", "kinematics"):
            for begin in ("SCALE X4 Y4 Z4\nG642 CTOL=0.05\n", "G642 CTOL=0.05\nSCALE X4 Y4 Z4\n"):
                program = begin + HEAD + square
                with self.subTest(program, backend=backend):
                    rows = self.rows(program, "sinumerik", backend)
                    missed = [min(math.dist(row[:2], corner) for row in rows) for corner in CORNERS]
                    self.assertLess(max(missed), 1.01 * 0.05 + 1e-4, missed)
                    self.assertGreater(min(missed), 0.2 * 0.05, missed)

    def test_an_exact_stop_under_cutter_compensation_is_a_rest_at_the_corner_of_the_tool(self):
        for dialect, rounds, stop, go_on in (("sinumerik", "G64\n", "G9 ", ""), ("fagor", "G05\n", "G07 ", "G05 ")):
            for exact in (True, False):
                lines = f"G41 D1 G1 X10 Y0\n{stop if exact else ''}X20\n{go_on}Y20\nG40 X0\nM30\n"
                with self.subTest(dialect=dialect, exact=exact):
                    rows = self.rows("T1 M6\n" + rounds + HEAD + lines, dialect)
                    rests = [row for row, following in zip(rows, rows[1:]) if math.dist(row, following) < 1e-9]
                    # beside both sides of the corner by the radius of the tool
                    inside = [row for row in rests if 1 < row[1] < 19 and abs(row[0] + row[1] - 20) < 1e-6]
                    self.assertEqual(bool(inside), exact, rests[::100])

    def test_holes_are_as_deep_as_they_are_programmed(self):
        for dialect, program in (
                ("sinumerik", f"G64\n{HEAD}MCALL CYCLE81(5,-1,5,-17.262)\nX10\nX20\nMCALL\nG0 X30\nM30\n"),
                ("sinumerik", f"CTOL=0.5 G642\n{HEAD}Z4\nCYCLE81(5,-1,5,-17.262)\nG0 X30\nM30\n"),
                ("fagor", f"G05\n{HEAD}G0 Z5\nG99 G81 X10 Y0 Z4 I-17.262\nX20\nG80\nG0 X30\nM30\n")):
            with self.subTest(program):
                rows = self.rows(program, dialect)
                deepest = min(row[2] for row in rows)
                self.assertAlmostEqual(deepest, -17.262, places=5)

    def test_corners_swing_out_but_not_beyond_a_soft_limit(self):
        for limit, swings in ((490, True), (500, False)):
            program = f"G0 X{limit - 20} Y{limit - 20}\nG64 P0.05\nG1 F3000 X{limit}\nY{limit}\nX{limit - 20}\nM2\n"
            result = harness.run([RUN], {"part.ngc": program})
            self.assertIsNone(result.failure, result.log)
            self.assertEqual(result.errors, [], result.log)
            rows = result.columns("joint.0", "joint.1")
            beyond = [max(row[axis] for row in rows) - limit for axis in (0, 1)]
            if swings:
                self.assertTrue(all(0.01 < way < 0.05 for way in beyond), beyond)
            else:
                self.assertLessEqual(max(beyond), 1e-9)

    def test_programs_that_touch_a_soft_limit_do_not_pass_it(self):
        limit = 500
        zigzag = [(limit - depth, 480 + 0.4 * k) for k, depth in enumerate((0, 0.9, 0.3, 0, 0.2, 1.3) * 8)]
        angles = [0.025 * k for k in range(-40, 41)]
        circle = [(limit - 20 + 20 * math.cos(angle), 480 + 20 * math.sin(angle)) for angle in angles]
        lines = ["".join(f"X{x:.6f} Y{y:.6f}\n" for x, y in points) for points in (circle, zigzag)]
        rounded = f"X{limit - 10} Y440\nG3 X{limit} Y450 J10\nG1 Y470\nG3 X{limit - 10} Y480 I-10\n"
        for moves in (*lines, rounded):
            with self.subTest(moves[:30]):
                program = f"G0 X{limit - 30} Y440\nG64 P0.05\nG1 F3000\n{moves}G1 X{limit - 30}\nM2\n"
                result = harness.run([RUN], {"part.ngc": program})
                self.assertIsNone(result.failure, result.log)
                self.assertEqual(result.errors, [], result.log)
                farthest = max(result.column("joint.0"))
                self.assertLessEqual(farthest, limit + 1e-9)
                self.assertGreater(farthest, limit - 0.05)

    def test_corners_stay_inside_where_a_pin_says_so(self):
        program = "G0 X20 Y20\nG64 P0.05\nG1 F3000 X40\nY40\nX20\nM2\n"
        for inside in (0, 1):
            result = harness.run([RUN], {"part.ngc": program}, hal=f"setp blendtp.corners-inside {inside}\n")
            self.assertIsNone(result.failure, result.log)
            self.assertEqual(result.errors, [], result.log)
            rows = result.columns("joint.0", "joint.1")
            beyond = max(max(row) for row in rows) - 40
            if inside:
                self.assertLessEqual(beyond, 1e-9)
            else:
                self.assertGreater(beyond, 0.01)


if __name__ == "__main__":
    unittest.main()
