"""A fault of the planner in any servo period of a program: the machine rests on its path, and no later line ever runs."""

import math
import os
import unittest
from itertools import pairwise

import pytest

import harness

pytestmark = pytest.mark.thorough

MODULES = os.environ.get("FRAMEPATH_FAULT_MODULES", os.path.join(harness.ROOT, "target", "fault-modules"))

#: Every how many servo periods of the program there is a run with a fault in it; `make faults` takes each.
EVERY = int(os.environ.get("FRAMEPATH_FAULT_EVERY", "61"))

#: Corners, an arc, short lines, a dwell; and at the end what must not run behind a fault: away from the work with Z,
#: then a rapid through where the work would be.
PROGRAM = """\
G21 G90 G17 G94 G64 P0.05 F4000
G1 X4
G1 Y3
G2 X8 Y3 I2
G1 X8.2 Y3.1
G1 X8.4 Y3.3
G1 X8.5 Y3.6
G1 X8.5 Y6
G4 P0.02
G1 Z-2
M62 P0
G1 X4 Y6
M63 P0
G0 Z8
G0 X30 Y0
M2
"""
#: Servo periods that the program takes at least, and that it does not take.
PERIODS = 700
ENOUGH = 1100

#: No axis takes longer from 100 mm/s to rest, with 1000 mm/s2 and 20000 mm/s3 ..
GREATEST_STOP = 9.0
#: .. and the recorded joints, which LinuxCNC smooths, depart from the planner's path by .02. On a busy computer moves come
#: later than in the run without a fault: a corner is then rounded otherwise, within its tolerance of .05.
OFF_THE_PATH = 0.02 + 0.05


class FaultsInjected(unittest.TestCase):
    periods: list[int]
    result: harness.Result

    @classmethod
    def setUpClass(cls):
        cls.periods = list(range(1, ENOUGH, EVERY))
        steps = []
        for period in [0, *cls.periods]:
            steps += [["halcmd", "sets", "record-period", "0"], ["mdi", "G53 G0 X0 Y0 Z0"], ["forget"],
                      ["halcmd", "sets", "record-period", str(period)],
                      ["run", "PROGRAMS/part.ngc"], ["sleep", 0.05], ["note", f"end {period}"],
                      ["getp", f"injected {period}", "blendtp.fault-injected"], ["recall", f"errors {period}"]]
        integers = {"period": "blendtp.fault-period", "injected": "blendtp.fault-injected"}
        cls.result = harness.run(steps, {"part.ngc": PROGRAM}, modules=MODULES, integers=integers,
                                 timeout=60 + 3 * len(cls.periods))

    def runs(self):
        """(period of the fault, rows of its program) for each run, the one without a fault first."""
        runs: dict[int, list] = {}
        columns = self.result.columns("period", "injected", "joint.0", "joint.1", "joint.2")
        for period, injected, *joints in columns:
            runs.setdefault(period, []).append((injected, joints))
        return runs

    def test_the_scenario_went_through(self):
        self.assertIsNone(self.result.failure, self.result.log[-3000:])

    def test_every_fault_stops_the_program_where_it_is(self):
        runs = self.runs()
        # without a fault, from the last rest at the origin on
        way = self.way_without_fault()
        injected = 0
        for period in self.periods:
            with self.subTest(period=period):
                answers = self.result.answers
                errors = answers[f"errors {period}"]
                rows = runs[period]
                if answers[f"injected {period}"] == "0":
                    self.assertGreater(period, PERIODS)
                    self.assertEqual(errors, [])
                    continue
                injected += 1
                self.assertTrue(any("fault of blendtp" in error for error in errors), errors)
                self.assertEqual(answers[f"end {period}"]["interp_state"], 1)
                behind = [joints for fault, joints in rows if fault]
                travelled = sum(math.dist(a, b) for a, b in pairwise(behind))
                self.assertLess(travelled, GREATEST_STOP)
                for joints in behind:
                    self.assertLess(min(math.dist(joints, place) for place in self.near(way, joints)), OFF_THE_PATH)
                for before, after in pairwise(behind[-20:]):
                    self.assertEqual(before, after)
        self.assertGreater(injected, PERIODS // EVERY)

    def test_the_speed_falls_within_the_limits(self):
        period = 1e-3
        for number, rows in self.runs().items():
            if number == 0:
                continue
            places = [joints for _, joints in rows]
            for joint in range(3):
                p = [place[joint] for place in places]
                # what the recorder's last digit does to the second difference
                rounding = 4e-6 / period ** 2
                worst = max(abs(a - 2 * b + c) / period ** 2 for a, b, c in zip(p, p[1:], p[2:], strict=False))
                self.assertLess(worst, 1001 + rounding, f"acceleration with a fault in period {number}")

    def way_without_fault(self):
        """The places of the run without a fault: its last part, since the moves before it go to the origin."""
        result = self.result
        columns = result.columns("period", "joint.0", "joint.1", "joint.2")
        way = []
        for period, *joints in columns:
            if period:
                break
            way.append(joints)
        return way

    @staticmethod
    def near(way, place):
        """Points of the way, and of the lines between them near the place."""
        for a, b in pairwise(way):
            if math.dist(a, place) > 1.0:
                continue
            length = math.dist(a, b)
            share = 0.0 if length == 0 else sum((p - x) * (y - x) for p, x, y in zip(place, a, b, strict=True)) / length ** 2
            share = min(1.0, max(0.0, share))
            yield [x + share * (y - x) for x, y in zip(a, b, strict=True)]
        yield [math.inf] * 3


if __name__ == "__main__":
    unittest.main()
