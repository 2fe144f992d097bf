"""What a position display shows while a frame is in force."""

import math
import re

from frame_map import Map, determinant, inverse, product

LETTERS = "XYZABCUVW"

#: what is rounded off is not shown: lengths in the units of the display, angles in degrees
SHOWN = 5e-4


def joints_of_axes(ini) -> list[int | None]:
    """The joint of each of nine axes, None where there is none. ini: LinuxCNC's INI file, linuxcnc.ini."""
    kinematics = ini.find("KINS", "KINEMATICS") or ""
    if not re.match(r"(framekins|trivkins)\b|$", kinematics):
        # joints of other kinematics are no axes
        return [None] * len(LETTERS)
    found = re.search(r"\bcoordinates=(\w+)", kinematics)
    letters = found.group(1).upper() if found else "XYZ"
    return [letters.index(letter) if letter in letters else None for letter in LETTERS]


class MachineStatus:
    """LinuxCNC's status with positions of the machine's own axes, in place of those in the coordinates of the frame."""

    def __init__(self, status, joints):
        """joints: see joints_of_axes."""
        self._status = status
        self.position = axis_positions(status.position, status.joint_position, joints)
        self.actual_position = axis_positions(status.actual_position, status.joint_actual_position, joints)

    def __getattr__(self, name):
        return getattr(self._status, name)


def axis_positions(axes, joint_positions, joints):
    """Positions of the machine's own axes: those of the joints, and `axes` where an axis has none. joints: see
    joints_of_axes."""
    return tuple(value if joint is None else joint_positions[joint] for value, joint in zip(axes, joints, strict=True))


def describe(frame: Map, work: Map, unit: float) -> str:
    """A frame in a line. frame: of the machine; work: the work offset; unit: units of the display in a machine unit."""
    programmed = product(inverse(work), frame, work)
    words = [f"{letter}{row[3] * unit:.3f}" for letter, row in zip(LETTERS, programmed, strict=False)
             if abs(row[3] * unit) > SHOWN]
    size = determinant(programmed)
    scale = abs(size) ** (1 / 3)
    if size < 0:
        words.append("mirrored")
    else:
        trace = sum(programmed[axis][axis] for axis in range(3)) / scale
        angle = math.degrees(math.acos(max(-1.0, min(1.0, (trace - 1) / 2))))
        if angle > SHOWN:
            words.append(f"turned {angle:.3f}")
    if any(abs(math.hypot(*(row[axis] for row in programmed)) - 1) > 1e-6 for axis in range(3)):
        words.append("scaled")
    return " ".join(["FRAME", *words])
