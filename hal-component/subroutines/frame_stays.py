"""What the operator is told of a frame that should be gone and is not."""

import hal

#: framekins.refusal: the kinematics of inner= would let the joints jump
OTHER_JOINTS = 19

JUMP = ("the joints of inner= would jump where the machine is: go where they do not, in MDI (an arm: bend its wrist; maxkins: "
        "G0 B0 or G0 C0)")

#: and external offsets move the axes, or a pin for them says what they are not
OFFSETS_MOVE, UNKNOWN_OFFSET = 21, 22

MOVES = "an external offset (axis.L.eoffset) moves the axes, and it goes when that stands: hold it, or take it away"

UNKNOWN = ("a pin framekins.external-offset.L is not the external offset of its axis, see the message of framekins: set it "
           "right, or switch the machine off")

REASONS = {OTHER_JOINTS: JUMP, OFFSETS_MOVE: MOVES, UNKNOWN_OFFSET: UNKNOWN}

NETS = "are framekins.in-position, framekins.teleop and motion.switchkins-type linked as in the HAL file of the sample?"


def would_jump():
    """Whether framekins has found that the joints would jump."""
    return hal.get_value("framekins.refusal") == OTHER_JOINTS


def complaint():
    """Of a frame that framekins does not remove."""
    return ("the frame has to go, and framekins does not remove it: do not touch off nor start a program; "
            + REASONS.get(hal.get_value("framekins.refusal"), NETS))


def late_start(active, stays):
    """Of a program that was started in a frame; stays: framekins has not been able to remove it."""
    what = f"a frame was still {'active' if active else 'suspended'} when the program started: "
    if stays and would_jump():
        return f"{what}it cannot go, for {JUMP}. Then start the program again"
    return f"{what}it is removed first, start the program again behind that"


def work_offset_changed(due):
    """Of a move behind a work offset that the frame does not have; due: the frame has to go."""
    if due and would_jump():
        return f"the work offset has changed while a frame has to go: {JUMP}. Then touch off again"
    return ("the work offset has changed while a frame is active: call o<frame_refresh> behind G54.., G10 L2, G52; to touch off "
            "(G10 L20, G92) call o<frame_suspend> before it and o<frame_resume> behind it")
