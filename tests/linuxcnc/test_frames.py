"""Frames on a running machine: what is refused, and that nothing moves then."""

import math
import unittest

import harness


def program(*lines):
    return {"part.ngc": "\n".join(["G21 G61.1 G17 G90 G94 F3000", *lines, "M2"]) + "\n"}


#: what goes along with command 77001 and value 5
CHECK = [["force", "framekins.check", math.sqrt(2) * 77001 + math.sqrt(3) * 5]]

RUN = ["run", "PROGRAMS/part.ngc"]


def travel(result):
    """The greatest distance that any joint covers in the recording."""
    return max(max(column) - min(column) for column in (result.column(f"joint.{n}") for n in range(3)))


class Refused(unittest.TestCase):
    def check(self, result, refusal, *words):
        text = "\n".join(result.errors) + result.log
        for word in words:
            self.assertIn(word, text)
        self.assertEqual(int(result.answers["refusal"]), refusal, text)

    def test_a_singular_frame(self):
        result = harness.run([RUN, ["getp", "refusal", "framekins.refusal"]],
                             program("o<scale> call [2] [0] [1]", "G1 X10"))
        self.check(result, 3, "frame was refused", "a scale factor is 0")
        self.assertLess(travel(result), 1e-9)

    def test_a_frame_too_large_to_be_meant(self):
        result = harness.run([RUN, ["getp", "refusal", "framekins.refusal"]],
                             program("o<trans> call [1000000000] [0] [0]", "G1 X10"))
        self.check(result, 4, "frame was refused", "larger than a machine")
        self.assertLess(travel(result), 1e-9)

    def test_the_old_frame_stays(self):
        result = harness.run([RUN, ["getp", "refusal", "framekins.refusal"], ["getp", "slot", "framekins.slot"],
                              ["note", "end"]],
                             program("o<trans> call [10] [20] [0]", "G1 X1 Y1", "o<ascale> call [0] [1] [1]"),
                             # a refusal ends the program, and by default that removes the frame
                             ini={("FRAMEPATH", "CLEAR_ON_ABORT"): "0"})
        self.check(result, 3, "frame was refused")
        self.assertEqual(result.answers["slot"], "1")
        joints = result.answers["end"]["joints"]
        self.assertAlmostEqual(joints[0], 11, places=9)
        self.assertAlmostEqual(joints[1], 21, places=9)

    def test_a_switch_in_mid_motion(self):
        # by hand, past the subroutines: the command pin gets a new number while the machine moves
        result = harness.run([
            ["force", "framekins.command", 0], ["force", "framekins.value.1", 5], *CHECK,
            ["mdi_start", "G1 X100 F3000"], ["wait_moving"], ["setp", "framekins.command", 77001], ["sleep", 0.2],
            ["getp", "refusal", "framekins.refusal"], ["getp", "active", "framekins.active"], ["finish"],
            ["note", "end"]])
        self.assertIsNone(result.failure, result.log)
        self.check(result, 10, "the machine moves")
        self.assertEqual(result.answers["active"], "FALSE")
        self.assertAlmostEqual(result.answers["end"]["joints"][0], 100, places=9)

    def test_a_switch_in_teleop(self):
        result = harness.run([
            ["force", "framekins.command", 0], ["force", "framekins.value.1", 5], *CHECK, ["teleop", True],
            ["setp", "framekins.command", 77001], ["sleep", 0.2], ["getp", "refusal", "framekins.refusal"],
            ["getp", "active", "framekins.active"]])
        self.assertIsNone(result.failure, result.log)
        self.check(result, 11, "teleop")
        self.assertEqual(result.answers["active"], "FALSE")
        self.assertLess(travel(result), 1e-9)

    def test_a_singular_map_by_hand(self):
        result = harness.run([
            ["mdi", "G0 X0"], ["halcmd", "unlinkp", "motion.switchkins-type"], ["setp", "framekins.map.zz", 0],
            ["setp", "motion.switchkins-type", 1], ["sleep", 0.2], ["getp", "refusal", "framekins.refusal"],
            ["getp", "active", "framekins.active"]])
        self.check(result, 7, "singular")
        self.assertEqual(result.answers["active"], "FALSE")
        self.assertLess(travel(result), 1e-9)

    def test_a_map_that_is_not_finite(self):
        result = harness.run([
            ["mdi", "G0 X0"], ["force", "framekins.command", 0], ["setp", "framekins.map.x", "nan"],
            ["force", "framekins.check", math.sqrt(2) * 77012], ["setp", "framekins.command", 77012],
            ["sleep", 0.2], ["getp", "refusal", "framekins.refusal"], ["getp", "active", "framekins.active"]])
        self.check(result, 2, "not a number")
        self.assertEqual(result.answers["active"], "FALSE")


class SoftLimits(unittest.TestCase):
    """The sample's joints go from -500 to 500."""

    def refused(self, result, joint, start):
        self.assertIn(f"the move would take joint {joint} to", result.log)
        self.assertIn("beyond its soft limit", result.log)
        # one message, and nothing was sent behind it
        self.assertEqual(len(result.errors), 1, result.errors)
        for value, expected in zip(result.answers["end"]["joints"][:len(start)], start, strict=True):
            self.assertAlmostEqual(value, expected, delta=1e-9)

    def test_in_the_middle_of_an_arc(self):
        result = harness.run([["mdi", "G0 X480 Y-50"], ["mdi", "G3 X480 Y50 I0 J50 F3000"], ["note", "end"]])
        self.refused(result, 0, (480, -50, 0))

    def test_in_the_middle_of_a_tilted_arc(self):
        # a quarter turn about Y: X of the program is -Z of the machine
        result = harness.run([["mdi", "o<rot> call [0] [90] [0]"], ["mdi", "G0 X480 Y-50"],
                              ["mdi", "G3 X480 Y50 I0 J50 F3000"], ["note", "end"]])
        self.refused(result, 2, (0, -50, -480))

    def test_an_arc_that_just_fits(self):
        result = harness.run([RUN, ["note", "end"]], program("G0 X449.9999 Y-50", "G3 X449.9999 Y50 I0 J50", "G0 X0 Y0"))
        self.assertEqual(result.errors, [], result.log)
        self.assertAlmostEqual(max(result.column("joint.0")), 499.9999, delta=2e-4)


class Maps(unittest.TestCase):
    def test_a_ready_map_by_hand(self):
        result = harness.run([
            ["mdi", "G0 X10 Y5"], ["halcmd", "unlinkp", "motion.switchkins-type"],
            ["setp", "framekins.map.xx", 0], ["setp", "framekins.map.xy", -1], ["setp", "framekins.map.x", 100],
            ["setp", "framekins.map.yx", 1], ["setp", "framekins.map.yy", 0],
            ["setp", "motion.switchkins-type", 1], ["sleep", 0.1], ["mdi", "G0 X20 Y30"], ["note", "end"]])
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        joints = result.answers["end"]["joints"]
        # a quarter turn, then shifted by 100
        self.assertAlmostEqual(joints[0], 100 - 30, places=9)
        self.assertAlmostEqual(joints[1], 20, places=9)

    def test_the_frame_turns_about_the_work_offset(self):
        result = harness.run([RUN, ["note", "end"]], program(
            "G10 L2 P2 X100 Y50 R90", "G55", "G92 X0 Y0", "G92.1", "o<rot> call [0] [0] [90]", "G1 X10 Y0"))
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        joints = result.answers["end"]["joints"]
        # the offset turns by 90 degrees, the frame by another 90: (10, 0) points to -X
        self.assertAlmostEqual(joints[0], 100 - 10, places=9)
        self.assertAlmostEqual(joints[1], 50, places=9)


if __name__ == "__main__":
    unittest.main()
