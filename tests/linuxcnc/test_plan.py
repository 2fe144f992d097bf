"""`framepath plan` against a real LinuxCNC with blendtp: time, and the position in every servo cycle.

Ten programs run one after the other in one LinuxCNC; between them the machine goes back to where a plan begins. It is
held at the start until the queue is full (plan --fill-queue): how fast LinuxCNC hands over moves depends on what else
the computer has to do.
"""

import csv
import json
import math
import os
import re
import subprocess
import tempfile
import unittest

import harness

TOOL = os.environ.get("FRAMEPATH_TOOL", os.path.join(harness.ROOT, "target", "release", "framepath"))
INI = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")
NCFILES = "/usr/share/linuxcnc/ncfiles"
PERIOD = 1e-3
AXES = "xyz"
#: seconds of standstill between two programs; none of them stands as long on its way
PAUSE = 0.4
#: cycles of standstill that divide the recording
STANDSTILL = 60
HEAD = "G21 G17 G90 G94 G54 G40 G49"


def sample(name, lines, feed):
    """The first lines of one of LinuxCNC's programs, faster: it is run in real time."""
    with open(os.path.join(NCFILES, name + ".ngc"), encoding="latin-1") as file:
        text = [next(file, "").rstrip() for _ in range(lines)]
    # stops and tool changes ask the operator
    kept = [re.sub(r"\([^)]*\)?", "", line) for line in text if not re.search(r"(?i)\bM0\b|M6\b|\bM2\b|\bM30\b|%", line)]
    # an F in a name is none
    faster = [re.sub(r"(?i)(?<![a-z_<#])F\s*(\[[^]]*\]|#<\w+>|[\d.]+)", f"F{feed}", line) for line in kept]
    return [*faster, "M5 M9"]


def program(*lines):
    return "\n".join(["G61.1", HEAD, *lines, "M2"]) + "\n"


def lines(points):
    return ["G1 " + " ".join(f"{axis.upper()}{place:.6f}" for axis, place in zip(AXES, point)) for point in points]


def curve(count, step):
    return [(20 * math.sin(step * n / 20), 12 * (1 - math.cos(step * n / 9)), 2 * math.sin(step * n / 5))
            for n in range(1, count + 1)]


PROGRAMS = {
    "3D_Chips": program(*sample("3D_Chips", 120, 6000)),
    "tort": program("F3000", *sample("tort", 20, 5000)),
    "arcspiral": program(*sample("arcspiral", 60, 220)),
    "cds": program(*sample("cds", 22, 220)),
    "spiral": program(*(line.replace("800", "50") for line in sample("spiral", 13, 220))),
    "stops": program("F4000", "G1 X30 Y5", "X10 Y20 Z-4", "G0 X40", "G2 X20 Y0 I-20 J0", "G1 X1 Y0 Z0"),
    "corners": program("G64 P0.05 F5000", *lines([(8 * n, 12 * (n % 2), 0) for n in range(1, 13)])),
    "dense": program("G64 P0.01 Q0 F4000", *lines(curve(1300, 0.2))),
    "merged": program("G64 P0.03 Q0.02 F4000", *lines(curve(300, 0.25))),
    "modes": program("G64 P0.1 F3000", "G1 X20 Y5", "G3 X30 Y15 J10", "G61", "G1 X40 Y15 Z3", "G18 G2 X50 Z3 I5",
                     "G17 G64", "G1 X60 Y20", "X50 Y30", "G0 X0 Y0 Z0", "G20", "G1 F100 X0.5", "G21"),
}


def plan(*arguments, check=True):
    done = subprocess.run([TOOL, "plan", *arguments], capture_output=True, text=True, check=False)
    if check and done.returncode:
        raise AssertionError(done.stderr)
    return done


def from_first_motion(positions):
    """What lies between the first and the last change."""
    moving = [n for n in range(1, len(positions)) if positions[n] != positions[n - 1]]
    return positions[moving[0] - 1:moving[-1] + 1]


class AgainstLinuxCnc(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        steps = []
        for name in PROGRAMS:
            steps += [["mdi", "G61.1 G21 G90 G54"], ["mdi", "G53 G0 X0 Y0 Z0"], ["sleep", PAUSE],
                      ["setp", "motion.feed-inhibit", 1],
                      ["start", f"PROGRAMS/{name}.ngc"], ["fill_queue"], ["setp", "motion.feed-inhibit", 0],
                      ["finish"], ["sleep", PAUSE]]
        files = {f"{name}.ngc": text for name, text in PROGRAMS.items()}
        # the first way back to zero has to be one, too
        steps = [["mdi", "G0 X1"], ["sleep", PAUSE], *steps]
        result = harness.run(steps, files)
        if result.failure or result.errors:
            raise AssertionError(f"{result.failure} {result.errors}\n{result.log}")
        cls.motions = cls.divide([tuple(p) for p in result.columns(*(f"axis.{axis}" for axis in AXES))])

    @staticmethod
    def divide(positions):
        """The motions, divided by long standstills."""
        motions, start, still = [], None, 0
        for n in range(1, len(positions)):
            if positions[n] != positions[n - 1]:
                start, still = (n - 1 if start is None else start), 0
                last = n
            elif start is not None:
                still += 1
                if still == STANDSTILL:
                    motions.append(positions[start:last + 1])
                    start = None
        return motions

    def predicted(self, name, folder):
        file, table = os.path.join(folder, name + ".ngc"), os.path.join(folder, name + ".csv")
        with open(file, "w", encoding="utf-8") as out:
            out.write(PROGRAMS[name])
        figures = json.loads(plan(file, "--ini", INI, "--fill-queue", "--csv", table, "--json").stdout)["programs"][0]
        with open(table, encoding="utf-8") as rows:
            positions = [tuple(float(row[f"axis.{axis}"]) for axis in AXES) for row in csv.DictReader(rows)]
        return figures, from_first_motion(positions)

    def test_times_and_positions(self):
        self.assertEqual(len(self.motions), 1 + 2 * len(PROGRAMS))
        same = 0
        with tempfile.TemporaryDirectory() as folder:
            for n, name in enumerate(PROGRAMS):
                real = self.motions[2 + 2 * n]
                figures, positions = self.predicted(name, folder)
                cycles, predicted = len(real) - 1, len(positions) - 1
                with self.subTest(program=name):
                    self.assertEqual(figures["cycles"], predicted)
                    self.assertLessEqual(abs(cycles - predicted), max(3, 0.002 * cycles))
                    self.assertLess(math.dist(real[-1], positions[-1]), 1e-6)
                away = max((math.dist(a, b) for a, b in zip(real, positions)), default=0)
                same += away < 1e-6 and cycles == predicted
                print(f"{name:10} LinuxCNC {cycles * PERIOD:8.3f} s, planned {predicted * PERIOD:8.3f} s, "
                      f"positions within {away:.2g} mm")
        # where the plan does not depend on when a move comes
        self.assertGreaterEqual(same, 3)


class Refusals(unittest.TestCase):
    def test_what_the_interpreter_refuses_is_passed_on(self):
        with tempfile.NamedTemporaryFile("w", suffix=".ngc") as file:
            file.write("G21 F100\nG1 X1\nG1 X2 Q?\nM2\n")
            file.flush()
            done = plan(file.name, "--ini", INI, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(f"{file.name}:3: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
