"""gmoccapy and qtdragon, on an X server without a monitor, with the USER_COMMAND_FILEs that users have."""

import unittest

import pytest

import harness
import screen_checks
from test_preview import program

pytestmark = pytest.mark.thorough

GMOCCAPY = screen_checks.Screen(["gmoccapy"], "probe_gmoccapy.py", ["gmoccapy_screen.py", "probe_panel.py"])
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


class RotaryLamps(unittest.TestCase):
    """The panel of gladevcp has lamps of A and C where the machine has these axes."""

    #: gladevcp with what says which lamps are shown
    PROBE = "gladevcp -u ./probe_panel.py"
    #: each axis turns alone for seconds, as fast as it may
    PROGRAM = program("G0 A-100", "M0", "G0 A100", "M0", "G0 C360")

    def test_in_a_tab_of_gmoccapy_they_say_which_axis_limits(self):
        steps = [["wait_pin", "pyvcp.rotary"], ["ask", "drawn", "open", "PROGRAMS/part.ngc"], *screen_checks.START]
        for turns, rests in (("a", "c"), ("c", "a")):
            steps += [["wait_paused"], ["resume"], ["expect", f"pyvcp.limit.{turns}", "TRUE"],
                      ["getp", f"{rests} rests", f"pyvcp.limit.{rests}"], ["getp", f"{turns} shown", f"pyvcp.shown.limit.{turns}"]]
        tab = screen_checks.TAB_OF_A_TABLE.replace("gladevcp", self.PROBE)
        result = GMOCCAPY.watch([*steps, ["finish"]], self.PROGRAM, record=False, **screen_checks.TABLE,
                                ini={("DISPLAY", "EMBED_TAB_COMMAND"): tab})
        screen_checks.good(self, result)
        for axis in "ac":
            self.assertEqual([result.answers[f"{axis} rests"], result.answers[f"{axis} shown"]], ["FALSE", "TRUE"])

    def windows(self, *steps):
        """Without a screen."""
        result = harness.run([["monitor"], *steps, ["expect", "pyvcp.frame.guarded", "TRUE"]], display="screen_driver.py",
                             files=("screen_driver.py", "probe_panel.py"), record=False, **screen_checks.TABLE)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [])

    def test_a_window_of_that_machine(self):
        self.windows(["halcmd", "source", "../../panel/panel_window_xyzac.hal"], ["expect", "pyvcp.rotary", "TRUE"])

    def test_elsewhere_they_are_not_there(self):
        command = screen_checks.TAB.replace("gladevcp -x {XID}", self.PROBE)
        self.windows(["halcmd", "loadusr", "-Wn", "pyvcp", *command.split()],
                     *(["expect", f"pyvcp.hidden.limit.{axis}", "TRUE"] for axis in "ac"))


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
