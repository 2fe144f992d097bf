"""framekins before the kinematics of another module, in halrun: each of them loads, switches and unloads, and what cannot be
is refused by name."""

import os
import tempfile
import unittest

import pytest

import harness
from inner_modules import MODULES, SKEW, all_of_linuxcnc, with_skewkins
from test_loading import Refusals, halrun

BOTH = """\
loadrt framekins inner={name}
loadrt {name}
"""

# motmod itself can be loaded only once in a HAL that has run
LOAD = BOTH + """\
loadrt motmod servo_period_nsec=1000000 num_joints={joints} num_aio=16
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf framekins servo-thread
net switch framekins.switchkins-type => motion.switchkins-type
setp framekins.in-position 1
start
"""

#: until the servo thread has done so
WAIT = f"loadusr -w {os.path.join(harness.HERE, 'wait_for_pin')} "

ASK = "setp framekins.inner-type {number}\n" + WAIT + """framekins.inner-type-active {number}
getp motion.switchkins-type
"""

UNLOAD = """\
unloadrt {name}
unloadrt framekins
"""


def numbers(output):
    return [int(line) for line in output.splitlines() if line.isdigit()]


@pytest.mark.thorough
class EachModule(unittest.TestCase):
    def comes_and_goes(self, kinematics, **options):
        """Loaded, unloaded, loaded again, switched to each of its types and back, and unloaded."""
        types = [*range(kinematics.types), 0]
        text = BOTH + UNLOAD + LOAD + "".join(ASK.format(number=number) for number in types)
        text += "stop\nunloadrt motmod\n" + UNLOAD
        text = text.format(name=kinematics.name, joints=kinematics.joints)
        output, code = halrun("loadrt tpmod\nloadrt homemod\n" + text, **options)
        self.assertEqual(code, 0, output)
        # without a frame motion's number is the type: remaps of LinuxCNC look at it
        self.assertEqual(numbers(output), types, output)
        for word in ("FAIL", "rmmod", "framekins:"):
            self.assertNotIn(word, output)

    def test_the_modules_of_linuxcnc(self):
        modules, names = all_of_linuxcnc()
        self.assertGreaterEqual(len(modules), len(MODULES))
        # none is left out, but for ours where they are installed
        self.assertEqual({kinematics.name for kinematics in modules}, names - {"framekins"})
        for kinematics in modules:
            with self.subTest(kinematics.name):
                self.comes_and_goes(kinematics)

    def test_one_that_a_user_has_compiled(self):
        with tempfile.TemporaryDirectory() as folder:
            with_skewkins(folder)
            self.comes_and_goes(SKEW, modules=folder)

    def test_a_type_that_is_not_there(self):
        state = "getp framekins.inner-type-active\ngetp framekins.hold\n"
        text = LOAD.format(name="xyzac-trt-kins", joints=5)
        text += "setp framekins.inner-type 5\n" + WAIT + "framekins.inner-refusal 18\n" + state
        text += "setp framekins.inner-type 0\n" + WAIT + "framekins.inner-refusal 0\n" + state
        output, code = halrun("loadrt tpmod\nloadrt homemod\n" + text)
        self.assertEqual(code, 0, output)
        self.assertEqual(output.count("framekins.inner-type = 5 is not taken by xyzac-trt-kins"), 1, output)
        self.assertEqual([word for word in output.split("\n") if word in ("0", "5", "TRUE", "FALSE")],
                         ["0", "TRUE", "0", "FALSE"], output)


class InnerRefusals(Refusals):
    MOTION = "loadrt motmod servo_period_nsec=1000000 num_joints=5\naddf framekins servo-thread\n"
    PLANNER = "loadrt tpmod\nloadrt homemod\n"

    def test_the_module_is_not_loaded(self):
        self.refused(self.PLANNER + "loadrt framekins inner=xyzac-trt-kins\n" + self.MOTION,
                     "inner=xyzac-trt-kins is not loaded: write loadrt framekins inner=xyzac-trt-kins, then loadrt "
                     "xyzac-trt-kins with its parameters", "then loadrt motmod", "function 'framekins' not found")

    def test_the_module_is_loaded_last(self):
        self.refused(self.PLANNER + "loadrt framekins inner=xyzac-trt-kins\n" + self.MOTION + "loadrt xyzac-trt-kins\n",
                     "inner=xyzac-trt-kins is not loaded", "then loadrt motmod")

    def test_framekins_behind_the_module(self):
        self.refused("loadrt xyzac-trt-kins\nloadrt framekins inner=xyzac-trt-kins\n",
                     "xyzac-trt-kins.so is loaded already and would be taken in its place",
                     "loadrt framekins inner=.. has to come first in the HAL files")

    def test_framekins_behind_motmod(self):
        self.refused(self.PLANNER + "loadrt xyzac-trt-kins\nloadrt motmod servo_period_nsec=1000000 num_joints=5\n"
                     "loadrt framekins inner=xyzac-trt-kins\n", "before motmod")

    def test_a_module_that_is_no_kinematics(self):
        self.refused(self.PLANNER + "loadrt framekins inner=scale\nloadrt scale\n" + self.MOTION,
                     "inner=scale has no kinematicsInverse", "write the module of [KINS]KINEMATICS")

    def test_a_module_that_is_not_there(self):
        self.refused("loadrt framekins inner=xyzac\n", "inner=xyzac: there is no", "xyzac.so",
                     "loadrt framekins inner=xyzac-trt-kins")

    def test_a_machine_beside_it(self):
        for beside, remedy in (("coordinates=XYZAC", "give coordinates= to that module"),
                               ("machine=xyzac", "to framekins inner= alone"),
                               ("tool_length=machine", "TOOL_LENGTH under [FRAMEPATH]")):
            self.refused(f"loadrt framekins inner=xyzac-trt-kins {beside}\n",
                         f"inner=xyzac-trt-kins and {beside.split('=')[0]}= exclude each other", remedy)

    def test_framekins_itself(self):
        self.refused("loadrt framekins inner=framekins\n", "inner=framekins: that is framekins itself",
                     "as in: loadrt framekins inner=xyzac-trt-kins")

    def test_motion_itself(self):
        self.refused(self.PLANNER + "loadrt framekins inner=motmod\n" + self.MOTION,
                     "inner=motmod has no kinematicsType", "write the module of [KINS]KINEMATICS")

    def test_what_needs_inner(self):
        for parameter in ("tool_types=7", "tool_axes=banana"):
            self.refused(f"loadrt framekins coordinates=XYZ {parameter}\n",
                         f"{parameter.split('=')[0]}= is for kinematics behind inner=, and there is no inner=: leave it out")

    def test_a_type_of_kinematics_that_have_one(self):
        text = "loadrt framekins inner=trivkins tool_types={}\nloadrt trivkins coordinates=XYZAC\n" + self.MOTION
        self.refused(self.PLANNER + text.format("0,5"),
                     "tool_types=0,5: inner=trivkins has one type only, which is 0: write tool_types=0")
        output, code = halrun(self.PLANNER + text.format("0"))
        self.assertEqual((code, "framekins:" in output), (0, False), output)

    def test_types_that_are_none(self):
        self.refused("loadrt framekins inner=xyzac-trt-kins tool_types=0,16\n", "tool_types=0,16: this is no list of types",
                     "as in tool_types=0,2")


if __name__ == "__main__":
    unittest.main()
