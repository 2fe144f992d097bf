"""Moves that would wait for ever: framekins holds the machine until what has changed on its pins is taken over."""

#: what a program writes instead, where framekins has the table
OWN = ("the length of the tool (G43, G49), the tool centre point or the table has changed and is not taken over: write G43.4 "
       "in place of G43, o<tool_centre_off> call in place of G49, or o<frame_refresh> call behind the change")
#: and where another module's kinematics are behind it
INNER = ("the type on framekins.inner-type is not in force, see framekins.inner-refusal: change it while the machine stands, "
         "and write M66 E0 L0 behind the change")
JUMPED = ("the length of the tool (G43, G49) has changed with rotary axes turned, and the joints of the kinematics of inner= "
          "have jumped: write G43.4 in place of G43, o<tool_centre_off> call in place of G49; o<frame_refresh> call goes on "
          "from here")


class Held:
    """How long a move has waited. What a program takes over in its next block holds nothing for longer than the status takes
    to tell of it."""

    def __init__(self, patience, inner):
        """patience: s that this may last; inner: the kinematics are another module's."""
        self.patience = patience
        self.inner = inner
        self.since = None

    def reason(self, waits, clock, is_type_refused):
        """Why a move has to be stopped, None while it need not.

        waits: a move is on its way and framekins holds it. clock: s of now. is_type_refused(): inner
        kinematics do not have their type; asked only where it has to be known.
        """
        if not waits:
            self.since = None
            return None
        self.since = clock if self.since is None else self.since
        if clock - self.since < self.patience:
            return None
        if not self.inner:
            return OWN
        return INNER if is_type_refused() else JUMPED
