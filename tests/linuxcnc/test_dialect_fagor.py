"""Programs of a Fagor 8055, from the part program to the joints of a real LinuxCNC with both modules.

The expected paths are written down by hand from the manual's examples. Every program runs twice: with its coordinates
rewritten, and with the frame kinematics.
"""

import unittest

from geometry import follow
from part_programs import Path, filtered, joints_of

SAMPLE = "framepath-fagor"


MIRRORED = """%PIEZA,MX--,
G90 G00 X0 Y0 Z0
(CALL 1)
G11
(CALL 1)
G10 G12
(CALL 1)
G11
(CALL 1)
M30
(SUB 1)
G91 G01 X30 Y30 F3000
Y60
X20 Y-20
X40
G02 X0 Y-40 I0 J-20
G01 X-60
X-30 Y-30
(RET)
"""


def mirrored():
    path = Path()
    for x, y in [(1, 1), (-1, 1), (1, -1), (-1, -1)]:
        path.to((30 * x, 30 * y), (30 * x, 90 * y), (50 * x, 70 * y), (90 * x, 70 * y))
        path.arc((90 * x, 30 * y), (90 * x, 50 * y), -180 * x * y)
        path.to((30 * x, 30 * y), (0, 0))
    return path


SCALED = """G90 G00 X-30 Y10 Z0
(CALL 1)
G92 X-79 Y-30
G72 S2
(CALL 1)
G72 S1
M30
(SUB 1)
G90 X-19 Y0
G01 X0 Y10 F3000
G02 X0 Y-10 I0 J-10
G01 X-19 Y0
(RET)
"""


def scaled():
    path = Path().to((-30, 10), (-19, 0), (0, 10)).arc((0, -10), (0, 0), -180).to((-19, 0))
    return path.to((22, 30), (60, 50)).arc((60, 10), (60, 30), -180).to((22, 30))


# LinuxCNC takes (RPT ..) for a comment: without the filter the second part would be missing.
REPEATED = """G90 G00 X20 Y20 Z0
N10 G91 G01 X-10 F3000
X-10 Y-20
X20 Y10
N20 Y10
G72 S0.5
(RPT N10,20)
M30
"""


def repeated():
    path = Path().to((20, 20), (10, 20), (0, 0), (20, 10), (20, 20))
    return path.to((15, 20), (10, 10), (20, 15), (20, 20))


# Mirror, scale and rotation together; a preset under the mirror; a tangent arc, a rounding, a polar place.
TOGETHER = """G90 G0 X10 Y0 Z0
G11
G92 X50
G1 X60 F3000
G10
G54
G0 X0 Y0
G12
G72 S2
G73 Q90 I2 J1
G1 X6 Y2
G73
G72 S1
G10
G0 X0 Y0
G36 R5 G1 X20
Y20
G8 X0 Y20
G93 I0 J10
R10 Q180
M30
"""


def together():
    path = Path().to((10, 0), (-100, 0), (0, 0), (6, 6), (0, 0))
    path.to((15, 0)).arc((20, 5), (15, 5), 90).to((20, 20))
    return path.arc((0, 20), (10, 20), 180).to((-10, 10))


# The factor for one axis acts behind cutter compensation: with a tool of radius 5 the wall at X10 is passed at X15, and
# that is doubled.
COMPENSATED = """T2 M6
G44
G90 G0 X30 Y-20 Z0
G72 X2
G42 G1 X10 Y0 F3000
Y20
G40 X30
M30
"""


def compensated():
    # the entry ends at (30, 0), on the way: nothing stops there
    return Path().to((30, -20), (30, 20), (60, 20))


def run(program, backend):
    return joints_of(filtered(program, "fagor", "part.pim", backend), SAMPLE)


class Fagor(unittest.TestCase):
    def check(self, program, path, backends=("program", "kinematics")):
        for backend in backends:
            with self.subTest(backend=backend):
                worst, missed = follow(run(program, backend), path.shapes)
                self.assertLess(worst, 1e-6)
                # every corner is a stop; a stop between two samples lies beside both
                self.assertLess(missed, 5e-6)

    def test_mirror_images(self):
        self.check(MIRRORED, mirrored())

    def test_scale_about_a_preset_zero(self):
        self.check(SCALED, scaled())

    def test_repeated_blocks(self):
        self.check(REPEATED, repeated())

    def test_everything_together(self):
        self.check(TOGETHER, together())

    def test_a_factor_behind_cutter_compensation(self):
        self.check(COMPENSATED, compensated(), ["kinematics"])

    def test_a_wrong_path_would_be_noticed(self):
        joints = run(REPEATED, "program")
        shapes = repeated().shapes
        del shapes[5]
        self.assertGreater(max(follow(joints, shapes)), 1e-2)


if __name__ == "__main__":
    unittest.main()
