"""Moves that joints with limits cannot follow, in LinuxCNC itself: kinematics that turn to other joints on the way, and places
that no joints lead to. The machine stops before the move, and `framepath plan` refuses it in the same words."""

import unittest

from inner_machine import Machine
from test_inner_machines import DELTA, SCARA
from test_joint_limits import limited, peaks, planned, set_limits

DIMENSIONS = "".join(f"setp pumakins.{name} {value}\n" for name, value in
                     {"A2": 300, "A3": 50, "D3": 70, "D4": 400, "D6": 70}.items())

#: the shoulder passes behind the machine, where scarakins begins its turn
BEHIND = ["G1 X-350 Y200", "G1 X-400 Y100", "G1 X-400 Y-100"]


def wrist(*joints, tip=70):
    """An arm whose wrist has these joints."""
    return Machine("pumakins", (0, -20, -30, *joints), "XYZABC", DIMENSIONS + f"setp pumakins.D6 {tip}\n")


def program(lines, mode="G90"):
    return "\n".join([f"G21 G17 {mode} G94 G64 P0.05 F6000", *lines, "M2"]) + "\n"


class Refused(unittest.TestCase):
    def refused(self, machine, lines, *words, mode="G90", inner=None):
        """The error, where the machine stands then, and that no joint exceeds its limits until then."""
        joints = len(machine.home)
        steps = [*set_limits(joints), ["run", "PROGRAMS/part.ngc"], ["note", "end"]]
        result = machine.run(steps, {"part.ngc": program(lines, mode)}, inner=inner)
        said = [error for error in result.errors if all(word in error for word in words)]
        self.assertEqual((len(result.errors), len(said)), (1, 1), result.errors)
        # screens show no more
        self.assertLess(len(said[0]), 255)
        begin = next((row for row, line in enumerate(result.column("line")) if line > 0), 0)
        for joint in range(joints):
            for ratio, most in zip(peaks(result.commanded(joint)[begin:]), (1.002, 1.01, 1.1), strict=True):
                self.assertLessEqual(ratio, most, joint)
        with self.assertRaisesRegex(RuntimeError, f"part.ngc:{len(lines) + 1}: the planner refuses the move: .*{words[0]}"):
            planned(limited(machine, joints), program(lines, mode))
        return result.answers["end"]["position"]

    def test_a_turn_that_a_joint_goes_back(self):
        place = self.refused(SCARA, BEHIND, "joint 0, which has limits, would jump by -360", "at G53 X-400.0000", "line 4",
                             inner="inner=scarakins")
        self.assertGreater(place[1], 0)

    def test_a_wrist_that_turns_over(self):
        self.refused(wrist(0, 40, 0), ["G1 B-80"], "joint 3, which has limits, would jump by 180",
                     "A180.0000 B-43.3123 C0.0000", "line 2", mode="G91")

    def test_a_hole_in_the_reach(self):
        """scarakins answers for it all the same."""
        self.refused(SCARA, ["G1 X0 Y200", "G1 X0 Y-200"], "scarakins has no joints that lead to G53 X0.0000", "line 3")

    def test_an_arc_out_of_the_reach(self):
        lines = ["G1 X90 Y0", "G3 X90 Y0.001 I100 J0"]
        self.refused(DELTA, lines, "lineardeltakins has no joints that lead to G53 X", "line 3")


class Passed(unittest.TestCase):
    def test_beside_a_straight_wrist_the_machine_is_slow(self):
        machine = wrist(90, 0.1, -90, tip=0)
        result = machine.run([*set_limits(6), ["run", "PROGRAMS/part.ngc"], ["note", "end"]],
                             {"part.ngc": program(["G1 B-4"], "G91")})
        self.assertEqual(result.errors, [])
        begin = next(row for row, line in enumerate(result.column("line")) if line > 0)
        velocity, acceleration, _ = peaks(result.commanded(3)[begin:])
        self.assertGreater(velocity, 0.9)
        self.assertLessEqual(velocity, 1.002)
        self.assertLessEqual(acceleration, 1.01)

    def test_joints_without_limits_of_their_own_are_the_users_affair(self):
        result = SCARA.run([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": program(BEHIND)})
        self.assertEqual(result.errors, [])
        self.assertAlmostEqual(result.answers["end"]["position"][1], -100, places=6)


if __name__ == "__main__":
    unittest.main()
