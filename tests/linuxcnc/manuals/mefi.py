"""MEFI: recalculation of coordinates (13)."""

from math import atan2, degrees

from geometry import Frame, Line
from part_programs import Example, Path, both, scaled

#: the contour with compensation that the examples call; the tools have no radius
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

MIRROR = """\
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
“Подпрограмма с коррекцией радиуса
""" + CONTOUR.format(offset=" D3")

SCALE = """\
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
“Подпрограмма с коррекцией радиуса
""" + CONTOUR.format(offset="")

SHIFT = """\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 D3          "Вызов подпрограммы - А
N30 G37 X80 Y120        "Независимый сдвиг на (80,120)
N40 G71 L100 D4          "Вызов подпрограммы - В
N90 G37                  "Отмена сдвига
N99 M30
"Подпрограмма с коррекцией длины
""" + CONTOUR.format(offset=" D3")


def fitted(start, end, offset):
    """The listed centres are rounded: the nearest one that is equally far from both ends."""
    chord = [end[0] - start[0], end[1] - start[1]]
    off = sum((offset[i] - 0.5 * chord[i]) * chord[i] for i in (0, 1)) / (chord[0] ** 2 + chord[1] ** 2)
    return [start[i] + offset[i] - off * chord[i] for i in (0, 1)]


def contour(path, frame):
    path.under(frame).to((0, 0), (30, 20))
    for end, offset, sign in [((50, 24.849), (16.641, -24.962), -1), ((30, 73.484), (3.359, 29.811), 1)]:
        start = path.local
        centre = fitted(start, end, offset)
        angles = [degrees(atan2(y - centre[1], x - centre[0])) for x, y in (start[:2], end)]
        path.arc(centre, sign * (sign * (angles[1] - angles[0]) % 360))
    return path.to((20, 61.075), (30, 20), (0, 0))


def contours(*frames):
    path = Path()
    for frame in frames:
        contour(path, frame)
    return path.shapes


def place(command):
    """A program that goes to (10, 20) under a command of one line, and back."""
    return f"{command}\nG01 X10 Y20 F3000\nG34\nX0 Y0\nM30\n"


def there_and_back(x, y):
    return Path().to((x, y), (0, 0)).shapes


#: the lines that the manual explains one by one, and where they take (10, 20)
LINES = [("13.2", "G35 X0", (-10, 20)), ("13.2", "G35 Y0", (10, -20)), ("13.2", "G35 X0 Y0", (-10, -20)),
         ("13.2", "G35 X0\nG35", (10, 20)), ("13.3", "G36 X1.27", (12.7, 25.4)), ("13.3", "G36 Y0.38", (3.8, 7.6)),
         ("13.3", "G36 X1.54 Y5.28", (10 * 1.54 / 5.28, 20 * 1.54 / 5.28)), ("13.3", "G36 X2\nG36", (10, 20)),
         ("13.4", "G37 X10.127", (20.127, 20)), ("13.4", "G37 X-0.138 Y12", (9.862, 32)),
         ("13.4", "G37 X5\nG37", (10, 20))]

#: the machine with the axes of G35 Y0 U0 C0
NINE = "xyzabcuvw"
ZERO = 9 * (0.0,)
TURNED = (0.0, -20.0, 0.0, 0.0, 0.0, -3.0, -5.0, 0.0, 0.0)

#: G53 holds on here; the work offset is (20, 30, -5)
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
WORK_OFFSET = "G10 L2 P1 X20 Y30 Z-5\n"
G53 = Path().to((21, 32, -5), (10, 20), (10, 20, 3), (15, 20), (21, 32, -5)).shapes

EXAMPLES = [
    *(Example(f"{chapter}: {line!r}", place(line), there_and_back(*end)) for chapter, line, end in LINES),
    Example("13.2: 'G35 Y0 U0 C0'", "G35 Y0 U0 C0\nG01 Y20 U5 C3 F3000\nG34\nY0 U0 C0\nM30\n",
            [Line(ZERO, TURNED), Line(TURNED, ZERO)], axes=NINE),
    Example("13.2: four images of a part", MIRROR,
            contours(*(scaled(x, y) for x, y in [(1, 1), (-1, 1), (-1, -1), (1, -1)]))),
    # the kinematics would scale the tool's radius too
    Example("13.3: three sizes of a part", SCALE,
            contours(Frame(), scaled(1.54 / 3.28, 1.54 / 3.28), scaled(1.27, -1.27)), ("program",)),
    Example("13.3: three sizes of a part, without compensation", SCALE.replace(" G41", "").replace(" G40", ""),
            contours(Frame(), scaled(1.54 / 3.28, 1.54 / 3.28), scaled(1.27, -1.27))),
    Example("13.4: a part shifted", SHIFT, contours(Frame(), Frame((80, 120, 0)))),
    Example("13.1: each leaves the others alone", place("G37 X5 Y6\nG36 X2\nG35 X0"),
            Path().under(both(Frame((5, 6, 0)), scaled(-2, 2))).to((10, 20)).under(Frame()).to((0, 0)).shapes),
    Example("G53 holds on", MODAL_G53, G53, before=WORK_OFFSET),
]
