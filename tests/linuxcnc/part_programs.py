"""Part programs of other controls: what the filter makes of them, where the joints go, and paths written by hand."""

import math
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass

import harness
from geometry import Arc, Frame, Line

#: tool number and diameter; 3, 4 and 5 leave a compensated contour where it was programmed
TOOLS = {1: 6.0, 2: 10.0, 3: 0.0, 4: 0.0, 5: 0.0}


class Path:
    """Shapes one after the other from the machine's zero on, written in the coordinates of a frame.

    A coordinate that is left out is the one that was written last.
    """

    def __init__(self):
        self.shapes, self.frame = [], Frame()
        self.local: tuple[float, ...] = (0.0, 0.0, 0.0)
        self.end = [0.0, 0.0, 0.0]

    def under(self, frame):
        """What follows is written in the coordinates of this frame."""
        self.frame = frame
        return self

    def to(self, *points):
        for point in points:
            self.local = (*point, *self.local[len(point):])
            end = self.frame.point(self.local)
            if math.dist(end, self.end) > 1e-12:
                self.shapes.append(Line(self.end, end))
            self.end = end
        return self

    def arc(self, centre, degrees):
        """About (x, y) of the frame, parallel to its XY plane; degrees above 0 are counterclockwise in the frame."""
        x, y = self.local[0] - centre[0], self.local[1] - centre[1]
        turn = math.copysign(1.0, degrees)
        z = self.local[2]
        arc = Arc(self.frame.point((*centre, z)), self.frame.vector((x, y, 0.0)),
                  self.frame.vector((-turn * y, turn * x, 0.0)), abs(degrees))
        self.shapes.append(arc)
        self.end = arc.end
        angle = math.radians(degrees)
        self.local = (centre[0] + x * math.cos(angle) - y * math.sin(angle),
                      centre[1] + x * math.sin(angle) + y * math.cos(angle), z)
        return self


def turn(axis, degrees):
    """The frame that is turned about one of the axes "x", "y" and "z"."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {"x": Frame(y=(0.0, c, s), z=(0.0, -s, c)), "y": Frame(x=(c, 0.0, -s), z=(s, 0.0, c)),
            "z": Frame(x=(c, s, 0.0), y=(-s, c, 0.0))}[axis]


def scaled(x=1.0, y=1.0, z=1.0):
    return Frame(x=(x, 0.0, 0.0), y=(0.0, y, 0.0), z=(0.0, 0.0, z))


def both(*frames):
    """Each frame in the coordinates of the one before it."""
    result = Frame()
    for frame in frames:
        result = Frame(result.point(frame.origin), *(result.vector(axis) for axis in frame.axes))
    return result


@dataclass
class Example:
    """A program of a control's manual, and where it takes the tool."""

    #: where it stands in the manual
    name: str
    #: as the manual has it; where a listing was damaged, as it must have been
    program: str
    #: shapes from the machine's zero on, worked out by hand
    shapes: list
    backends: tuple = ("program", "kinematics")
    #: for the filter
    options: tuple = ()
    #: G-code that is run first
    before: str = ""
    #: letters of the machine's axes
    axes: str = "xyz"
    #: how far corners may be rounded
    tolerance: float = 0.0


def convert(program, dialect, backend, options=()):
    """What the filter does with a program: exit code, standard output, standard error."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "part.nc")
        with open(path, "w", encoding="utf-8") as file:
            file.write(program)
        done = subprocess.run([harness.TOOL, "filter", "--dialect", dialect, "--backend", backend, "--path-mode", "G61.1",
                               *options, path], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def filtered(program, dialect, backend, options=()):
    """The part program as LinuxCNC gets it, with a stop at the end of every move."""
    code, output, complaints = convert(program, dialect, backend, options)
    if code:
        raise AssertionError(complaints)
    return output


def quick(gcode, feed=18000):
    """The same path faster: the examples' own feeds would take minutes."""
    return re.sub(r"\bF[\d.]+", f"F{feed}", gcode)


def tool_table(unit=1.0):
    return "".join(f"T{number} P{number} D{diameter / unit:.9f} Z0\n" for number, diameter in TOOLS.items())


#: an output that neither the frames nor the examples use
SIGNAL, SIGNAL_PIN = 15, "motion.analog-out-15"


def with_signal(program, number):
    """The program with an output that is set when all its motion is over."""
    found = re.search(r"^([^(;\n]*)\b(M2|M30)\b(.*)$", program, re.MULTILINE)
    if not found:
        raise AssertionError(f"the program has no end: {program[-500:]}")
    before, end, comment = found.groups()
    return f"{program[:found.start()]}{before}{comment}\nM68 E{SIGNAL} Q{number}\n{end}\n"


def quick_machine(letters):
    """Changes of the INI for a quicker machine, so that many small moves take little time.

    Not too quick: half a servo period before and behind a stop it is 3 nanometres away, at most.
    """
    changes = {("TRAJ", "MAX_LINEAR_VELOCITY"): "300"}
    for joint, letter in enumerate(letters.upper()):
        for section in (f"AXIS_{letter}", f"JOINT_{joint}"):
            changes[(section, "MAX_VELOCITY")] = "300"
            changes[(section, "MAX_ACCELERATION")] = "5000"
        if letter in "XYZ":
            changes[(f"AXIS_{letter}", "MAX_JERK")] = "100000"
    return changes


def run(programs, sample, ini=None, hal="", letters="xyz"):
    """Runs programs one after the other in one LinuxCNC, each from the machine's zero on.

    Returns for each of them where the joints are in every servo cycle. Raises AssertionError on any message.
    """
    zero, joints = " ".join(f"{letter.upper()}0" for letter in letters), len(letters)
    reset = "\n".join(["G92.1", f"G10 L2 P1 {zero} R0", f"G54 G17 G21 G40 G49 G90 G94 G61.1 G0 {zero}", "M2", ""])
    files, steps = {"tools.tbl": tool_table()}, []

    def add(program, part):
        number = len(files)
        files[f"part{number}.ngc"] = with_signal(program, number)
        # LinuxCNC's status may tell of the program before: not so the signal
        steps.extend([["halcmd", "sets", "record-part", str(part)], ["start", f"PROGRAMS/part{number}.ngc"],
                      ["expect", SIGNAL_PIN, str(number), 120], ["finish"]])

    for number, program in enumerate(programs):
        add(program, number + 1)
        add(reset, 0)
    changes = {("EMCIO", "TOOL_TABLE"): "../../programs/tools.tbl", **quick_machine(letters), **(ini or {})}
    result = harness.run(steps, files, ini=changes, hal=hal, sample=sample, joints=joints, axes="",
                         integers={"part": ""})
    if result.failure or result.errors:
        raise AssertionError(f"{result.failure} {result.errors}\n{result.log}")
    places = list(zip(*(result.commanded(joint) for joint in range(joints)), strict=True))
    parts = result.column("part")
    return [[place for place, part in zip(places, parts, strict=True) if part == number + 1] for number in range(len(programs))]


@dataclass
class Deviations:
    """How recorded joints lie beside a path that was written down by hand."""

    #: (number of the shape, place on it from 0 to 1, vector from the shape to the joints) in order of time
    beside: list
    #: greatest distance of the joints from the end of a shape
    missed: float

    def worst(self):
        return max(math.hypot(*vector) for _, _, vector in self.beside)

    def apart(self, other):
        """Greatest distance between two runs along the same path, place by place."""
        greatest, n = 0.0, 0
        for shape, t, vector in self.beside:
            while n + 1 < len(other.beside) and other.beside[n + 1][:2] <= (shape, t):
                n += 1
            shape_0, t_0, before = other.beside[n]
            shape_1, t_1, after = other.beside[min(n + 1, len(other.beside) - 1)]
            share = (t - t_0) / (t_1 - t_0) if shape_0 == shape_1 == shape and t_1 > t_0 else 0.0
            there = [b + share * (a - b) for b, a in zip(before, after, strict=True)]
            greatest = max(greatest, math.dist(vector, there))
        return greatest


def place(shape, t):
    if isinstance(shape, Arc):
        return shape.at(t)
    return [s + t * (e - s) for s, e in zip(shape.start, shape.end, strict=True)]


def deviations(points, shapes, corner=5e-6):
    """Goes through the recorded joints in order of time, and along the shapes in their order.

    Raises AssertionError if the joints do not come to the last shape.
    """
    beside, missed, n, nearest_end = [], 0.0, 0, math.inf
    for point in points:
        while n + 1 < len(shapes):
            nearest_end = min(nearest_end, math.dist(point, shapes[n].end))
            here, there = shapes[n].nearest(point)[0], shapes[n + 1].nearest(point)[0]
            # on to the next shape when this one has been run to its end and the point lies better on the next
            if there >= here or nearest_end >= corner:
                break
            missed, nearest_end = max(missed, nearest_end), math.inf
            n += 1
        t = shapes[n].nearest(point)[1]
        beside.append((n, t, [p - s for p, s in zip(point, place(shapes[n], t), strict=True)]))
    if n + 1 < len(shapes):
        raise AssertionError(f"the joints do not come behind shape {n} of {len(shapes)}, which ends at {shapes[n].end}")
    return Deviations(beside, max(missed, math.dist(points[-1], shapes[-1].end)))
