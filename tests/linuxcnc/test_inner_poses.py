"""framekins before each kinematics module, without LinuxCNC: joints = inner(frame(position)), and back."""

import contextlib
import ctypes
import math
import os
import random
import shutil
import tempfile
import unittest

import pytest

import harness
from inner_modules import MODULES, SKEW, STOCK, Kinematics, with_skewkins
from kinematics_host import Module

POSES = 10000

#: machine units
CLOSE = 1e-9

AXES = "xyzabcuvw"
ROWS = ["xx", "xy", "xz", "x", "yx", "yy", "yz", "y", "zx", "zy", "zz", "z"]


def turn(number):
    """Rows of a random rotation, from a random quaternion."""
    q = [number.gauss(0, 1) for _ in range(4)]
    w, x, y, z = (part / math.hypot(*q) for part in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


class Frame:
    """A turn, a scale and a shift, and the pins of framekins that say so."""

    def __init__(self, number):
        self.rows, self.scale = turn(number), number.uniform(0.5, 2)
        self.shift = [number.uniform(-20, 20) for _ in range(3)]

    def machine(self, pose):
        tip = [self.scale * sum(a * b for a, b in zip(row, pose[:3], strict=True)) + shift
               for row, shift in zip(self.rows, self.shift, strict=True)]
        return tip + pose[3:]

    def program(self, pose):
        back = [(value - shift) / self.scale for value, shift in zip(pose[:3], self.shift, strict=True)]
        return [sum(self.rows[k][axis] * back[k] for k in range(3)) for axis in range(3)] + pose[3:]

    def pins(self):
        elements = [element for row, shift in zip(self.rows, self.shift, strict=True)
                    for element in [*(self.scale * part for part in row), shift]]
        return dict(zip([f"map.{name}" for name in ROWS], elements, strict=True))


class Pair:
    """A module by itself, and another copy of it behind framekins."""

    def __init__(self, kinematics, folder):
        path = os.path.join(folder, f"{kinematics.name}.so")
        if not os.path.exists(path):
            shutil.copy(os.path.join(STOCK, f"{kinematics.name}.so"), folder)
        self.alone = Module(path, kinematics.name)
        self.alone.library.kinematicsType()
        beside = tempfile.mkdtemp(dir=folder)
        self.inner = Module(path, kinematics.name, beside)
        self.ours = Module(os.path.join(harness.MODULES, "framekins.so"), "framekins", beside, inner=kinematics.name)
        for pin in [f"map.{name}" for name in ROWS] + [f"position.{axis}" for axis in AXES]:
            self.ours.find(pin, ctypes.c_double)
        for pin in ("in-position", "inner-type-active", "slot"):
            self.ours.find(pin, ctypes.c_int)
        self.ours.set(in_position=1)
        self.ours.library.kinematicsType()
        self.ours.function = self.ours.find_function()

    def stand(self, kinematics):
        """Where the machine is before anything else, as motion asks for it."""
        if kinematics.at_position:
            position = [*kinematics.at_position, *[0.0] * (9 - len(kinematics.at_position))]
            joints = self.alone.inverse(position)
        else:
            position, joints = [0.0] * 9, [*kinematics.at_joints, *[0.0] * (16 - len(kinematics.at_joints))]
        self.home = position, joints
        for module in (self.alone, self.ours):
            # the first of a hexapod begins at zeros, whatever it is told
            with contextlib.suppress(ArithmeticError):
                module.forward(joints, position)
            module.forward(joints, position)

    def return_home(self, frame):
        """Where it began: there the kinematics lead back to the joints that they were given, as a switch asks for."""
        position, joints = self.home
        self.ours.flags.value = 0
        self.ours.inverse(self.ours.forward(joints, frame.program(position)), joints)

    def switch(self, frame, kind):
        """A frame by hand, and the type of the kinematics behind it."""
        self.ours.set(**frame.pins())
        # motion has stood, and so have external offsets
        for _ in range(4):
            self.ours.update()
        assert self.ours.switch(16 + kind) == 0
        if kind:
            assert self.alone.switch(kind) == 0

    def axes(self):
        """The machine's axes behind the frame, as framekins has them."""
        self.ours.update()
        return [self.ours.pins[f"position.{axis}"].value for axis in AXES]


def around(number, centre, distance):
    return [value + number.uniform(-distance, distance) for value in centre]


@pytest.mark.thorough
class Poses(unittest.TestCase):
    def machine_pose(self, number, pair, kinematics, kind):
        """A random position that the machine can reach, and joints near it."""
        if kinematics.at_position:
            position, joints = pair.home
            count = len(kinematics.at_position)
            # other types take joints for axes, and some have an eye on the first type all the same
            centre = joints if kind else position
            return around(number, centre[:count], kinematics.around) + [0.0] * (9 - count), joints
        joints = around(number, kinematics.at_joints, kinematics.around) + [0.0] * (16 - len(kinematics.at_joints))
        return pair.alone.forward(joints), around(number, joints, 0.01)

    def compare(self, kinematics, kind, folder):
        """How far the axes are from those of the frame, and the way back from where it began."""
        number = random.Random(f"{kinematics.name} {kind}")
        pair, worst, back = Pair(kinematics, folder), 0.0, 0.0
        frame = Frame(number)
        pair.stand(kinematics)
        for count in range(POSES // kinematics.types):
            if count % 100 == 0:
                if count:
                    pair.return_home(frame)
                    frame = Frame(number)
                pair.switch(frame, kind)
            machine, near = self.machine_pose(number, pair, kinematics, kind)
            position = frame.program(machine)
            pair.alone.flags.value = pair.ours.flags.value = 0
            joints = pair.ours.inverse(position, near)
            axes = pair.axes()
            worst = max(worst, *(abs(a - b) for a, b in zip(axes, frame.machine(position), strict=True)))
            pair.alone.flags.value = 0
            # the very same numbers in, the very same numbers out
            self.assertEqual(joints, pair.alone.inverse(axes, near))
            pair.alone.flags.value = pair.ours.flags.value = 0
            found = frame.machine(pair.ours.forward(joints, position))
            back = max(back, *(abs(a - b) for a, b in zip(found, pair.alone.forward(joints, axes), strict=True)))
        self.assertEqual((pair.ours.pins["slot"].value, pair.ours.pins["inner-type-active"].value), (1, kind))
        return worst, back

    def check(self, kinematics: Kinematics, folder):
        for kind in range(kinematics.types):
            with self.subTest(kinematics.name, type=kind):
                worst, back = self.compare(kinematics, kind, folder)
                self.assertLess(worst, CLOSE)
                self.assertLess(back, CLOSE)

    def test_the_modules_of_linuxcnc(self):
        with tempfile.TemporaryDirectory() as folder:
            for kinematics in MODULES:
                self.check(kinematics, folder)

    def test_one_that_a_user_has_compiled(self):
        with tempfile.TemporaryDirectory() as folder:
            with_skewkins(folder)
            self.check(SKEW, folder)


if __name__ == "__main__":
    unittest.main()
