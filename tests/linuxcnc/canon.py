"""What LinuxCNC's own interpreter makes of a program: its canonical calls, compared with shapes written by hand."""

import os
import re
import subprocess
import tempfile
from itertools import zip_longest

from geometry import Line
from part_programs import tool_table

#: axes of the plane, first and second, and the one that is perpendicular
PLANES = {"XY": (0, 1, 2), "XZ": (2, 0, 1), "YZ": (1, 2, 0)}


def calls(program):
    """[(name, arguments as text)] of a program that the interpreter reads to its end."""
    with tempfile.TemporaryDirectory() as folder:
        def write(name, text):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)

        write("part.ngc", program)
        # without a machine, the interpreter takes the tool table as inch
        write("tool.tbl", tool_table(25.4))
        write("machine.ini", "[RS274NGC]\nPARAMETER_FILE = rs274.var\n")
        done = subprocess.run(["rs274", "-n", "0", "-g", "-i", "machine.ini", "-t", "tool.tbl", "part.ngc"], cwd=folder,
                              env=dict(os.environ, HOME=folder), stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=30, check=False)
    complaints = done.stderr.replace("executing", "").strip()
    if complaints:
        raise AssertionError(f"the interpreter says: {complaints}")
    found = re.findall(r"^\s*\d+ \S+\s+(\w+)\((.*)\)\s*$", done.stdout, re.MULTILINE)
    if not any(name == "PROGRAM_END" for name, _ in found):
        raise AssertionError(f"the interpreter did not reach the end: {done.stdout[-500:]}")
    return found


def canonical_shapes(program):
    """[(end, None)] of lines and [(end, (centre, turns with sign, axis it turns about))] of arcs; lengths in mm."""
    shapes: list[tuple] = []
    offset, plane = {}, "XY"
    last = [0.0] * 6
    for name, text in calls(program):
        numbers = [float(word) for word in re.findall(r"-?\d+\.\d+|-?\d+", text)] if "(" not in text else []
        if name == "SET_G5X_OFFSET":
            offset["g5x"] = numbers[1:7]
        elif name == "SET_G92_OFFSET":
            offset["g92"] = numbers[:6]
        elif name == "SET_XY_ROTATION" and numbers[0]:
            raise AssertionError("a rotated work offset: the calls leave it out")
        elif name == "SELECT_PLANE":
            plane = next(name for name in PLANES if name in text)
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            end = moved(numbers, offset)
            if end != last:
                shapes.append((end, None))
            last = end
        elif name == "ARC_FEED":
            first, second, along = PLANES[plane]
            end, centre = [0.0] * 6, [0.0] * 3
            end[first], end[second], centre[first], centre[second], turns, end[along] = numbers[:6]
            centre[along] = end[along]
            end, centre = moved(end, offset), moved(centre, offset)
            shapes.append((end, (centre, turns, along)))
            last = end
    return shapes


def moved(point, offset):
    """A point in coordinates of the machine."""
    for shift in offset.values():
        point = [p + s for p, s in zip(point, shift[:len(point)], strict=True)]
    return point


def expected(shape):
    """A shape written by hand in the form of a canonical one."""
    if isinstance(shape, Line):
        return list(shape.end), None
    u, v = shape.u, shape.v
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    along = max(range(3), key=lambda axis: abs(normal[axis]))
    return list(shape.end), (list(shape.centre), 1 if normal[along] > 0 else -1, along)


def compare(found, shapes, near=1.1e-4):
    """None, or what differs; the interpreter prints four decimals."""
    wanted = [expected(shape) for shape in shapes]
    if len(found) != len(wanted):
        return f"{len(found)} moves, not {len(wanted)}: {found}"

    def differ(a, b):
        # a shape may be written without axes that stay at 0
        return any(abs(p - q) > near for p, q in zip_longest(a, b, fillvalue=0.0))

    for number, ((end, arc), (right, circle)) in enumerate(zip(found, wanted, strict=True)):
        if differ(end, right) or (arc is None) != (circle is None):
            return f"move {number}: {end} {arc}, not {right} {circle}"
        if arc and (differ(arc[0], circle[0]) or arc[1] * circle[1] <= 0 or arc[2] != circle[2]):
            return f"arc {number}: {arc}, not {circle}"
    return None
