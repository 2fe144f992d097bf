"""`framepath compare` against a real LinuxCNC with its own planner: the time of the same module on the same programs.

compare drives LinuxCNC's tpmod outside of LinuxCNC, with a move in each cycle. What it says of the time of the ten
programs (ten_programs.py) has to be what they take in LinuxCNC on a machine with the same limits. Where it is not, and
moves did come late, the program is run again.
"""

import json
import os
import shutil
import subprocess
import tempfile
import unittest

import pytest

import harness
from ten_programs import ATTEMPTS, NCFILES, PROGRAMS, PROMPT, record

SAMPLE = "framepath-sim"
INI = os.path.join(harness.SAMPLES, "configs", SAMPLE, f"{SAMPLE}.ini")
PLANNER = "tpmod"
MODULE = os.path.join(harness.LINUXCNC_MODULES, f"{PLANNER}.so")
PERIOD = 1e-3
#: share of the time by which compare and LinuxCNC may differ
ALLOWED = 0.005
OURS = os.path.join(harness.MODULES, "blendtp.so")


def without_blendtp(folder):
    """A copy of the sample for LinuxCNC's planner, which has no limits of jerk and no pins. Returns its path."""
    copy = os.path.join(folder, "configuration")
    shutil.copytree(os.path.join(harness.SAMPLES, "configs", SAMPLE), copy)
    for ending, left_out in (("hal", "setp blendtp."), ("ini", "HALFILE = ../../panel/operator.hal")):
        path = os.path.join(copy, f"{SAMPLE}.{ending}")
        with open(path, encoding="utf-8") as file:
            lines = file.readlines()
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(line for line in lines if not line.startswith(left_out))
    return copy


def compare(*arguments):
    """What `framepath compare` says of each program."""
    done = subprocess.run([harness.TOOL, "compare", "--json", *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)["programs"]


def compared(folder):
    """{name: time in cycles} by compare."""
    files = []
    for name, text in PROGRAMS.items():
        files.append(os.path.join(folder, f"{name}.ngc"))
        with open(files[-1], "w", encoding="utf-8") as file:
            file.write(text)
    times = {}
    for program in compare(*files, "--with", MODULE, "--ini", INI):
        figures, = program["runs"]
        if figures["state"] != "complete":
            raise AssertionError(f"{program['program']}: {figures['state']}")
        times[os.path.splitext(program["program"])[0]] = round(figures["motion"]["time"] / PERIOD)
    return times


@pytest.mark.thorough
class AgainstLinuxCnc(unittest.TestCase):
    def test_times(self):
        with tempfile.TemporaryDirectory() as folder:
            times, configuration = compared(folder), without_blendtp(folder)
            self.assertEqual(set(times), set(PROGRAMS))
            left = list(PROGRAMS)
            for _ in range(ATTEMPTS):
                recordings = record(left, ini={("TRAJ", "TPMOD"): PLANNER}, configuration=configuration)
                left = [name for name, recording in recordings.items() if self.came_late(name, recording, times[name])]
                if not left:
                    return
        self.skipTest(f"the computer is too busy: the moves of {left} came late, {ATTEMPTS} times")

    def came_late(self, name, recording, time):
        """Whether a program took another time than compare says because its moves came late. If it did so for no such
        reason, that is a failure."""
        off = time - recording.cycles
        print(f"{name:10} LinuxCNC {recording.cycles * PERIOD:8.3f} s, compare {off:+d} cycles; moves up to "
              f"{recording.late()} cycles late", flush=True)
        if abs(off) <= ALLOWED * recording.cycles:
            return False
        if recording.late() > PROMPT:
            return True
        with self.subTest(program=name):
            self.fail(f"compare says {100 * off / recording.cycles:+.2f} %, although the moves came promptly")
        return False


class LongerPlans(unittest.TestCase):
    """A plan that is refused to be made longer by much is made longer by less: otherwise the machine brakes for the
    end of what is planned."""

    def test_no_rest_in_the_middle(self):
        chips = os.path.join(NCFILES, "3D_Chips.ngc")
        for program in compare(chips, "--with", OURS, "--feed-at-least", "6000"):
            figures, = program["runs"]
            self.assertEqual((figures["state"], figures["rests"]["count"]), ("complete", 0), figures["rests"])

    def test_an_operator_who_raises_the_speed(self):
        spiral = os.path.join(NCFILES, "arcspiral.ngc")
        for operator in ("3", "5"):
            for program in compare(spiral, "--with", MODULE, "--with", OURS, "--feed-at-least", "6000",
                                   "--velocity-limit", "200", "--operator", operator):
                stock, ours = (run["motion"]["time"] for run in program["runs"])
                self.assertLess(ours, 1.02 * stock, f"operator {operator}")


if __name__ == "__main__":
    unittest.main()
