"""Mistakes in the HAL file and the INI of a machine: each is said, with the line that mends it."""

import os
import shutil
import subprocess
import tempfile
import unittest

import pytest

import harness
from overload import is_overloaded
from test_loading import MOTION, halrun

pytestmark = pytest.mark.thorough

SAMPLE = "framepath-sim"
HANDLER, CONTROLLER = ("addf motion-command-handler servo-thread\n", "addf motion-controller servo-thread\n")
MOVES = "G21 G90 G64 P0.01 G1 F6000\n" + "".join(f"X{n % 7} Y{n % 5}\n" for n in range(240)) + "M2\n"
PROGRAM = [["run", "PROGRAMS/moves.ngc"]]


def run_with(steps, *changes, ini=None, hal=""):
    """The sample machine with texts of its HAL file replaced."""
    with tempfile.TemporaryDirectory() as folder:
        configuration = os.path.join(folder, SAMPLE)
        shutil.copytree(os.path.join(harness.SAMPLES, "configs", SAMPLE), configuration)
        path = os.path.join(configuration, f"{SAMPLE}.hal")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for before, after in changes:
            if before not in text:
                raise AssertionError(f"no {before} in the sample")
            text = text.replace(before, after)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return harness.run(steps, {"moves.ngc": MOVES}, configuration=configuration, ini=ini, hal=hal, record=False)


class Case(unittest.TestCase):
    def nothing_said(self, result):
        self.assertEqual((result.failure, result.errors), (None, []))


class Threads(Case):
    def said(self, result, words):
        return [error for error in result.errors if words in error]

    def test_in_the_right_order_nothing_is_said(self):
        result = run_with(PROGRAM)
        self.nothing_said(result)

    def test_a_planner_that_runs_in_every_twentieth_period_is_in_the_right_order(self):
        single = [["mdi", f"G0 X{n % 2}"] for n in range(24)]
        result = run_with(single, ("[EMCMOT]EMCMOT servo_period", "[EMCMOT]EMCMOT traj_period_nsec=20000000 servo_period"))
        self.nothing_said(result)

    def test_the_wrong_order_is_said_once(self):
        result = run_with(PROGRAM, (HANDLER + CONTROLLER, CONTROLLER + HANDLER))
        self.assertIsNone(result.failure)
        said = self.said(result, "motion-controller comes before motion-command-handler")
        if not said and is_overloaded():
            # a servo thread that is late does not show the order, and counts for nothing
            self.skipTest("the computer is too busy: the servo thread was late where moves came")
        self.assertEqual(len(said), 1, result.errors)
        self.assertIn("write addf motion-command-handler servo-thread and then addf motion-controller", said[0])

    def test_another_thread_is_said_at_start_and_takes_no_command(self):
        fast = "base_period_nsec=500000 base_thread_fp=1"
        result = run_with([["note", "start"], ["reverse"], ["mdi", "G0 X5"], ["note", "end"]],
                          ("[EMCMOT]EMCMOT servo_period", f"[EMCMOT]EMCMOT {fast} servo_period"),
                          (HANDLER, HANDLER.replace("servo-thread", "base-thread")))
        for module in ("blendtp", "framekins"):
            said = self.said(result, f"{module}: motion-command-handler is in another thread than motion-controller, "
                                     "no move is taken")
            self.assertEqual(len(said), 1, result.errors)
            self.assertIn("write addf motion-command-handler servo-thread and then addf motion-controller", said[0])
        # motion asks framekins whether the end of a move has joints before it asks blendtp to take the move
        self.assertTrue(self.said(result, "fails kinematicsInverse"), result.errors)
        # what blendtp says of a run that it is asked to reverse
        self.assertFalse(self.said(result, "there is no way back from here"), result.errors)
        self.assertEqual(result.answers["end"]["position"], result.answers["start"]["position"])

    def test_no_controller_is_said_at_start(self):
        result = run_with([], (CONTROLLER, ""))
        self.assertIn("machine on", result.failure)
        self.assertIn("blendtp: motion-controller is in no thread that runs: write addf", result.log)


    def test_framekins_in_another_thread_is_said_and_takes_no_frame(self):
        slow = "loadrt threads name1=slow period1=10000000\naddf framekins slow\n"
        result = run_with([["mdi", "o<trans> call [10] [0] [0]"], ["getp", "active", "framekins.active"]],
                          ("addf framekins servo-thread\n", slow))
        said = self.said(result, "framekins: it is in another thread than motion-controller, no frame is taken")
        self.assertEqual(len(said), 1, result.errors)
        self.assertIn("write addf framekins servo-thread behind addf motion-controller servo-thread", said[0])
        self.assertEqual(result.answers["active"], "FALSE")


class Jerk(Case):
    """[AXIS_L]MAX_JERK has to be taken to a pin by a line of HAL; LinuxCNC 2.10 does it."""

    def test_a_forgotten_line_is_said_at_the_first_move(self):
        result = run_with([["mdi", "G0 X1"], ["mdi", "G0 X2"]], ("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n", ""))
        self.assertIsNone(result.failure)
        self.assertEqual(result.errors, [] if harness.HANDS_OVER_JERK else [
            "nothing sets blendtp.axis.y.max-jerk (so not limited), although the INI has [AXIS_Y]MAX_JERK = 20000: "
            "write setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK in the HAL file"])

    def test_no_limit_on_purpose_is_not(self):
        result = run_with([["mdi", "G0 X1"]], ("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n",
                                               "setp blendtp.axis.y.max-jerk 0\n"))
        self.nothing_said(result)
        result = run_with([["mdi", "G0 X1"]], ("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n", ""),
                          ini={("AXIS_Y", "MAX_JERK"): "0"})
        self.nothing_said(result)

    def test_a_net_sets_it_too(self):
        result = run_with([["mdi", "G0 X1"]], ("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n",
                                               "net jerk-y blendtp.axis.y.max-jerk\nsets jerk-y [AXIS_Y]MAX_JERK\n"))
        self.nothing_said(result)


class Overrides(Case):
    """What is not a number holds the machine, and is named once; a number lets it go on to the end."""

    HELD = "blendtp: the machine is held, since "

    def test_each_is_named_once(self):
        nan = float("nan")
        steps: list[list] = [["start", "PROGRAMS/moves.ngc"]]
        for wrong, right in ((["setp", "motion.adaptive-feed", nan], ["setp", "motion.adaptive-feed", 1]),
                             (["feed_override", nan], ["feed_override", 1.0]),
                             (["max_velocity", nan], ["max_velocity", 100.0])):
            steps += [["sleep", 0.2], wrong, ["sleep", 1.0], right]
        result = harness.run([*steps, ["finish"], ["note", "end"]],
                             {"moves.ngc": "M52 P1\n" + MOVES.replace("F6000", "F1500")}, record=False)
        self.assertIsNone(result.failure)
        self.assertEqual(result.errors, [
            self.HELD + "motion.adaptive-feed is not a number: look at what sets it, or write M52 P0",
            self.HELD + "the feed override is not a number: set it anew, or look at what sets it",
            self.HELD + "the slider for the greatest velocity is not a number: set it anew, or look at what sets it"])
        self.assertEqual(result.answers["end"]["position"][:2], [239 % 7, 239 % 5])


class Planner(unittest.TestCase):
    def test_tpmod_missing_in_the_ini(self):
        with self.assertRaises(RuntimeError) as raised:
            run_with([["mdi", "G0 X1"]], ("loadrt [KINS]KINEMATICS\n", "loadrt blendtp\nloadrt [KINS]KINEMATICS\n"),
                     ini={("TRAJ", "TPMOD"): None})
        self.assertIn("tpmod.so is loaded already and would be taken in its place: write TPMOD = blendtp",
                      str(raised.exception))

    def test_another_planner_behind_it(self):
        output, code = halrun(MOTION.replace("loadrt homemod\n", "loadrt homemod\nloadrt tpmod\n"))
        self.assertEqual(code, 0, output)
        self.assertIn("blendtp: tpmod is loaded, too, and has nothing to do: remove its loadrt", output)
        output, code = halrun(MOTION)
        self.assertNotIn("is loaded, too", output)


class OutsideOfLinuxCNC(unittest.TestCase):
    def test_what_drives_the_planner_otherwise_than_motmod_is_told_nothing(self):
        for moves_per_cycle in ("1", "4"):
            done = subprocess.run([harness.TOOL, "compare", "--generated", "trochoidal", "--jerk", "20A", "--adds-per-cycle",
                                   moves_per_cycle, "--with", os.path.join(harness.MODULES, "blendtp.so")],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertRegex(done.stdout, "blendtp.so +20A +[0-9]")
            self.assertNotIn("blendtp:", done.stdout)


if __name__ == "__main__":
    unittest.main()
