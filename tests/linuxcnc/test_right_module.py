"""The right module under the right LinuxCNC: one that was built for another is refused when it is loaded, and so is one
that would be loaded for nothing, since another has its place."""

import glob
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import pytest

import abi_drivers
import harness
from abi_drivers import LIBRARY
from test_loading import MOTION, Refusals, halrun

#: What every refusal of a module of another LinuxCNC says.
BUILT_FOR, RUNNING, REMEDY = "built for LinuxCNC", "running under LinuxCNC 2.9", "make install again"


def build(folder, *arguments):
    """The modules, built into a folder with other settings of make."""
    done = subprocess.run(["make", "-C", harness.SAMPLES, f"OUT={folder}", f"LIBRARY={LIBRARY}", *arguments],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)
    return done.stdout


def changed_headers(folder, before, after):
    """A copy of LinuxCNC's headers in which a line of motion.h or tp_types.h reads otherwise."""
    copy = os.path.join(folder, "headers")
    for headers in harness.HEADERS:
        shutil.copytree(headers, copy, dirs_exist_ok=True)
    found = 0
    for name in ("motion.h", "tp_types.h"):
        path = os.path.join(copy, name)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        found += text.count(before)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(before, after))
    if found != 1:
        raise AssertionError(f"{before} is {found} times in LinuxCNC's headers")
    return copy


class OtherLinuxCNC(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.modules = os.path.join(self.folder, "modules")

    def assert_refused(self, commands, name, *words):
        output, code = halrun(commands, self.modules)
        self.assertNotEqual(code, 0, output)
        lines = [line for line in output.splitlines() if line.startswith(f"{name}: {BUILT_FOR}")]
        self.assertEqual(len(lines), 1, output)
        for word in (RUNNING, REMEDY, *words):
            self.assertIn(word, lines[0])
        return output

    def test_another_version_is_refused_at_once(self):
        for version in ("2.10.0~pre1", "3.9.0"):
            build(self.modules, f"LINUXCNC_VERSION={version}")
            self.assert_refused("loadrt blendtp\n", "blendtp", f"{BUILT_FOR} {version},")
            self.assert_refused("loadrt framekins coordinates=XYZ\n", "framekins", f"{BUILT_FOR} {version},")

    @pytest.mark.thorough
    def test_another_release_of_the_series_and_an_unknown_one_are_not(self):
        for version in ("2.9.10", ""):
            build(self.modules, f"LINUXCNC_VERSION={version}")
            output, code = halrun(MOTION, self.modules)
            self.assertEqual(code, 0, output)
            self.assertNotIn(BUILT_FOR, output)

    def other_layout(self, before, after, *words):
        headers = changed_headers(self.folder, before, after)
        build(self.modules, f"LINUXCNC_INCLUDE={headers}")
        shutil.rmtree(headers)
        output = self.assert_refused(MOTION, "blendtp", f"{BUILT_FOR} an unknown version,", *words)
        self.assertIn("MOTION: tpCreate failed", output)
        self.assertNotIn("MOTION: init_threads", output)

    def test_a_larger_status_is_refused(self):
        self.other_layout("\tdouble requested_vel;", "\tdouble requested_vel, requested_acc;",
                          "configuration is 5632 bytes behind motion's status, not 5640")

    def test_a_smaller_status_is_refused(self):
        self.other_layout("    int stepping;", "", "bytes behind motion's status, not ")

    def test_a_larger_configuration_is_refused(self):
        self.other_layout("        double maxFeedScale;", "        double maxFeedScale, leastFeedScale;", "its planner is ")

    def test_fields_in_another_order_are_refused(self):
        self.other_layout("double rapid_scale;\t/* velocity scale factor for rapids */\n\tunsigned char enables_new;",
                          "unsigned char enables_new;\n\tdouble rapid_scale;", "the overrides are not 1")


@pytest.mark.thorough
class NextSeries(unittest.TestCase):
    """What LinuxCNC 2.10 has more of, with headers that are changed to have it: the same C is built for both."""

    def test_moves_with_a_limit_of_jerk_and_a_status_that_says_how_it_goes(self):
        with tempfile.TemporaryDirectory() as folder:
            headers = changed_headers(folder, "    int stepping;",
                                      "    int stepping; double current_acc, current_jerk; PmCartesian current_dir;")
            with open(os.path.join(headers, "tp.h"), encoding="utf-8") as file:
                text = file.read()
            with open(os.path.join(headers, "tp.h"), "w", encoding="utf-8") as file:
                file.write(text.replace("double acc,", "double acc, double ini_maxjerk,"))
            driver = abi_drivers.with_source("blendtp", os.path.join(folder, "driver"), includes=["-isystem", headers])
            for seed in range(3):
                done = subprocess.run([driver, str(seed), "5000"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                      text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout)


class Check(unittest.TestCase):
    """framepath check reads in the file of a module what it is built for."""

    def check(self, modules):
        """The texts that framepath check has found in a sample, under the installed LinuxCNC with modules of a folder."""
        with tempfile.TemporaryDirectory() as folder:
            with open("/usr/bin/linuxcnc", encoding="utf-8") as file:
                script = file.read()
            with open(os.path.join(folder, "linuxcnc"), "w", encoding="utf-8") as file:
                file.write(re.sub("(?m)^LINUXCNC_RTLIB_DIR=.*", f"LINUXCNC_RTLIB_DIR={modules}", script))
            ini = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")
            path = f"{folder}:{os.path.dirname(harness.TOOL)}:/usr/bin:/bin"
            done = subprocess.run([harness.TOOL, "check", ini, "--json"], env=dict(os.environ, PATH=path), capture_output=True,
                                  text=True, check=False)
            return [finding["found"] for finding in json.loads(done.stdout)["findings"]]

    def test_those_of_the_installed_one_fit(self):
        self.assertEqual(self.check(harness.MODULES), [])

    def test_those_of_another_one_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            build(folder, "LINUXCNC_VERSION=2.10.0~pre1")
            found = self.check(folder)
        self.assertEqual(len(found), 2, found)
        for name, text in zip(("blendtp", "framekins"), found, strict=True):
            self.assertIn(f"{folder}/{name}.so is {BUILT_FOR} 2.10.0~pre1, and 2.9", text)


class RunningVersion(unittest.TestCase):
    """The version is read beside the program that loads the module, be LinuxCNC installed or run in place."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = folder.name
        os.mkdir(os.path.join(self.tree, "bin"))
        os.mkdir(os.path.join(self.tree, "scripts"))

    def started(self, built_for, running, script):
        """What a program with blendtp in it says at its start."""
        program = os.path.join(self.tree, "bin", "program")
        abi_drivers.with_source("blendtp", program, built_for=built_for)
        with open(os.path.join(self.tree, script), "w", encoding="utf-8") as file:
            file.write(f'#!/bin/bash\n# LINUXCNCVERSION\nLINUXCNCVERSION="{running}"; export LINUXCNCVERSION\n')
        done = subprocess.run([program, "1", "0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        os.remove(os.path.join(self.tree, script))
        return done.returncode, done.stdout

    @pytest.mark.thorough
    def test_built_for_this_one_and_loaded_by_the_next(self):
        for script in ("bin/linuxcnc", "scripts/linuxcnc"):
            code, said = self.started("2.9.4", "2.10.0~pre1", script)
            self.assertNotEqual(code, 0, said)
            self.assertIn("blendtp: built for LinuxCNC 2.9.4, running under LinuxCNC 2.10.0~pre1: in framepath's sources: "
                          "make install again", said)

    def test_the_same_series(self):
        for script in ("bin/linuxcnc", "scripts/linuxcnc"):
            code, said = self.started("2.9.0~pre1", "2.9.10", script)
            self.assertEqual(code, 0, said)


class Beside(Refusals):
    """Motion takes its planner and its kinematics from the first module that has them."""

    def test_a_planner_that_is_loaded_already(self):
        self.refused("loadrt tpmod\nloadrt blendtp\n", "blendtp: ", "modules/tpmod.so is loaded already",
                     "TPMOD = blendtp under [TRAJ]")

    def test_kinematics_that_are_loaded_already(self):
        self.refused("loadrt trivkins\nloadrt framekins coordinates=XYZ\n", "framekins: ",
                     "modules/trivkins.so is loaded already", "KINEMATICS = framekins")


class Built(unittest.TestCase):
    """`make modules` builds anew for another LinuxCNC, be its headers ever so old."""

    def test_other_headers_are_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            modules = os.path.join(folder, "modules")
            noticed = os.path.join(modules, "built-for")
            build(modules, "built-for")
            with open(noticed, encoding="utf-8") as file:
                first = file.read()
            stamp = os.stat(noticed).st_mtime_ns
            build(modules, "built-for")
            self.assertEqual(os.stat(noticed).st_mtime_ns, stamp)
            headers = changed_headers(folder, "    int stepping;", "    int stepping, standing;")
            os.utime(os.path.join(headers, "motion.h"), (0, 0))
            build(modules, "built-for", f"LINUXCNC_INCLUDE={headers}")
            with open(noticed, encoding="utf-8") as file:
                self.assertNotEqual(file.read(), first)

    def test_a_source_of_linuxcnc_has_the_headers_and_the_version(self):
        show = ["make", "-s", "-C", harness.ROOT, "--eval", "show: ; @echo $$LINUXCNC_INCLUDE $$LINUXCNC_VERSION", "show"]
        with tempfile.TemporaryDirectory() as source:
            for folder in ("motion", "tp", "task"):
                os.makedirs(os.path.join(source, "src", "emc", folder))
            with open(os.path.join(source, "VERSION"), "w", encoding="utf-8") as file:
                file.write("2.10.0~pre1\n")
            done = subprocess.run([*show, f"LINUXCNC_SOURCE={source}"], capture_output=True, text=True, check=True)
            self.assertEqual(done.stdout.split(), [f"{source}/src/emc:{source}/src/emc/motion:{source}/src/emc/tp",
                                                   "2.10.0~pre1"])
            done = subprocess.run([*show, f"LINUXCNC_SOURCE={source}/src"], capture_output=True, text=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"LINUXCNC_SOURCE={source}/src has no src/emc/motion", done.stderr)
            os.remove(os.path.join(source, "VERSION"))
            done = subprocess.run([*show, f"LINUXCNC_SOURCE={source}"], capture_output=True, text=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"LINUXCNC_SOURCE={source} has no version in a file VERSION: it is to be", done.stderr)

    def test_headers_of_a_linuxcnc_that_is_run_in_place(self):
        with tempfile.TemporaryDirectory() as tree:
            for name in ("include", "scripts"):
                os.mkdir(os.path.join(tree, name))
            shutil.copy(os.path.join(harness.HEADERS[0], "motion.h"), os.path.join(tree, "include"))
            with open(os.path.join(tree, "scripts", "linuxcnc"), "w", encoding="utf-8") as file:
                file.write('LINUXCNCVERSION="2.9.77"; export LINUXCNCVERSION\n')
            build(tree, "built-for", f"LINUXCNC_INCLUDE={tree}/include")
            with open(os.path.join(tree, "built-for"), encoding="utf-8") as file:
                self.assertEqual(file.readline(), "2.9.77\n")

    def test_cargo_looks_at_what_make_has_noticed(self):
        noticed = f"cargo:rerun-if-changed={os.path.join(harness.MODULES, 'built-for')}"
        for folder in glob.glob(os.path.join(os.path.dirname(LIBRARY), "build", "framepath-*", "output")):
            with open(folder, encoding="utf-8") as file:
                if noticed in file.read().splitlines():
                    return
        self.fail(f"no build script said {noticed}")

    def test_the_version_is_that_of_the_installed_one(self):
        version = subprocess.run(["linuxcnc_var", "LINUXCNCVERSION"], capture_output=True, text=True, check=True).stdout
        with open(os.path.join(harness.MODULES, "built-for"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip(), version.strip())


if __name__ == "__main__":
    unittest.main()
