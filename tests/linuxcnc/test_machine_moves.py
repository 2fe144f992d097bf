"""Moves of the machine's own axes from programs, and the modes that they leave behind."""

import unittest

import pytest

import harness
from test_gcode import QUICK

RUN = ["run", "PROGRAMS/part.ngc"]

#: the motion mode and the feed mode, as LinuxCNC's interpreter has them
SHOW = "(DEBUG, MODES #<_motion_mode> #<_feed> #<_inverse_time> #<_units_per_rev> #<_incremental> #<_lathe_diameter_mode>)"


class Case(unittest.TestCase):
    def good(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        return result

    def modes(self, result):
        return [tuple(float(word) for word in text.split()[1:]) for _, text in result.messages if text.startswith("MODES")]

    def at(self, result, name, *joints):
        for found, expected in zip(result.answers[name]["joints"], joints, strict=False):
            self.assertAlmostEqual(found, expected, places=5, msg=f"{name}: {result.answers[name]['joints']}")


class Modes(Case):
    """G79, `o<machine_move>`, `o<retract>` and `o<rotary_zero>` in every mode of motion and feed."""

    def test_without_a_feed(self):
        text = f"G21 G90 G17\nG79 Z5\n{SHOW}\nG0 X5\nG79 X6\n{SHOW}\nM2\n"
        # M2 leaves G1 behind, so that the second time the mode is that
        result = self.good(harness.run([RUN, RUN, ["note", "end"]], {"part.ngc": text}, ini=QUICK, record=False))
        self.at(result, "end", 6, 0, 5)
        self.assertEqual([mode[:2] for mode in self.modes(result)], [(800, 0), (0, 0), (10, 0), (0, 0)])

    def test_what_was_is_left_behind(self):
        moves = ("G79 Z5", "o<machine_move> call [1] [2] [3]", "o<retract> call [7]")
        lines, expected = ["G21 G90 G17 G8 F500"], []
        for move in moves:
            for begin, modes in (("G94 G1 F500 X1", (10, 500, 0, 0, 0, 0)), ("G0 X0", (0, 500, 0, 0, 0, 0)),
                                 ("G93 G1 X2 F60", (10, None, 1, 0, 0, 0)), ("G95 F.2", (10, .2, 0, 1, 0, 0)),
                                 ("G94 F300 G91 G1 X1", (10, 300, 0, 0, 1, 0)), ("G90 G7", (10, 300, 0, 0, 0, 1)),
                                 ("G8 G80", (800, 300, 0, 0, 0, 0)), ("G2 X0 Y0 R50", (800, 300, 0, 0, 0, 0))):
                lines += [begin, move, SHOW]
                expected.append(modes)
        result = self.good(harness.run([RUN], {"part.ngc": "\n".join([*lines, "M2"]) + "\n"}, ini=QUICK, record=False))
        found = self.modes(result)
        self.assertEqual(len(found), len(expected))
        for modes, wanted in zip(found, expected, strict=True):
            self.assertEqual([mode for mode, one in zip(modes, wanted, strict=True) if one is not None],
                             [one for one in wanted if one is not None])

    def test_an_abort_on_the_way_leaves_what_was(self):
        steps: list[list] = [["mdi", "G21 G90 G94 G61 F3000"]]
        for move in ("o<retract> call [400]", "G79 Z-400"):
            steps += [["mdi", "G90 G0 X0 Y0 Z0"], ["mdi", "o<trans> call [0] [0] [5]"], ["mdi", "G91 G1 X1"], ["mdi_start", move],
                      ["wait_moving"], ["sleep", 0.3], ["abort"], ["mdi", SHOW]]
        result = self.good(harness.run(steps, record=False))
        self.assertEqual(self.modes(result), [(10, 3000, 0, 0, 1, 0)] * 2)

    def test_five_axes_in_inverse_time(self):
        text = "\n".join(["G21 G90 G17", "G43.4 H1", "G0 X0 Y0 Z50", "G93 G1 X1 F60", "G68.2 X1 Y2 I10 J20 K0", "G53.1", SHOW,
                          "G1 X2 F60", "G69", "o<rotary_zero> call", SHOW, "G1 X3 F60", "G94", "M2"]) + "\n"
        result = self.good(harness.run([RUN], {"part.ngc": text}, sample="framepath-xyzac", joints=5, axes="xyzac", record=False))
        self.assertEqual([(mode[0], mode[2]) for mode in self.modes(result)], [(10, 1), (10, 1)])


@pytest.mark.thorough
class BackInTheFrame(Case):
    """The move behind one of the machine waits for the next, or for a spindle, while the codes in force are still those of the
    move before, which a probing move keeps to its end: neither blendtp nor frame_guard takes it for a move of the machine."""

    MOVES = ("G79 X1 Y2 Z3", "o<machine_move> call [1] [2] [3]", "o<retract> call [9]",
             "o<frame_suspend> call\nG28\no<frame_resume> call")
    BEGIN = "G21 G90 G17 G61 F6000\no<trans> call [7] [-3] [4]\no<arot> call [30] [20] [10]\n"
    PLANNERS: dict = {
        "blendtp": ({}, None),
        "tpmod": ({("TRAJ", "TPMOD"): "tpmod", ("HAL", "HALFILE"): "framepath-sim.hal"},
                  lambda text: "\n".join(line for line in text.splitlines() if "blendtp" not in line) + "\n"),
    }

    def test_the_next_move_is_none_of_the_machine(self):
        lines = [f"G1 X{3 + turn % 3} Y2 Z1\n{move}\n" for turn in range(8) for move in self.MOVES]
        texts = {"many": f"{self.BEGIN}{''.join(lines)}G1 X3 Y2 Z1\nM66 E0 L0\n",
                 "spindle": f"{self.BEGIN}G1 X3 Y2 Z1\nG79 X1 Y2 Z3\nM3 S100\nG1 X3 Y2 Z1\nM66 E0 L0\n",
                 "probe": f"G53 G0 X0 Y0 Z9\n{self.BEGIN}" + "\n".join(
                     f"{move}\nG38.3 X20 Y20 Z20 F600\nG1 X3 Y2 Z1" for move in ("", *self.MOVES)) + "\n",
                 "wrong": f"{self.BEGIN}G1 X3 Y2 Z1\nG53 G0 X40\n"}
        for planner, (ini, edit) in self.PLANNERS.items():
            with self.subTest(planner):
                result = harness.run(
                    [["run", "PROGRAMS/many.ngc"], ["setp", "spindle.0.at-speed", 0], ["start", "PROGRAMS/spindle.ngc"],
                     ["expect", "spindle.0.on", "TRUE"], ["sleep", 0.3], ["setp", "spindle.0.at-speed", 1], ["finish"],
                     ["recall", "right"], ["forget"], ["run", "PROGRAMS/probe.ngc"], ["expect", "framekins.active", "FALSE"],
                     ["recall", "probe"], ["forget"], ["run", "PROGRAMS/wrong.ngc"], ["expect", "framekins.active", "FALSE"],
                     ["recall", "wrong"]],
                    {f"{name}.ngc": f"{text}o<frame_off> call\nM2\n" for name, text in texts.items()}, ini={**QUICK, **ini},
                    edit_hal=edit, record=False)
                self.good(result)
                # LinuxCNC's planner may end a program for another reason, see docs/promises.md
                race = {"Queue is not empty after external input"} if planner == "tpmod" else set()
                self.assertEqual(set(result.answers["right"]) - race, set())
                self.assertNotRegex("\n".join(result.answers["probe"]), "G53|G28")
                self.assertIn("G53", "\n".join(result.answers["wrong"]))


class Lathe(Case):
    def test_x_is_a_diameter_in_a_code_and_a_radius_in_a_call(self):
        steps: list[list] = [["mdi", "G18 G7"]]
        for name, line in (("code", "G79 X20"), ("call", "o<machine_move> call [8] [0] [3]"), ("own", "G53 G0 X20"),
                           ("radius", "G8 G79 X20")):
            steps += [["mdi", line], ["note", name]]
        steps += [["forget"], ["mdi", "o<machine_move> call [8] [1] [0]"], ["sleep", 0.05], ["recall", "Y"]]
        result = self.good(harness.run(steps, sample="framepath-lathe", joints=2, axes="xz", record=False))
        self.at(result, "code", 10)
        self.at(result, "call", 8, 3)
        self.at(result, "own", 10)
        self.at(result, "radius", 20)
        self.assertIn("an axis that this machine does not have: write 0 for it", "\n".join(result.answers["Y"]))


class ToolCentre(Case):
    def test_turned_axes_with_the_tool_centre_point_are_refused(self):
        steps: list[list] = [["mdi", "G43.4 H1"], ["mdi", "G0 X10 Y5 Z30 A20 C30"], ["note", "before"]]
        for name, line in (("G79", "G79 Z100"), ("o<machine_move>", "o<machine_move> call [1] [2] [100]")):
            steps += [["forget"], ["mdi", line], ["sleep", 0.05], ["recall", name], ["note", f"after {name}"]]
        steps += [["mdi", "o<rotary_zero> call"], ["note", "level"], ["mdi", "G79 Z100"], ["note", "end"]]
        result = self.good(harness.run(steps, sample="framepath-xyzac", joints=5, axes="xyzac", record=False))
        for name in ("G79", "o<machine_move>"):
            text = "\n".join(result.answers[name])
            for part in (name, "o<tool_centre_off> call", "o<rotary_zero> call", "o<retract> call"):
                self.assertIn(part, text)
            self.at(result, f"after {name}", *result.answers["before"]["joints"][:5])
        self.at(result, "end", *result.answers["level"]["joints"][:2], 100, 0, 0)

    def test_a_tool_change_is_refused_where_it_would_go_elsewhere(self):
        turned: list[list] = [["mdi", "G43.4 H1"], ["mdi", "G0 X10 Y5 Z30 A20 C30"]]
        change: list[list] = [["note", "before"], ["forget"], ["mdi", "T2 M6"], ["sleep", 0.05], ["recall", "M6"],
                              ["note", "after"]]
        level: list[list] = [["mdi", "o<rotary_zero> call"], ["mdi", "T2 M6"], ["note", "end"]]
        machine = {"sample": "framepath-xyzac", "joints": 5, "axes": "xyzac", "record": False}
        place = {("EMCIO", "TOOL_CHANGE_POSITION"): "10 20 30"}
        frames: list[list] = [[], [["mdi", "o<trans> call [1] [2] [3]"]]]
        for frame in frames:
            result = self.good(harness.run([*turned, *frame, *change, *level], ini=place, **machine))
            text = "\n".join(result.answers["M6"])
            for part in ("M6", "o<tool_centre_off> call", "o<rotary_zero> call"):
                self.assertIn(part, text)
            self.at(result, "after", *result.answers["before"]["joints"][:5])
            self.at(result, "end", 10, 20, 30, 0, 0)
        # nothing moves without such a place
        result = self.good(harness.run([*turned, *change], **machine))
        self.assertEqual(result.answers["M6"], [])
        self.at(result, "after", *result.answers["before"]["joints"][:5])


if __name__ == "__main__":
    unittest.main()
