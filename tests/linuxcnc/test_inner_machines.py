"""framekins before LinuxCNC's own kinematics in a running LinuxCNC: the same joints without a frame, the right ones with it."""

import math
import unittest
from typing import ClassVar

import pytest

from inner_machine import Machine

pytestmark = pytest.mark.thorough

SCARA = Machine("scarakins", (45, -90, 150, 0, 0, 0), "XYZABC", "setp scarakins.D6 0\n")
BRIDGE = Machine("5axiskins", (0, 0, 0, 0, 0, 0), "XYZBCW")
DELTA = Machine("lineardeltakins", (math.sqrt(269 ** 2 - 130.25 ** 2) - 100,) * 3)
HEXAPOD = Machine("genhexkins", (29.7466,) * 6, "XYZABC", world_home="HOME = 0 0 20 0 0 0")
TABLE_HAL = """\
net tool-z motion.tooloffset.z => xyzac-trt-kins.tool-offset
setp xyzac-trt-kins.y-offset 20
setp xyzac-trt-kins.z-offset 10
setp xyzac-trt-kins.z-rot-point -50
"""
#: as LinuxCNC's sample has it: type 0 are the joints, type 1 is the tool centre point
TABLE = Machine("xyzac-trt-kins sparm=identityfirst", (0,) * 5, "XYZAC", TABLE_HAL, switches=True)
#: B carries A, which carries the workpiece
DOUBLE = Machine("xyzab_tdr_kins", (0,) * 5, "XYZAB", "setp xyzab_tdr_kins.x-offset -20\nsetp xyzab_tdr_kins.z-offset -10\n",
                 switches=True)
TILTING = Machine("xyzac-trt-kins", (0,) * 5, "XYZAC", TABLE_HAL)
OWN = Machine("framekins coordinates=XYZAC machine=xyzac", (0,) * 5, "XYZAC",
              TABLE_HAL.replace("xyzac-trt-kins", "framekins") + "setp framekins.tool-centre-point 1\n")

#: an arm with its wrist straight
WRIST = Machine("genserkins", (0, -30, -30, 0, 0, 0), "XYZABC", "".join(
    f"setp genserkins.{name} {value}\n" for name, value in {
        "ALPHA-1": -1.570796326, "A-2": 400, "D-2": 130, "A-3": 5, "ALPHA-3": -1.570796326, "D-3": 400,
        "ALPHA-4": 1.570796326, "ALPHA-5": -1.570796326, "D-5": 100, "A-0": 0, "ALPHA-0": 0, "D-0": 0, "A-1": 0, "D-1": 0,
        "ALPHA-2": 0, "A-4": 0, "D-4": 0, "A-5": 0}.items()))

WIDE = (-10000, 10000)

#: how far joints may be from those that they are compared with
CLOSE = 1e-9


class InnerMachines(unittest.TestCase):
    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        return result

    def near(self, found, expected, delta):
        """Row by row, with the first that differs."""
        for number, (row, other) in enumerate(zip(found, expected, strict=False)):
            if any(abs(a - b) > delta for a, b in zip(row, other, strict=True)):
                self.fail(f"row {number}: {row} instead of {other}")
        self.assertEqual(len(found), len(expected))


class WithoutAFrame(InnerMachines):
    """The same program by itself and behind framekins: every period is the same."""

    def is_the_same(self, machine, *lines):
        inner = f"inner={machine.kinematics.split()[0]}"
        alone, behind = (self.good(machine.run_program(*lines, inner=inner)) for inner in (None, inner))
        expected, found = machine.way(alone), machine.way(behind)
        self.assertGreater(len(expected), 200)
        # to the recorder's last digit
        self.near(found, expected, 0)

    def test_scara(self):
        self.is_the_same(SCARA, "G91", "G1 X-20 Y-30 C10", "G2 X20 Y0 I10 J5", "G1 Z-20", "G3 X-10 Y10 R30 Z5")

    def test_a_bridge_mill(self):
        self.is_the_same(BRIDGE, "G1 X20 Y10 Z-5 B20 C30", "G2 X40 Y10 I10 J0 B-10", "G1 X0 Y0 Z0 B0 C0 W3")

    def test_a_linear_delta(self):
        self.is_the_same(DELTA, "G91", "G1 X30 Y-10 Z20", "G2 X-10 Y20 R40", "G1 Z-15 X5")

    def test_a_hexapod(self):
        self.is_the_same(HEXAPOD, "G91", "G1 X1 Y-1 Z.5 A2", "G2 X-1 Y1 R2", "G1 B-3 C4")

    def test_a_table_that_is_switched(self):
        # a switch as the motion ends takes a pose on the way, and which one is a matter of time, by itself as well; the servo
        # thread may sleep through a shorter dwell
        self.is_the_same(TABLE, "G1 X10 Y20 Z-5", "G4 P.15", "M428", "G1 X20 A20 C40", "G2 X0 Y0 R30 C0", "G4 P.15", "M429",
                         "G1 X5 Y5 Z5 A0 C10")

    def test_a_table_that_is_switched_forty_times(self):
        # what was read too early would be a wrong place for the next relative move
        self.is_the_same(TABLE, "G91", "o1 repeat [20]", "G4 P.15", "M428", "G1 X.1 A.5 C1", "G4 P.15", "M429",
                         "G1 X-.3 Y.1 C.5", "o1 endrepeat")


class WithAFrame(InnerMachines):
    def test_it_is_that_of_our_own_machine(self):
        lines = ["G43.1 Z15", "o<frame_refresh> call", "G10 L2 P1 X10 Y5 Z2", "o<trans> call [5] [-3] [8]",
                 "o<arot> call [20] [-15] [40]", "G1 X20 Y10 Z3", "G2 X30 Y0 I2 J-8 A15 C30",
                 "o<ascale> call [1.5] [1.5] [1.5]", "G1 X10 Y-10 Z5 A-10 C80", "o<frame_off> call", "G1 X0 Y0 Z0"]
        own = self.good(OWN.run_program(*lines))
        inner = self.good(TILTING.run_program(*lines, inner="inner=xyzac-trt-kins tool_types=0"))
        self.assertGreater(len(OWN.way(own)), 1000)
        self.near(TILTING.way(inner), OWN.way(own), CLOSE)

    def test_the_tool_is_turned_by_the_frame_unless_the_kinematics_do(self):
        lines = ["G43.1 Z30", "o<trans> call [300] [200] [500]", "o<arot> call [0] [90] [0]", "G1 X0 Y0 Z0"]
        # a tool along Z that is turned about Y lies along X; or it stays
        for types, along in (("", 30), ("tool_types=0", 0)):
            result = self.good(SCARA.run_program(*lines, inner=f"inner=scarakins {types}"))
            elbow = math.radians(SCARA.joints(result)[1])
            reach = math.hypot(340 + 250 * math.cos(elbow), 250 * math.sin(elbow))
            self.assertAlmostEqual(reach, math.hypot(300 + along, 200), places=6)

    def test_a_shift_that_is_larger_than_the_machine(self):
        """Kinematics that iterate begin where the machine is, and not at a position of another frame."""
        plain = self.good(HEXAPOD.run_program("G1 X1 Y1", "G2 X2 Y0 R3", "G1 X0 Y0 A5"))
        lines = ["o<trans> call [100] [-200] [50]", "G1 X-99 Y201", "G2 X-98 Y200 R3", "G1 X-100 Y200 A5", "o<frame_off> call",
                 "G1 A5"]
        framed = self.good(HEXAPOD.run_program(*lines, inner="inner=genhexkins"))
        self.near([HEXAPOD.joints(framed)], [HEXAPOD.joints(plain)], 1e-6)

    def test_the_type_changes_in_a_frame(self):
        lines = ["o<trans> call [10] [0] [0]", "o<arot_rpl> call [90]", "G1 X5 Y0", "G4 P.02", "M68 E3 Q1", "M66 E0 L0",
                 "o1 if [#<_hal[framekins.inner-type-active]> NE 1]", "(ABORT, not switched)", "o1 endif", "G1 C90", "G1 X7",
                 "o<frame_off> call"]
        result = self.good(TABLE.run_program(*lines, inner="inner=xyzac-trt-kins tool_types=1"))
        # 10 to the right and 7 up on the workpiece, which has turned
        self.near([TABLE.joints(result)], [(-7, 10, 0, 0, 90)], 1e-6)

    def test_the_tool_is_put_normal_to_the_frame_on_a_table(self):
        lines = ["G43.1 Z15", "o<frame_refresh> call", "G10 L2 P1 X10 Y5 Z2 C20", "G1 X20 Y10 Z3 C15",
                 "o<trans> call [5] [-3] [8]", "o<arot> call [20] [-15] [40]", "o<tool_normal> call", "G1 X20 Y10 Z3"]
        own = self.good(OWN.run_program(*lines))
        inner = self.good(TILTING.run_program(*lines, inner="inner=xyzac-trt-kins tool_types=0"))
        self.near([TILTING.joints(inner)], [OWN.joints(own)], CLOSE)
        self.assertGreater(abs(OWN.joints(own)[3]), 20)

    def test_the_tool_is_put_normal_to_the_frame_by_a_head(self):
        lines = ["G1 X20 Y10 Z-5 B5 C3 W2", "o<trans> call [50] [40] [-30]", "o<arot> call [0] [30] [0]",
                 "o<arot> call [20] [0] [0]", "o<tool_normal> call", "G1 X0 Y0 Z0", "G91 G1 Z10"]
        result = self.good(BRIDGE.run_program(*lines, inner="inner=5axiskins tool_types=0"))
        x, y, z, b, c, w = BRIDGE.joints(result)
        # by hand: the turn by 30 about Y, then by 20 about the new X, puts Z there
        slope, lean = math.radians(30), math.radians(20)
        normal = (math.sin(slope) * math.cos(lean), -math.sin(lean), math.cos(slope) * math.cos(lean))
        # of the two ways to point there the nearer one; the head leans against X at B > 0
        self.near([(b, c)], [(-math.degrees(math.acos(normal[2])), math.degrees(math.atan2(normal[1], normal[0])))], 1e-6)
        # the pivot is 250 + W above the tip, along the tool
        pivot = [10 * along + start + 252 * along for start, along in zip((50, 40, -30), normal, strict=True)]
        self.near([(x, y, z, w)], [(pivot[0], pivot[1], pivot[2] - 250, 2)], 1e-6)

    def test_the_tool_is_put_normal_to_the_frame_on_a_double_table(self):
        lines = ["M428", "G1 X5 Y4 A3 B2", "o<trans> call [5] [6] [7]", "o<arot> call [20] [0] [0]",
                 "o<arot> call [0] [30] [0]", "G1 X1 Y2 Z3", "o<tool_normal> call", "G4 P.02", "M66 E0 L0",
                 "(DEBUG, AT #<_hal[joint.0.pos-cmd]> #<_hal[joint.1.pos-cmd]>)", "G91 G1 Z10"]
        result = self.good(DOUBLE.run_program(*lines, inner="inner=xyzab_tdr_kins tool_types=1"))
        before = next(text.split()[1:] for _, text in result.messages if text.startswith("AT "))
        x, y, _, a, b = DOUBLE.joints(result)
        # what moves along the tool moves the joint Z alone; the frame is undone turn by turn
        self.near([(x, y)], [tuple(map(float, before))], 1e-4)
        self.near([(abs(a), abs(b))], [(20, 30)], 1e-6)

    def test_what_cannot_be_turned_is_refused(self):
        turned = ["o<rot> call [0] [20] [0]"]
        for machine, lines, said in (
                (SCARA, ["o<trans> call [1] [0] [0]", "o<tool_normal> call"],
                 "cannot find out how the kinematics behind framekins turn the tool"),
                (TABLE, [*turned, "o<tool_normal> call"],
                 "no rotary axis turns the tool with the type that the kinematics have"),
                (TILTING, ["o<tool_normal> call"], "needs a frame behind inner=")):
            kinematics = machine.kinematics.split()[0]
            result = machine.run_program(*lines, "G1 X10", inner=f"inner={kinematics} tool_types={machine is not TILTING:d}")
            self.assertIn(said, "\n".join(result.errors), result.log)
            self.near([machine.joints(result)], [machine.home], CLOSE)

    def test_a_type_that_is_not_there_holds_the_machine(self):
        # by hand motion is in teleop mode, where no type changes
        result = TABLE.run([["mdi", "G1 X0 F3000"], ["force", "framekins.inner-type", "7"], ["sleep", 0.3],
                            ["mdi_start", "G1 X10 F3000"], ["sleep", 1],
                            ["note", "held"], ["force", "framekins.inner-type", "0"], ["sleep", 0.3],
                            ["mdi", "G1 X3 F3000"], ["note", "end"]], inner="inner=xyzac-trt-kins", record=False)
        self.assertIn("framekins.inner-type = 7 is not taken by xyzac-trt-kins", "\n".join(result.errors))
        # the move does not wait for ever
        self.assertIn("the type on framekins.inner-type is not in force", "\n".join(result.errors))
        self.assertNotIn("Inverse BAD", result.log)
        self.near([TABLE.joints(result, "held"), TABLE.joints(result)], [(0,) * 5, (3, 0, 0, 0, 0)], CLOSE)

    def test_an_axis_that_is_not_there(self):
        lathe = Machine("trivkins coordinates=XZ", (0, 0), "XZ", joint_0=WIDE, joint_1=WIDE)
        lines = ["o<rot> call [0] [0] [30]", "G1 X10"]
        result = lathe.run_program(*lines, inner="inner=trivkins")
        self.assertIn("framekins.refusal = 14", "\n".join(result.errors), result.log)


class OtherJoints(InnerMachines):
    """Behind maxkins, which leads from joints to a place and from there to other joints where B and C are both turned, and
    behind arms that are straight."""

    LONG = "setp maxkins.pivot-length 150\n"

    def test_a_frame_that_would_turn_a_straight_wrist_over_is_refused(self):
        for frame in ("o<rot> call [0] [0] [30]", "o<trans> call [10] [5] [-5]"):
            steps = [["mdi", "F1000"], ["note", "before"], ["mdi", frame], ["sleep", 0.3], ["note", "after"],
                     ["getp", "active", "framekins.active"]]
            result = WRIST.run(steps, inner="inner=genserkins")
            self.assertIsNone(result.failure, result.log)
            self.assertIn("an arm with its wrist bent", "\n".join(result.errors), result.log)
            self.assertEqual(result.answers["active"], "FALSE", frame)
            self.near([WRIST.joints(result, "after")], [WRIST.joints(result, "before")], 0)
            self.near(WRIST.way(result), [], 0)

    def test_a_stretched_arm_takes_frames(self):
        stretched = Machine("scarakins", (0, 0, 150, 0, 0, 0), "XYZABC", SCARA.hal)
        for frame in ("o<trans> call [-10] [0] [0]", "o<rot> call [0] [0] [30]"):
            steps = [["mdi", "F3000"], ["note", "before"], ["mdi", frame], ["sleep", 0.3], ["note", "after"],
                     ["getp", "active", "framekins.active"], ["mdi", "o<frame_off> call"], ["note", "end"]]
            result = self.good(stretched.run(steps, inner="inner=scarakins"))
            self.assertEqual(result.answers["active"], "TRUE", frame)
            for name in ("after", "end"):
                self.near([stretched.joints(result, name)], [stretched.joints(result, "before")], 1e-5)

    def test_a_frame_where_joints_would_jump_is_refused(self):
        machine = Machine("maxkins", (0,) * 6, "XYZABC", self.LONG)
        steps = [["mdi", "F1000"], ["mdi", "G1 B10 C20"], ["mdi", "G1 X10 Y-20 Z5"], ["note", "before"], ["forget"],
                 ["mdi", "o<atrans> call [1] [2] [3]"], ["sleep", 0.3], ["recall", "refused"], ["note", "after"],
                 # where they agree, and back there
                 ["mdi", "G1 B0"], ["mdi", "o<atrans> call [1] [2] [3]"], ["mdi", "G1 B10"], ["note", "in it"], ["forget"],
                 ["abort"], ["sleep", 0.5], ["recall", "stays"], ["note", "aborted"], ["mdi", "G1 B0"], ["sleep", 0.3],
                 ["getp", "active", "framekins.active"]]
        result = machine.run(steps, inner="inner=maxkins tool_types=0")
        self.good(result)
        for name in ("refused", "stays"):
            text = "\n".join(result.answers[name])
            self.assertIn("lead back from where the machine is to other joints, which would jump", text)
            self.assertIn("maxkins with B or C at 0", text)
        self.near([machine.joints(result, "after")], [machine.joints(result, "before")], CLOSE)
        self.near([machine.joints(result, "aborted")], [machine.joints(result, "in it")], CLOSE)
        self.assertEqual(result.answers["active"], "FALSE")
        rows = result.columns(*(f"joint.{joint}" for joint in range(6)))
        step = max(abs(a - b) for row, after in zip(rows, rows[1:], strict=False) for a, b in zip(row, after, strict=True))
        # the fastest of the machine in a period
        self.assertLess(step, 1)

    def test_no_program_starts_in_a_frame_that_cannot_go(self):
        machine = Machine("maxkins", (0,) * 6, "XYZABC", self.LONG)
        programs = {"leave.ngc": "G90 F3000\no<trans> call [100] [0] [0]\nG1 B20 C30 X5\nM2\n",
                    "next.ngc": "G90 F3000\nG1 X20 Y0 Z0\nM2\n"}
        starts = 8
        start: list[list] = [["start_at_once"], ["sleep", 0.3], ["finish"]]
        steps: list[list] = [["forget"], ["run", "PROGRAMS/leave.ngc"], ["open", "PROGRAMS/next.ngc"], ["sleep", 1.5],
                             ["note", "before"], *start * starts, ["recall", "errors"], ["note", "after"]]
        # behind a touch off rotary axes still lead to where it can go
        steps += [["mdi", "G10 L20 P1 X0"], ["mdi", "G0 C0"], ["sleep", 0.5], ["getp", "active", "framekins.active"]]
        result = machine.run(steps, programs, inner="inner=maxkins tool_types=0")
        self.assertIsNone(result.failure, result.log)
        # the touch off outlives its frame
        self.assertEqual(len(result.errors), 1, result.errors)
        self.assertIn("was set in a frame that is gone now", result.errors[0])
        texts = result.answers["errors"]
        stopped = [text for text in texts if "a frame was still active when the program started" in text]
        self.assertEqual(len(stopped), starts, texts)
        self.assertTrue(all("it cannot go" in text and "G0 B0 or G0 C0" in text for text in stopped), texts)
        self.near([machine.joints(result, "after")], [machine.joints(result, "before")], 1e-9)
        self.assertEqual(result.answers["active"], "FALSE")


class ExtraJoints(InnerMachines):
    """A joint of motion that the kinematics do not move, num_extrajoints of motmod."""

    def run_with_one(self, kinematics):
        machine = Machine(kinematics, (0,) * 5, "XYZ", motion="num_extrajoints=1", joint_4=WIDE)
        return machine.run_program("o<rot> call [0] [0] [90]", "G1 X10 Y0"), machine

    def test_the_letters_are_those_of_the_other_joints(self):
        result, machine = self.run_with_one("framekins coordinates=XYYZ")
        self.near([machine.joints(self.good(result))], [(0, 10, 10, 0, 0)], 1e-9)
        with self.assertRaises(RuntimeError) as caught:
            self.run_with_one("framekins coordinates=XYYZA")
        self.assertIn("names 5 joints, [KINS]JOINTS = 5: 1 of these beside the kinematics", str(caught.exception))


class SoftLimits(InnerMachines):
    """On the way of moves, in a frame: as without one, from the joints of before."""

    FRAME: ClassVar = ["mdi", "o<rot> call [0] [0] [30]"]

    def errors(self, machine, *moves):
        steps = [self.FRAME, *(["mdi", move] for move in moves)]
        return machine.run(steps, inner=f"inner={machine.kinematics}", record=False)

    def scara(self, limit):
        return Machine("scarakins", (45, -90, 150, 0, 0, 0), "XYZABC", "setp scarakins.D6 0\n", joint_1=(limit, 10))

    def test_an_arc_that_bends_the_elbow_too_far(self):
        result = self.errors(self.scara(-92), "G91 G2 X0 Y0 I-20 J0 F6000")
        said = [error for error in result.errors if "the move would take joint 1 to" in error]
        self.assertEqual((len(said), len(result.errors)), (1, 1), result.errors)

    def test_an_arc_that_fits(self):
        # with the elbow on the other side it would not
        self.assertEqual(self.errors(self.scara(-170), "G91 G2 X0 Y0 I-20 J0 F6000").errors, [])

    def test_kinematics_that_count_are_not_asked(self):
        rose = Machine("rosekins", (50, 0, 0))
        result = self.errors(rose, "o<frame_off> call", "G3 X50 Y0 I-50 J0 F6000")
        self.assertEqual(sum("rosekins cannot be asked" in line for line in result.log.splitlines()), 1, result.log)


if __name__ == "__main__":
    unittest.main()
