"""What the operator is told of a frame that has gone."""

import time

from frame_settings import OUTPUTS

#: s beyond three cycles of LinuxCNC's task within which it has ended a program behind an error
LONGEST_ABORT = 0.1

#: where a command of somebody else cannot be carried out
GIVE_AGAIN = "a command was given while the frame was being removed: give it again, start the program again"

#: where no program's end has removed it
REMOVED = "the frame is removed (an abort, an error, or machine off): set it again before anything moves in it"


def outputs_taken(first):
    """Of a program that has written 0 to the first of the outputs, which is the sign of an abort."""
    return (f"M67 or M68 of the program has set motion.analog-out-{first:02} to 0, and with it removed the frame: "
            f"{first:02} to {first + OUTPUTS - 1:02} carry frames. Take another output in the program, or other ones for "
            "frames by [FRAMEPATH]ANALOG_OUTPUT")


class Overwritten:
    """Whether a program has set the first of the outputs to 0 itself: behind an error, which does so too, it does not go on."""

    def __init__(self, task_cycle):
        self.patience = LONGEST_ABORT + 3 * task_cycle
        #: since when a program runs on with a 0 there, None if none does
        self.since = None
        #: one has done so for longer than behind an error
        self.sure = False

    def follow(self, runs, zeroed):
        """Takes one look: whether a program runs, and whether the output has become 0 since the look before."""
        if not runs:
            self.since = None
        elif zeroed:
            self.since = time.monotonic()
        elif self.since and time.monotonic() - self.since > self.patience:
            self.sure = True

    def take(self, ended):
        """Whether it was so, where a frame has gone; `ended`: and no program goes on."""
        found = self.sure or self.since is not None and not ended
        self.since, self.sure = None, False
        return found
