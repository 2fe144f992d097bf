"""Machines with a tilting rotary table: against LinuxCNC's own kinematics, and with frames in LinuxCNC itself."""

import contextlib
import ctypes
import math
import os
import random
import unittest

import harness
from kinematics_host import Module

STOCK = "/usr/lib/linuxcnc/modules"
SAMPLE = "framepath-xyzac"

#: pins of the same name and meaning in both modules
DIMENSIONS = {"xyzac": ["x-rot-point", "y-rot-point", "z-rot-point", "y-offset", "z-offset", "tool-offset"],
              "xyzbc": ["x-rot-point", "y-rot-point", "z-rot-point", "x-offset", "z-offset", "tool-offset"]}


class AgainstStock(unittest.TestCase):
    """The same dimensions, the same joints: the same numbers."""

    def pair(self, machine):
        letters = machine.upper()
        stock = Module(os.path.join(STOCK, f"{machine}-trt-kins.so"), f"{machine}-trt-kins", coordinates=letters)
        for pin in DIMENSIONS[machine]:
            stock.find(pin, ctypes.c_double)
        with contextlib.suppress(KeyError):  # LinuxCNC 2.9 has one direction only
            stock.find("conventional-directions", ctypes.c_int)
        ours = Module(os.path.join(harness.MODULES, "framekins.so"), "framekins", coordinates=letters, machine=machine)
        for pin in DIMENSIONS[machine]:
            ours.find(pin, ctypes.c_double)
        for pin in ("conventional-directions", "in-position", "tool-centre-point", "parameters-pending"):
            ours.find(pin, ctypes.c_int)
        ours.set(in_position=1)
        return stock, ours

    def compare(self, machine, tool_centre_point):
        stock, ours = self.pair(machine)
        number, worst = random.Random(machine), 0.0
        for _ in range(300):
            for pin in DIMENSIONS[machine]:
                value = number.uniform(-300, 300)
                stock.pins[pin].value = value
                ours.pins[pin].value = value
            if "conventional-directions" in stock.pins:
                direction = number.randrange(2)
                stock.set(conventional_directions=direction)
                ours.set(conventional_directions=direction)
            ours.set(tool_centre_point=int(tool_centre_point))
            # stock: type 0 is the table, 1 the identity; ours takes both from the pin, at any switch
            self.assertEqual(stock.switch(0 if tool_centre_point else 1), 0)
            # motion has stood, asks for its place behind the switch, and moves from the next period on
            for _ in range(4):
                ours.update()
            self.assertEqual(ours.switch(0), 0)
            ours.forward([0.0] * 16)
            ours.update()
            for _ in range(20):
                values = [number.uniform(-400, 400) for _ in range(3)] + [number.uniform(-120, 120),
                                                                         number.uniform(-720, 720)]
                joints = values + [0.0] * 11
                expected, found = stock.forward(joints), ours.forward(joints)
                worst = max(worst, *(abs(a - b) for a, b in zip(expected, found, strict=True)))
                pose = found
                expected, back = stock.inverse(pose), ours.inverse(pose)
                worst = max(worst, *(abs(a - b) for a, b in zip(expected[:5], back[:5], strict=True)))
                worst = max(worst, *(abs(a - b) for a, b in zip(joints[:5], back[:5], strict=True)))
        self.assertLess(worst, 1e-9)

    def test_xyzac_with_the_tool_centre_point(self):
        self.compare("xyzac", True)

    def test_xyzac_without(self):
        self.compare("xyzac", False)

    def test_xyzbc_with_the_tool_centre_point(self):
        self.compare("xyzbc", True)

    def test_xyzbc_without(self):
        self.compare("xyzbc", False)

    def test_dimensions_wait_for_a_switch(self):
        _, ours = self.pair("xyzac")
        ours.set(tool_centre_point=1, z_rot_point=-50)
        ours.update()
        joints = [10.0, 20.0, 30.0, 40.0, 50.0] + [0.0] * 11
        pose = ours.forward(joints)
        self.assertNotAlmostEqual(pose[0], 10, places=3)
        ours.set(z_rot_point=77)
        ours.update()
        self.assertEqual(ours.forward(joints), pose)
        self.assertEqual(ours.pins["parameters-pending"].value, 1)
        # moving: refused, and nothing changes
        ours.set(in_position=0)
        self.assertEqual(ours.switch(0), 10)
        self.assertEqual(ours.forward(joints), pose)
        ours.set(in_position=1)
        self.assertEqual(ours.switch(1), 0)
        ours.update()
        self.assertNotEqual(ours.forward(joints), pose)
        self.assertEqual(ours.pins["parameters-pending"].value, 0)
        # no number: refused, the old dimensions stay
        pose = ours.forward(joints)
        for nonsense in (math.nan, math.inf, 1e300):
            ours.set(z_rot_point=nonsense)
            self.assertEqual(ours.switch(0), 15)
            ours.update()
            self.assertEqual(ours.forward(joints), pose)
            self.assertEqual(ours.pins["parameters-pending"].value, 1)


class Loading(unittest.TestCase):
    def refused(self, *words, **parameters):
        with self.assertRaises(Module.LoadError) as caught:
            Module(os.path.join(harness.MODULES, "framekins.so"), "framekins", **parameters)
        message = str(caught.exception)
        self.assertEqual(message.count("\n"), 1, message)
        for word in words:
            self.assertIn(word, message)

    def test_an_unknown_machine(self):
        self.refused("machine=hexapod", "machine=identity", "machine=xyzac", coordinates="XYZ", machine="hexapod")

    def test_a_machine_without_its_axes(self):
        self.refused("coordinates=XYZ", "xyzac needs X Y Z A C", coordinates="XYZ", machine="xyzac")
        self.refused("coordinates=XYZAC", "xyzbc needs X Y Z B C", coordinates="XYZAC", machine="xyzbc")

    def test_an_unknown_rule_for_the_tool_length(self):
        self.refused("tool_length=long", "tool_length=frame", "tool_length=machine", coordinates="XYZ",
                     tool_length="long")

    def test_an_identity_machine_has_no_pins_of_a_table(self):
        ours = Module(os.path.join(harness.MODULES, "framekins.so"), "framekins", coordinates="XYZ")
        for pin in ("tool-centre-point", "x-rot-point", "tilt-min"):
            with self.assertRaises(KeyError):
                ours.find(pin, ctypes.c_int)


def sample_number(section, key):
    """A number of the sample's INI."""
    path = os.path.join(harness.SAMPLES, "configs", SAMPLE, f"{SAMPLE}.ini")
    here = None
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split("=")
            if line.startswith("["):
                here = line.strip()
            elif here == f"[{section}]" and words[0].strip() == key:
                return float(words[1])
    raise KeyError(key)


def turned(vector, axis, degrees):
    """Right-handed about a coordinate axis (0 to 2)."""
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    result = list(vector)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    result[i], result[j] = c * vector[i] - s * vector[j], s * vector[i] + c * vector[j]
    return result


def on_the_table(point, a, c):
    """Where a point of the workpiece (all in machine coordinates) is when the table has turned, by the dimensions
    of the sample: first about C, then with C about A."""
    centre = [sample_number("TABLE", f"{k}_ROT_POINT") for k in "XYZ"]
    tilting = [centre[0], centre[1] + sample_number("TABLE", "Y_OFFSET"), centre[2] + sample_number("TABLE", "Z_OFFSET")]
    point = [p + q for p, q in zip(centre, turned([p - q for p, q in zip(point, centre, strict=True)], 2, c), strict=True)]
    return [p + q for p, q in zip(tilting, turned([p - q for p, q in zip(point, tilting, strict=True)], 0, a), strict=True)]


def frame_point(point, origin, x, y, z):
    """TRANS origin, ROT x y z."""
    return [o + p for o, p in zip(origin, turned(turned(turned(point, 0, x), 1, y), 2, z), strict=True)]


RUN = ["run", "PROGRAMS/part.ngc"]


def run(steps, *lines, **options):
    text = "\n".join(["G21 G61.1 G17 G90 G94 F3000", *lines, "M2"]) + "\n"
    return harness.run(steps, {"part.ngc": text}, sample=SAMPLE, joints=5, axes="xyzac", **options)


TOOL_CENTRE_POINT = ["M64 P0", "o<frame_refresh> call"]


class InLinuxCNC(unittest.TestCase):
    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def near(self, found, expected, places=6):
        for a, b in zip(found[:len(expected)], expected, strict=True):
            self.assertAlmostEqual(a, b, places=places, msg=f"{found} instead of {expected}")

    def test_the_tool_stands_normal_to_the_frame(self):
        length = 20.0
        corner = [7.0, 4.0, 0.0]
        result = run(
            [RUN, ["note", "end"]],
            *TOOL_CENTRE_POINT, "T2 M6", "G43", "o<frame_refresh> call",
            "G10 L2 P1 X30 Y20 Z10 A5 C-12", "o<trans> call [15] [-5] [8]", "o<arot> call [20] [-35] [50]",
            "G0 Z60", "G91", "G1 X1", "o<tool_normal> call",
            # relative as before, and no rapid move by accident
            "o10 if [[#<_incremental> NE 1] OR [#<_motion_mode> NE 10]]", "(ABORT, not G91 G1 any more)", "o10 endif",
            "G90", "G0 X7 Y4 Z30", "G1 Z0")
        self.good(result)
        joints = result.answers["end"]["joints"]
        a, c = joints[3], joints[4]
        # the frame's normal, once the table has turned, is the spindle's direction
        origin = [15.0 + 30.0, -5.0 + 20.0, 8.0 + 10.0]
        tip, above = (on_the_table(frame_point(p, origin, 20.0, -35.0, 50.0), a, c) for p in (corner, [7.0, 4.0, 1.0]))
        self.near([q - p for p, q in zip(tip, above, strict=True)], [0, 0, 1])
        # and the tip is where the program says: the spindle a tool's length above
        self.near(joints[:3], [tip[0], tip[1], tip[2] + length])

    def test_the_tip_stays_on_the_workpiece_while_the_table_turns(self):
        result = run([RUN, ["note", "end"]], *TOOL_CENTRE_POINT, "T2 M6", "G43", "o<frame_refresh> call",
                     "o<rot> call [0] [25] [0]", "G1 X5 Y6 Z7", "o<tool_normal> call", "o<frame_off> call", "G1 X5")
        self.good(result)
        # all the way: the tip, turned back, does not leave its place on the workpiece
        rows = result.columns("joint.0", "joint.1", "joint.2", "joint.3", "joint.4")
        moved = [row for row in rows if abs(row[3]) > 1e-6 and abs(row[3]) < 24.999]
        self.assertGreater(len(moved), 50)
        point = frame_point([5.0, 6.0, 7.0], [0, 0, 0], 0, 25, 0)
        for row in moved:
            tip = on_the_table(point, row[3], row[4])
            # LinuxCNC's cubic interpolator comes behind the kinematics
            self.near([row[0], row[1], row[2] - 20], tip, places=3)

    def test_what_cannot_be_reached_is_refused(self):
        result = run([RUN, ["note", "end"]], *TOOL_CENTRE_POINT, "o<rot> call [120] [0] [0]", "o<tool_normal> call",
                     "G1 X10")
        self.assertIn("cannot reach the normal", "\n".join(result.errors), result.log)
        self.near(result.answers["end"]["joints"], [0] * 5)

    def test_cutter_compensation_has_to_end_first(self):
        result = run([RUN], *TOOL_CENTRE_POINT, "o<rot> call [20] [0] [0]", "G41 D1", "o<tool_normal> call")
        self.assertIn("G40", "\n".join(result.errors), result.log)

    def test_limits_that_make_no_sense_are_refused(self):
        result = run([["setp", "framekins.tilt-min", "20"], ["setp", "framekins.tilt-max", "-20"], RUN],
                     *TOOL_CENTRE_POINT, "o<rot> call [20] [0] [0]", "o<tool_normal> call")
        self.assertIn("framekins.normal-refusal = 4", "\n".join(result.errors), result.log)

    def test_without_the_tool_centre_point_it_is_refused(self):
        result = run([RUN], "o<rot> call [20] [0] [0]", "o<tool_normal> call")
        self.assertIn("needs the tool centre point", "\n".join(result.errors), result.log)

    def test_a_new_tool_length_holds_the_machine_until_it_is_taken_over(self):
        result = run([["start", "PROGRAMS/part.ngc"], ["sleep", 2], ["getp", "pending", "framekins.parameters-pending"],
                      ["note", "held"], ["abort"]],
                     *TOOL_CENTRE_POINT, "T2 M6", "G43", "G1 X10")
        self.assertEqual(result.answers["pending"], "TRUE", result.log)
        self.assertIn("o<frame_refresh> call behind the change", "\n".join(result.errors))
        self.near(result.answers["held"]["joints"], [0] * 5)

    def test_linuxcnc_moves_the_tool_centre_point_as_by_hand(self):
        result = run([RUN, ["note", "end"]], *TOOL_CENTRE_POINT, "G1 X12 Y-7 Z30 A40 C70")
        self.good(result)
        joints = result.answers["end"]["joints"]
        self.near(joints, [*on_the_table([12.0, -7.0, 30.0], 40, 70), 40, 70])


class ThreeAxes(unittest.TestCase):
    """o<tool_normal> on a machine that cannot turn anything."""

    def run_program(self, *lines):
        return harness.run([RUN, ["note", "end"]],
                           {"part.ngc": "\n".join(["G21 G61.1 G17 G90 F3000", *lines, "M2"]) + "\n"})

    def test_nothing_has_to_be_done(self):
        result = self.run_program("o<rot> call [0] [0] [30]", "o<tool_normal> call", "G1 X10")
        self.assertEqual(result.errors, [], result.log)
        self.assertAlmostEqual(result.answers["end"]["joints"][1], 5, places=9)

    def test_a_tilted_frame_is_refused(self):
        result = self.run_program("o<rot> call [0] [30] [0]", "o<tool_normal> call", "G1 X10")
        self.assertIn("no table that framekins could tilt", "\n".join(result.errors), result.log)


if __name__ == "__main__":
    unittest.main()
