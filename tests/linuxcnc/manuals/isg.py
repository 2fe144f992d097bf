"""ISG and TwinCAT: mirroring in the plane."""

from geometry import Frame
from manuals.mefi import G53, MODAL_G53, WORK_OFFSET
from part_programs import Example, Path, both, scaled, turn

MIRROR = """\
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

#: the triangle under each of the functions, about the point (60, 40) that is not mirrored
ALL_MIRRORS = """\
%L DREIECK
N10 G90 G01 X10 Y20 F3000
N20 G91 X10 Y-10
N30 X-10 Y-10
N40 Y20
N50 M29

%MAIN
N10 G92 G90 X60 Y40
N20 LL DREIECK
N30 G21
N40 LL DREIECK
N50 G22
N60 LL DREIECK
N70 G23
N80 LL DREIECK
N90 G20
N100 LL DREIECK
N110 G92 G90 X0 Y0
N120 M30
"""


def triangles(*signs):
    path = Path()
    for x, y in signs:
        path.under(Frame((60, 40, 0), (x, 0, 0), (0, y, 0))).to((10, 20), (20, 10), (10, 0), (10, 20))
    return path.shapes


SEPARATE_AXES = """\
G351 X-1
G01 G90 X10 Y20 F3000
G351 Y-1
X10 Y20
G351 X1
X10 Y20
G351 Y1
X10 Y20
M30
"""

OFFSET_MIRRORED = "G92 X60 Y40\nG351 X-1\nG01 G90 X10 Y20 F3000\nM30\n"

COMPENSATED = """\
T1 D1 M6
G21
G00 G90 X0 Y-20
G41 G01 Y0 F3000
Y30
G02 X10 Y40 I10 J0
G01 X40
Y0
X0
G40 X-20 Y-20
M30
"""


def compensated():
    path = Path().under(scaled(-1)).to((0, -20), (-3, 0), (-3, 30)).arc((10, 30), -90).to((40, 43))
    return path.arc((40, 40), -90).to((43, 0)).arc((40, 0), -90).to((0, -3), (-20, -20)).shapes


#: only the centre of the circle is mirrored: it is cut with another radius
CIRCLE = "G01 G90 X10 Y0 F3000\nG21\nG161 G02 I20 J0\nM30\n"

TILTED = """\
#CS ON [40,10,0,0,-30,0]
G01 X0 Y0 Z0 F3000
X20
G03 X10 Y10 I-10 J0
G02 I5 J0
#CS OFF
G00 X0 Y0 Z0
M30
"""


def tilted():
    path = Path().under(both(Frame((40, 10, 0)), turn("y", -30))).to((0, 0), (20, 0)).arc((10, 0), 90)
    return path.arc((15, 10), -360).under(Frame()).to((0, 0)).shapes


def outside_xy(end):
    return Path().to(end).shapes


OUTSIDE_XY = "G18\nG21\nG01 G90 X10 Y20 Z30 F3000\nM30\n"

EXAMPLES = [
    Example("a triangle mirrored", MIRROR, triangles((-1, 1))),
    Example("all mirrors", ALL_MIRRORS, triangles((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 1))),
    Example("G351, each axis for itself", SEPARATE_AXES,
            Path().to((-10, 20), (-10, -20), (10, -20), (10, 20)).shapes),
    Example("G351 mirrors the offset", OFFSET_MIRRORED, Path().to((-70, 60)).shapes),
    Example("the side of compensation", COMPENSATED, compensated()),
    # clockwise in the program, counterclockwise in the mirror
    Example("a circle gets another radius", CIRCLE, Path().to((10, 0)).arc((-20, 0), 360).shapes,
            options=("--mirrored-circle", "warn")),
    Example("outside of G17, the plane", OUTSIDE_XY, outside_xy((10, 20, -30)),
            options=("--mirror-outside-xy", "plane")),
    Example("outside of G17, X and Y", OUTSIDE_XY, outside_xy((-10, 20, 30)), options=("--mirror-outside-xy", "xy")),
    Example("a tilted plane", TILTED, tilted(), ("kinematics",)),
    Example("G53 holds on", MODAL_G53, G53, before=WORK_OFFSET),
]
