"""Frames and everything else an operator does: start, end, abort, reset, machine coordinates, offsets, probing, jogging."""

import os
import sys
import tempfile
import unittest

import harness
from test_gcode import QUICK, SAY, said

sys.path.insert(0, os.path.join(harness.SAMPLES, "subroutines"))
from frame_settings import Settings, SettingsError

BEGIN = "G21 G61.1 G17 G90 G94 F3000\n"


def programs(**texts):
    return {f"{name}.ngc": BEGIN + text for name, text in texts.items()}


def run(name):
    return ["run", f"PROGRAMS/{name}.ngc"]


def clearing(start, end, abort):
    return {("FRAMEPATH", key): str(int(value)) for key, value in
            (("CLEAR_AT_START", start), ("CLEAR_AT_END", end), ("CLEAR_ON_ABORT", abort))}


OFF = ["expect", "framekins.active", "FALSE"]
#: and the interpreter has its position without it
KNOWN = ["expect", "framekins.hold", "FALSE"]
ON = ["expect", "framekins.active", "TRUE"]
#: and none is kept that a command would bring back
FORGOTTEN = ["expect", "framekins.operations", "0"]


class Case(unittest.TestCase):
    def fine(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def at(self, result, name, joints, position=None):
        """Where the joints were, and that LinuxCNC showed the position that belongs to them."""
        for key, wanted in (("joints", joints), ("position", position)):
            if wanted is not None:
                got = result.answers[name][key][:3]
                for one, other in zip(got, wanted, strict=True):
                    self.assertAlmostEqual(one, other, places=5, msg=f"{name}: {key} {got} {wanted}")


class Clearing(Case):
    LEAVES_A_FRAME = "o<trans> call [10] [20] [0]\nG0 X1 Y2 Z3\n"

    def test_at_start_end_and_abort(self):
        result = harness.run([
            run("leave"), OFF, ["sleep", 0.1], ["note", "end"],
            # one axis alone shows whether the interpreter knows where the others are
            run("one"), ["note", "one"],
            ["start", "PROGRAMS/long.ngc"], ON, ["wait_moving"], ["sleep", 0.2], ["abort"], OFF, ["sleep", 0.2],
            ["note", "aborted"], run("one"), ["note", "one after abort"],
            # a frame of MDI is not one of the program's
            ["mdi", "o<trans> call [0] [50] [0]"], ["mdi", "G0 X0 Y0"], ["note", "mdi"],
            ["switch_mode", "auto"], OFF, ["sleep", 0.1], run("one"), ["note", "one after MDI"],
            # the same without waiting: it starts without the frame, or it does not start
            ["mdi", "G0 X0 Y0"], ["mdi", "o<arot> call [0] [0] [90]"], ["forget"], ["start_at_once"], ["sleep", 0.5],
            OFF, ["finish"],
            ["recall", "at once errors"], ["note", "at once"], run("one"), ["note", "one at last"],
            # in MDI itself the frame stays from line to line, until something is aborted
            ["mdi", "o<trans> call [0] [50] [0]"], ["sleep", 0.2], ["mdi", "G0 X0 Y0"], ["note", "mdi again"],
            ["abort"], OFF, ["sleep", 0.1], ["mdi", "G0 X5"], ["note", "mdi after abort"],
        ], programs(leave=self.LEAVES_A_FRAME + "M2\n", one="G1 X30\nM30\n",
                    long="o<trans> call [10] [20] [0]\nG1 X1 Y2\nG1 X400\nM2\n"), ini=QUICK)
        self.fine(result)
        self.at(result, "end", (11, 22, 3), (11, 22, 3))
        self.at(result, "one", (30, 22, 3), (30, 22, 3))
        self.at(result, "aborted", result.answers["aborted"]["position"][:3])
        self.at(result, "one after abort", (30, 22, 3), (30, 22, 3))
        self.at(result, "mdi", (0, 50, 3), (0, 0, 3))
        self.at(result, "one after MDI", (30, 50, 3), (30, 50, 3))
        self.at(result, "one at last", (30, 0, 3), (30, 0, 3))
        # it has run to the end without the frame, or it was refused with the reason before it got anywhere
        refused = "\n".join(result.answers["at once errors"])
        joints = result.answers["at once"]["joints"]
        if refused:
            self.assertRegex(refused, "start the program again|in MDI mode")
        else:
            self.assertAlmostEqual(joints[0], 30, places=5)
        self.assertLess(abs(joints[1]), 0.5)
        self.at(result, "mdi again", (0, 50, 3), (0, 0, 3))
        self.at(result, "mdi after abort", (5, 50, 3), (5, 50, 3))

    def test_programs_one_behind_the_other(self):
        # each start falls somewhere into the removal of the last frame: it is refused, or it starts right
        result = harness.run([
            ["mdi", "G0 X0 Y7 Z3"], ["open", "PROGRAMS/part.ngc"], ["forget"], *[["start_at_once"], ["finish"]] * 15,
            OFF, KNOWN, ["recall", "errors"], run("part"), ["note", "end"],
        ], programs(part="o<trans> call [10] [20] [0]\nG1 X1\nG1 X5\nM2\n"), ini=QUICK)
        self.fine(result)
        for text in result.answers["errors"]:
            self.assertRegex(text, "start the program again|give it again|in MDI mode|in auto mode with the interpreter idle"
                                   "|does not leave AUTO")
        # no program names Y: it may never move, whatever the interpreter was told in between
        y = result.column("joint.1")
        y = y[next(n for n, place in enumerate(y) if abs(place - 7) < 1e-9):]
        self.assertLess(max(y) - min(y), 1e-9)
        self.at(result, "end", (15, 7, 3))

    #: as o<frame_resume>, which is refused where nothing is suspended
    BACK = "o<frame_send> call [11] [0] [0] [0] [0]"

    def test_a_suspended_frame_is_forgotten_as_well(self):
        # at the end of its program, and where a program starts behind one of MDI
        suspended = [["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "o<frame_suspend> call"], ["mdi", "G0 X0 Y0"]]
        back = ["mdi", self.BACK]
        result = harness.run([
            run("leave"), FORGOTTEN, back, ["mdi", "G0 X10"], ["note", "MDI"],
            run("leave"), FORGOTTEN, run("next"), ["note", "program"],
            *suspended, ["switch_mode", "auto"], FORGOTTEN, run("next"), ["note", "start"],
            # in MDI itself it comes back
            *suspended, ["sleep", 0.2], back, ["mdi", "G0 X10"], ["note", "kept"],
        ], programs(leave="o<rot> call [0] [0] [90]\nG1 X2\no<frame_suspend> call\nG53 G0 X0 Y0 Z0\nM2\n",
                    next=f"G0 X0 Y0\nG43 H2\n{self.BACK}\nG1 X10\nG49\nM2\n"), ini=QUICK)
        self.fine(result)
        for name in ("MDI", "program", "start"):
            self.at(result, name, (10, 0, 0))
        self.at(result, "kept", (0, 10, 0))

    def test_a_suspended_frame_at_a_second_start(self):
        result = harness.run([
            run("leave"), ["sleep", 0.3], ["forget"], ["start", "PROGRAMS/next.ngc"], ["finish"], FORGOTTEN, ["recall", "stopped"],
            run("next"), ["note", "end"],
        ], programs(leave="o<rot> call [0] [0] [90]\no<frame_suspend> call\nM2\n",
                    next=f"G4 P0.5\n{self.BACK}\nG1 X10\nM2\n"), ini={**QUICK, **clearing(True, False, True)})
        self.fine(result)
        self.assertIn("a frame was still suspended when the program started", "\n".join(result.answers["stopped"]))
        self.at(result, "end", (10, 0, 0))

    def test_a_start_that_falls_between_two_looks(self):
        # frame_guard sees the first run waiting for its last move, and next the second one reading
        text = "G1 X3\nG4 P1\nM66 E0 L0\no<trans> call [10] [20] [0]\nG1 X5 F600\nM2\n"
        result = harness.run([
            ["start", "PROGRAMS/part.ngc"], ON, ["wait_place", 0, 14], ["forget"], ["guard", "STOP"], ["finish"], ["cycle_start"],
            ["sleep", 0.2], ["guard", "CONT"], ["finish"], OFF, KNOWN, ["recall", "stopped"], ["note", "end"],
        ], programs(part=text), ini=QUICK)
        self.fine(result)
        self.assertIn("a frame was still active when the program started", "\n".join(result.answers["stopped"]))
        self.at(result, "end", (13, 0, 0), (13, 0, 0))

    def test_to_resume_or_step_is_no_start(self):
        # behind a pause of the while in which it was read LinuxCNC reads once more at each of them, beyond the end of the program
        text = "G1 X3 F600\nM66 E0 L0\no<trans> call [10] [20] [0]\nG1 X50 F1500\nG4 P0.1\nX0\nM2\n(the end)\n"
        begin = [["start", "PROGRAMS/part.ngc"], ["wait_moving"], ["pause"], ["sleep", 0.1], ["resume"], ON, ["wait_place", 0, 15]]
        for keys in (("resume",), ("step", "resume")):
            with self.subTest(keys):
                pressed = [step for key in keys for step in ([key], ["sleep", 0.007])] * (60 // len(keys))
                result = harness.run([*begin, *pressed, ["finish"], OFF, KNOWN, ["note", "end"]], programs(part=text), ini=QUICK)
                result.forgive_end_of_steps()
                self.fine(result)
                self.at(result, "end", (10, 0, 0))

    def test_an_abort_that_leaves_a_frame_suspended_says_so(self):
        result = harness.run([
            ["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G91 G1 X1 F3000"], ["forget"], ["mdi_start", "G79 Z400"], ["wait_moving"],
            ["abort"], ["sleep", 0.3], ["recall", "aborted"], ["mdi", "o<frame_resume> call"], ["mdi", "G90 G1 X5 Z0"],
            ["note", "end"],
        ], ini=clearing(True, True, False))
        self.fine(result)
        text = "\n".join(result.answers["aborted"])
        for part in ("the frame was suspended, and it still is", "o<frame_resume> call", "o<frame_off> call", "G90"):
            self.assertIn(part, text)
        self.assertEqual(text.count("still is"), 1, text)
        self.at(result, "end", (0, 5, 0))

    def test_only_what_is_suspended_is_brought_back(self):
        steps: list[list] = []
        for name, lines in {"nothing": ["o<frame_resume> call"], "active": ["o<rot> call [0] [0] [90]", "o<frame_resume> call"],
                            "added": ["o<frame_suspend> call", "o<atrans> call [1] [0] [0]"],
                            "scales": ["o<ascale_off> call"]}.items():
            steps += [["forget"], *[["mdi", line] for line in lines], ["sleep", 0.05], ["recall", name]]
        # past a frame that is suspended the machine moves, and it stays so
        result = harness.run([*steps, ["forget"], ["mdi", "G79 X5"], ["mdi", "o<retract> call [3]"], OFF,
                              ["mdi", "G1 X6 F3000"], ["note", "off"], ["mdi", "o<frame_resume> call"], ["mdi", "G79 X0"], ON, ["mdi", "G1 X2 Y0"],
                              ["note", "on"], ["mdi", "o<frame_off> call"], ["mdi", "G79 X1"], ["mdi", "o<retract> call [4]"],
                              ["note", "none"]], ini={**QUICK, **clearing(True, True, False)})
        self.fine(result)
        for name, words in {"nothing": "no frame is suspended", "active": "the frame is active, and not suspended",
                            "added": "the frame is suspended, and this command would add to it",
                            "scales": "the frame is suspended"}.items():
            self.assertIn(words, "\n".join(result.answers[name]), name)
        self.at(result, "off", (6, 0, 3))
        self.at(result, "on", (0, 2, 3))
        self.at(result, "none", (1, 2, 4))

    def test_an_abort_with_cutter_compensation_on(self):
        moves = [["mdi", "o<rot> call [20] [0] [0]"], ["mdi", "G41.1 D2"], ["mdi", "G1 X10 F1000"], ["mdi_start", "G1 X100"],
                 ["wait_moving"]]
        result = harness.run([
            *moves, ["abort"], OFF, KNOWN, ["sleep", 0.3], ["note", "aborted"], ["sleep", 0.3], ["note", "later"],
            ["mdi", "G0 X0 Y0 Z0"], ["note", "moved"],
            *moves, ["estop"], OFF, ["on"], ["mdi", "G0 X0 Y0 Z0"], ["note", "stopped"],
            # what an error has held back for a corner does not run either
            ["forget"], run("corner"), OFF, KNOWN, ["sleep", 0.3], ["recall", "said"], ["note", "error"],
            ["mdi", "G0 X0 Y0 Z0"], ["note", "end"],
        ], programs(corner="o<rot> call [20] [0] [0]\nG41.1 D2\nG1 X10 Y5\nG1 X30\nG1 X31 Y30\nG77.3 R45\nX20\nG40\nM2\n"),
            ini=QUICK)
        self.fine(result)
        self.at(result, "later", result.answers["aborted"]["joints"][:3])
        self.assertLess(result.answers["aborted"]["joints"][0], 90)
        for name in ("moved", "stopped", "end"):
            self.at(result, name, (0, 0, 0))
        self.assertIn("G77.3 change the frame: end the cutter compensation with G40 first", "\n".join(result.answers["said"]))
        self.assertEqual(len(result.answers["said"]), 1, result.answers["said"])
        # the move to X31 Y30 was not its turn yet
        self.assertLess(result.answers["error"]["joints"][1], 20)

    def test_an_abort_with_a_subroutine_of_the_users(self):
        own = "o<on_abort> sub\n  o<frame_abort> call\n  M64 P1\no<on_abort> endsub\nM2\n"
        result = harness.run([
            ["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G0 X10 Y0"], ON, ["mdi_start", "G1 X400 F1000"], ["wait_moving"],
            ["abort"], OFF, KNOWN, ["expect", "motion.digital-out-01", "TRUE"], ["sleep", 0.3], ["mdi", "G0 X5"],
            ["note", "end"],
        ], {"on_abort.ngc": own}, ini={
            **QUICK, ("RS274NGC", "SUBROUTINE_PATH"): "../../programs:../../subroutines",
            ("RS274NGC", "ON_ABORT_COMMAND"): "O <on_abort> call"})
        self.fine(result)
        self.assertAlmostEqual(result.answers["end"]["joints"][0], 5, places=5)

    def test_on_reset(self):
        frame = [["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G0 X10 Y0"]]
        result = harness.run([
            *frame, ["note", "before"], ["machine_off"], OFF, ["on"], ["switch_mode", "mdi"], ["note", "off"],
            ["mdi", "G0 X5"], ["note", "moved"],
            *frame, ["estop"], OFF, ["on"], ["switch_mode", "mdi"], ["note", "estop"], ["mdi", "G0 X5"],
            ["note", "moved again"],
        ], ini=QUICK)
        self.fine(result)
        self.at(result, "before", (0, 10, 0), (10, 0, 0))
        self.at(result, "off", (0, 10, 0), (0, 10, 0))
        self.at(result, "moved", (5, 10, 0), (5, 10, 0))
        self.at(result, "estop", (0, 10, 0), (0, 10, 0))
        self.at(result, "moved again", (5, 10, 0), (5, 10, 0))

    def test_nothing_is_cleared_if_the_settings_say_so(self):
        result = harness.run([
            run("leave"), ["sleep", 0.4], ON, ["note", "end"],
            run("one"), ["sleep", 0.3], ON, ["note", "start"],
            ["start", "PROGRAMS/long.ngc"], ["wait_moving"], ["abort"], ["sleep", 0.4], ON,
            ["machine_off"], ["sleep", 0.3], ON, ["on"], ["mdi", "G0 X0"], ["note", "off"],
        ], programs(leave=self.LEAVES_A_FRAME + "M2\n", one="G1 X30\nM30\n", long="G1 X400\nM2\n"),
            ini={**QUICK, **clearing(False, False, False)})
        self.fine(result)
        self.at(result, "end", (11, 22, 3), (1, 2, 3))
        self.at(result, "start", (40, 22, 3), (30, 2, 3))
        self.at(result, "off", (10, 22, 3), (0, 2, 3))

    def test_only_at_the_end(self):
        result = harness.run([
            ["start", "PROGRAMS/long.ngc"], ON, ["wait_moving"], ["abort"], ["sleep", 0.5], ON,
            ["mdi", "o<frame_off> call"], run("leave"), OFF,
        ], programs(leave=self.LEAVES_A_FRAME + "M30\n", long="o<trans> call [1] [0] [0]\nG1 X400\nM2\n"),
            ini={**QUICK, **clearing(False, True, False)})
        self.fine(result)


class MachineCoordinates(Case):
    def test_moves_past_the_frame(self):
        text = SAY + """\
G10 L2 P1 X100 Y0 Z0 R0
G54
o<rot> call [0] [0] [90]
G1 X10 Y0 Z0
o<say> call [1]
o<machine_move> call [5] [6] [7]
o<say> call [2]
X20 Y0 Z0 (a feed move, as before)
o<say> call [3]
G79 Z9
o<say> call [4]
G91
G79 X1 Y2
G90
o<say> call [5]
o<frame_suspend> call
G53 G0 X40 Y41 Z42
G28
o<say> call [6]
G30
o<frame_resume> call
G1 X20 Y0 Z0
o<say> call [7]
(the change position is one of the machine)
T1 M6
o<say> call [8]
G1 X20 Y0 Z0
o<say> call [9]
o<frame_off> call
G10 L2 P1 X0
M2
"""
        result = harness.run([["mdi", "G53 G0 X50 Y51 Z52"], ["mdi", "G28.1"], ["mdi", "G53 G0 X60 Y61 Z62"],
                              ["mdi", "G30.1"], run("part")], programs(part=text),
                             ini={**QUICK, ("EMCIO", "TOOL_CHANGE_POSITION"): "-30 -31 -32"})
        self.fine(result)
        expected = {1: (100, 10, 0), 2: (5, 6, 7), 3: (100, 20, 0), 4: (100, 20, 9), 5: (1, 2, 9), 6: (50, 51, 52),
                    7: (100, 20, 0), 8: (-30, -31, -32), 9: (100, 20, 0)}
        for number, joints in expected.items():
            for got, wanted in zip(said(result)[number], joints, strict=True):
                self.assertAlmostEqual(got, wanted, places=5, msg=f"{number}: {said(result)[number]} {joints}")

    def test_what_is_refused(self):
        frame = "o<trans> call [0] [0] [30]\no<arot> call [0] [0] [90]\n"
        texts = {
            "g53": frame + "G53 G1 X-60\n",
            "g28": frame + "G28 X0 Y0 Z0\n",
            "g30": frame + "G30\n",
            "work": "G55\n" + frame + "G54\nG1 X-60\n",
            "refresh": "G55\n" + frame + "G54\no<frame_refresh> call\nG1 X-10 Y0 Z0\n",
            "g92": frame + "G92 X7\nG1 X-60\n",
            "length": "o<scale> call [2] [2] [2]\nT2 M6 G43\nG1 X-60\n",
            "length_refreshed": "o<scale> call [2] [2] [2]\nT2 M6 G43\no<frame_refresh> call\nG1 X-10 Y0 Z0\n",
            "turned_length": "o<rot> call [0] [0] [90]\nT2 M6 G43\nG1 X-10 Y0 Z0\n",
        }
        # the first three by the planner before anything moves, the others by frame_guard when the move begins
        machine = "G28, G30 and G53 mean the machine without its frame"
        words = {"g53": machine, "g28": machine, "g30": machine, "work": "work offset has changed",
                 "g92": "work offset has changed", "length": "tool offset has changed"}
        steps: list[list] = [["mdi", "G53 G0 X40 Y41 Z42"], ["mdi", "G28.1"], ["mdi", "G30.1"], ["mdi", "G10 L2 P2 X10 Y0 Z0"],
                 ["mdi", "G53 G0 X0 Y0 Z0"]]
        for name in texts:
            steps += [["forget"], ["note", f"{name} before"], run(name), OFF, ["sleep", 0.1], ["recall", name],
                      ["note", f"{name} after"], ["mdi", "G92.1 G54 G49"], ["mdi", "G53 G0 X0 Y0 Z0"]]
        # with the limits of the sample, so that the way until the machine stops means something
        result = harness.run(steps, programs(**{name: text + "M2\n" for name, text in texts.items()}))
        self.fine(result)
        for name in texts:
            said_then = "\n".join(result.answers[name])
            if name in words:
                self.assertIn(words[name], said_then, name)
                travel = [abs(a - b) for a, b in zip(result.answers[f"{name} before"]["joints"],
                                                     result.answers[f"{name} after"]["joints"], strict=True)]
                # seen within some hundredths of a second, or tenths on a busy computer: the move of 60 mm hardly begins
                self.assertLess(max(travel), 1e-9 if words[name] == machine else 20, name)
            else:
                self.assertEqual(said_then, "", name)
        self.at(result, "refresh after", (0, -10, 30))
        self.at(result, "length_refreshed after", (-20, 0, 20))
        self.at(result, "turned_length after", (0, -10, 20))

    def test_a_tool_change_position_without_the_remap(self):
        result = harness.run([["forget"], run("part"), OFF, ["recall", "errors"], ["note", "end"]],
                             programs(part="o<rot> call [0] [0] [90]\nT1 M6\nM2\n"),
                             ini={("RS274NGC", "REMAP"): None, ("EMCIO", "TOOL_CHANGE_POSITION"): "-30 -31 -32"})
        self.fine(result)
        self.assertIn("tool change position would run through the active frame", "\n".join(result.answers["errors"]))
        # stopped on the way there, by frame_guard, which a busy computer keeps waiting
        self.assertLess(max(abs(joint) for joint in result.answers["end"]["joints"][:3]), 20)


class ByHand(Case):
    def test_probing_jogging_and_homing_in_a_frame(self):
        probe = """\
loadrt comp names=wall
addf wall servo-thread
setp wall.in0 20
net joint-1 => wall.in1
net probe wall.out => motion.probe-input
"""
        result = harness.run([
            ["mdi", "G10 L2 P1 X100 Y0 Z0"], ["mdi", "G54"],
            ["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G0 X0 Y0"], ["note", "start"],
            # the wall stands at Y 20 of the machine: X 20 of the program
            ["mdi", "F300"], ["mdi", "G38.2 X50"], ["mdi", "(DEBUG, PROBED #5061 #5062 #5063 #5070)"],
            ["mdi", "G0 X0"],
            # the keys of the axes run along the frame
            ["note", "before jog"], ["jog_along", 0, 20, 5], ["note", "after jog"],
            # the joints home as ever, and the position follows
            ["home_again", 0], ["note", "homed"], ["getp", "active", "framekins.active"],
            ["mdi", "G0 X1 Y2"], ["note", "end"],
        ], hal=probe, ini={**QUICK, ("JOINT_0", "HOME"): "0"})
        self.fine(result)
        self.at(result, "start", (100, 0, 0), (100, 0, 0))
        text = next(words for _, words in result.messages if words.startswith("PROBED"))
        x, y, _, tripped = (float(word) for word in text.split()[1:])
        self.assertEqual(tripped, 1)
        self.assertAlmostEqual(x, 20, delta=0.02)
        self.assertAlmostEqual(y, 0, places=5)
        before, after = result.answers["before jog"]["joints"], result.answers["after jog"]["joints"]
        # a jog of LinuxCNC comes to rest a few nanometres short of its target
        self.assertAlmostEqual(after[0] - before[0], 0, places=5)
        self.assertAlmostEqual(after[1] - before[1], 5, places=3)
        self.assertEqual(result.answers["active"], "TRUE")
        self.at(result, "homed", (0, after[1], 0), (100 + after[1], 100, 0))
        self.at(result, "end", (98, 1, 0), (101, 2, 0))


class SettingsOfTheIni(unittest.TestCase):
    BASE = "[TRAJ]\nLINEAR_UNITS = mm\n[RS274NGC]\nOWORD_NARGS = 1\nON_ABORT_COMMAND = o<frame_abort> call\n"

    def read(self, text, base=BASE):
        with tempfile.NamedTemporaryFile("w", suffix=".ini") as file:
            file.write(base + text)
            file.flush()
            return Settings(file.name)

    def refused(self, text, *words, base=BASE):
        with self.assertRaises(SettingsError) as caught:
            self.read(text, base)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_defaults_and_values(self):
        settings = self.read("")
        self.assertEqual((settings.clear_at_start, settings.clear_at_end, settings.clear_on_abort,
                          settings.tool_length, settings.rots_convention, settings.analog_output),
                         (True, True, True, "frame", "seed", 0))
        settings = self.read("[FRAMEPATH]\nCLEAR_AT_START=0\nCLEAR_AT_END = 0\nTOOL_LENGTH = Machine\n"
                             "ROTS_CONVENTION = k2\nANALOG_OUTPUT = 55\n")
        self.assertEqual((settings.clear_at_start, settings.clear_at_end, settings.clear_on_abort,
                          settings.tool_length, settings.rots_convention, settings.analog_output),
                         (False, False, True, "machine", "k2", 55))
        self.assertAlmostEqual(self.read("", self.BASE.replace("mm", "inch")).units_per_mm, 1 / 25.4)
        self.assertEqual((self.read("").tolerance, self.read("").retract_z), (0.01, None))
        settings = self.read("[FRAMEPATH]\nTOLERANCE = 0.05\nRETRACT_Z = -12.5\n")
        self.assertEqual((settings.tolerance, settings.retract_z), (0.05, -12.5))
        self.assertEqual((self.read("").type_output, self.read("[FRAMEPATH]\nTYPE_OUTPUT = 63\n").type_output), (3, 63))

    def test_every_mistake_is_named(self):
        self.refused("[FRAMEPATH]\nCLEAR_AT_STRAT = 1\n", ".ini:7: [FRAMEPATH]CLEAR_AT_STRAT", "CLEAR_AT_START",
                     "ANALOG_OUTPUT")
        self.refused("[FRAMEPATH]\nCLEAR_AT_END = yes\n", "[FRAMEPATH]CLEAR_AT_END = yes", "0 or 1")
        self.refused("[FRAMEPATH]\nTOOL_LENGTH = head\n", "frame or machine")
        self.refused("[FRAMEPATH]\nROTS_CONVENTION =\n", "seed or k2")
        self.refused("[FRAMEPATH]\nCLEAR_AT_END = 1 # always\n", "comments on a line of their own")
        for value in ("56", "-1", "1.5", "x"):
            self.refused(f"[FRAMEPATH]\nANALOG_OUTPUT = {value}\n", "from 0 to 55")
        for value in ("64", "-1", "x"):
            self.refused(f"[FRAMEPATH]\nTYPE_OUTPUT = {value}\n", "from 0 to 63")
        for value in ("0", "11", "fine"):
            self.refused(f"[FRAMEPATH]\nTOLERANCE = {value}\n", "from 0.001 to 10 mm")
        self.refused("[FRAMEPATH]\nRETRACT_Z = top\n", "a place of the machine")
        self.refused("[FRAMEPATH]\nCLEAR_AT_END = 1\nCLEAR_AT_END = 0\n", "twice")
        self.refused("[framepath]\nCLEAR_AT_END = 1\n", "[framepath]", "capitals")
        self.refused("", "[RS274NGC]OWORD_NARGS = 1", base=self.BASE.replace("OWORD_NARGS = 1\n", ""))
        self.refused("", "[RS274NGC]ON_ABORT_COMMAND", base=self.BASE.replace("ON_ABORT_COMMAND", "#"))
        self.refused("", "[TRAJ]LINEAR_UNITS", base=self.BASE.replace("mm", "feet"))
        self.refused("", "[TRAJ]LINEAR_UNITS is missing", base=self.BASE.replace("LINEAR_UNITS = mm\n", ""))

    def test_letters_of_the_kinematics_that_do_not_fit_the_machine(self):
        def machine(letters, joints=3, axes="XYZ"):
            return f"[KINS]\nKINEMATICS = framekins coordinates={letters}\nJOINTS = {joints}\n[TRAJ]\nCOORDINATES = {axes}\n"

        for text, extra in ((machine("xyz") + "[FRAMEPATH]\n", 0), (machine("XYYZ", 4, "X Y Z"), 0),
                            (machine("XY").replace("framekins", "mykins"), 0), (machine("XYYZ", 5), 1)):
            self.assertIsNone(self.read(text).joint_problem(extra))
        for text, extra, words in (
                (machine("XY"), 0, "[KINS]KINEMATICS: coordinates=XY names 2 joints, [KINS]JOINTS = 3: write"),
                (machine("XYZ"), 1, "names 3 joints, [KINS]JOINTS = 3: 1 of these beside the kinematics (num_extrajoints"),
                (machine("XYY"), 0, "[KINS]KINEMATICS: coordinates=XYY: [TRAJ]COORDINATES has an axis Z that moves no joint")):
            self.assertIn(words, self.read(text).joint_problem(extra))

    def test_linuxcnc_does_not_start_with_a_mistake(self):
        with self.assertRaises(RuntimeError) as caught:
            harness.run([], ini={("FRAMEPATH", "CLEAR_AT_STRAT"): "1"})
        self.assertIn("[FRAMEPATH]CLEAR_AT_STRAT: there is no such key", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
