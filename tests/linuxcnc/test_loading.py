"""The modules in halrun: how they load, what they say when they cannot, and that motmod's calls arrive in them."""

import os
import subprocess
import tempfile
import unittest

import harness


def halrun(text):
    """Output and exit code of halrun with a file of commands."""
    with tempfile.NamedTemporaryFile("w", suffix=".hal", delete=False) as file:
        file.write(text)
    os.chmod(file.name, 0o644)
    try:
        done = subprocess.run([os.path.join(harness.HERE, "isolated"), harness.MODULES, "halrun", "-f", file.name],
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


class Loading(unittest.TestCase):
    def test_both_load_before_motmod(self):
        output, code = halrun(MOTION + "addf motion-controller servo-thread\nstart\nshow comp\n"
                                       "getp blendtp.version\ngetp framekins.version\n")
        self.assertEqual(code, 0, output)
        for component in ("blendtp", "framekins", "motmod"):
            self.assertIn(component, output)
        # version 0.1.0
        self.assertEqual([line for line in output.splitlines() if line.strip() == "100"], ["100", "100"], output)

    def refused(self, commands, *words):
        output, code = halrun(commands)
        self.assertNotEqual(code, 0, output)
        for word in words:
            self.assertIn(word, output)

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

    def test_loaded_twice(self):
        for load, name in (("loadrt blendtp", "blendtp"), ("loadrt framekins coordinates=XYZ", "framekins")):
            output, _ = halrun(f"{load}\n{load}\n")
            # LinuxCNC's own loader refuses it by name
            self.assertIn(f"{name}: already exists", output)

    def test_duplicate_letters_are_accepted(self):
        output, code = halrun("loadrt framekins coordinates=xyyz\ngetp framekins.version\n")
        self.assertEqual(code, 0, output)
        self.assertIn("100", output.split())


if __name__ == "__main__":
    unittest.main()
