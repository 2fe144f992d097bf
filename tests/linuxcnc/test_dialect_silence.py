"""Words of other controls that LinuxCNC would obey in silence, as something else.

LinuxCNC takes each of these programs as it is without a complaint, and goes elsewhere; behind the filter it goes where
the control would. (That it does so with its joints too is shown by the same programs in test_dialect_examples.)
"""

import unittest

from canon import canonical_shapes, compare
from geometry import chained
from part_programs import filtered

ORIGIN = (0.0, 0.0, 0.0)
OFFSET = "G21\nG10 L2 P1 X20 Y30 Z-5\n"


class Silence(unittest.TestCase):
    def check(self, dialect, program, points, before=""):
        shapes = chained(ORIGIN, *points)
        self.assertIsNotNone(compare(canonical_shapes(before + program), shapes), "LinuxCNC means the same by it")
        found = canonical_shapes(before + filtered(program, dialect, "program"))
        self.assertIsNone(compare(found, shapes))

    def test_isg_g20_and_g21_are_inch_and_millimetre_to_linuxcnc(self):
        self.check("isg", "G01 G90 X10 Y20 F3000\nG21\nX10 Y20\nG20\nX10 Y20\nM30\n",
                   [(10, 20, 0), (-10, 20, 0), (10, 20, 0)])

    def test_fagor_rpt_is_a_comment_to_linuxcnc(self):
        self.check("fagor", "G90 G00 X0 Y0\nN10 G91 G01 X20 Y10 F3000\nN20 X-10\n(RPT N10,20)\nM30\n",
                   [(20, 10, 0), (10, 10, 0), (30, 20, 0), (20, 20, 0)])

    def test_isg_g92_is_a_preset_to_linuxcnc(self):
        self.check("isg", "G01 G90 X7 Y7 F3000\nG92 X60 Y40\nX10 Y20\nG92 X0 Y0\nX10 Y20\nM30\n",
                   [(7, 7, 0), (70, 60, 0), (10, 20, 0)])

    def test_modal_g53_holds_for_one_line_in_linuxcnc(self):
        for dialect in ("isg", "mefi"):
            with self.subTest(dialect):
                self.check(dialect, "G54\nG01 X1 Y2 Z0 F3000\nG53 G01 X10 Y20\nZ3\nG54\nX1 Y2 Z0\nM30\n",
                           [(21, 32, -5), (10, 20, -5), (10, 20, 3), (21, 32, -5)], OFFSET)


if __name__ == "__main__":
    unittest.main()
