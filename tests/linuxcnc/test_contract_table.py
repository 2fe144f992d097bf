"""Every promise of a planner towards LinuxCNC, with LinuxCNC's own planner and with blendtp; the table is printed. And those
that a frame could break, with a turned one on."""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "contract"))

import table
from overload import ATTEMPTS, is_overloaded
from row import all_rows

#: `contract/table.py --frame` has all of them
IN_A_FRAME = ("AbortOnThePath", "AtTheirMoves", "DistanceToGo", "ExternalOffsetInFrame", "FeedHold", "Index", "InPosition",
              "JogInFrame", "LimitsInFrame", "MachineOff", "OverrideInBlends", "PauseAndResume", "ProbingInFrame", "ReverseRun",
              "RigidTap", "RunFromLine", "SoftLimitInFrame", "Steps", "TouchInFrame", "Velocity")


class Case(unittest.TestCase):
    def outcomes(self, names=None, **options):
        """Of all planners; what fails with ours where the computer is overloaded is run again."""
        found = table.outcomes(names, **options)
        for _ in range(ATTEMPTS - 1):
            late = [name for name, outcome in found[table.OURS].items() if not outcome.works]
            if not late or not is_overloaded():
                break
            print(f"failed on an overloaded computer, and run again: {late}")
            for planner, outcomes in table.outcomes(late, **options).items():
                found[planner].update(outcomes)
        return found

    def assert_kept(self, found, names):
        for name in names:
            with self.subTest(name):
                outcome = found[table.OURS][name]
                self.assertTrue(outcome.works, outcome.text)


class Contract(Case):
    def test_every_promise(self):
        found = self.outcomes()
        print("\n".join(table.lines(found)))
        self.assert_kept(found, [row.name() for row in all_rows("plain")])


class Framed(Case):
    def test_promises_in_a_turned_frame(self):
        found = self.outcomes(list(IN_A_FRAME), behind="frame", planners=(table.OURS,))
        self.assert_kept(found, IN_A_FRAME)


if __name__ == "__main__":
    unittest.main()
