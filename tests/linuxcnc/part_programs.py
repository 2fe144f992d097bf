"""Part programs of other controls: what the filter makes of them, where the joints go, and paths written by hand."""

import math
import os
import subprocess
import tempfile

import harness
from geometry import Arc, Line

TOOL = os.environ.get("FRAMEPATH_TOOL", os.path.join(harness.ROOT, "target", "release", "framepath"))


def filtered(program, dialect, name, backend):
    """The part program as LinuxCNC gets it, with a stop at the end of every move."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(program)
        done = subprocess.run([TOOL, "filter", "--dialect", dialect, "--backend", backend,
                               "--path-mode", "G61.1", path],
                              capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


def joints_of(gcode, sample):
    """Where the three joints are in every servo cycle of a real LinuxCNC."""
    result = harness.run([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": gcode}, sample=sample)
    if result.failure or result.errors:
        raise AssertionError(f"{result.failure} {result.errors}\n{result.log}")
    return list(zip(*(result.commanded(joint) for joint in range(3))))


class Path:
    """Shapes at Z0 from the machine's zero on, one after the other."""

    def __init__(self):
        self.shapes, self.at = [], (0.0, 0.0)

    def to(self, *points):
        for x, y in points:
            if (x, y) != self.at:
                self.shapes.append(Line([*self.at, 0.0], [x, y, 0.0]))
            self.at = (x, y)
        return self

    def arc(self, end, centre, degrees):
        """Degrees above 0 are counterclockwise."""
        u = [self.at[0] - centre[0], self.at[1] - centre[1], 0.0]
        turn = math.copysign(1.0, degrees)
        self.shapes.append(Arc([*centre, 0.0], u, [-turn * u[1], turn * u[0], 0.0], abs(degrees)))
        self.at = end
        return self
