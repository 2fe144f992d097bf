"""Every program and example of the controls' manuals, one by one (manuals/), from the part program to the joints of a
real LinuxCNC with both modules.

Each is translated by both backends where both can do it, runs, and must go along the path that was worked out by hand;
what LinuxCNC's interpreter makes of the translation is compared with the same path.
"""

import unittest

import pytest

from canon import canonical_shapes, compare
from manuals import fagor, fanuc, isg, linuxcnc, mefi, sinumerik
from part_programs import convert, deviations, filtered, quick, run

#: mm; the filter writes six decimals
NEAR = 1e-6

TABLES = {"sinumerik": (sinumerik, "framepath-sim"), "fagor": (fagor, "framepath-fagor"),
          "mefi": (mefi, "framepath-mefi"), "isg": (isg, "framepath-isg"), "fanuc": (fanuc, "framepath-sim")}
LETTERS = "xyzabcuvw"


def nine_axes():
    """Changes of the INI and HAL text that make a machine with three axes one with nine."""
    changes = {("KINS", "JOINTS"): "9", ("KINS", "KINEMATICS"): "framekins coordinates=XYZABCUVW",
               ("TRAJ", "COORDINATES"): "XYZABCUVW"}
    limits = {"MIN_LIMIT": "-500", "MAX_LIMIT": "500"}
    home = {"TYPE": "LINEAR", "HOME": "0", "HOME_SEQUENCE": "0", "FERROR": "1", "MIN_FERROR": "0.1"}
    hal = ""
    for joint, letter in list(enumerate(LETTERS))[3:]:
        for key, value in limits.items():
            changes[(f"AXIS_{letter.upper()}", key)] = value
        kind = {"TYPE": "ANGULAR"} if letter in "abc" else {}
        for key, value in {**limits, **home, **kind}.items():
            changes[(f"JOINT_{joint}", key)] = value
        hal += f"net joint-{joint} joint.{joint}.motor-pos-cmd => joint.{joint}.motor-pos-fb\n"
        hal += f"setp blendtp.axis.{letter}.max-jerk 100000\n"
    return changes, hal


class Examples(unittest.TestCase):
    """Those of one control."""

    dialect: str

    def joints(self, backend, axes):
        """{name of an example: how its joints lie beside its path} on the machine with these axes."""
        table, sample = TABLES[self.dialect]
        examples = [e for e in table.EXAMPLES if backend in e.backends and e.axes == axes]
        programs = [example.before + quick(filtered(example.program, self.dialect, backend, example.options))
                    for example in examples]
        ini, hal = nine_axes() if axes == LETTERS else ({}, "")
        beside = {}
        for example, joints in zip(examples, run(programs, sample, ini, hal, axes) if programs else [], strict=True):
            with self.subTest(example.name, backend=backend):
                found = beside[example.name] = deviations(joints, example.shapes)
                self.assertLess(found.worst(), NEAR)
                # every corner is a stop; one between two samples lies beside both
                self.assertLess(found.missed, 5e-6)
        return beside

    def run_table(self, axes):
        """Each example runs along its path with both backends, and both take the joints the same way."""
        program, kinematics = (self.joints(backend, axes) for backend in ("program", "kinematics"))
        for name in program.keys() & kinematics.keys():
            with self.subTest(name):
                self.assertLess(program[name].apart(kinematics[name]), NEAR)

    def refuse(self):
        """What only one backend can do, the other refuses: it does something else in no case."""
        for example in TABLES[self.dialect][0].EXAMPLES:
            for backend in {"program", "kinematics"} - set(example.backends):
                with self.subTest(example.name):
                    code, output, complaints = convert(example.program, self.dialect, backend, example.options)
                    self.assertEqual((code, output), (1, ""))
                    self.assertIn("error", complaints)

    def understood(self):
        """LinuxCNC's interpreter reads the rewritten program; without a machine it knows no U, V and W."""
        for example in TABLES[self.dialect][0].EXAMPLES:
            readable = example.axes == "xyz" or not set("UVW") & set(example.program)
            if "program" in example.backends and readable:
                with self.subTest(example.name):
                    output = filtered(example.program, self.dialect, "program", example.options)
                    self.assertIsNone(compare(canonical_shapes(example.before + output), example.shapes))


def joints_of(axes):
    """The test of the examples for a machine with these axes."""
    # a function with a name: pytest takes a lambda for an argument of its mark
    @pytest.mark.thorough
    def test(self):
        self.run_table(axes)
    return test


def of(dialect):
    """The class with the tests of a control."""
    axes = sorted({example.axes for example in TABLES[dialect][0].EXAMPLES})
    joints = {f"test_joints_of_{len(letters)}_axes": joints_of(letters) for letters in axes}
    return type(dialect.capitalize(), (Examples,), {
        "__module__": __name__, "dialect": dialect, "test_refused": Examples.refuse,
        "test_read_again": Examples.understood, **joints})


Sinumerik, Fagor, Mefi, Isg, Fanuc = map(of, TABLES)


class Own(unittest.TestCase):
    """LinuxCNC's own examples, with our planner."""

    def test_linuxcnc(self):
        examples = linuxcnc.EXAMPLES
        paths = run([quick(example.program) for example in examples], "framepath-sim")
        for example, joints in zip(examples, paths, strict=True):
            with self.subTest(example.name):
                if example.tolerance:
                    nearest = [min(shape.nearest(point)[0] for shape in example.shapes) for point in joints]
                    self.assertLess(max(nearest), example.tolerance)
                    # corners are rounded, not stopped at
                    self.assertGreater(max(nearest), 0.1 * example.tolerance)
                else:
                    found = deviations(joints, example.shapes)
                    self.assertLess(found.worst(), NEAR)
                    self.assertLess(found.missed, 5e-6)


class Noticed(unittest.TestCase):
    """A path that is wrong would be noticed."""

    def test_in_the_joints(self):
        example = next(e for e in fagor.EXAMPLES if "repeated, beside zero" in e.name)
        joints, = run([quick(filtered(example.program, "fagor", "program", example.options))], "framepath-fagor")
        self.assertLess(deviations(joints, example.shapes).worst(), NEAR)
        left_out = deviations(joints, example.shapes[:5] + example.shapes[6:])
        self.assertGreater(max(left_out.worst(), left_out.missed), 1e-2)
        with self.assertRaises(AssertionError):
            deviations(joints, example.shapes[::-1])

    def test_by_the_interpreter(self):
        example = next(e for e in isg.EXAMPLES if e.name == "a triangle mirrored")
        found = canonical_shapes(filtered(example.program, "isg", "program"))
        self.assertIsNotNone(compare(found, example.shapes[:-1]))
        self.assertIsNotNone(compare(found, example.shapes[::-1]))


if __name__ == "__main__":
    unittest.main()
