"""LinuxCNC's own sample of a tilting rotary table, with its remaps and with framekins before it."""

import os
import shutil
import tempfile
import unittest

import harness
import inner_machine

SAMPLE = "xyzac-trt"
FOLDER = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis/vismach/5axis/table-rotary-tilting"

SIM = "HALFILE = LIB:basic_sim.tcl"

#: what is changed in the INI file; [KINS]KINEMATICS stays
CHANGES = [
    (SIM, f"HALFILE = before.hal\n{SIM} -no_use_hal_manualtoolchange\nHALFILE = after.hal"),
    ("=> motion.switchkins-type", "=> framekins.inner-type"),
    ("EMCMOT = motmod", "EMCMOT = motmod num_aio=16"),
    ("SUBROUTINE_PATH = ./remap_subs",
     "SUBROUTINE_PATH = ./remap_subs:../../subroutines\nOWORD_NARGS = 1\n" + inner_machine.ABORT),
]

#: signals that the sample has already
NETS = [("net motion-on motion.motion-enabled", "net sample:enable"),
        ("net tool-z motion.tooloffset.z", "net :tool-offset motion.tooloffset.z")]


class Sample(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.config = os.path.join(folder.name, "config")
        shutil.copytree(FOLDER, self.config)
        with open(os.path.join(self.config, f"{SAMPLE}.ini"), encoding="utf-8") as file:
            # its picture wants a screen
            lines = [line.replace("xyzac-trt-gui.tool-offset", "").replace("xyzac-trt-gui.y-offset", "")
                     .replace("xyzac-trt-gui.z-offset", "") for line in file if "loadusr" not in line and "POSTGUI" not in line]
        text = "".join(line for line in lines if "xyzac-trt-gui." not in line)
        nets = inner_machine.FRAMES + inner_machine.GUARD
        for old, new in CHANGES:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        for old, new in NETS:
            self.assertIn(old, nets)
            nets = nets.replace(old, new, 1)
        self.write(f"{SAMPLE}.ini", text + "\n" + inner_machine.SETTINGS)
        self.write("before.hal", "loadrt framekins inner=xyzac-trt-kins tool_types=1\n")
        self.write("after.hal", nets)

    def write(self, name, text):
        with open(os.path.join(self.config, name), "w", encoding="utf-8") as file:
            file.write(text)

    def test_types_and_frames(self):
        steps = [["mdi", "M428"], ["getp", "M428", "framekins.inner-type-active"], ["mdi", "G1 X5 A10 C20 F1000"],
                 ["note", "turned"], ["mdi", "M429"], ["mdi", "o<trans> call [5] [0] [0]"], ["mdi", "G1 X0 Y0"],
                 ["note", "framed"], ["mdi", "o<frame_off> call"], ["mdi", "M430"],
                 ["getp", "M430", "framekins.inner-type-active"]]
        result = harness.run(steps, sample=SAMPLE, configuration=self.config, record=False)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        self.assertEqual((result.answers["M428"], result.answers["M430"]), ("1", "2"))
        # by hand calculation: 5 mm along X, with the table turned by 20 degrees, Y 20 and Z 10 to the tilting axis at 10
        turned = result.answers["turned"]["joints"][:5]
        for found, expected in zip(turned, (4.698463103929, 3.724447160592, -3.024085210391, 10, 20), strict=True):
            self.assertAlmostEqual(found, expected, places=9)
        for found, expected in zip(result.answers["framed"]["joints"], (5, 0, turned[2], 10, 20), strict=False):
            self.assertAlmostEqual(found, expected, places=9)


if __name__ == "__main__":
    unittest.main()
