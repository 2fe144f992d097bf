"""A program with tilted frames, an arc in each, on a machine with three axes: what the joints really do.

    TRANS X10 Y10, L10, ATRANS X35, AROT Y30, ATRANS X5, L10, G0 X300 Y100
"""

import math
import unittest

import harness
from geometry import Frame, Line, follow

S30, C30 = math.sin(math.radians(30)), math.cos(math.radians(30))

FLAT = Frame((10.0, 10.0, 0.0))
#: 10 + 35 + 5 cos 30, 10, -5 sin 30
TILTED = Frame((45 + 5 * C30, 10.0, -5 * S30), (C30, 0.0, -S30), (0.0, 1.0, 0.0), (S30, 0.0, C30))

L10 = """\
o<l10> sub
  G0 X0 Y0 Z5
  G1 Z-1 F600
  G1 X10 F3000
  G3 X10 Y10 I0 J5
  G1 X0
  G1 Y0
  G0 Z5
o<l10> endsub
"""

PROGRAM = L10 + """\
N10 G17 G54 G21 G90 G94 G61.1
N20 o<trans> call [10] [10] [0]
N30 o<l10> call
N40 o<atrans> call [35] [0] [0]
N50 o<arot> call [0] [30] [0]
N60 o<atrans> call [5] [0] [0]
N70 o<l10> call
N80 G0 X300 Y100
M30
"""

RUN = ["run", "PROGRAMS/part.ngc"]


def slot(frame):
    """L10 from (0, 0, 5)."""
    return [frame.line((0, 0, 5), (0, 0, -1)), frame.line((0, 0, -1), (10, 0, -1)),
            frame.arc((10, 5, -1), (0, -5, 0), (5, 0, 0), 180), frame.line((10, 10, -1), (0, 10, -1)),
            frame.line((0, 10, -1), (0, 0, -1)), frame.line((0, 0, -1), (0, 0, 5))]


def path(result):
    return list(zip(*(result.commanded(joint) for joint in range(3)), strict=True))


class Seed3d(unittest.TestCase):
    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def check(self, result, shapes):
        self.good(result)
        worst, missed = follow(path(result), shapes)
        self.assertLess(worst, 1e-6)
        self.assertLess(missed, 1e-6)

    def test_the_joints_run_the_slot_in_both_frames(self):
        result = harness.run([RUN], {"part.ngc": PROGRAM})
        flat, tilted = FLAT.point((0, 0, 5)), TILTED.point((0, 0, 5))
        self.check(result, [Line((0, 0, 0), flat), *slot(FLAT), Line(flat, tilted), *slot(TILTED),
                            Line(tilted, TILTED.point((300, 100, 5)))])

    def test_the_tilted_arc_is_a_circle_in_space(self):
        result = harness.run([RUN], {"part.ngc": PROGRAM})
        self.good(result)
        centre, corner = TILTED.point((10, 5, -1)), TILTED.point((10, 0, -1))
        self.assertAlmostEqual(corner[0], 49.3301270 + 8.6602540 - 0.5, places=6)
        radii, heights = [], []
        for point in path(result):
            relative = [p - c for p, c in zip(point, centre, strict=True)]
            x, z = (sum(r * a for r, a in zip(relative, TILTED.axes[k], strict=True)) for k in (0, 2))
            if x > 0.01 and math.hypot(*relative) < 5.5:
                radii.append(math.hypot(*relative))
                heights.append(z)
        self.assertGreater(len(radii), 50)
        self.assertLess(max(abs(r - 5) for r in radii), 1e-6)
        self.assertLess(max(abs(h) for h in heights), 1e-6)


class ToolLength(unittest.TestCase):
    def end(self, rule):
        """Joints at (7, 4, 3) of the tilted frame, with a tool of 20 mm."""
        lines = ["G17 G54 G21 G90 G94 G61.1", "T2 M6", "G43", "o<trans> call [10] [10] [0]",
                 "o<atrans> call [35] [0] [0]", "o<arot> call [0] [30] [0]", "o<atrans> call [5] [0] [0]",
                 "G1 X7 Y4 Z3 F3000", "M2"]
        result = harness.run([RUN, ["note", "end"]], {"part.ngc": "\n".join(lines) + "\n"},
                             {("KINS", "KINEMATICS"): f"framekins coordinates=XYZ tool_length={rule}"})
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        return result.answers["end"]["joints"][:3]

    def check(self, rule, direction):
        expected = [p + 20 * d for p, d in zip(TILTED.point((7, 4, 3)), direction, strict=True)]
        for found, wanted in zip(self.end(rule), expected, strict=True):
            self.assertAlmostEqual(found, wanted, places=9)

    def test_it_lies_along_the_tilted_z(self):
        self.check("frame", TILTED.axes[2])

    def test_it_stays_along_the_machine(self):
        self.check("machine", (0, 0, 1))


class Mirror(unittest.TestCase):
    """Cutter compensation on the left of a contour, and its mirror image: a tool of radius 3."""

    CONTOUR = ("G0 X0 Y-20", "G41 D1", "G1 Y0 F3000", "Y30", "G2 X10 Y40 I10 J0", "G1 X40", "Y0", "X0", "G40",
               "G1 X-20 Y-20", "M2")

    def shapes(self, frame):
        line, arc = frame.line, frame.arc
        return [line((0, 0, 0), (0, -20, 0)), line((0, -20, 0), (-3, 0, 0)), line((-3, 0, 0), (-3, 30, 0)),
                arc((10, 30, 0), (-13, 0, 0), (0, 13, 0), 90), line((10, 43, 0), (40, 43, 0)),
                arc((40, 40, 0), (0, 3, 0), (3, 0, 0), 90), line((43, 40, 0), (43, 0, 0)),
                arc((40, 0, 0), (3, 0, 0), (0, -3, 0), 90), line((40, -3, 0), (0, -3, 0)),
                line((0, -3, 0), (-20, -20, 0))]

    def check(self, frame, *commands):
        lines = ["G17 G54 G21 G90 G94 G61.1", *commands, *self.CONTOUR]
        result = harness.run([RUN], {"part.ngc": "\n".join(lines) + "\n"})
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        worst, missed = follow(path(result), self.shapes(frame))
        self.assertLess(worst, 1e-6)
        self.assertLess(missed, 1e-6)

    def test_compensation_without_a_frame(self):
        self.check(Frame())

    def test_compensation_under_mirror_cuts_the_mirror_image(self):
        self.check(Frame(x=(-1.0, 0.0, 0.0)), "o<mirror> call [1] [0] [0]")

    def test_compensation_in_a_tilted_plane(self):
        self.check(Frame(x=(C30, 0.0, -S30), z=(S30, 0.0, C30)), "o<rot> call [0] [30] [0]")


if __name__ == "__main__":
    unittest.main()
