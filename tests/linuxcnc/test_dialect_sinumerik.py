"""The example programs of the Sinumerik-like control's manual, from the part program to the joints of a real LinuxCNC.

The contour is ours (the manual has it in pictures only); where each frame puts it is worked out here from the manual's
rules and not by the filter. Every program runs twice: with its coordinates rewritten, and with the frame kinematics;
the one with a tilted plane with the kinematics only.
"""

import math
import unittest

from geometry import Arc, Line, follow
from part_programs import Path, filtered, joints_of

SAMPLE = "framepath-sim"

L10 = """%_N_L10_SPF
G0 X0 Y0
G1 X10 F3000
G3 X10 Y10 CR=5
G1 X0
Y0
M17
"""

TURNED = """%_N_TURNED_MPF
N10 G17 G54 ;Plano de trabajo X/Y, sistema coordenado de pieza en origen
N15 G0 X0 Y0 Z0
N20 TRANS X20 Y10 ;Traslación absoluta
N30 L10 ;LLamada a subprograma
N40 TRANS X55 Y35 ;Traslación absoluta
N50 AROT RPL=45 ;Rotación aditiva del sistema en el plano a 45°
N60 L10 ;LLamada a subprograma
N70 TRANS X20 Y40 ;Traslación absoluta
;(cancela transformaciones previas)
N80 AROT RPL=60 ;Rotación aditiva en el plano a 60°
N90 L10 ;LLamada a subprograma
N95 TRANS
N100 G0 X100 Y100 ;Retracción
N110 M30 ;Fin de programa
"""

SCALED = """%_N_SCALED_MPF
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N15 G0 X0 Y0 Z0
N20 TRANS X15 Y15 ;Traslación (cancela transformaciones previas)
N30 L10 ;Mecanizado de geometría grande
N40 TRANS X40 Y20 ;Traslación (cancela transformaciones previas)
N50 AROT RPL=35 ;Rotación en el plano 35°, aditiva
N60 ASCALE X0.7 Y0.7 ;Factor de escalado para la geometría pequeña
N70 L10 ;Mecanizado de geometría pequeña
N75 TRANS
N80G0 X100 Y100 M30 ;Retracción, fin de programa
"""

MIRRORED = """%_N_MIRRORED_MPF
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N15 G0 X0 Y0 Z0
N20 L10 ;Mecanizado de la primera geometría, arriba a la derecha
N30 MIRROR X0 ;Espejado del eje X (el sentido se invierte en X)
N40 L10 ;Mecanizado de la segunda geometría, arriba a la izquierda
N50 AMIRROR Y0 ;Espejado del eje Y aditiva (el sentido también se invierte en Y)
N60 L10 ;Mecanizado de la tercer geometría, abajo a la izquierda
N70 MIRROR Y0 ;Cancela espejados previos. Espejado del eje Y
N80 L10 ;Mecanizado de la cuarta geometría, abajo a la derecha
N90 MIRROR ;Desactivar espejado
N100 G0 X100 Y100 M30 ;Retracción, fin de programa
"""

TILTED = """%_N_TILTED_MPF
N10 G17 G54 ;Plano de trabajo X/Y, sistema coordenado de pieza en origen
N15 G0 X0 Y0 Z0
N20 TRANS X10 Y10 ;Traslación absoluta
N25 G0 Z0
N30 L10 ;LLamada a subprograma
N40 ATRANS X35 ;Traslación aditiva
N50 AROT Y30 ;Rotación aditiva al rededor del eje Y 35°
N60 ATRANS X5 ;Traslación aditiva
N65 G0 X0 Y0 Z0
N70 L10 ;LLamada a subprograma
N75 TRANS
N80 G0 X100 Y100 Z0 M30 ;Retracción, fin de programa
"""


def contour(path, origin, degrees=0.0, scale=1.0, mirror=(1, 1)):
    """L10 in the plane, mirrored, then scaled and turned about its origin."""
    angle = math.radians(degrees)

    def at(x, y):
        x, y = scale * mirror[0] * x, scale * mirror[1] * y
        return (origin[0] + x * math.cos(angle) - y * math.sin(angle),
                origin[1] + x * math.sin(angle) + y * math.cos(angle))

    path.to(at(0, 0), at(10, 0)).arc(at(10, 10), at(10, 5), 180 * mirror[0] * mirror[1])
    return path.to(at(0, 10), at(0, 0))


def turned():
    path = contour(Path(), (20, 10))
    path = contour(path, (55, 35), 45)
    return contour(path, (20, 40), 60).to((100, 100)).shapes


def scaled():
    path = contour(Path(), (15, 15))
    return contour(path, (40, 20), 35, 0.7).to((100, 100)).shapes


def mirrored():
    path = Path()
    for mirror in [(1, 1), (-1, 1), (-1, -1), (1, -1)]:
        path = contour(path, (0, 0), mirror=mirror)
    return path.to((100, 100)).shapes


def tilted():
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    # X10 Y10, then X35, then 5 along the tilted X
    origin = (45 + 5 * cos, 10.0, -5 * sin)

    def at(x, y):
        return [origin[0] + x * cos, origin[1] + y, origin[2] - x * sin]

    shapes = contour(Path(), (10, 10)).shapes
    shapes.append(Line([10.0, 10.0, 0.0], at(0, 0)))
    shapes.append(Line(at(0, 0), at(10, 0)))
    # from the centre back to the start, and a quarter of a turn on
    shapes.append(Arc(at(10, 5), [0.0, -5.0, 0.0], [5 * cos, 0.0, -5 * sin], 180))
    for start, end in [((10, 10), (0, 10)), ((0, 10), (0, 0))]:
        shapes.append(Line(at(*start), at(*end)))
    shapes.append(Line(at(0, 0), [100.0, 100.0, 0.0]))
    return shapes


class Sinumerik(unittest.TestCase):
    def check(self, program, shapes, backends=("program", "kinematics")):
        for backend in backends:
            with self.subTest(backend=backend):
                joints = joints_of(filtered(program + L10, "sinumerik", "part.mpf", backend), SAMPLE)
                worst, missed = follow(joints, shapes)
                self.assertLess(worst, 1e-6)
                # every corner is a stop; a stop between two samples lies beside both
                self.assertLess(missed, 5e-6)

    def test_shifted_and_turned(self):
        self.check(TURNED, turned())

    def test_scaled(self):
        self.check(SCALED, scaled())

    def test_mirrored(self):
        self.check(MIRRORED, mirrored())

    def test_tilted(self):
        self.check(TILTED, tilted(), ["kinematics"])


if __name__ == "__main__":
    unittest.main()
