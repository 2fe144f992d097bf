"""The C of both modules with sanitizers, and the modules as users get them under valgrind: their whole interface is driven
in a process of its own (tests/abi), without LinuxCNC."""

import os
import shutil
import subprocess
import tempfile
import unittest
import unittest.mock

import pytest

import abi_drivers

SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize=object-size", "-fno-sanitize-recover=all",
              "-fno-omit-frame-pointer"]
MACHINES = (("XYZ", "identity", "frame"), ("xyyzabcuvw", "identity", "machine"), ("XYZAC", "xyzac", "frame"),
            ("XYZBC", "xyzbc", "machine"))
REFUSED = (("", "identity", "frame", "coordinates="), ("XYQ", "identity", "frame", "coordinates=XYQ"),
           ("X" * 500, "identity", "frame", "coordinates=XXX"), ("XYZ", "5", "frame", "machine=5"),
           ("XYZ", "xyzac", "frame", "coordinates=XYZ"), ("XYZ", "identity", "long", "tool_length=long"))


class Watched(unittest.TestCase):
    """The tests; a subclass says who watches, and for how many periods."""

    folder: str
    drivers: dict[str, str]
    #: what the watcher is called with, and what it says of a fault
    WRAPPER: tuple[str, ...]
    FINDING: str
    SEEDS: int
    PLANNER_PERIODS: int
    KINEMATICS_PERIODS: int

    @classmethod
    def compiled(cls, name, output):
        raise NotImplementedError

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.drivers = {name: cls.compiled(name, os.path.join(cls.folder, name)) for name in abi_drivers.MODULES}

    def done(self, name, *arguments):
        return subprocess.run([*self.WRAPPER, self.drivers[name], *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, env=self.environment())

    def environment(self):
        return None

    def fine(self, name, *arguments):
        done = self.done(name, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_planner(self):
        for seed in range(self.SEEDS):
            with self.subTest(seed=seed):
                self.fine("blendtp", str(seed), str(self.PLANNER_PERIODS))

    def test_kinematics(self):
        for machine in MACHINES:
            with self.subTest(machine=machine):
                self.fine("framekins", *machine, "1", str(self.KINEMATICS_PERIODS))

    def test_refused_parameters(self):
        for *parameters, words in REFUSED:
            with self.subTest(parameters=parameters):
                self.assertIn(f"framekins: {words}", self.fine("framekins", *parameters, "1", "0"))

    def test_ini(self):
        ini = os.path.join(self.folder, "machine.ini")
        with open(ini, "wb") as file:
            file.write(b"[AXIS_" + b"X" * 5000 + b"\n[AXIS_]\nMAX_JERK\n[AXIS_\xff]\nMAX_JERK = 5\n[\n[AXIS_X]\nMAX_JERK ="
                       + b" " * 4000 + b"7\n[AXIS_Y]\n MAX_JERK=1e999\nMAX_JERK = x\n[AXIS_Z]\n\x00\nMAX_JERK = nan")
        with unittest.mock.patch.dict(os.environ, INI_FILE_NAME=ini):
            self.fine("blendtp", "1", "20")

    def test_a_fault_is_seen(self):
        for name, arguments in (("blendtp", ("1", "1")), ("framekins", ("XYZ", "identity", "frame", "1", "1"))):
            done = self.done(name, *arguments, "fault")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(self.FINDING, done.stdout)


class Sanitizers(Watched):
    """Address and undefined behaviour in the C of the modules, linked with the library."""

    WRAPPER, FINDING = (), "heap-buffer-overflow"
    SEEDS, PLANNER_PERIODS, KINEMATICS_PERIODS = 4, 20000, 100000

    @classmethod
    def compiled(cls, name, output):
        return abi_drivers.with_source(name, output, *SANITIZERS)

    def environment(self):
        # what a machine has until it is switched off is no leak
        return dict(os.environ, ASAN_OPTIONS="detect_leaks=0")


@pytest.mark.thorough
class Valgrind(Watched):
    """The modules as they are installed."""

    WRAPPER, FINDING = ("valgrind", "--quiet", "--error-exitcode=9"), "Invalid read"
    SEEDS, PLANNER_PERIODS, KINEMATICS_PERIODS = 1, 3000, 5000

    @classmethod
    def compiled(cls, name, output):
        return abi_drivers.with_module(name, output)


# without a watcher it is nothing to run
del Watched

if __name__ == "__main__":
    unittest.main()
