"""LinuxCNC's own manual for users: its chapter on concepts. These programs need no filter."""

from part_programs import Example, Path

SQUARE = "G21 G90 G17 {mode}\nG1 X10 F3000\nY10\nX0\nY0\nM2\n"
SQUARED = Path().to((10, 0), (10, 10), (0, 10), (0, 0)).shapes

#: offsets of every kind, and what the manual says to do when one is lost among them
LOST = """\
G61.1 G21 G90 G17
G10 L2 P2 X5 Y6 Z7 R30
G55 G43 H2
G1 X1 Y1 Z1 F3000
G92 X3 Y3 Z3
G53 G0 X0 Y0 Z0
G92.1
G54
G10 L2 P1 X0 Y0 Z0 R0
G49
G0 X1 Y2 Z3
G10 L2 P2 X0 Y0 Z0 R0
M2
"""


def lost():
    # (1, 1) of a system turned by 30 degrees: cos 30 - sin 30 and sin 30 + cos 30
    c, s = 3 ** 0.5 / 2, 0.5
    return Path().to((5 + c - s, 6 + s + c, 8), (0, 0, 0), (1, 2, 3)).shapes


EXAMPLES = [
    Example("the shortest program", "G61.1\nG1 X1 F10 (G1 is linear motion, X1 the destination, F10 the speed)\nM2\n",
            Path().to((1, 0)).shapes),
    Example("G61", SQUARE.format(mode="G61"), SQUARED),
    Example("G61.1", SQUARE.format(mode="G61.1"), SQUARED),
    Example("G64 P0.05", SQUARE.format(mode="G64 P0.05"), SQUARED, tolerance=0.05),
    Example("G64 P0.05 Q0.01", SQUARE.format(mode="G64 P0.05 Q0.01"), SQUARED, tolerance=0.05),
    Example("when you are lost", LOST, lost()),
]
