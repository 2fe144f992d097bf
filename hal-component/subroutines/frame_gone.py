"""What the operator is told of a frame that has gone."""

from frame_settings import OUTPUTS

#: where a command of somebody else cannot be carried out
GIVE_AGAIN = "a command was given while the frame was being removed: give it again, start the program again"

#: where no program's end has removed it
REMOVED = "the frame is removed (an abort, an error, or machine off): set it again before anything moves in it"


def outputs_taken(first):
    """Of a program that has written 0 to the first of the outputs, which is the sign of an abort."""
    return (f"M67 or M68 of the program has set motion.analog-out-{first:02} to 0, and with it removed the frame: "
            f"{first:02} to {first + OUTPUTS - 1:02} carry frames. Take another output in the program, or other ones for "
            "frames by [FRAMEPATH]ANALOG_OUTPUT")
