"""What AXIS pops up: once, and with what to do."""

import unittest

import pytest

import harness

pytestmark = pytest.mark.thorough

#: A part program that the filter refuses.
REFUSED = {"part.mpf": "N10 G0 X10\nN20 G1 X(\nM30\n"}


class Refused(unittest.TestCase):
    def test_a_program_that_the_filter_refuses_at_the_start_is_told_of_once(self):
        # the popup of the filter waits for a key, and AXIS goes on with its start behind it
        steps = [["show", "axis"], ["dismiss"], ["sleep", 4]]
        ini = {("DISPLAY", "OPEN_FILE"): "../../programs/part.mpf",
               ("FILTER", "mpf"): f"{harness.TOOL} filter --dialect sinumerik"}
        result = harness.run(steps, REFUSED, ini=ini, display="popup_driver.py", files=("screen_driver.py", "popup_driver.py"),
                             record=False, timeout=120)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.messages, [], result.log)
        # what it showed is what the filter has said
        self.assertEqual(result.log.count("help: write X10 or X=expression"), 1, result.log)


if __name__ == "__main__":
    unittest.main()
