"""Builds the programs of tests/abi, which drive a module in a process without LinuxCNC."""

import os
import shutil
import subprocess

import harness

LIBRARY = os.path.join(os.path.dirname(harness.MODULES), "realtime", "libframepath.a")
DRIVERS = os.path.join(harness.ROOT, "tests", "abi")
STUBS = os.path.join(harness.ROOT, "tool", "src", "loaded", "stubs.c")
FLAGS = ["-g", "-O1", "-Wall", "-Wextra", "-Werror", "-DRTAPI", "-DUSPACE", "-D__MODULE__", "-D_GNU_SOURCE",
         "-DHOST_KEEPS_HEAP", "-I", os.path.join(harness.ROOT, "include"), "-I", DRIVERS]
#: the driver of each module, and what it is compiled with
MODULES: dict[str, tuple[str, list[str]]] = {
    "blendtp": ("drive_planner.c", []), "framekins": ("drive_kinematics.c", ["-DHOST_WITHOUT_KINEMATICS"])}


def _cc(name, output, *arguments, includes=harness.INCLUDES):
    driver, module_flags = MODULES[name]
    flags = [*FLAGS, *includes]
    # what tells the C which LinuxCNC the headers belong to
    has = subprocess.run([os.path.join(harness.SAMPLES, "linuxcnc-has"), "cc", *flags], capture_output=True, text=True,
                         check=True).stdout.split()
    done = subprocess.run(["cc", *flags, *has, *module_flags, os.path.join(DRIVERS, driver), STUBS, *arguments, "-o", output],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)
    return output


def with_source(name, output, *flags, built_for="", includes=harness.INCLUDES):
    """A driver with the C of its module and the library in one, built for this version of LinuxCNC."""
    return _cc(name, output, f'-DFRAMEPATH_BUILT_FOR="{built_for}"', *flags, os.path.join(harness.SAMPLES, f"{name}.c"),
               "-Wl,--no-as-needed", "-lm", LIBRARY, includes=includes)


def with_module(name, output):
    """A driver with a copy of the module that users get, beside it."""
    module = f"{output}.so"
    shutil.copy(os.path.join(harness.MODULES, f"{name}.so"), module)
    return _cc(name, output, module, "-rdynamic", "-lm")
