"""The kinematics modules that framekins is put before: LinuxCNC's own, and one as a user writes it."""

import dataclasses
import glob
import os
import shutil
import subprocess

import harness

#: of a LinuxCNC that is run where it was built, else of the one that is installed
BUILT = os.environ.get("LINUXCNC_IN_PLACE")
STOCK = os.path.join(BUILT, "rtlib") if BUILT else "/usr/lib/linuxcnc/modules"


@dataclasses.dataclass(frozen=True)
class Kinematics:
    """A module, with places that it can reach: joints, or positions where joints are hard to guess, and how far around."""

    name: str
    joints: int
    types: int = 1
    at_joints: tuple[float, ...] = ()
    at_position: tuple[float, ...] = ()
    around: float = 20


MODULES = [
    Kinematics("5axiskins", 6, 3, (30, 40, 50, 10, 20, 30)),
    Kinematics("corexykins", 9, at_joints=(0,) * 9),
    Kinematics("genhexkins", 6, 3, at_position=(0, 0, 20, 0, 0, 0), around=1),
    Kinematics("genserkins", 6, 3, (10, -40, -20, 20, 50, 30), around=5),
    Kinematics("lineardeltakins", 9, at_position=(0, 0, -100)),
    Kinematics("maxkins", 9, at_joints=(100, 50, 0, 10, 0, 30, 0, 0, 0)),
    Kinematics("millturn", 4, 2, (0, 0, 0, 0)),
    Kinematics("pentakins", 5, at_position=(0, 0, 200, 0, 0), around=5),
    Kinematics("pumakins", 6, 3, (10, -40, -20, 20, -50, 30)),
    Kinematics("rosekins", 3, at_position=(70, 0, 0)),
    Kinematics("rotarydeltakins", 9, at_joints=(5, 0, -5)),
    Kinematics("rotatekins", 9, at_joints=(30, 20, 10, 0, 0, 15)),
    Kinematics("scarakins", 6, 3, (45, -90, 150, 0, 0, 0)),
    Kinematics("scorbot-kins", 5, at_joints=(5, 10, -20, 15, 10), around=5),
    Kinematics("tripodkins", 3, at_position=(0.4, 0.4, 1), around=0.1),
    Kinematics("trivkins", 9, at_joints=(0,) * 9),
    Kinematics("userkins", 3, at_joints=(0, 0, 0)),
    Kinematics("xyzab_tdr_kins", 5, 2, (10, 20, 30, 5, -10)),
    Kinematics("xyzac-trt-kins", 5, 3, (10, 20, 30, 5, -10)),
    Kinematics("xyzbc-trt-kins", 5, 3, (10, 20, 30, 5, -10)),
]

#: those that come with LinuxCNC 2.10
NEWER = [
    Kinematics("matrixkins", 3, at_joints=(0, 0, 0)),
    Kinematics("three21kins", 6, 3),
    Kinematics("xyzacb_trsrn", 6, 3, (10, 20, 30, 5, -10, 15)),
    Kinematics("xyzbca_trsrn", 6, 3, (10, 20, 30, 5, -10, 15)),
]

SKEW = Kinematics("skewkins", 3, 2, (0, 0, 0))


def is_kinematics(path):
    """Whether a module is asked for joints: motmod asks, the others answer."""
    symbols = subprocess.run(["nm", "-D", "--defined-only", path], capture_output=True, text=True, check=True).stdout
    return " T kinematicsInverse\n" in symbols


def all_of_linuxcnc():
    """The kinematics modules that this LinuxCNC has."""
    names = {os.path.basename(path)[:-3] for path in glob.glob(os.path.join(STOCK, "*.so")) if is_kinematics(path)}
    return [kinematics for kinematics in MODULES + NEWER if kinematics.name in names], names


def with_compiled(folder, name):
    """Our modules, and one that halcompile makes of the component of this name."""
    for file in glob.glob(os.path.join(harness.MODULES, "*.so")):
        shutil.copy(file, folder)
    shutil.copy(os.path.join(harness.HERE, f"{name}.comp"), folder)
    subprocess.run(["halcompile", "--compile", f"{name}.comp"], cwd=folder, check=True, capture_output=True)
    os.chmod(folder, 0o755)


def with_skewkins(folder):
    """The same with skewkins.comp."""
    with_compiled(folder, "skewkins")
