"""A selection of the table of faults (faults/fault_table.py): what takes seconds, and less of what is done many times."""

import os
import sys
import unittest

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "faults"))

import fault_table
from fault import all_rows

pytestmark = pytest.mark.thorough

ROWS = ("TaskStopped", "TaskKilled", "GuiKilled", "GuardKilled", "GuardStopped", "Aborts", "FramedAborts", "RotaryAborts",
        "MachineOff", "Refused_AXIS_X_MAX_VELOCITY_0", "Refused_TRAJ_MAX_LINEAR_VELOCITY_0",
        "Refused_EMCMOT_SERVO_PERIOD_1000000000", "Refused_KINS_KINEMATICS_framekins_coordinates_XY",
        "Harmless_AXIS_X_MAX_JERK_1e9", "Period_0_25", "Period_5", "Reloaded",
        "FullFilter", "FullPlan", "FullPlanCsv", "FullReport")


class Faults(unittest.TestCase):
    def test_selection(self):
        self.assertLessEqual(set(ROWS), {row.name() for row in all_rows()})
        for name, seen in fault_table.outcomes(ROWS, short=True).items():
            with self.subTest(name):
                self.assertTrue(seen.holds, seen.text)


if __name__ == "__main__":
    unittest.main()
