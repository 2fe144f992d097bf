"""The machine of the table with framekins in place of its kinematics and a turned frame in every program: what is run, and
how what is recorded is read in the coordinates of the frame."""

import math

#: The frame turns by these degrees about Z, the new Y and the new X, about the zero of the machine, where each row begins:
#: each axis of a program moves three joints.
TURN = (20.0, -15.0, 35.0)
#: Sets it: what o<rot> takes.
WORDS = " ".join(f"[{angle}]" for angle in TURN)
#: Takes the place of the first line of a program, so that those behind it keep their numbers.
SUBROUTINES = {
    "frame.ngc": f"o<frame> sub\n  o<rot> call {WORDS}\no<frame> endsub\nM2\n",
    "framed.ngc": f"o<framed> sub\n  G21 G17 G40 G49 G54 G80 G90 G94 F3000\n  o<rot> call {WORDS}\no<framed> endsub\nM2\n",
}
#: The first of the nine outputs that carry it: the rows have output 0.
FIRST_OUTPUT = 4
CARRIED = ("command", "value.1", "value.2", "value.3", "work-offset.x", "work-offset.y", "work-offset.z",
           "work-offset.rotation", "check")

INI = {("KINS", "KINEMATICS"): "framekins coordinates=XYZAB", ("EMCMOT", "EMCMOT"): "motmod num_aio=16",
       ("RS274NGC", "SUBROUTINE_PATH"): "subroutines:../../subroutines", ("RS274NGC", "OWORD_NARGS"): "1",
       ("RS274NGC", "ON_ABORT_COMMAND"): "o<frame_abort> call", ("FRAMEPATH", "ANALOG_OUTPUT"): str(FIRST_OUTPUT)}

#: The rows inhibit the feed too.
HAL = "".join(f"net frame-{n} motion.analog-out-{FIRST_OUTPUT + n:02} => framekins.{pin}\n"
              for n, pin in enumerate(CARRIED)) + """\
addf framekins servo-thread
net frame-tool-x motion.tooloffset.x => framekins.tool-offset.x
net frame-tool-y motion.tooloffset.y => framekins.tool-offset.y
net frame-tool-z motion.tooloffset.z => framekins.tool-offset.z
net motion-in-position motion.in-position => framekins.in-position
net motion-teleop motion.teleop-mode => framekins.teleop
net motion-on motion.motion-enabled => framekins.enabled
net frame-switch framekins.switchkins-type => motion.switchkins-type
net frame-guarded framekins.guarded => motion.enable
net external-offset-y axis.y.eoffset => framekins.external-offset.y
loadrt or2 names=inhibited
addf inhibited servo-thread
net frame-hold framekins.hold => inhibited.in0
net inhibited inhibited.out => motion.feed-inhibit
loadusr -Wn frame-guard ../../subroutines/frame_guard.py
"""
#: Pins that rows set, and what they set here.
PINS = {"motion.feed-inhibit": "inhibited.in1"}


def turn():
    """The rotation as a matrix: machine = matrix x program."""
    x, y, z = map(math.radians, TURN)
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(angle), math.sin(angle)) for angle in (x, y, z))
    return ((cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx),
            (sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx),
            (-sy, cy * sx, cy * cx))


MATRIX = turn()


def in_frame(machine):
    """A place of the machine, X Y Z, in the coordinates of the frame."""
    return [sum(MATRIX[row][column] * machine[row] for row in range(3)) for column in range(3)]


def on_machine(program):
    """A place of the frame, X Y Z, in those of the machine."""
    return [sum(factor * value for factor, value in zip(row, program, strict=True)) for row in MATRIX]
