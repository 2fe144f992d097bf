"""A servo thread that is interrupted between taking a command and moving."""

import tempfile
import unittest

import pytest

import harness

pytestmark = pytest.mark.thorough

PROBES = 40
HAL = """\
loadrt interruption
delf motion-controller servo-thread
delf framekins servo-thread
addf interruption servo-thread
addf motion-controller servo-thread
addf framekins servo-thread
"""


class Interruption(unittest.TestCase):
    def test_task_learns_of_a_move_when_its_period_is_complete(self):
        # a task that takes a probing move for done before it has begun finds the queue "not empty after probing"
        probes = "".join(f"G38.3 X{0.1 * (number % 2)}\n" for number in range(1, PROBES + 1))
        with tempfile.TemporaryDirectory() as modules:
            harness.modules_with("interruption", modules)
            result = harness.run([["run", "PROGRAMS/probes.ngc"], ["note", "end"]],
                                 {"probes.ngc": f"G21 G90 G94 F600\n{probes}G1 X7\nM2\n"}, hal=HAL, modules=modules)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        self.assertAlmostEqual(result.answers["end"]["position"][0], 7, places=6)


if __name__ == "__main__":
    unittest.main()
