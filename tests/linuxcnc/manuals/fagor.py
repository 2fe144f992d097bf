"""Fagor 8055: mirror images (7.5) and scale factors (7.6).

Where the manual says "execution of the subroutine" the call is written out. Its listings of repeated blocks have lost
their line breaks; here they are as their pictures show them.
"""

from geometry import Line
from part_programs import Example, Path

IMAGES = """\
G90 G00 X0 Y0 Z0
(CALL 1)	; Mecaniza "a".
G11	; Imagen espejo en eje X.
(CALL 1)	; Mecaniza "b".
G10 G12	; Imagen espejo en eje Y.
(CALL 1)	; Mecaniza "c".
G11	; Imagen espejo en los ejes X e Y.
(CALL 1)	; Mecaniza "d".
M30	; Fin de programa
(SUB 1)
G91 G01 X30 Y30 F100
Y60
X20 Y-20
X40
G02 X0 Y-40 I0 J-20
G01 X-60
X-30 Y-30
(RET)
"""


def images():
    path = Path()
    for x, y in [(1, 1), (-1, 1), (1, -1), (-1, -1)]:
        path.to((30 * x, 30 * y), (30 * x, 90 * y), (50 * x, 70 * y), (90 * x, 70 * y))
        path.arc((90 * x, 50 * y), -180 * x * y).to((30 * x, 30 * y), (0, 0))
    return path.shapes


TWO_SIZES = """\
G90 G00 X-30 Y10 Z0
(CALL 1) ; Mecaniza "a".
G92 X-79 Y-30      ; Preselección de cotas
                   ; (traslado de origen de coordenadas)
G72 S2             ; Aplica factor de escala de 2.
(CALL 1) ; Mecaniza "b".
G72 S1             ; Anular factor de escala
M30                ; Fin de programa
(SUB 1)
G90 X-19 Y0
G01 X0 Y10 F150
G02 X0 Y-10 I0 J-10
G01 X-19 Y0
(RET)
"""


def two_sizes():
    # the second part is about (60, 30): there the preset has its zero
    path = Path().to((-30, 10), (-19, 0), (0, 10)).arc((0, 0), -180).to((-19, 0))
    return path.to((22, 30), (60, 50)).arc((60, 30), -180).to((22, 30)).shapes


REPEATED_FROM_ZERO = """\
G90 G00 X0 Y0
N10 G91 G01 X20 Y10
Y10
X-10
N20 X-10 Y-20
;Factor de escala
G72 S0.5
;Repite del bloque 10 al bloque 20
(RPT N10,20)
M30
"""

REPEATED_BESIDE_ZERO = """\
G90 G00 X20 Y20
N10 G91 G01 X-10
X-10 Y-20
X20 Y10
N20 Y10
;Factor de escala
G72 S0.5
;Repite del bloque 10 al bloque 20
(RPT N10,20)
M30
"""

# With a tool of radius 5 the wall at X10 is passed at X15, and that is doubled.
FACTOR_BEHIND_COMPENSATION = """\
T2 M6
G44
G90 G0 X30 Y-20 Z0
G72 X2
G42 G1 X10 Y0 F3000
Y20
G40 X30
M30
"""

BOTH_FACTORS = """\
G90 G0 X0 Y0 Z0
G72 S3
G72 X2
G1 X10 F3000
Y10
G72 S1
X0
M30
"""

THREE_IMAGES = """\
G90 G1 X5 Y0 Z0 F3000
G11 G12 G13
X1 Y2 Z3
G10
X1 Y2 Z5
M30
"""

PRESET_UNDER_A_MIRROR = """\
G90 G0 X10 Y0 Z0
G11
G92 X50
G90 X60
M30
"""

MIRROR_THEN_ROTATION = """\
G90 G0 X0 Y0 Z0
G11
G73 Q90 I10 J0
G1 X20 Y0 F3000
M30
"""

#: a preset under the mirror, all three together, a tangent arc, a rounding, a polar place
TOGETHER = """\
G90 G0 X10 Y0 Z0
G11
G92 X50
G1 X60 F3000
G10
G54
G0 X0 Y0
G12
G72 S2
G73 Q90 I2 J1
G1 X6 Y2
G73
G72 S1
G10
G0 X0 Y0
G36 R5 G1 X20
Y20
G8 X0 Y20
G93 I0 J10
R10 Q180
M30
"""


def together():
    path = Path().to((10, 0), (-100, 0), (0, 0), (6, 6), (0, 0), (15, 0)).arc((15, 5), 90).to((20, 20))
    return path.arc((10, 20), 180).to((-10, 10)).shapes


#: the axes of the machine with nine
NINE = "xyzabcuvw"


def nine(*points):
    """Lines of nine axes from zero through points of some of them."""
    shapes: list[Line] = []
    last: tuple[float, ...] = 9 * (0.0,)
    for point in points:
        end = tuple(point.get(letter, value) for letter, value in zip(NINE, last, strict=True))
        shapes.append(Line(last, end))
        last = end
    return shapes


FEED = ("--feed", "3000")

EXAMPLES = [
    Example("7.5: any axis, G14 W", "G14 W\nG0 X1 W5\nG91 W1\nG10\nG90 W1\nM30\n",
            nine({"x": 1, "w": -5}, {"w": -6}, {"w": 1}), axes=NINE),
    Example("7.5: several axes, G14 X Z A B", "G14 X Z A B\nG0 X1 Y2 Z3 A4 B5\nG10\nX1 Z3 A4 B5\nM30\n",
            nine({"x": -1, "y": 2, "z": -3, "a": -4, "b": -5}, {"x": 1, "z": 3, "a": 4, "b": 5}),
            axes=NINE),
    Example("7.5: four images of a part", IMAGES, images()),
    Example("7.5: three mirrors in one block", THREE_IMAGES,
            Path().to((5, 0, 0), (-1, -2, -3), (1, 2, 5)).shapes),
    Example("7.5: a mirror acts before a rotation", MIRROR_THEN_ROTATION, Path().to((-10, -10)).shapes),
    Example("7.5: a preset is not mirrored", PRESET_UNDER_A_MIRROR, Path().to((10, 0), (-100, 0)).shapes),
    Example("7.6.1: two sizes of a part", TWO_SIZES, two_sizes()),
    Example("7.6.1: blocks repeated, from zero", REPEATED_FROM_ZERO,
            Path().to((20, 10), (20, 20), (10, 20), (0, 0), (10, 5), (10, 10), (5, 10), (0, 0)).shapes, options=FEED),
    Example("7.6.1: blocks repeated, beside zero", REPEATED_BESIDE_ZERO,
            Path().to((20, 20), (10, 20), (0, 0), (20, 10), (20, 20), (15, 20), (10, 10), (20, 15), (20, 20)).shapes,
            options=FEED),
    Example("7.6.2: both kinds of factor", BOTH_FACTORS, Path().to((60, 0), (60, 30), (0, 30)).shapes),
    # the entry ends at (30, 0), on the way
    Example("7.6.2: a factor behind compensation", FACTOR_BEHIND_COMPENSATION,
            Path().to((30, -20), (30, 20), (60, 20)).shapes, ("kinematics",)),
    Example("all together", TOGETHER, together()),
]
