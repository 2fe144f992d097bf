"""Whether a program goes beyond the ends of the machine's joints."""

#: machine units: what is less beyond a limit is rounding
ROUNDING = 1e-6


def joint_limits(status, joints):
    """The least and the greatest position of the joints of X Y Z, in machine units; None if one of them has no joint."""
    if None in joints[:3]:
        return None
    found = [status.joint[joint] for joint in joints[:3]]
    return [one["min_position_limit"] for one in found], [one["max_position_limit"] for one in found]


def exceeded(reach, limits, inches: float) -> list[str]:
    """A sentence for each limit that is exceeded. reach: least and greatest X Y Z of the axes, inches, None of a program
    that does not move; limits: the same of the joints, machine units; inches: in a machine unit."""
    sentences: list[str] = []
    if reach is None:
        return sentences
    for axis, letter in enumerate("XYZ"):
        (least, greatest), (minimum, maximum) = ([side[axis] for side in both] for both in (reach, limits))
        if least / inches < minimum - ROUNDING:
            sentences.append(
                f"The program takes {letter} of the machine to {least / inches:.3f}, its joint ends at {minimum:.3f}")
        if greatest / inches > maximum + ROUNDING:
            sentences.append(
                f"The program takes {letter} of the machine to {greatest / inches:.3f}, its joint ends at {maximum:.3f}")
    return sentences
