"""A stock configuration of LinuxCNC, configured by framepath configure, runs in LinuxCNC."""

import os
import shutil
import subprocess
import tempfile
import unittest

import pytest

import harness

STOCK = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis"
SUBROUTINES = os.path.join(harness.ROOT, "hal-component/subroutines")

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


#: a lathe in inches, whose HAL file is one in Tcl of LinuxCNC's
LATHE = """G20 G90 G18 G7 G61.1
o<trans> call [0.5] [0] [-0.25]
G1 X0.5 Z1 F30
o<frame_off> call
M2
"""


def stock(ini, *edits):
    """A folder with a sample of LinuxCNC and the files beside it, changed by (from, to); the subroutines are where the
    harness has them."""
    source = os.path.join(STOCK, ini)
    base = tempfile.mkdtemp(prefix="framepath-configure.")
    os.symlink(os.path.join(harness.SAMPLES, "subroutines"), os.path.join(base, "subroutines"))
    folder = os.path.join(base, "configs", "stock")
    os.makedirs(folder)
    for entry in os.scandir(os.path.dirname(source)):
        if entry.is_file():
            shutil.copy(entry.path, folder)
    remaps = os.path.join(os.path.dirname(source), "remap_subs")
    if os.path.isdir(remaps):
        shutil.copytree(remaps, os.path.join(folder, "remap_subs"))
    with open(source, encoding="utf-8") as file:
        text = file.read()
    for line, changed in edits:
        assert line in text, line
        text = text.replace(line, changed)
    with open(os.path.join(folder, os.path.basename(ini)), "w", encoding="utf-8") as file:
        file.write(text)
    return folder


def run_configured(test, ini, folder, steps, programs, *options):
    """Runs steps on it, configured with these options, and takes the folder away."""
    test.addCleanup(shutil.rmtree, os.path.dirname(os.path.dirname(folder)))
    name = os.path.basename(ini)
    subprocess.run([harness.TOOL, "configure", name, *options], cwd=folder, check=True, capture_output=True)
    sample = name.replace(".ini", "-framepath")
    return harness.run(steps, programs, sample=sample, configuration=folder, record=False)


class Configure(unittest.TestCase):
    def run_configured(self, steps, programs, *options, kinematics=None):
        edits = [(line, "") for line in NEED_A_SCREEN]
        if kinematics:
            edits.append(("KINEMATICS = trivkins", f"KINEMATICS = {kinematics}"))
        return run_configured(self, "axis_mm.ini", stock("axis_mm.ini", *edits), steps, programs, *options)

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


#: what those with a HAL file in Tcl name that wants a screen
TCL_NEEDS_A_SCREEN = (("HALUI = halui\n", "\n"), ("LIB:basic_sim.tcl", "LIB:basic_sim.tcl -no_use_hal_manualtoolchange"))


@pytest.mark.thorough
class Tcl(unittest.TestCase):
    """HAL files in Tcl are LinuxCNC's own affair: what is needed comes before and behind them."""

    def run_stock(self, ini, edits, steps, programs, *options):
        folder = stock(ini, *TCL_NEEDS_A_SCREEN, *edits)
        return run_configured(self, ini, folder, steps, programs, *options)

    def test_frames_on_a_lathe(self):
        postgui = ("POSTGUI_HALFILE = lathe_postgui.hal\n", "")
        result = self.run_stock("lathe.ini", [postgui], [["getp", "jerk", "blendtp.axis.x.max-jerk"], ["run", "PROGRAMS/part.ngc"],
                                                         ["note", "end"]], {"part.ngc": LATHE},
                                "--frames", "--subroutines", SUBROUTINES)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual((result.errors, result.status), ([], 0))
        self.assertEqual(float(result.answers["jerk"]), 400)
        for joint, place in enumerate((0.75, 0.75)):
            self.assertAlmostEqual(result.answers["end"]["joints"][joint], place, places=5)

    def test_frames_before_a_tilting_table(self):
        without = [("HALCMD = loadusr -W xyzac-trt-gui\n", ""), ("POSTGUI_HALFILE = switchkins_postgui.hal\n", "")]
        pictures = [(f" xyzac-trt-gui.{pin}\n", "\n") for pin in ("table-x", "saddle-y", "spindle-z", "tilt-a", "rotate-c",
                                                                  "tool-offset", "y-offset", "z-offset")]
        # of two positions the one that A reaches, from -100 to 50
        plane = "G43.4\nG68.2 X0 Y0 Z0 I30 J-60 K0\nG53.1\nG69\no<rotary_zero> call\no<tool_centre_off> call\n"
        result = self.run_stock("vismach/5axis/table-rotary-tilting/xyzac-trt.ini", without + pictures,
                                [["getp", "most", "framekins.tilt-max"], ["run", "PROGRAMS/part.ngc"], ["note", "end"]],
                                {"part.ngc": plane + FRAMES}, "--frames", "--subroutines", SUBROUTINES)
        self.assertEqual(float(result.answers["most"]), 50, result.log)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual((result.errors, result.status), ([], 0))
        for joint, place in enumerate((30, 10)):
            self.assertAlmostEqual(result.answers["end"]["joints"][joint], place, places=4)


if __name__ == "__main__":
    unittest.main()
