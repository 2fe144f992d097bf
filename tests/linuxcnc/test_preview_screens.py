"""gmoccapy and qtdragon, on an X server without a monitor, with the USER_COMMAND_FILEs that users have."""

import unittest

import screen_checks
from test_preview import program

GMOCCAPY = screen_checks.Screen(["gmoccapy"], "probe_gmoccapy.py", ["gmoccapy_screen.py"])
QTDRAGON = screen_checks.Screen(["qtvcp", "qtdragon"], "probe_qtvcp.py", ["qtvcp_screen.py"], (screen_checks.READS_IN_AUTO,))


class Gmoccapy(screen_checks.OnTheScreen):
    screen = GMOCCAPY

class GmoccapyTrail(screen_checks.TrailOnATable):
    screen = GMOCCAPY

class Qtdragon(screen_checks.OnTheScreen):
    screen = QTDRAGON

class QtdragonTrail(screen_checks.Trail):
    # it knows no machine with A and C
    screen = QTDRAGON

class Told(unittest.TestCase):
    """What has no place in a preview is told."""

    #: (lines of the program, what the operator is told)
    CASES = ((("o<trans> call [400] [0] [0]", "G1 X99.99999"), None),
             (("o<trans> call [400] [0] [0]", "G1 X100.00001"), "takes X of the machine to 500.000"),
             (("o<rot> call [0] [90] [0]", "G1 X500.01"), "takes Z of the machine to -500.010"),
             (("o<scale> call [1] [0] [1]", "G1 X5"), "a scale factor is 0"))

    def check(self, screen):
        programs = {f"{number}.ngc": program(*lines)["part.ngc"] for number, (lines, _) in enumerate(self.CASES)}
        steps = [["ask", f"drawn {name}", "open", f"PROGRAMS/{name}"] for name in programs]
        result = screen.watch(steps, programs, record=False)
        self.assertIsNone(result.failure, result.log)
        told = [text for _, text in self.CASES if text]
        self.assertEqual(len(result.answers["notes"]), len(told), result.answers["notes"])
        for text, note in zip(told, result.answers["notes"], strict=True):
            self.assertIn(text, note)

    def test_gmoccapy(self):
        self.check(GMOCCAPY)

    def test_qtdragon(self):
        self.check(QTDRAGON)

if __name__ == "__main__":
    unittest.main()
