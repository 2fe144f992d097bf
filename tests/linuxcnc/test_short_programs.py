"""Random short programs (short_programs.py): none may end in a fault or beyond a limit, and a real LinuxCNC does with
them what `framepath plan` says."""

import math
import os
import shutil
import unittest
from typing import ClassVar

import pytest

import harness
import short_programs
import test_plan
from ten_programs import motion

#: Programs that are planned, with every limit of jerk; short_programs.py takes as many as one likes.
PLANNED = 250
#: Programs that a real LinuxCNC runs.
RUN = range(1, 41)
#: X Y Z and a rotary axis that lock nothing, with what a random program wants of room.
CONTRACT = os.path.join(harness.HERE, "contract", "machine")
FAR = 1e4
CHANGES = {("AXIS_Y", "OFFSET_AV_RATIO"): None, ("TASK", "CYCLE_TIME"): 0.001,
           **{(f"{section}_{name}", key): sign * FAR for section, names in (("AXIS", "XYZAB"), ("JOINT", "01234"))
              for name in names for key, sign in (("MIN_LIMIT", -1), ("MAX_LIMIT", 1))}}
JERK = 20000


@pytest.mark.thorough
class Planned(unittest.TestCase):
    def test_none_ends_in_a_fault_or_beyond_a_limit(self):
        found = short_programs.bulk(range(1, PLANNED + 1))
        lines = list(short_programs.summary(found, PLANNED))
        print("\n".join(lines))
        self.assertFalse(any(map(len, found.values())), "\n".join(lines))


class Recorder(harness.Recorder):
    """Of a machine without frames."""

    def __init__(self):
        super().__init__(5, "xyzb", {"moves": "arrivals.moves", "scale": "arrivals.scale", "program": ""})
        del self.integers["slot"]
        self.header.remove("slot")


@pytest.mark.thorough
class AgainstLinuxCnc(test_plan.AgainstLinuxCnc):
    axes = "xyzb"
    #: The planner waits the longer for a move the slower they came, in the programs before as well: it matters where all the
    #: motion takes milliseconds. And where a move comes a cycle later than the plan has it, another of two ways may be taken.
    steady = 1
    prompt = 0
    #: Of moves of nanometres the first and the last cycles are less than what a recording shows.
    same, same_cycles = 1e-6, 3
    machine: ClassVar[dict] = {"sample": "machine", "configuration": CONTRACT, "ini": CHANGES, "timeout": 600,
               "hal": "".join(f"setp blendtp.axis.{axis}.max-jerk {JERK}\n" for axis in "xyzab")}

    def setUp(self):
        super().setUp()
        configuration = os.path.join(self.folder, "machine")
        shutil.copytree(CONTRACT, configuration)
        self.ini = os.path.join(configuration, "machine.ini")
        with open(self.ini, encoding="utf-8") as file:
            text = harness.edit_ini(file.read(), CHANGES)
        with open(self.ini, "w", encoding="utf-8") as file:
            file.write(text)
        # what has no plan is the other test's
        texts = {f"short{seed}": short_programs.program(seed).text for seed in RUN}
        self.programs = {name: text for name, text in texts.items() if self.has_plan(name, text)}
        self.assertGreater(len(self.programs), len(RUN) // 2)

    def recorded_with(self):
        return dict(self.machine, recorder=Recorder())

    def with_the_same_arrivals(self, name, recording):
        """The nearer of two plans: how long the planner waits for a move has to do with the programs before, and a wait of
        two cycles that was none to it is one to a plan that knows only this program."""
        return min((self.beside(name, recording, *options) for options in (
            (), ("--arrivals", self.file(name + ".txt", recording.arrivals())))), key=lambda found: found[1])

    def beside(self, name, recording, *options):
        """Cycles, and how far any position is from the recorded one, both from the first motion on."""
        positions, cycles = self.planned(name, *options)
        begins = [motion([places[0], *places])[0] - 1 for places in (positions, recording.positions)]
        pairs = list(zip(positions[begins[0]:], recording.positions[begins[1]:recording.end + 1], strict=False))
        away = max(math.dist(a, b) for a, b in pairs)
        return cycles, away if len(pairs) == recording.end + 1 - begins[1] else math.inf

    def has_plan(self, name, text):
        return test_plan.plan(self.file(name + ".ngc", text), "--ini", self.ini, check=False).returncode == 0


if __name__ == "__main__":
    unittest.main()
