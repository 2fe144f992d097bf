"""Soft limits on the way of a move, on machines whose joints do not follow the program: robots of LinuxCNC's own kinematics."""

import math
import os
import shutil
import tempfile
import unittest

import harness

INI = """[EMC]
VERSION = 1.1
MACHINE = robot
[DISPLAY]
DISPLAY = axis
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = robot.var
RS274NGC_STARTUP_CODE = G17 G21 G40 G49 G54 G61.1 G80 G90 G94
[EMCMOT]
EMCMOT = motmod
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.01
[HAL]
HALFILE = robot.hal
[TRAJ]
COORDINATES = {letters}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 50
MAX_LINEAR_VELOCITY = 200
TPMOD = {planner}
{world_home}
[KINS]
JOINTS = {joints}
KINEMATICS = {kinematics}
"""

AXIS = """[AXIS_{letter}]
MIN_LIMIT = -10000
MAX_LIMIT = 10000
MAX_VELOCITY = 200
MAX_ACCELERATION = 2000
"""

JOINT = """[JOINT_{number}]
TYPE = ANGULAR
HOME = {home}
HOME_OFFSET = {home}
HOME_SEQUENCE = 0
MIN_LIMIT = {least}
MAX_LIMIT = {greatest}
MAX_VELOCITY = 10000
MAX_ACCELERATION = 100000
FERROR = 1000
MIN_FERROR = 1000
"""

HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net estop-loop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
setp spindle.0.at-speed 1
"""


class Robot(unittest.TestCase):
    """A machine of these kinematics, at home with these joints."""

    kinematics: str | None = None
    home: tuple[float, ...] = ()
    letters = "XYZABC"
    world_home = ""
    hal = ""
    precision = 1e-6

    def run_moves(self, *moves, planner="blendtp", **limits):
        """Moves by MDI, with limits: joint_1=(least, greatest)."""
        folder = tempfile.mkdtemp(prefix="framepath-robot.")
        try:
            text = INI.format(kinematics=self.kinematics, joints=len(self.home), letters=self.letters, planner=planner,
                              world_home=self.world_home)
            text += "".join(AXIS.format(letter=letter) for letter in self.letters)
            hal = HAL + self.hal
            for number, home in enumerate(self.home):
                least, greatest = limits.get(f"joint_{number}", (-5000, 5000))
                text += JOINT.format(number=number, home=home, least=least, greatest=greatest)
                hal += f"net joint-{number} joint.{number}.motor-pos-cmd => joint.{number}.motor-pos-fb\n"
            for name, content in (("robot.ini", text), ("robot.hal", hal)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(content)
            steps = [["note", "start"], *(["mdi", move] for move in moves), ["note", "end"]]
            return harness.run(steps, sample="robot", configuration=folder, record=False)
        finally:
            shutil.rmtree(folder)

    def joints(self, result, note):
        return result.answers[note]["joints"][:len(self.home)]

    def assert_joints(self, result, expected, note="end"):
        for found, joint in zip(self.joints(result, note), expected, strict=True):
            self.assertAlmostEqual(found, joint, delta=self.precision, msg=result.log)

    def runs(self, *moves, **limits):
        """The moves run, and end where stock's planner ends them."""
        result = self.run_moves(*moves, **limits)
        self.assertEqual(result.errors, [], result.log)
        stock = self.run_moves(*moves, planner="tpmod", **limits)
        self.assertEqual(stock.errors, [], stock.log)
        self.assert_joints(result, self.joints(stock, "end"))
        return result

    def is_refused(self, joint, limit, *moves, **limits):
        """The last of the moves is refused before it begins; the others run. How far the joint would go."""
        result = self.run_moves(*moves, **limits)
        said = [error for error in result.errors if f"the move would take joint {joint} to" in error]
        self.assertEqual((len(said), len(result.errors)), (1, 1), result.errors)
        self.assertIn(f"beyond its soft limit {limit:f}", said[0])
        before = self.run_moves(*moves[:-1], **limits)
        self.assertEqual(before.errors, [], before.log)
        self.assert_joints(result, self.joints(before, "end"))
        words = said[0].split()
        return float(words[words.index("to", words.index("joint")) + 1])


class Scara(Robot):
    """The elbow is below 0: scarakins answers with one above 0 to flags of 0."""

    kinematics = "scarakins"
    home = (45, -90, 150, 0, 0, 0)
    hal = "setp scarakins.D6 0\n"

    def elbow(self, reach):
        """The joint where the arm of 340 and 250 mm ends so far from the column."""
        return -math.degrees(math.acos((reach ** 2 - 340 ** 2 - 250 ** 2) / (2 * 340 * 250)))

    def test_an_arc_that_stock_runs(self):
        self.runs("G91 G2 X40 Y0 I20 J0 F6000", joint_1=(-170, 10))

    def test_an_arc_that_bends_the_elbow_too_far(self):
        beyond = self.is_refused(1, -92, "G91 G2 X0 Y0 I-20 J0 F6000", joint_1=(-92, 10))
        x, y = 340 * math.sqrt(0.5) + 250 * math.sqrt(0.5) - 20, 340 * math.sqrt(0.5) - 250 * math.sqrt(0.5)
        self.assertAlmostEqual(beyond, self.elbow(math.hypot(x, y) - 20), delta=2e-6)

    def test_a_line_that_fits(self):
        self.runs("G0 X165 Y-300", "G1 Y300 F12000", joint_1=(self.elbow(165) - 1e-3, 10))

    def test_a_line_that_bends_the_elbow_too_far(self):
        beyond = self.is_refused(1, -150, "G0 X165 Y-300", "G1 Y300 F12000", joint_1=(-150, 10))
        self.assertAlmostEqual(beyond, self.elbow(165), delta=2e-6)


class Puma(Robot):
    """The wrist is flipped: with flags of 0 it would not be."""

    kinematics = "pumakins"
    home = (10, -40, -20, 20, -50, 30)

    def test_a_circle_that_stock_runs(self):
        self.runs("G91 G2 X0 Y0 I20 J0 F6000", joint_4=(-100, 10))

    def test_a_circle_that_leaves(self):
        self.assertGreater(self.is_refused(1, -35, "G91 G2 X0 Y0 I20 J0 F6000", joint_1=(-100, -35)), -35)

    def test_a_way_without_joints(self):
        # nearer to the column than the shoulder is wide
        result = self.run_moves("G0 X20 Y-400", "G1 Y400 F6000")
        said = [error for error in result.errors if "pumakins finds no joints" in error]
        self.assertEqual(len(said), 1, result.errors)


class Serial(Robot):
    """Kinematics that iterate from the joints of before."""

    kinematics = "genserkins"
    #: Where they end depends on the steps to there, by more or less with the processor: 1.06e-5 degrees.
    precision = 5e-5
    home = (10, -40, -20, 20, 50, 30)

    def test_a_circle_that_stock_runs(self):
        self.runs("G91 G2 X0 Y0 I20 J0 F6000")

    def test_a_circle_that_leaves(self):
        self.assertGreater(self.is_refused(1, -35, "G91 G2 X0 Y0 I20 J0 F6000", joint_1=(-100, -35)), -35)


class Hexapod(Robot):
    """Forward kinematics that iterate."""

    kinematics = "genhexkins"
    home = (29.7466,) * 6
    world_home = "HOME = 0 0 20 0 0 0"

    def test_a_circle_that_stock_runs(self):
        self.runs("G91 G2 X0 Y0 I2 J0 F6000")

    def test_a_circle_that_leaves(self):
        self.assertGreater(self.is_refused(0, 31, "G91 G2 X0 Y0 I2 J0 F6000", joint_0=(10, 31)), 31)


class Table(Robot):
    """A tilting rotary table turns a point 50 mm from its centre past Y 50."""

    kinematics = "xyzac-trt-kins"
    home = (50, 0, 0, 0, 0)
    letters = "XYZAC"

    def test_a_line_that_fits(self):
        self.runs("G1 C180 F20000", joint_1=(-100, 50.001))

    def test_a_line_that_leaves(self):
        beyond = self.is_refused(1, 49.9, "G1 C180 F20000", joint_1=(-100, 49.9))
        self.assertAlmostEqual(beyond, 50, delta=2e-6)

    def test_a_line_of_all_axes_that_leaves(self):
        # in the middle of a program, which ends there
        self.is_refused(1, 49, "G1 X51 F6000", "G1 X50 Y1 Z2 A1 C175 F6000", joint_1=(-100, 49))


class Rose(Robot):
    """Kinematics that count the turns of a joint from call to call."""

    kinematics = "rosekins"
    home = (50, 0, 0)
    letters = "XYZ"

    def test_a_turn_is_counted_once(self):
        result = self.run_moves("G3 X50 Y0 I-50 J0 F6000")
        self.assert_joints(result, (50, 0, 360))
        said = [line for line in result.log.splitlines() if "rosekins cannot be asked" in line]
        self.assertEqual(len(said), 1, result.log)


if __name__ == "__main__":
    unittest.main()
