"""The Sinumerik-like control: coordinates, and its chapter on transformations.

The contour L10 is ours (the manual has it in pictures only). Where the manual shows a frame alone, three points are
run in it.
"""

import math

from geometry import Frame
from part_programs import Example, Path, both, scaled, turn

L10 = """\
%_N_L10_SPF
G0 X0 Y0 Z5
G1 Z-1 F3000
X10
G3 X10 Y10 CR=5
G1 X0
Y0
G0 Z5
M17
"""


def l10(path, frame):
    path.under(frame).to((0, 0, 5), (0, 0, -1), (10, 0)).arc((10, 5), 180)
    return path.to((0, 10), (0, 0), (0, 0, 5))


def shift(x=0.0, y=0.0, z=0.0):
    return Frame((x, y, z))


#: three points of a frame
POINTS = "G1 X10 Y0 Z0 F3000\nX0 Y10\nY0 Z10\n"


def points(*frames):
    """The three points in each of the frames."""
    path = Path()
    for frame in frames:
        path.under(frame).to((10, 0, 0), (0, 10, 0), (0, 0, 10))
    return path.shapes


def in_frames(*commands):
    """A program that runs the three points after each of the commands."""
    return "G17 G54\n" + "".join(f"{command}\n{POINTS}" for command in commands) + "M30\n"


def two_angles(first, second, a, b):
    """ROTS: about one axis by a, then about another, as it is then, so far that its plane meets the other at b."""
    a, b = math.radians(a), math.radians(b)
    return both(turn(first, math.degrees(a)), turn(second, math.degrees(math.atan(math.tan(b) * math.cos(a)))))


def rpy(x, y, z):
    return both(turn("z", z), turn("y", y), turn("x", x))


ABSOLUTE = """\
G17 G90 G1 F3000
X20 Y35
X50 Y60
X70 Y20
M30
"""

ABSOLUTE_DIAMETERS = """\
G18 DIAMON G90 G1 F3000
X25 Z-7.5
X40 Z-15
X40 Z-25
X60 Z-35
M30
"""

RELATIVE = """\
G17 G91 G1 F3000
X20 Y35 ; (respecto al origen de coordenadas)
X30 Y20 ; (respecto a P1)
X20 Y-35 ; (respecto a P2)
M30
"""

RELATIVE_DIAMETERS = """\
G18 DIAMON G1 F3000
G90 X25 Z-7.5; (respecto al origen de coordenadas)
G91 X15 Z-7.5 ; (respecto a P1)
G91 Z-10 ; (respecto a P2)
G91 X20 Z-10 ; (respecto a P3)
M30
"""

TURNING = [(12.5, 0, -7.5), (20, 0, -15), (20, 0, -25), (30, 0, -35)]

IN_PLANE = """\
G18 ;Plano de trabajo XZ
ROT RPL=-50 ;Rotación según sentido negativo del eje Y 50°
G1 X10 Y0 Z0 F3000
X0 Y10
Y0 Z10
M30
"""

TURNED = """\
N10 G17 G54 ;Plano de trabajo X/Y, sistema coordenado de pieza en origen
N20 TRANS X20 Y10 ;Traslación absoluta
N30 L10 ;LLamada a subprograma
N40 TRANS X55 Y35 ;Traslación absoluta
N50 AROT RPL=45 ;Rotación aditiva del sistema en el plano a 45°
N60 L10 ;LLamada a subprograma
N70 TRANS X20 Y40 ;Traslación absoluta
;(cancela transformaciones previas)
N80 AROT RPL=60 ;Rotación aditiva en el plano a 60°
N90 L10 ;LLamada a subprograma
N100 G0 X100 Y100 ;Retracción
N110 M30 ;Fin de programa
""" + L10

TILTED = """\
N10 G17 G54 ;Plano de trabajo X/Y, sistema coordenado de pieza en origen
N20 TRANS X10 Y10 ;Traslación absoluta
N30 L10 ;LLamada a subprograma
N40 ATRANS X35 ;Traslación aditiva
N50 AROT Y30 ;Rotación aditiva al rededor del eje Y 35°
N60 ATRANS X5 ;Traslación aditiva
N70 L10 ;LLamada a subprograma
N80 G0 X300 Y100 M30 ;Retracción, fin de programa
""" + L10

THREE_AXES = """\
N10 ROT X90 Y90 Z90
""" + POINTS + "M30\n"

SEQUENCE = """\
ROT X30   ;Rotación según eje X en 30°, cancelando cualquier transformación previa
AROT Z-50 ;Rotación según eje Z (ya rotado) en -50°, superponiendo el efecto
AROT Y15  ;Rotación según eje Y (ya rotado) en 15°, superponiendo el efecto
""" + POINTS + "M30\n"

SCALED = """\
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N20 TRANS X15 Y15 ;Traslación (cancela transformaciones previas)
N30 L10 ;Mecanizado de geometría grande
N40 TRANS X40 Y20 ;Traslación (cancela transformaciones previas)
N50 AROT RPL=35 ;Rotación en el plano 35°, aditiva
N60 ASCALE X0.7 Y0.7 ;Factor de escalado para la geometría pequeña
N70 L10 ;Mecanizado de geometría pequeña
N80G0 X300 Y100 M30 ;Retracción, fin de programa
""" + L10

TWO_MIRRORS = """\
MIRROR X0 Y100 ;Invierte sentido de los eje X e Y, no tiene en cuenta los valores
               ;El espejado se realiza respecto al origen de coordenadas
""" + POINTS + "M30\n"

MIRRORED = """\
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N20 L10 ;Mecanizado de la primera geometría, arriba a la derecha
N30 MIRROR X0 ;Espejado del eje X (el sentido se invierte en X)
N40 L10 ;Mecanizado de la segunda geometría, arriba a la izquierda
N50 AMIRROR Y0 ;Espejado del eje Y aditiva (el sentido también se invierte en Y)
N60 L10 ;Mecanizado de la tercer geometría, abajo a la izquierda
N70 MIRROR Y0 ;Cancela espejados previos. Espejado del eje Y
N80 L10 ;Mecanizado de la cuarta geometría, abajo a la derecha
N90 MIRROR ;Desactivar espejado
N100 G0 X300 Y100 M30 ;Retracción, fin de programa
""" + L10

COMPENSATED = """\
T1 M6 D1
{mirror}
G0 X0 Y-20
G41 G1 Y0 F3000
Y30
G2 X10 Y40 I10 J0
G1 X40
Y0
X0
G40 X-20 Y-20
M30
"""


def compensated(frame):
    """The contour with a tool of radius 3 on its left."""
    path = Path().under(frame).to((0, -20), (-3, 0), (-3, 30)).arc((10, 30), -90).to((40, 43)).arc((40, 40), -90)
    return path.to((43, 0)).arc((40, 0), -90).to((0, -3), (-20, -20)).shapes


def turned():
    last = both(shift(20, 40), turn("z", 60))
    path = l10(l10(Path(), shift(20, 10)), both(shift(55, 35), turn("z", 45)))
    return l10(path, last).to((100, 100)).shapes


def tilted():
    last = both(shift(45, 10), turn("y", 30), shift(5))
    return l10(l10(Path(), shift(10, 10)), last).to((300, 100)).shapes


def scaled_part():
    last = both(shift(40, 20), turn("z", 35), scaled(0.7, 0.7))
    return l10(l10(Path(), shift(15, 15)), last).to((300, 100)).shapes


def mirrored():
    path = Path()
    for x, y in [(1, 1), (-1, 1), (-1, -1), (1, -1)]:
        path = l10(path, scaled(x, y))
    return path.under(Frame()).to((300, 100)).shapes


KINEMATICS = ("kinematics",)

EXAMPLES = [
    Example("coordinates: absolute, milling", ABSOLUTE, Path().to((20, 35), (50, 60), (70, 20)).shapes),
    Example("coordinates: absolute, turning", ABSOLUTE_DIAMETERS, Path().to(*TURNING).shapes),
    Example("coordinates: relative, milling", RELATIVE, Path().to((20, 35), (50, 55), (70, 20)).shapes),
    Example("coordinates: relative, turning", RELATIVE_DIAMETERS, Path().to(*TURNING).shapes),
    Example("the commands, shifts and turns in the plane",
            in_frames("TRANS X20 Y10 Z5", "ATRANS X1 Y2 Z3", "ROT RPL=30", "AROT RPL=15"),
            points(shift(20, 10, 5), shift(21, 12, 8), turn("z", 30), turn("z", 45))),
    Example("the commands, turns in space",
            in_frames("ROT X30 Y20 Z10", "ROTS X25", "ROTS X30 Y20", "AROTS Z40", "ROTS X5\nAROTS X15 Z25"),
            points(rpy(30, 20, 10), turn("x", 25), two_angles("y", "x", 30, 20),
                   both(two_angles("y", "x", 30, 20), turn("z", 40)),
                   both(turn("x", 5), two_angles("x", "z", 25, 15))), KINEMATICS),
    Example("the commands, mirrors", in_frames("MIRROR X0 Y0 Z0", "AMIRROR X0 Y0 Z0"),
            points(scaled(-1, -1, -1), Frame())),
    Example("a bare command ends them all",
            in_frames("TRANS X5\nAROT RPL=30\nTRANS", "TRANS X5\nROT", "ASCALE X2 Y2\nSCALE", "TRANS X5\nMIRROR"),
            points(*4 * [Frame()])),
    Example("shifts: TRANS after TRANS", in_frames("TRANS X20 Y10", "TRANS X5 Y30"),
            points(shift(20, 10), shift(5, 30))),
    Example("shifts: ATRANS after TRANS", in_frames("TRANS X20 Y10", "ATRANS X5 Y30"),
            points(shift(20, 10), shift(25, 40))),
    Example("shifts: TRANS and the work offset", in_frames("TRANS X20 Y10"), points(shift(27, 18, 9)),
            before="G10 L2 P1 X7 Y8 Z9\n"),
    Example("turns: ROT RPL in G18", IN_PLANE, points(turn("y", -50)), KINEMATICS),
    Example("turns: shift and turn in the plane", TURNED, turned()),
    Example("turns: shift and turn in space, one axis", TILTED, tilted(), KINEMATICS),
    Example("turns: three axes", THREE_AXES, points(rpy(90, 90, 90)), KINEMATICS),
    Example("turns: one after the other", SEQUENCE,
            points(both(turn("x", 30), turn("z", -50), turn("y", 15))), KINEMATICS),
    Example("turns: ROTS with two angles", in_frames("ROTS X30 Y20", "ROTS Z30 X20", "ROTS Y30 Z20"),
            points(two_angles("y", "x", 30, 20), two_angles("x", "z", 30, 20), two_angles("z", "y", 30, 20)),
            KINEMATICS),
    Example("turns: ROTS with one angle", in_frames("ROTS X20", "ROT X20"),
            points(turn("x", 20), turn("x", 20)), KINEMATICS),
    Example("turns: the working plane turns too", "T1 M6 D1\nROT Y90\nG1 X10 Y0 Z0 F3000\nG3 X10 Y10 I0 J5\nM30\n",
            Path().under(turn("y", 90)).to((10, 0, 0)).arc((10, 5), 180).shapes, KINEMATICS),
    Example("scale: two sizes of a contour", SCALED, scaled_part()),
    Example("scale: shifts after it", in_frames("SCALE X2 Y2\nATRANS X2.5 Y18", "ASCALE"),
            points(both(scaled(2, 2), shift(2.5, 18)), shift(2.5, 18))),
    Example("mirror: values do not count", TWO_MIRRORS, points(scaled(-1, -1))),
    Example("mirror: four images of a contour", MIRRORED, mirrored()),
    Example("mirror: at a shifted origin, and shifts and turns after it",
            in_frames("TRANS X10\nAMIRROR X0", "MIRROR X0\nATRANS X10", "MIRROR X0\nAROT RPL=30"),
            points(both(shift(10), scaled(-1)), both(scaled(-1), shift(10)), both(scaled(-1), turn("z", 30)))),
    Example("mirror: the side of compensation, as it is", COMPENSATED.format(mirror="TRANS"), compensated(Frame())),
    Example("mirror: the side of compensation, mirrored", COMPENSATED.format(mirror="MIRROR X0"),
            compensated(scaled(-1))),
]
