"""G68.2, G69, G53.1 and G43.4 in a real LinuxCNC, against rotation matrices that are written out here."""

import itertools
import math
import unittest

import numpy

import harness
from test_gcode import QUICK, said
from test_machines import on_the_table

RUN = ["run", "PROGRAMS/part.ngc"]

#: shows where the joints are, from inside a program, under a number, to more digits than o<say> of other tests; motion is done
#: some periods before its interpolator brings them to rest
SAY = """\
o<say> sub
G4 P0.01
M66 E0 L0
o1 while [ABS[#<_hal[joint.0.vel-cmd]>] + ABS[#<_hal[joint.1.vel-cmd]>] + ABS[#<_hal[joint.2.vel-cmd]>] GT 0]
M66 E0 L0
o1 endwhile
(DEBUG, AT %.9f#1 #<_hal[joint.0.pos-cmd]> #<_hal[joint.1.pos-cmd]> #<_hal[joint.2.pos-cmd]>)
o<say> endsub
"""

MODES = "G21 G61.1 G17 G90 G94 F3000"

#: codes of LinuxCNC's pull request 4374 that are not there
UNKNOWN = ("G68.3", "G53.2", "G53.3", "G53.4", "G53.5", "G53.7", "G43.5")

#: all orders of axes in which no axis follows itself
ORDERS = [q for q in itertools.product((1, 2, 3), repeat=3) if q[0] != q[1] and q[1] != q[2]]
ANGLES = (25.0, -40.0, 70.0)
ORIGIN = (12.0, -7.0, 5.0)
POINT = (11.0, 23.0, -9.0)


def about(axis, degrees):
    """The rotation about X = 1, Y = 2, Z = 3."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return numpy.array({1: [[1, 0, 0], [0, c, -s], [0, s, c]],
                        2: [[c, 0, s], [0, 1, 0], [-s, 0, c]],
                        3: [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])


def turned(order, angles):
    """About each axis as the ones before have turned it."""
    first, second, third = (about(axis, angle) for axis, angle in zip(order, angles, strict=True))
    return first @ second @ third


def fixed(order, angles):
    """About the axes of the work offset."""
    first, second, third = (about(axis, angle) for axis, angle in zip(order, angles, strict=True))
    return third @ second @ first


def words(letters, values):
    return " ".join(f"{letter}{value:.12g}" for letter, value in zip(letters, values, strict=True))


class Planes(unittest.TestCase):
    def check(self, cases, before=()):
        """cases: (lines that set the plane, point of the program, where the joints are then)."""
        lines = [SAY, MODES, *before]
        for number, (commands, point, _) in enumerate(cases):
            lines += [*commands, f"G0 {words('XYZ', point)}", f"o<say> call [{number}]", "G69"]
        result = harness.run([RUN], {"part.ngc": "\n".join([*lines, "M2"]) + "\n"}, ini=QUICK, record=False)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        found = said(result)
        self.assertEqual(sorted(found), list(range(len(cases))))
        for number, (commands, _, expected) in enumerate(cases):
            away = max(abs(got - wanted) for got, wanted in zip(found[number], expected, strict=True))
            self.assertLess(away, 1e-6, f"{commands}: {found[number]} instead of {expected}")

    def test_twelve_orders_about_turned_axes_and_twelve_about_fixed_ones(self):
        cases = []
        for kind, rotation in ((0, turned), (1, fixed)):
            for order in ORDERS:
                code = f"G68.2 P{kind} Q{''.join(map(str, order))} {words('XYZ', ORIGIN)} {words('IJK', ANGLES)}"
                cases.append(([code], POINT, ORIGIN + rotation(order, ANGLES) @ POINT))
        self.assertEqual(len(cases), 24)
        self.check(cases)

    def test_what_is_left_out_is_zero_and_the_order_is_313(self):
        self.check([
            # by hand: 10 along Z, tilted by 20 about X and turned by 30 about Z
            (["G68.2 X10 Y5 I30 J20 K-10"], (0, 0, 10), (11.71010072, 2.03801868, 9.39692621)),
            (["G68.2 P0 J90"], (0, 10, 0), (0, 0, 10)),
            (["G68.2 X1"], (1, 2, 3), (2, 2, 3)),
            (["G68.2 R90"], (10, 0, 0), (0, 10, 0)),
            # R turns in the plane, behind the angles
            (["G68.2 J90 R90"], (10, 0, 0), (0, 0, 10)),
            # where X points along Z, and angles about Z and X are the same turn
            (["G68.2 Q123 I30 J90 K40"], POINT, turned((1, 2, 3), (30, 90, 40)) @ POINT),
            (["G68.2 Q321 I30 J-90 K40"], POINT, turned((3, 2, 1), (30, -90, 40)) @ POINT),
            (["G68.2 Q321 I180 J180 K180"], POINT, POINT),
            # a plane takes the place of the one before
            (["G68.2 I50 J50", "G68.2 X1 J90"], (0, 10, 0), (1, 0, 10)),
        ])

    def test_a_plane_in_a_plane(self):
        first, second = turned((3, 1, 3), ANGLES), (40.0, 15.0, -55.0)
        plane = f"G68.2 {words('XYZ', ORIGIN)} {words('IJK', ANGLES)}"
        there = numpy.array([3, 4, -6])
        cases = []
        for kind, rotation in ((0, turned), (1, fixed)):
            for order in ((3, 1, 3), (1, 2, 3), (2, 3, 2)):
                code = f"G68.4 P{kind} Q{''.join(map(str, order))} {words('XYZ', there)} {words('IJK', second)} R20"
                cases.append(([plane, code], POINT, ORIGIN + first @ (there + rotation(order, second) @ about(3, 20) @ POINT)))
        # without a plane it is one, Q is 313, and another one comes into it
        cases.append((["G68.4 X1 J90", "G68.4 Z5"], (0, 10, 0), (1, -5, 10)))
        self.check(cases)

    def test_a_plane_belongs_to_the_work_offset(self):
        offset = numpy.array([30, 20, 10])
        rotation = about(3, 35) @ turned((3, 1, 3), ANGLES)
        self.check([([f"G68.2 {words('XYZ', ORIGIN)} {words('IJK', ANGLES)}"], POINT,
                     offset + about(3, 35) @ ORIGIN + rotation @ POINT)], ["G10 L2 P1 X30 Y20 Z10 R35"])
        self.check([(["G20", "G68.2 X1 J90"], (0, 1, 0), (25.4, 0, 25.4)),
                    (["G91", "G68.2 J90", "G90"], (0, 1, 0), (0, 0, 25.4))])

    def test_three_points_and_two_vectors(self):
        origin, second, third = (numpy.array(point, dtype=float) for point in ((10, 5, 2), (16, 8, 4), (9, 12, 7)))
        x = (second - origin) / numpy.linalg.norm(second - origin)
        z = numpy.cross(x, third - origin)
        z /= numpy.linalg.norm(z)
        axes = numpy.array([x, numpy.cross(z, x), z]).T
        points = [f"G68.2 P2 Q{number} {words('XYZ', point)}" for number, point in enumerate((origin, second, third), 1)]
        leaning = x + .05 * z
        self.check([
            (points, POINT, origin + axes @ POINT),
            ([f"G68.2 P2 Q0 {words('XYZ', ORIGIN)} R25", *points], POINT, ORIGIN + axes @ about(3, 25) @ POINT),
            ([f"G68.2 P3 Q1 {words('XYZ', ORIGIN)} {words('IJK', 3 * x)}", f"G68.2 P3 Q2 {words('IJK', 7 * z)}"], POINT,
             ORIGIN + axes @ POINT),
            # R, and an X that is 2.9 degrees off the plane
            ([f"G68.2 P3 Q1 {words('XYZ', ORIGIN)} {words('IJK', leaning)} R-15", f"G68.2 P3 Q2 {words('IJK', z)}"], POINT,
             ORIGIN + axes @ about(3, -15) @ POINT),
        ])


class WrongUse(unittest.TestCase):
    def test_each_is_an_error_with_what_to_write(self):
        wrong = [
            (["G68.2"], "G69 takes the plane away"),
            (["G68.2 P1 I10"], "G68.2 P1 needs Q"),
            (["G68.2 Q112 I10"], "Q112.000 is no order of three axes: write Q313"),
            (["G68.2 Q124 I10"], "is no order"),
            (["G68.2 Q312.5 I10"], "Q312.500 is no order"),
            (["G68.2 P4 Q1 X0 Y0 Z0"], "G68.2 has no P4.000"),
            (["G68.2 X1 D5"], "takes P, Q, X, Y, Z, I, J, K and R only"),
            (["G68.2 P2 X0 Y0 Z0"], "P2 needs Q, the number of its block"),
            (["G68.2 P2 Q2 X0 Y0 Z0"], "P2 begins with Q0 or Q1"),
            (["G68.2 P2 Q1 X0 Y0"], "P2 needs X, Y and Z in each of its blocks"),
            (["G68.2 P2 Q1 X0 Y0 Z0 R5"], "R in its block with Q0 only"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G68.2 P2 Q3 X0 Y5 Z0"], "P2 Q2 has to come first"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G68.2 P2 Q2 X5 Y5 Z5", "G68.2 P2 Q3 X10 Y10 Z10.001"], "lie on a line"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G68.2 P2 Q2 X0 Y0 Z0", "G68.2 P2 Q3 X1 Y2 Z3"], "or on one another"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G68.2 J10"], "P2 Q2 has to come first"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G0 X1", "G68.2 P2 Q2 X5 Y5 Z5"], "no move may stand between"),
            (["G68.2 P3 Q1 X0 Y0 Z0 I1 J0 K0", "G53.1"], "P3 Q2 is missing"),
            (["G68.2 P3 Q1 X0 Y0 Z0 I1 J0"], "P3 Q1 needs X, Y and Z, the origin, and I, J and K"),
            (["G68.2 P3 Q1 X0 Y0 Z0 I1 J0 K0", "G68.2 P3 Q2 I0 J0"], "P3 Q2 needs I, J and K"),
            (["G68.2 P3 Q1 X0 Y0 Z0 I0 J0 K0"], "has no length"),
            (["G68.2 P3 Q1 X0 Y0 Z0 I1 J0 K0", "G68.2 P3 Q2 I0.1 J0 K1"], "not at right angles: they are 5.711 degrees"),
            (["G69 X1"], "G69 takes no words"),
            (["G53.1 P1"], "G53.1 and G53.6 take no words"),
            (["G53.6 Q1"], "G53.1 and G53.6 take no words"),
            (["G68.4"], "G68.4 needs X, Y, Z, I, J, K or R"),
            (["G68.4 P1 I10"], "G68.4 P1 needs Q"),
            (["G68.4 P2 Q1 X0 Y0 Z0"], "G68.4 takes angles only"),
            (["G68.4 Q113 I10"], "Q113.000 is no order of three axes"),
            (["G68.4 X1 D5"], "takes P, Q, X, Y, Z, I, J, K and R only"),
            (["G68.2 P2 Q1 X0 Y0 Z0", "G68.4 J10"], "P2 Q2 is missing"),
            *(([f"{code} X1"], "Unknown g code used") for code in UNKNOWN),
            (["G43.4 H1 X5"], "G43.4 takes H only"),
            (["G43.4 H1"], "rotary axes that framekins knows"),
        ]
        steps: list[list] = [["mdi", "G21 G61.1 G17 G90"]]
        for number, (lines, _) in enumerate(wrong):
            steps += [["forget"], *(["mdi", line] for line in lines), ["sleep", 0.05], ["recall", str(number)],
                      ["mdi", "G0 X0"]]
        steps += [["forget"], ["mdi", "G41 D1"], ["mdi", "G68.2 J10"], ["recall", "compensation"], ["mdi", "G40"],
                  ["note", "end"], ["getp", "active", "framekins.active"]]
        result = harness.run(steps, ini=QUICK, record=False)
        self.assertIsNone(result.failure, result.log)
        for number, (lines, reason) in enumerate(wrong):
            self.assertIn(reason, "\n".join(result.answers[str(number)]), lines)
        self.assertIn("G40", "\n".join(result.answers["compensation"]))
        self.assertEqual(result.answers["active"], "FALSE")
        for joint in result.answers["end"]["joints"][:3]:
            self.assertAlmostEqual(joint, 0, places=9)


class AcrossPrograms(unittest.TestCase):
    def test_blocks_do_not_go_on_in_another_program(self):
        begin = "G21 G90\nG68.2 P2 Q1 X1 Y1 Z0\n"
        rest = "G68.2 P2 Q2 X5 Y1 Z0\nG68.2 P2 Q3 X1 Y5 Z0\n"
        steps = [["run", "PROGRAMS/begin.ngc"], ["sleep", 0.1], ["forget"], ["run", "PROGRAMS/rest.ngc"], ["sleep", 0.1],
                 ["recall", "rest"], ["run", "PROGRAMS/begin.ngc"], ["sleep", 0.1], ["run", "PROGRAMS/whole.ngc"],
                 ["run", "PROGRAMS/begin.ngc"], ["sleep", 0.1], ["run", "PROGRAMS/normal.ngc"],
                 # line by line in MDI
                 *(["mdi", line] for line in (begin + rest).splitlines()), ["getp", "active", "framekins.active"]]
        result = harness.run(steps, {"begin.ngc": begin + "M2\n", "rest.ngc": f"G21 G90\n{rest}G0 X1\nM2\n",
                                     "whole.ngc": f"{begin}{rest}G0 X1\nM2\n", "normal.ngc": "G21 G90\nG68.4 J10\nM2\n"},
                             ini=QUICK, record=False)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        self.assertIn("G68.2 P2 begins with Q0 or Q1", "\n".join(result.answers["rest"]))
        self.assertEqual(result.answers["active"], "TRUE")


class FiveAxes(unittest.TestCase):
    """On the sample with a tilting rotary table."""

    def run_steps(self, steps, *lines):
        text = "\n".join([MODES, *lines, "M2"]) + "\n"
        return harness.run(steps, {"part.ngc": text, "first.ngc": f"{MODES}\nT2 M6\nG0 X10 Y20 Z60 A15 C25\nM2\n"},
                           sample="framepath-xyzac", joints=5, axes="xyzac")

    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def test_no_joint_moves_at_any_of_them(self):
        result = self.run_steps(
            [["run", "PROGRAMS/first.ngc"], ["note", "before"], RUN, ["note", "after"]],
            "G43.4 H2", "G68.2 X10 Y5 I30 J20 K-10", "G43.4", "G68.2 P1 Q123 I5 J6 K7", "G69", "G68.2 P2 Q1 X0 Y0 Z0",
            "G68.2 P2 Q2 X5 Y1 Z1", "G68.2 P2 Q3 X1 Y6 Z2", "G68.2 P3 Q1 X1 Y2 Z3 I1 J0 K0", "G68.2 P3 Q2 I0 J-1 K5",
            "G69", "o<tool_centre_off> call", "G68.2 J30", "G43.4 H2", "G69", "o<tool_centre_off> call")
        self.good(result)
        rows = result.columns(*(f"joint.{n}" for n in range(5)))
        there = (10, 20, 60, 15, 25)
        reached = next(n for n, row in enumerate(rows) if max(abs(a - b) for a, b in zip(row, there, strict=True)) < 2e-6)
        for joint in range(5):
            places = [row[joint] for row in rows[reached:]]
            self.assertLess(max(places) - min(places), 2e-6, f"joint {joint} moved")

    def test_the_tool_stands_normal_to_the_plane(self):
        result = self.run_steps([RUN, ["note", "end"]], "T2 M6", "G43.4 H2", "G68.2 X10 Y5 I30 J20 K-10", "G0 X0 Y0 Z10",
                                "G53.1", "G1 X3 Y4 Z5")
        self.good(result)
        joints = result.answers["end"]["joints"]
        self.assertAlmostEqual(joints[3], -20, places=6)
        self.assertAlmostEqual(joints[4], -30, places=6)
        place = numpy.array([10, 5, 0]) + turned((3, 1, 3), (30, 20, -10)) @ [3, 4, 5]
        tip = on_the_table(list(place), -20, -30)
        for got, wanted in zip(joints[:3], [tip[0], tip[1], tip[2] + 20], strict=True):
            self.assertAlmostEqual(got, wanted, places=6)

    def test_g53_6_is_g53_1(self):
        lines = ["T2 M6", "G43.4 H2", "G68.2 X10 Y5 I30 J20 K-10", "G0 X0 Y0 Z10"]
        places = []
        for code in ("G53.1", "G53.6"):
            result = self.run_steps([RUN, ["note", "end"]], *lines, code, "G1 X3 Y4 Z5")
            self.good(result)
            places.append(result.answers["end"]["joints"][:5])
        for one, other in zip(*places, strict=True):
            self.assertAlmostEqual(one, other, delta=1e-12)

    def test_a_move_behind_g49_is_refused_by_name(self):
        for last in ("G49", "G43 H1"):
            with self.subTest(last):
                by_hand = [["forget"], ["mdi", last], ["mdi", "G0 X7"], ["sleep", 0.2], ["recall", "mdi"], ["note", "held"]]
                remedy = [["mdi", "o<tool_centre_off> call"], ["mdi", "G0 X7"], ["note", "again"]]
                result = self.run_steps([RUN, ["note", "end"], *by_hand, *remedy], "T2 M6", "G43.4 H2", "G1 X1", last, "G1 X5")
                self.assertIsNone(result.failure, result.log)
                text = "\n".join(result.errors)
                for part in ("the length of the tool", "G43.4", "o<tool_centre_off> call", "o<frame_refresh> call"):
                    self.assertIn(part, text, result.log)
                for name in ("end", "held"):
                    self.assertAlmostEqual(result.answers[name]["joints"][0], 1, places=6)
                # in MDI as well, and then as the message says
                self.assertIn("o<tool_centre_off> call", "\n".join(result.answers["mdi"]))
                self.assertAlmostEqual(result.answers["again"]["joints"][0], 7, places=6)

    def test_a_program_ends_the_tool_centre_point(self):
        result = self.run_steps([RUN, ["note", "end"]], "T2 M6", "G43.4 H2", "G1 X1 A10 C20", "o<tool_centre_off> call",
                                "G1 X5 Y6 Z7 A0 C0")
        self.good(result)
        for got, wanted in zip(result.answers["end"]["joints"], (5, 6, 7, 0, 0), strict=False):
            self.assertAlmostEqual(got, wanted, places=6)


if __name__ == "__main__":
    unittest.main()
