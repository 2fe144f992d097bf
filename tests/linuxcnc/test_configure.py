"""A stock configuration of LinuxCNC, configured by framepath configure, runs in LinuxCNC."""

import os
import shutil
import subprocess
import tempfile
import unittest

import harness

STOCK = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis"
SUBROUTINES = "../../subroutines"

#: a change of tools asks for a person in front of a screen, and AXIS for a screen
NEED_A_SCREEN = ("HALFILE = axis_manualtoolchange.hal\n", "HALUI = halui\n")

PROGRAM = """G21 G90 G17 G64 P0.05
G1 X20 Y5 F1500
X40 Y0
G2 X60 Y0 I10 J0
G1 X10 Y10 Z5
M2
"""

FRAMES = """G21 G90 G17 G61.1
o<trans> call [10] [5] [0]
G1 X20 Y5 F1500
o<frame_off> call
M2
"""


def configured(*options, kinematics=None):
    """A folder with axis_mm-framepath.ini and what belongs to it."""
    folder = tempfile.mkdtemp(prefix="framepath-configure.")
    with open(os.path.join(STOCK, "axis_mm.ini"), encoding="utf-8") as file:
        text = file.read()
    for line in NEED_A_SCREEN:
        assert line in text, line
        text = text.replace(line, "")
    if kinematics:
        text = harness.edit_ini(text, {("KINS", "KINEMATICS"): kinematics})
    with open(os.path.join(folder, "axis_mm.ini"), "w", encoding="utf-8") as file:
        file.write(text)
    shutil.copy(os.path.join(STOCK, "sim_mm.tbl"), folder)
    # since LinuxCNC 2.9.4
    cooling = os.path.join(STOCK, "cooling.hal")
    if os.path.exists(cooling):
        shutil.copy(cooling, folder)
    subprocess.run([harness.TOOL, "configure", "axis_mm.ini", *options], cwd=folder, check=True, capture_output=True)
    return folder


class Configure(unittest.TestCase):
    def run_configured(self, steps, programs, *options, kinematics=None):
        folder = configured(*options, kinematics=kinematics)
        self.addCleanup(shutil.rmtree, folder)
        return harness.run(steps, programs, sample="axis_mm-framepath", configuration=folder, record=False)

    def test_blendtp_runs_a_program(self):
        result = self.run_configured([["getp", "version", "blendtp.version"], ["getp", "jerk", "blendtp.axis.x.max-jerk"],
                                      ["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": PROGRAM})
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [])
        self.assertGreater(int(result.answers["version"]), 0)
        self.assertEqual(float(result.answers["jerk"]), 10160)
        for joint, place in enumerate((10, 10, 5)):
            self.assertAlmostEqual(result.answers["end"]["joints"][joint], place, places=4)

    def test_frames_move_the_program(self):
        result = self.run_configured([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": FRAMES},
                                     "--frames", "--subroutines", SUBROUTINES)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [])
        for joint, place in enumerate((30, 10)):
            self.assertAlmostEqual(result.answers["end"]["joints"][joint], place, places=4)

    def test_frames_before_kinematics_that_stay(self):
        result = self.run_configured([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": FRAMES},
                                     "--frames", "--subroutines", SUBROUTINES, kinematics="corexykins")
        self.assertIsNone(result.failure, result.log)
        self.assertEqual((result.errors, result.status), ([], 0))
        for joint, place in enumerate((40, 20)):
            self.assertAlmostEqual(result.answers["end"]["joints"][joint], place, places=4)


if __name__ == "__main__":
    unittest.main()
