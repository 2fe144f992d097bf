"""Fanuc-like controls: what the manual of Series 30i defines, with numbers of our own."""

import math

from geometry import Frame
from manuals.isg import compensated, tilted
from part_programs import Example, Path

TURNED = """\
%
O0001 (FOUR TIMES, EACH TURNED BY ANOTHER 30 DEGREES)
G90 G1 F3000.
M98 P2 L4
G69
G90 X0 Y0
M30
O0002
G68 X0 Y0 G91 R30.
G90 X20. Y0
Y10.
X0 Y0
M99
%
"""


def turned():
    path = Path()
    for step in range(1, 5):
        path.under(Frame.turned((0, 0, 0), 30 * step)).to((20, 0), (20, 10), (0, 0))
    return path.shapes


MIRRORED = """\
O0001
G90 G1 F3000.
M98 P2
G51.1 X10.
M98 P2
G51.1 Y10.
M98 P2
G50.1 X0
M98 P2
G50.1 Y0
M30
O0002
G1 X20. Y20.
X30.
G2 X40. Y30. R10.
G1 X20. Y20.
M99
"""


def mirrored():
    path = Path()
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        frame = Frame((10 - 10 * x, 10 - 10 * y, 0), (x, 0, 0), (0, y, 0))
        path.under(frame).to((20, 20), (30, 20)).arc((40, 20), -90).to((20, 20))
    return path.shapes


SCALED_AND_TURNED = """\
G51 X10. Y0 Z0 P2000
G68 X20. Y0 R90.
G90 G1 X20. Y0 F3000.
X25.
G3 X20. Y5. I-5.
G69
G50
G1 X0 Y0
M30
"""


def scaled_and_turned():
    """Twice the size about (10, 0), then a quarter turn about the scaled centre, (30, 0)."""
    frame = Frame((30, -40, 0), (0, 2, 0), (-2, 0, 0), (0, 0, 2))
    return Path().under(frame).to((20, 0), (25, 0)).arc((20, 0), 90).under(Frame()).to((0, 0)).shapes


CORNERS = """\
O0001
G91 G1 Z5. F3000.
G65 P9 X20. Y10. I10. A15. B60. H6.
Z-5.
M30
O0009 (CORNERS ON A CIRCLE)
#30=#4003
#31=0
WHILE[#31LE#11]DO1
#32=#1+#31*#2
G90 G1 X[#24+#4*COS[#32]] Y[#25+#4*SIN[#32]]
#31=#31+1
END1
G#30
M99
"""


def corners():
    path = Path().to((0, 0, 5))
    for number in range(7):
        angle = math.radians(15 + 60 * number)
        path.to((20 + 10 * math.cos(angle), 10 + 10 * math.sin(angle)))
    return path.to((*path.local[:2], 0)).shapes


COMPENSATED = """\
T1 M6
G51.1 X0
G0 G90 X0 Y-20.
G41 D1 G1 Y0 F3000.
Y30.
G2 X10. Y40. I10. J0
G1 X40.
Y0
X0
G40 X-20. Y-20.
G50.1 X0
M30
"""

TILTED = """\
G68.2 X40. Y10. Z0 I-90. J30. K90.
G1 X0 Y0 Z0 F3000.
X20.
G3 X10. Y10. I-10. J0
G2 I5. J0
G69
G0 X0 Y0 Z0
M30
"""

EXAMPLES = [
    Example("angles that add up", TURNED, turned()),
    Example("mirrored at X10 and Y10", MIRRORED, mirrored()),
    Example("scaled, then turned", SCALED_AND_TURNED, scaled_and_turned()),
    Example("a macro of a hexagon", CORNERS, corners()),
    Example("the side of compensation", COMPENSATED, compensated()),
    Example("a tilted plane", TILTED, tilted(), ("kinematics",)),
]
