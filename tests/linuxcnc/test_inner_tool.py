"""G43.4 and o<retract> before LinuxCNC's own kinematics in a running LinuxCNC: their types, and their tool."""

import math
import tempfile
import unittest

import pytest

import inner_machine
from inner_machine import Machine
from inner_modules import with_compiled
from test_inner_machines import BRIDGE, CLOSE, OWN, SCARA, TABLE, TILTING, InnerMachines

pytestmark = pytest.mark.thorough

TABLE_TYPES = "inner=xyzac-trt-kins tool_types=1"

#: with the tool below the head: 250 mm and its length
HEAD_HAL = """\
loadrt sum2 count=1
addf sum2.0 servo-thread
setp sum2.0.in1 250
net tool-z motion.tooloffset.z => sum2.0.in0
net pivot sum2.0.out => 5axiskins.pivot-length
"""
#: type 0 has the tool centre point, type 1 the axes
HEAD = Machine("5axiskins", (0, 0, 0, 0, 0, 0), "XYZBCW", HEAD_HAL, switches=True)
HEAD_TYPES = "inner=5axiskins tool_types=0"
#: one type only, with a head on B, a table on C
MIXED = Machine("maxkins", (0, 0, 0, 0, 0), "XYZBC")
MIXED_TYPES = "inner=maxkins tool_types=0"


def told(name, joints):
    """A line that says where the joints stand and which type is in force."""
    values = " ".join(f"#<_hal[joint.{number}.pos-cmd]>" for number in range(joints))
    return ["G4 P.1", "M66 E0 L0", f"(DEBUG, {name} #<_hal[framekins.inner-type-active]> {values})"]


#: a user's own, whose axes do not meet
BENT = Machine("bentkins", (0, 0, 0, 0, 0), "XYZBC")
#: an arm whose tool hangs down, but for 5 degrees
ARM = Machine("pumakins", (0, -90, 35, 0, 50, 0), "XYZABC")


class InnerTool(InnerMachines):
    def values(self, result, name):
        """What such a line has said: the type, and the joints."""
        lines = [text.split()[1:] for _, text in result.messages if text.split()[0] == name]
        self.assertEqual(len(lines), 1, result.log)
        kind, *joints = map(float, lines[0])
        return kind, joints

    def refused(self, machine, inner, words, *lines):
        result = machine.run_program(*lines, "G1 X10", inner=inner)
        self.assertIn(words, "\n".join(result.errors), result.log)
        return result


class ToolCentre(InnerTool):
    def test_a_table_is_switched_and_is_that_of_our_own(self):
        lines = ["G43.4 H1", "G1 X20 Y10 Z3 A20 C30", "X5 C40", "G43.4 H2", "G1 X20 Y10 Z3 A-10"]
        own = self.good(OWN.run_program(*lines))
        inner = self.good(TABLE.run_program(*lines, inner=TABLE_TYPES))
        self.near([TABLE.joints(inner)], [OWN.joints(own)], 1e-6)

    def test_no_joint_moves_and_the_types_are_those_of_the_list(self):
        codes = {"first": "G43.4 H1", "longer": "G43.4 H2", "again": "G43.4", "off": "o<tool_centre_off> call"}
        framed = ["o<trans> call [3] [4] [5]", "o<arot> call [10] [-20] [30]"]
        for before in (framed[:0], framed):
            lines = [*before, "G1 X5 Y4 A20 C30", *told("start", 5)]
            for name, code in codes.items():
                lines += [code, *told(name, 5)]
            result = self.good(TABLE.run_program(*lines, inner=TABLE_TYPES))
            _, start = self.values(result, "start")
            for name in codes:
                kind, joints = self.values(result, name)
                self.assertEqual(kind, 0 if name == "off" else 1)
                # what is told has six digits
                self.near([joints], [start], 1e-5)

    def test_a_head(self):
        lines = ["G1 X10 B10", "G43.4 H2", "G1 X10 Y5 Z-20 B30 C90", *told("turned", 6), "o<tool_centre_off> call",
                 *told("off", 6), "G91", "G1 X1"]
        result = self.good(HEAD.run_program(*lines, inner=HEAD_TYPES))
        kind, turned = self.values(result, "turned")
        # by hand: at B 30 the head leans against X, and C turns that against Y; the pivot is 290 above the tip
        side, above = 290 * math.sin(math.radians(30)), 290 * math.cos(math.radians(30))
        self.assertEqual(kind, 0)
        self.near([turned], [(10, 5 - side, -20 + above - 250, 30, 90, 0)], 1e-4)
        kind, off = self.values(result, "off")
        self.assertEqual(kind, 1)
        self.near([off], [turned], 1e-5)
        # now X is the joint alone
        self.near([HEAD.joints(result)], [(off[0] + 1, *off[1:])], 1e-4)

    def test_kinematics_with_one_type(self):
        result = self.good(MIXED.run_program("G43.4 H1", "G1 X5 B20", "o<rotary_zero> call", "G43.4 H2", "G1 Z1",
                                             "o<tool_centre_off> call", *told("off", 5), inner=MIXED_TYPES))
        self.assertEqual(self.values(result, "off")[0], 0)
        for code in ("G43.4 H2", "o<tool_centre_off> call"):
            self.refused(MIXED, MIXED_TYPES, "o<rotary_zero> call first", "G43.4 H1", "G1 B20", code)

    def test_a_length_that_lets_the_joints_jump_stops_the_next_move(self):
        for code in ("G49", "G43 H2"):
            for before in ((), ("o<trans> call [1] [2] [3]",)):
                lines = (*before, "G43.4 H1", "G1 X5 A30 C20", code, *told("jumped", 5))
                result = self.refused(TABLE, TABLE_TYPES, "write G43.4 in place of G43", *lines)
                self.near([TABLE.joints(result)], [self.values(result, "jumped")[1]], 1e-4)
        # what takes it over goes on, and at zero nothing jumps
        for lines in (("G1 A30 C20", "G43 H2", "o<frame_refresh> call"), ("G43 H2",), ("G49",)):
            self.good(TABLE.run_program("G43.4 H1", *lines, "G91", "G1 X1", inner=TABLE_TYPES))

    def test_a_suspended_frame_belongs_to_what_changes_and_stays_away(self):
        framed = ["o<trans> call [10] [0] [5]", "o<arot> call [0] [20] [0]"]
        zero, move = "G10 L2 P2 X1 Y2 Z3", "G1 X1 Y2 Z3"
        lines = ["G43.4 H1", *framed, "G1 X5 Y0 Z2", "o<frame_suspend> call"]
        refresh = f"{zero}\nG55\no<frame_refresh> call"
        for number, line in enumerate(("G43.4 H2", "o<tool_centre_off> call", "G43.4 H2", refresh)):
            lines += [line, f"o{number} if [#<_hal[framekins.active]> NE 0]", f"(ABORT, {number} brings it back)",
                      f"o{number} endif"]
        lines += ["G1 X4 Y0 Z30", *told("without", 5), "o<frame_resume> call", move]
        result = self.good(TABLE.run_program(*lines, inner=TABLE_TYPES))
        self.near([self.values(result, "without")[1]], [(5, 2, 73, 0, 0)], 1e-5)
        anew = self.good(TABLE.run_program("G43.4 H2", zero, "G55", *framed, move, inner=TABLE_TYPES))
        self.near([TABLE.joints(result)], [TABLE.joints(anew)], 1e-6)

    def test_a_tool_that_is_not_there_changes_nothing(self):
        bridge = Machine("5axiskins", (0,) * 6, "XYZBCW", "setp 5axiskins.pivot-length 250\n", switches=True)
        state = "(DEBUG, STATE #<_hal[framekins.inner-type-active]> #<_plane> #<_ccomp>)"
        for code, plane, words in (("G43.4 H7", 19, "Requested tool 7 not found"), ("G43.4 H-1", 17.1, "H-1 names no tool"),
                                   ("G43.4 H3", 17, "")):
            steps = [["mdi", f"G{plane}"], ["mdi", "G1 B20 F3000"], ["note", "before"], ["mdi", code], ["sleep", .3],
                     ["mdi", state], ["note", "after"], ["mdi", "G1 B0"], ["note", "end"]]
            result = bridge.run(steps, inner=HEAD_TYPES, record=False)
            self.assertIn(words, "\n".join(result.errors), result.log)
            self.assertEqual(len(result.errors), bool(words), result.log)
            said = [[float(word) for word in text.split()[1:]] for _, text in result.messages if text.startswith("STATE")]
            self.assertEqual(said, [[0, 10 * plane, 400]], result.log)
            self.near([bridge.joints(result, "after")], [bridge.joints(result, "before")], CLOSE)
            self.near([bridge.joints(result)], [(0,) * 6], CLOSE)

    def test_what_is_not_known_is_refused(self):
        self.refused(TABLE, "inner=xyzac-trt-kins", "as in tool_types=1", "G43.4 H1")

    def test_a_type_that_is_not_there_ends_the_program(self):
        result = TABLE.run([["run", "PROGRAMS/part.ngc"], ["mdi", "M68 E3 Q0"], ["mdi", "G1 X3 F3000"], ["note", "end"]],
                           {"part.ngc": "G43.4 H1\nG1 X10 F3000\nM2\n"}, inner="inner=xyzac-trt-kins tool_types=7")
        self.assertIn("framekins.inner-type = 7 is not taken by xyzac-trt-kins", "\n".join(result.errors), result.log)
        self.near([TABLE.joints(result)], [(3, 0, 0, 0, 0)], 1e-6)

    def test_the_output_is_the_one_that_is_linked(self):
        plain = inner_machine.SETTINGS
        try:
            inner_machine.SETTINGS = plain + "TYPE_OUTPUT = 13\n"
            self.refused(TABLE, TABLE_TYPES, "does not arrive by output 13", "G43.4 H1")
        finally:
            inner_machine.SETTINGS = plain


class Retract(InnerTool):
    def test_a_table_goes_up_by_z_alone(self):
        framed = ["G10 L2 P1 X10 Y5 Z2 R30", "o<trans> call [5] [-3] [8]", "o<arot> call [20] [-15] [40]",
                  "o<ascale> call [2] [2] [2]"]
        for before in (framed[:0], framed):
            lines = [*before, "G1 X5 Y4 Z3 A20 C30", *told("start", 5), "o<retract> call [60]"]
            result = self.good(TILTING.run_program(*lines, inner="inner=xyzac-trt-kins tool_types=0"))
            _, start = self.values(result, "start")
            self.near([TILTING.joints(result)], [(*start[:2], 60, *start[3:])], 1e-5)
            self.assertAlmostEqual(TILTING.joints(result)[2], 60, delta=1e-9)

    def test_it_is_that_of_our_own(self):
        lines = ["o<trans> call [5] [-3] [8]", "o<arot> call [20] [-15] [40]", "G20 G1 X.2 Y.3 Z.1 A20 C30 F1000",
                 "o<retract> call [2]"]
        own = self.good(OWN.run_program(*lines))
        self.assertAlmostEqual(OWN.joints(own)[2], 50.8, delta=1e-9)
        inner = self.good(TILTING.run_program(*lines, inner="inner=xyzac-trt-kins tool_types=0"))
        self.near([TILTING.joints(inner)], [OWN.joints(own)], CLOSE)

    def test_a_head_goes_along_the_tool(self):
        framed = ["o<trans> call [5] [-3] [8]", "o<arot> call [20] [-15] [40]"]
        for before in (framed[:0], framed):
            lines = [*before, "G1 X5 Y4 Z3 B30 C90", *told("start", 6), "G91", "o<retract> call [40]", "G1 X0"]
            result = self.good(BRIDGE.run_program(*lines, inner=HEAD_TYPES))
            _, start = self.values(result, "start")
            rise = 40 - start[2]
            self.assertGreater(abs(rise), 10)
            # by hand: at B 30 and C 90 the head leans against Y
            way = (start[0], start[1] - rise * math.tan(math.radians(30)), 40, *start[3:])
            self.near([BRIDGE.joints(result)], [way], 1e-4)
            self.assertAlmostEqual(BRIDGE.joints(result)[2], 40, delta=1e-9)

    def test_a_type_without_the_tool_centre_point_goes_up_by_z(self):
        result = self.good(TABLE.run_program("G1 X5 Y4 Z3 A20 C30", "o<retract> call [60]", inner=TABLE_TYPES))
        self.near([TABLE.joints(result)], [(5, 4, 60, 20, 30)], CLOSE)

    def test_what_cannot_be_drawn_back_is_refused(self):
        self.refused(BRIDGE, HEAD_TYPES, "lies level or points up", "G1 B88", "o<retract> call [50]")
        self.refused(SCARA, "inner=scarakins tool_types=0", "does not know how the kinematics behind framekins turn the tool",
                     "o<retract> call [50]")


class Described(InnerTool):
    """Heads that are found out, and arms that are not: what tool_axes= says of them."""

    FRAME = ("o<trans> call [5] [-3] [8]", "o<arot> call [0] [30] [0]", "o<arot> call [20] [0] [0]")

    def stands_normal(self, result):
        """By the angles that o<tool_normal> has left, and by hand: the frame turns by 30 about Y, and by 20 about the new X.
        The normal."""
        texts = [text.split()[1:] for _, text in result.messages if text.startswith("ANGLES")]
        self.assertEqual(len(texts), 1, result.log)
        slope, lean = math.radians(30), math.radians(20)
        normal = (math.sin(slope) * math.cos(lean), -math.sin(lean), math.cos(slope) * math.cos(lean))
        tilt, rotary = map(float, texts[0])
        tool = (math.sin(math.radians(tilt)) * math.cos(math.radians(rotary)),
                math.sin(math.radians(tilt)) * math.sin(math.radians(rotary)), math.cos(math.radians(tilt)))
        self.near([tool], [normal], 1e-6)
        return normal

    def test_a_head_of_a_user_whose_axes_do_not_meet(self):
        lines = [*self.FRAME, "o<tool_normal> call", "(DEBUG, ANGLES #<_tool_normal_tilt> #<_tool_normal_rotary>)",
                 "G1 X4 Y5 Z0", *told("start", 5), "o<retract> call [30]"]
        with tempfile.TemporaryDirectory() as folder:
            with_compiled(folder, "bentkins")
            for said in ("", "tool_axes=C,B"):
                result = self.good(BENT.run_program(*lines, inner=f"inner=bentkins tool_types=0 {said}", modules=folder))
                normal = self.stands_normal(result)
                _, start = self.values(result, "start")
                end = BENT.joints(result)
                rise = (30 - start[2]) / normal[2]
                self.near([end], [(start[0] + rise * normal[0], start[1] + rise * normal[1], 30, *start[3:])], 1e-4)
            result = BENT.run_program(*lines, inner="inner=bentkins tool_types=0 tool_axes=-C,B", modules=folder)
            self.assertIn("otherwise than tool_axes= says", "\n".join(result.errors), result.log)

    def test_an_arm_is_said(self):
        lines = ["G1 X350 Y100 Z50 A180 B0 C0", *self.FRAME, "o<tool_normal> call",
                 "(DEBUG, ANGLES #<_tool_normal_tilt> #<_tool_normal_rotary>)"]
        result = ARM.run_program(*lines, inner="inner=pumakins")
        self.assertIn("as in tool_axes=C,B", "\n".join(result.errors), result.log)
        result = self.good(ARM.run_program(*lines, inner="inner=pumakins tool_axes=C,B"))
        self.stands_normal(result)
        position = result.answers["end"]["position"]
        self.assertAlmostEqual(abs(position[3]), 180, places=6)
        # and leans where the third axis does, or is turned by one that carries the others
        self.refused(ARM, "inner=pumakins tool_axes=C,B", "A to 0 or 180, then o<tool_normal>", lines[0], "G1 A170", *lines[1:])
        self.refused(ARM, "inner=pumakins tool_axes=B,A", "bring B or C to 0 of the machine first", lines[0], "G1 C20",
                     *lines[1:])

    def test_nothing_that_turns_the_tool(self):
        lines = ["o<trans> call [1] [0] [0]", "o<tool_normal> call", "G1 X-1 Y0", "o<rot> call [0] [20] [0]", "o<tool_normal> call"]
        result = SCARA.run_program(*lines, inner="inner=scarakins tool_axes=none")
        self.assertIn("no rotary axis turns the tool", "\n".join(result.errors), result.log)


if __name__ == "__main__":
    unittest.main()
