"""The modules in halrun: how they load, what they say when they cannot, and that motmod's calls arrive in them; and what
the build looks for in them."""

import os
import shutil
import subprocess
import tempfile
import unittest

import harness


def halrun(text, modules=harness.MODULES):
    """Output and exit code of halrun with a file of commands, and with the modules of a folder."""
    with tempfile.NamedTemporaryFile("w", suffix=".hal", delete=False) as file:
        file.write(text)
    os.chmod(file.name, 0o644)
    try:
        done = subprocess.run([os.path.join(harness.HERE, "isolated"), modules, "halrun", "-f", file.name],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=60, check=False)
        return done.stdout, done.returncode
    finally:
        os.remove(file.name)


MOTION = """\
loadrt blendtp
loadrt homemod
loadrt framekins coordinates=XYZ
loadrt motmod servo_period_nsec=1000000 num_joints=3
"""


class Refusals(unittest.TestCase):
    def refused(self, commands, *words):
        """Carries out the commands, which fail with these words."""
        output, code = halrun(commands)
        self.assertNotEqual(code, 0, output)
        for word in words:
            self.assertIn(word, output)


class Loading(Refusals):
    def test_both_load_before_motmod(self):
        output, code = halrun(MOTION + "addf motion-controller servo-thread\nstart\nshow comp\n"
                                       "getp blendtp.version\ngetp framekins.version\n")
        self.assertEqual(code, 0, output)
        for component in ("blendtp", "framekins", "motmod"):
            self.assertIn(component, output)
        # version 0.1.0
        self.assertEqual([line for line in output.splitlines() if line.strip() == "100"], ["100", "100"], output)

    def test_unknown_parameter(self):
        self.refused("loadrt framekins coordinates=XYZ colour=red\n", "colour")
        self.refused("loadrt blendtp jerk=5\n", "jerk")

    def test_coordinates_missing_or_empty(self):
        self.refused("loadrt framekins\n", "framekins: coordinates=", "no axis is named",
                     "loadrt framekins coordinates=XYZ")
        self.refused("loadrt framekins coordinates=\n", "framekins: coordinates=", "no axis is named")

    def test_coordinates_with_a_wrong_letter(self):
        self.refused("loadrt framekins coordinates=XYQ\n", "coordinates=XYQ", "this is no axis letter", "letter 3")

    def test_more_coordinates_than_joints(self):
        self.refused("loadrt framekins coordinates=" + "X" * 17 + "\n", "more letters than LinuxCNC has joints",
                     "letter 17")

    def test_texts_of_parameters(self):
        self.refused("loadrt framekins coordinates=XYZ machine=5\n", "machine=5: there is no such machine", "machine=identity")
        self.refused("loadrt framekins coordinates=XYZ tool_length=12.5\n", "tool_length=12.5: there is no such rule")
        self.refused("loadrt framekins coordinates\n", "Invalid parameter `coordinates'")
        output, _ = halrun("loadrt framekins coordinates=XYZ machine=xyzac\n")
        self.assertIn("coordinates=XYZ: an axis that this machine needs is missing: xyzac needs X Y Z A C", output)
        self.assertNotIn("letter 0", output)

    def test_loaded_twice(self):
        for load, name in (("loadrt blendtp", "blendtp"), ("loadrt framekins coordinates=XYZ", "framekins")):
            output, _ = halrun(f"{load}\n{load}\n")
            # LinuxCNC's own loader refuses it by name
            self.assertIn(f"{name}: already exists", output)

    def test_kinematics_are_asked_for_their_type_by_motmod_alone(self):
        with tempfile.TemporaryDirectory() as modules:
            harness.modules_with("asked_kins", modules)
            os.chmod(modules, 0o755)
            asked = MOTION.replace("framekins coordinates=XYZ", "asked_kins") + "getp asked_kins.asked\n"
            output, code = halrun(asked, modules)
        self.assertEqual(code, 0, output)
        self.assertEqual([line for line in output.splitlines() if line.strip().isdigit()], ["1"], output)

    def test_duplicate_letters_are_accepted(self):
        output, code = halrun("loadrt framekins coordinates=xyyz\ngetp framekins.version\n")
        self.assertEqual(code, 0, output)
        self.assertIn("100", output.split())


class CheckModule(unittest.TestCase):
    """hal-component/check-module removes a module that must not run in a servo thread."""

    CHECK = os.path.join(harness.SAMPLES, "check-module")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.module = os.path.join(folder.name, "module.so")

    def check(self):
        done = subprocess.run([self.CHECK, self.module], capture_output=True, text=True, check=False)
        self.assertEqual(os.path.exists(self.module), done.returncode == 0)
        return done.returncode, done.stderr

    def compiled(self, text):
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.module, "-x", "c", "-"], input=text, text=True, check=True)
        return self.check()

    def refused(self, outcome, words):
        code, said = outcome
        self.assertEqual(code, 1)
        self.assertIn(words, said)

    def test_ours_are_good(self):
        for name in ("blendtp", "framekins"):
            shutil.copy(os.path.join(harness.MODULES, f"{name}.so"), self.module)
            self.assertEqual(self.check(), (0, ""))

    def test_what_allocates_or_has_storage_of_a_thread_is_not(self):
        self.refused(self.compiled("#include <stdlib.h>\nvoid *rtapi_app_main(void) { return malloc(9); }\n"),
                     "could panic or allocate")
        self.refused(self.compiled("__thread int a = 1;\nint rtapi_app_main(void) { return 1; }\n"),
                     "thread-local storage")

    def test_what_cannot_be_seen_is_not(self):
        shutil.copy(os.path.join(harness.MODULES, "blendtp.so"), self.module)
        subprocess.run(["strip", "--strip-all", self.module], check=True)
        self.refused(self.check(), "symbols cannot be seen")
        with open(self.module, "w", encoding="utf-8") as file:
            file.write("no module\n")
        self.refused(self.check(), "nm cannot read it")


if __name__ == "__main__":
    unittest.main()
