"""Offsets that are touched off in a frame and outlive it: a place in a frame is none behind it."""

from frame_offsets import differ

#: when the frame has gone
LEFT = ("a work offset or G92 was set in a frame that is gone now, and a place in that frame is none without it: touch off "
        "again before anything moves")
#: when a program starts behind that
HELD = ("the work offset was touched off in a frame that is gone, and not since: touch off again. If it is meant so, start the "
        "program again")


class Touched:
    """Whether the offset in force was set in a frame and never taken over by a command for frames."""

    def __init__(self):
        #: the offsets before somebody has set them in the frame in force, None if nobody has
        self.before = None
        #: they were set in a frame that is gone, and not since
        self.wrong = False
        #: the look before
        self.last = None

    def follow(self, now):
        """Takes one look. Whether a frame has just gone with such an offset left."""
        last, self.last = self.last or now, now
        was_set = is_set(now.offsets, last.offsets)
        if now.active and now.steady:
            if not differ(now.work_offset, now.offset_made):
                # taken over, or set back
                self.before = None
            elif last.active and was_set and not is_reset(now.offsets):
                self.before = self.before or last.offsets
        elif not now.has_frame and self.before:
            self.wrong, self.before = is_set(now.offsets, self.before), None
            return self.wrong
        if was_set and not now.active:
            self.wrong = False
        return False


def is_set(offsets, earlier):
    """Whether somebody has set the work offset in force, or G92."""
    return offsets.was_set_since(earlier) or offsets.was_shifted_since(earlier)


def is_reset(offsets):
    """Whether nothing is left of the work offset and G92, as programs leave it at their end: that is no place."""
    return not differ((*offsets.g5x, offsets.rotation, *offsets.g92), (0.0,) * (2 * len(offsets.g5x) + 1))
