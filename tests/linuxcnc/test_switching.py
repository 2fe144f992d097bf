"""Ten thousand random switches of frames on a running LinuxCNC: no joint moves at any of them."""

import os
import random
import re
import unittest

import pytest

import harness

#: switches at one place of the machine, places, machine units and degrees
SWITCHES, PLACES, STILL = 1000, 5, 1e-9

#: inputs that the switcher sets itself
LINKED = ["command", "value.1", "value.2", "value.3", "work-offset.x", "work-offset.y", "work-offset.z",
          "work-offset.rotation", "check", "tool-offset.x", "tool-offset.y", "tool-offset.z"]


@pytest.mark.thorough
class Switching(unittest.TestCase):
    def switch(self, table, before=(), ini=None, **options):
        """before: steps that come before all others."""
        with open(os.path.join(harness.HERE, "switcher.py"), encoding="utf-8") as file:
            programs = {"switcher.py": file.read()}
        number = random.Random(7)
        pins = LINKED + (["tool-offset", "tool-centre-point"] if table else [])
        steps: list[list] = [*before, *(["halcmd", "unlinkp", f"framekins.{pin}"] for pin in pins)]
        for place in range(PLACES):
            words = [f"{axis}{number.uniform(-100, 100):.6f}" for axis in ("XYZAC" if table else "XYZ")]
            arguments = [str(place), str(SWITCHES)] + (["table"] if table else [])
            steps += [["mdi", "G0 " + " ".join(words)], ["sleep", 0.1],
                      ["halcmd", "loadusr", "-w", "/usr/bin/python3", "-B", "PROGRAMS/switcher.py", *arguments],
                      ["sleep", 0.1]]
        result = harness.run(steps, programs, {("EMCMOT", "SERVO_PERIOD"): "500000", **(ini or {})}, timeout=280, **options)
        self.assertIsNone(result.failure, result.log[-3000:])
        self.assertEqual(result.log.count(f"switcher: {SWITCHES} took effect"), PLACES, result.log[-3000:])
        seen, worst = self.at_switches(result)
        made = SWITCHES * PLACES
        # a command that changes nothing needs no switch; there are few of these
        self.assertGreater(seen, 0.95 * made)
        self.assertLess(worst, STILL)
        # the machine was really somewhere, and moved between the places
        for joint in range(5 if table else 3):
            column = result.column(f"joint.{joint}")
            self.assertGreater(max(column) - min(column), 20)
        refused = sum(int(n) for n in re.findall(r"(\d+) were refused", result.log))
        self.assertGreater(refused, 0)

    def at_switches(self, result):
        """How many switches the recording has, and how far a joint moves around any of them."""
        first = result.header.index("joint.0")
        count = sum(name.startswith("joint.") for name in result.header)
        slots = result.column("slot")
        seen, worst = 0, 0.0
        for n in range(4, len(slots) - 4):
            if slots[n] == slots[n - 1]:
                continue
            seen += 1
            for row in result.rows[n - 3:n + 4]:
                for joint in range(first, first + count):
                    worst = max(worst, abs(row[joint] - result.rows[n - 4][joint]))
        return seen, worst

    def test_three_axes(self):
        self.switch(False)

    def test_five_axes_with_a_table(self):
        self.switch(True, sample="framepath-xyzac", joints=5, axes="xyzac")

    def test_five_axes_with_external_offsets(self):
        # where an axis with such an offset has left its limits, LinuxCNC takes the offset away in one period
        ini = {(f"AXIS_{axis}", key): value for axis in "XYZ"
               for key, value in (("MIN_LIMIT", "-1e9"), ("MAX_LIMIT", "1e9"), ("OFFSET_AV_RATIO", "0.5"))}
        hal = "".join(f"setp axis.{axis}.eoffset-enable 1\nsetp axis.{axis}.eoffset-scale 0.01\n"
                      f"net external-offset-{axis} axis.{axis}.eoffset => framekins.external-offset.{axis}\n" for axis in "yz")
        before = [*(["halcmd", "setp", f"axis.{axis}.eoffset-counts", counts] for axis, counts in (("y", "200"), ("z", "-300"))),
                  ["sleep", 1]]
        self.switch(True, before, ini, sample="framepath-xyzac", joints=5, axes="xyzac", hal=hal)


if __name__ == "__main__":
    unittest.main()
