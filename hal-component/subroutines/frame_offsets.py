"""Work offsets that change under a frame, and those that were set while it had to go: they were taken at a place that is none
any more."""

#: offsets that differ by less are equal, machine units or degrees
SAME = 1e-6

AXES = "XYZABCUVW"

#: axes of AXES that turn
ANGLES = "ABC"

#: status.program_units, in millimetres
UNITS = {1: 25.4, 2: 1.0, 3: 10.0}


class Offsets:
    """The work offset in force, and G92."""

    def __init__(self, status):
        self.index = status.g5x_index
        self.g5x = tuple(status.g5x_offset)
        self.rotation = status.rotation_xy
        self.g92 = tuple(status.g92_offset)

    def was_set_since(self, earlier):
        """Whether somebody has set the work offset (G10); another one that was chosen is none."""
        return self.index == earlier.index and differ((*self.g5x, self.rotation), (*earlier.g5x, earlier.rotation))

    def was_shifted_since(self, earlier):
        """Whether somebody has set G92 or G52."""
        return differ(self.g92, earlier.g92)

    def command(self, status, units_per_mm):
        """G10 that makes it so, in the units in which MDI is now."""
        unit = units_per_mm * UNITS.get(status.program_units, 1.0)
        words = [f"{letter}{value if letter in ANGLES else value / unit:.9f}"
                 for axis, (letter, value) in enumerate(zip(AXES, self.g5x, strict=True)) if status.axis_mask >> axis & 1]
        return f"G10 L2 P{self.index} {' '.join(words)} R{self.rotation:.9f}"


def differ(one, other):
    """Whether two lists of offsets are not equal."""
    return any(abs(a - b) > SAME for a, b in zip(one, other, strict=True))
