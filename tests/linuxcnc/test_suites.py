"""What `make suites` makes of LinuxCNC's own tests: copies for a planner, and what is said of them. No LinuxCNC is run."""

import os
import tempfile
import unittest

import harness
import suites

PLACE = "/nowhere/abort/g64"
FAILED = f"*** {PLACE}: XFAIL: test run exited with 2\nRuntest: 1 tests run, 0 successful, 1 failed + 0 expected, 0 skipped\n"


def source(folder, version, **tests):
    """A folder like LinuxCNC's source: for each test the text of its INI, or None."""
    for test, ini in tests.items():
        place = os.path.join(folder, "tests", test.replace("_", os.sep))
        os.makedirs(place)
        for name, text in (("test.sh", "exit 0\n"), ("test.ini", ini)):
            if text is not None:
                with open(os.path.join(place, name), "w", encoding="utf-8") as file:
                    file.write(text)
    with open(os.path.join(folder, "VERSION"), "w", encoding="utf-8") as file:
        file.write(version)


class Suites(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def test_the_planner_is_named_once_and_behind_its_section(self):
        self.assertEqual(suites.with_planner("[KINS]\nJOINTS = 3\n[TRAJ]\nCOORDINATES = X\n", "blendtp"),
                         "[KINS]\nJOINTS = 3\n[TRAJ]\nTPMOD = blendtp\nCOORDINATES = X\n")
        self.assertEqual(suites.with_planner("[TRAJ] # first\n", "tpmod"), "[TRAJ] # first\nTPMOD = tpmod\n")

    def test_tests_with_motion_are_found(self):
        motion = "[EMCMOT]\nEMCMOT = motmod\n[TRAJ]\n"
        other = motion.replace("motmod", "motion-logger")
        source(self.folder, suites.installed_version(), motion_g0=motion, interp_bad=None, logger=other)
        linuxcnc = suites.LinuxCNC(self.folder, self.folder)
        self.assertEqual(linuxcnc.tests_with_motion(), ["motion/g0"])
        self.assertEqual(linuxcnc.tests("interp"), ["interp/bad"])

    def test_a_source_of_another_series_that_is_not_built_is_refused(self):
        source(self.folder, "2.7.15\n")
        os.mkdir(os.path.join(self.folder, "tests"))
        with self.assertRaisesRegex(SystemExit, r"is LinuxCNC 2\.7\.15 and not built, 2\.\d.* is installed: build it"):
            suites.LinuxCNC(self.folder, self.folder)
        with self.assertRaisesRegex(SystemExit, "has no folder tests"):
            suites.LinuxCNC("/proc/self", self.folder)

    def test_nothing_else_can_be_loaded_in_place_of_ours(self):
        modules = suites.modules_for("blendtp", self.folder)
        self.assertEqual(os.path.getsize(os.path.join(modules, "tpmod.so")), 0)
        self.assertTrue(os.path.getsize(os.path.join(modules, "blendtp.so")))
        self.assertEqual(suites.modules_for("tpmod", self.folder), harness.MODULES)

    def test_what_is_said_of_a_test(self):
        passed = suites.judge("Runtest: 1 tests run, 1 successful, 0 failed + 0 expected, 0 skipped\n", PLACE, True)
        self.assertEqual((passed.passes, passed.text), (True, "passes"))
        failed = suites.judge(FAILED, PLACE, True)
        self.assertEqual((failed.passes, failed.text), (False, "fails: test run exited with 2"))
        skipped = suites.judge("Runtest: 0 tests run, 0 successful, 0 failed + 0 expected, 1 skipped\n", PLACE, True)
        self.assertEqual((skipped.passes, skipped.text), (True, "skipped"))
        self.assertFalse(suites.judge("sh: no such file\n", PLACE, True).passes)

    def test_only_what_is_known_is_excused(self):
        corner = suites.judge("*** ERROR max X4.570 != expected X3.700\nExiting with 2 errors\n" + FAILED, PLACE, True)
        self.assertIn("less is cut off", suites.known("abort/g64", corner))
        other = suites.judge("*** ERROR max X4.570 != expected X3.700\nExiting with 3 errors\n" + FAILED, PLACE, True)
        self.assertEqual(suites.known("abort/g64", other), "")
        self.assertEqual(suites.known("lathe", corner), "")

    def test_what_is_known_is_explained(self):
        with open(os.path.join(harness.ROOT, "docs", "suites.md"), encoding="utf-8") as file:
            page = file.read()
        for test in suites.KNOWN:
            self.assertIn(f"## {test}:", page)


if __name__ == "__main__":
    unittest.main()
