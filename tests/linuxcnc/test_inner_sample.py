"""LinuxCNC's own samples with framekins before their kinematics: two of the machines of machines.py, which has them all."""

import unittest

import pytest

import machine_row
import sample_machines
from sample_table import MACHINES, machine

pytestmark = pytest.mark.thorough


class Sample(unittest.TestCase):
    def test_types_and_frames_of_a_tilting_table(self):
        steps = [["mdi", "M428"], ["getp", "M428", "framekins.inner-type-active"], ["mdi", "G1 X5 A10 C20 F1000"],
                 ["note", "turned"], ["mdi", "M429"], ["mdi", "o<trans> call [5] [0] [0]"], ["mdi", "G1 X0 Y0"],
                 ["note", "framed"], ["mdi", "o<frame_off> call"], ["mdi", "M430"],
                 ["getp", "M430", "framekins.inner-type-active"]]
        result = sample_machines.run(machine("xyzac-trt"), steps, framed=True, record=False)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual((result.errors, result.status), ([], 0), result.log)
        self.assertEqual((result.answers["M428"], result.answers["M430"]), ("1", "2"))
        # by hand calculation: 5 mm along X, with the table turned by 20 degrees, Y 20 and Z 10 to the tilting axis at 10
        turned = result.answers["turned"]["joints"][:5]
        for found, expected in zip(turned, (4.698463103929, 3.724447160592, -3.024085210391, 10, 20), strict=True):
            self.assertAlmostEqual(found, expected, places=9)
        for found, expected in zip(result.answers["framed"]["joints"], (5, 0, turned[2], 10, 20), strict=False):
            self.assertAlmostEqual(found, expected, places=9)

    def test_a_row_of_the_table(self):
        found = machine_row.row(machine("5axis"), planners=("blendtp",))
        self.assertGreater(found.periods, 2000)

    def test_a_row_that_does_not_hold(self):
        """What ends elsewhere than the table says is told."""
        bridge = machine("5axis")
        result = type("Result", (), {"failure": None, "errors": [], "status": 0, "log": "", "answers": {
            name: {"position": [3, 2.5, -20, 0, 0, 0, 0, 0, 0]} for name in sample_machines.PROGRAMS}})()
        with self.assertRaisesRegex(machine_row.Broken, "Y ends at 2.5, and not at 2"):
            machine_row.good(bridge, result)
        result.status = 1
        with self.assertRaisesRegex(machine_row.Broken, "exit status 1"):
            machine_row.good(bridge, result)

    def test_the_table_has_all_kinds(self):
        self.assertEqual({row.kinematics for row in MACHINES},
                         {"xyzac-trt-kins", "xyzbc-trt-kins", "xyzab_tdr_kins", "5axiskins", "scarakins", "lineardeltakins",
                          "corexykins", "trivkins"})


if __name__ == "__main__":
    unittest.main()
