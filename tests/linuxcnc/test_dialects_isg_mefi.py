"""The examples of the MEFI and ISG manuals, from the part program to the joints of a real LinuxCNC, both ways."""

import math
import os
import subprocess
import tempfile
import unittest

import harness
from geometry import Arc, Line, chained, follow

TOOL = os.environ.get("FRAMEPATH_TOOL", os.path.join(harness.ROOT, "target", "release", "framepath"))

#: The contour is compared as it was programmed: the tools have no radius.
TOOLS = "".join(f"T{number} P{number} D0 Z0\n" for number in (3, 4, 5))

CONTOUR = """\
N1000 G79 L100    “Подпрограмма L100”
N1010 G01 X0 Y0
N1020 G01 X30 Y20 G41{offset}
N1030 G02 X50 Y24.849 I16.641 J-24.962
N1040 G03 X30 Y73.484 I3.359 J29.811
N1050 G01 X20 Y61.075
N1060 G01 X30 Y20
N1070 G01 X0 Y0 G40
N1080 G70
"""

MEFI_MIRROR = """\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 “Вызов подпрограммы - A
N30 G35 X0 “Отражение (переводит направление X)
N40 G71 L100 “Вызов подпрограммы - B
N50 G35 X0 Y0 “Отражение (переводит направление X, Y)
N60 G71 L100 “Вызов подпрограммы - C
N70 G35 Y0 “Отражение (переводит направление Y)
N80 G71 L100 “Вызов подпрограммы - D
N90 G35 “Отмена отражения
N99 M30
""" + CONTOUR.format(offset=" D3")

MEFI_SCALE = """\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 D3           "Вызов подпрограммы - А
N30 G36 X1.54 Y3.28       "Изменение масштаба уменьшения 1.54/3.28 = 0.46951
N40 G71 L100 D4           "Вызов подпрограммы - В
N50 G35 Y0                "Отражение (переводит направление Y)
N50 G36 X1.27             "Изменение масштаба увеличения 1.27
N60 G71 L100 D5           "Вызов подпрограммы - С
N90 G35                   "Отмена отражения
N95 G36                   "Отмена изменения масштаба
N99 M30
""" + CONTOUR.format(offset="")

MEFI_SHIFT = """\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 D3          "Вызов подпрограммы - А
N30 G37 X80 Y120        "Независимый сдвиг на (80,120)
N40 G71 L100 D4          "Вызов подпрограммы - В
N90 G37                  "Отмена сдвига
N99 M30
""" + CONTOUR.format(offset="")

ISG_MIRROR = """\
%L DREIECK            (Subroutine)

N10 G90 X10 Y20       (Define the mental)
N20 G91 X10 Y-10      (Coordinates to be mirrored)
N30 X-10 Y-10
N40 Y20
N50 M29

%SPIEGELUNG           (Main program)
N10 G92 G90 X60 Y40   (Reference point offset)
N20 G01 F500          (Straight line at feed 500)
N30 G21               (Mirroring in the X axis)
N40 LL DREIECK        (Call subroutine)
N60 G92 G90 X0 Y0     (Reset the reference point offset)
N70 M30
"""

#: G53 holds on; the work offset of the test is (20, 30, -5).
MODAL_G53 = """\
G54
G01 X1 Y2 Z0 F3000
G53
X10 Y20
Z3
G91 X5
G90 G54
X1 Y2 Z0
M30
"""

#: A tilted plane with an arc in it.
ISG_TILTED = """\
#CS ON [40,10,0,0,-30,0]
G01 X0 Y0 Z0 F3000
X20
G03 X10 Y10 I-10 J0
G02 I5 J0
#CS OFF
G00 X0 Y0 Z0
M30
"""


def translate(program, dialect, backend):
    """The part program as LinuxCNC gets it."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "part.nc")
        with open(path, "w", encoding="utf-8") as file:
            file.write(program)
        done = subprocess.run([TOOL, "filter", "--dialect", dialect, "--backend", backend,
                               "--path-mode", "G61.1", path],
                              capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


def arc(start, end, centre, left):
    """An arc in the XY plane from start to end about the centre, counterclockwise (left) or not."""
    u = [start[0] - centre[0], start[1] - centre[1]]
    turn = 1 if left else -1
    v = [-turn * u[1], turn * u[0]]
    to_end = [end[0] - centre[0], end[1] - centre[1]]
    angle = math.degrees(math.atan2(to_end[0] * v[0] + to_end[1] * v[1], to_end[0] * u[0] + to_end[1] * u[1])) % 360
    return Arc((*centre, start[2]), (*u, 0.0), (*v, 0.0), angle or 360)


def fitted(start, end, offset):
    """The listed centres are rounded: the nearest one that is equally far from both ends."""
    chord = [end[0] - start[0], end[1] - start[1]]
    off = sum((offset[i] - 0.5 * chord[i]) * chord[i] for i in (0, 1)) / (chord[0] ** 2 + chord[1] ** 2)
    return [start[i] + offset[i] - off * chord[i] for i in (0, 1)]


def contour(last, signs=(1, 1), factor=1.0, shift=(0.0, 0.0)):
    """L100 by hand, from where the tool was, under a mirror, a factor and a shift."""
    def at(point):
        return (shift[0] + signs[0] * factor * point[0], shift[1] + signs[1] * factor * point[1])

    def place(x, y):
        return (*at((x, y)), 0.0)

    zero, a, b, c, d = place(0, 0), place(30, 20), place(50, 24.849), place(30, 73.484), place(20, 61.075)
    first = at(fitted((30, 20), (50, 24.849), (16.641, -24.962)))
    second = at(fitted((50, 24.849), (30, 73.484), (3.359, 29.811)))
    mirrored = signs[0] * signs[1] < 0
    lines = [Line(last, zero)] if last != zero else []
    return lines + [Line(zero, a), arc(a, b, first, mirrored), arc(b, c, second, not mirrored), Line(c, d),
                    Line(d, a), Line(a, zero)]


def contours(last, *pieces):
    """L100 several times, from where the tool was."""
    shapes = []
    for piece in pieces:
        shapes += contour(last, **piece)
        last = shapes[-1].end
    return shapes


ORIGIN = (0.0, 0.0, 0.0)


def tilted(last):
    """-30 degrees about Y at (40, 10, 0): X goes up."""
    x, y = (math.cos(math.radians(30)), 0.0, math.sin(math.radians(30))), (0.0, 1.0, 0.0)

    def place(a, b):
        return tuple(o + a * e + b * f for o, e, f in zip((40.0, 10.0, 0.0), x, y))

    def vector(a, b):
        return tuple(a * e + b * f for e, f in zip(x, y))

    return [
        Line(last, place(0, 0)),
        Line(place(0, 0), place(20, 0)),
        # a quarter, counterclockwise about (10, 0)
        Arc(place(10, 0), vector(10, 0), vector(0, 10), 90),
        # a full circle, clockwise about (15, 10)
        Arc(place(15, 10), vector(-5, 0), vector(0, 5), 360),
        Line(place(10, 10), ORIGIN),
    ]


MIRRORED = [{"signs": signs} for signs in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
SCALED = [{}, {"factor": 1.54 / 3.28}, {"signs": (1, -1), "factor": 1.27}]
SHIFTED = [{}, {"shift": (80, 120)}]
TRIANGLE = [(50.0, 60.0, 0.0), (40.0, 50.0, 0.0), (50.0, 40.0, 0.0), (50.0, 60.0, 0.0)]
G53 = [(21.0, 32.0, -5.0), (10.0, 20.0, -5.0), (10.0, 20.0, 3.0), (15.0, 20.0, 3.0), (21.0, 32.0, -5.0)]


class Examples(unittest.TestCase):
    """The programs run one after the other, each from where the one before has left the tool, and stop at corners."""

    def follow(self, dialect, backend, programs, before=""):
        """programs: part program, and a function from the point where the tool is to the shapes expected."""
        files, steps, shapes, last = {"tools.tbl": TOOLS}, [], [], ORIGIN
        for number, (program, expected) in enumerate(programs):
            files[f"part{number}.ngc"] = before + translate(program, dialect, backend)
            steps.append(["run", f"PROGRAMS/part{number}.ngc"])
            shapes += expected(last)
            last = tuple(shapes[-1].end)
        result = harness.run(steps, files, ini={("EMCIO", "TOOL_TABLE"): "../../programs/tools.tbl"},
                             sample=f"framepath-{dialect}")
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        joints = list(zip(*(result.commanded(joint) for joint in range(3))))
        worst, missed = follow(joints, shapes)
        self.assertLess(worst, 1e-6)
        # where two shapes touch, the samples do not tell which of them they belong to
        self.assertLess(missed, 5e-6)

    def test_mefi_rewritten(self):
        self.follow("mefi", "program", [
            (MEFI_MIRROR, lambda last: contours(last, *MIRRORED)),
            (MEFI_SCALE, lambda last: contours(last, *SCALED)),
            (MEFI_SHIFT, lambda last: contours(last, *SHIFTED)),
        ])

    def test_mefi_with_the_kinematics(self):
        # the kinematics would scale the tool's radius too: it scales without compensation only
        free = MEFI_SCALE.replace("G41", "").replace("G40", "")
        self.follow("mefi", "kinematics", [
            (MEFI_MIRROR, lambda last: contours(last, *MIRRORED)),
            (free, lambda last: contours(last, *SCALED)),
            (MEFI_SHIFT, lambda last: contours(last, *SHIFTED)),
        ])

    def test_isg_rewritten(self):
        self.follow("isg", "program", [(ISG_MIRROR, lambda last: chained(last, *TRIANGLE))])

    def test_isg_with_the_kinematics(self):
        self.follow("isg", "kinematics", [
            (ISG_MIRROR, lambda last: chained(last, *TRIANGLE)),
            (ISG_TILTED, tilted),
        ])

    def test_modal_g53(self):
        offset = "G10 L2 P1 X20 Y30 Z-5\n"
        for dialect in ("isg", "mefi"):
            with self.subTest(dialect):
                self.follow(dialect, "program", [(MODAL_G53, lambda last: chained(last, *G53))], before=offset)


if __name__ == "__main__":
    unittest.main()
