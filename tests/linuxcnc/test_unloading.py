"""A module that is unloaded while LinuxCNC runs: the joints stay where they are, it is said, no move is taken any more, and it
cannot be loaded again."""

import unittest

import harness
import sample_machines
from sample_table import machine

AGAIN = ("motmod is loaded already: loadrt {0} has to come before loadrt motmod in the HAL files; while LinuxCNC runs it "
         "cannot be loaded again: end LinuxCNC and start it anew")
REFUSED = "blendtp: no move is taken, since {0} was unloaded while LinuxCNC runs: end LinuxCNC and start it anew"


class Unloading(unittest.TestCase):
    def unloaded(self, module, *loads, before=(), says, run=harness.run, **options):
        """The errors of a run in which a module goes and a move comes; the joints do not move by either."""
        steps = [*before, ["note", "with it"], ["halcmd", "unloadrt", module], ["sleep", 0.3],
                 *(["halcmd_refuses", "loadrt", module, *load] for load in loads), ["note", "without it"], ["mdi", "G0 X1"],
                 ["sleep", 0.2], ["note", "behind the move"]]
        result = run(steps, **options)
        self.assertIsNone(result.failure)
        said = [error for error in result.errors if "rtapi_app_main" not in error]
        self.assertEqual(len(said), 3 + len(loads), said)
        self.assertIn(f"{module}: it was unloaded while LinuxCNC runs: {says}", said[0])
        self.assertEqual(said[1:-2], [f"{module}: {AGAIN.format(module)}"] * len(loads))
        self.assertEqual(said[-2], REFUSED.format(module))
        for error in said:
            # screens show no more
            self.assertLessEqual(len(error), 255)
        notes = [result.answers[name] for name in ("with it", "without it", "behind the move")]
        self.assertEqual([note["position"] for note in notes], [notes[0]["position"]] * 3)
        return result

    def jumps(self, result, joint):
        places = result.commanded(joint)
        return max(abs(after - before) for before, after in zip(places, places[1:], strict=False))

    def test_framekins_with_a_frame(self):
        result = self.unloaded("framekins", ["coordinates=XYZ"], ["inner=trivkins"], ["coordinates=QQ"],
                               before=[["mdi", "o<trans> call [5] [7] [0]"]], says="a frame that is active stays")
        for joint in range(3):
            self.assertLess(self.jumps(result, joint), 0.2)

    def test_framekins_before_other_kinematics(self):
        def run(steps, **options):
            return sample_machines.run(machine("xyzac-trt"), steps, framed=True, planner="blendtp", **options)

        self.unloaded("framekins", ["inner=trivkins"], before=[["mdi", "G1 X5 A10 C20 F1000"]],
                      says="a frame that is active stays", run=run, record=False)

    def test_blendtp(self):
        self.unloaded("blendtp", [], says="the moves that are queued run", record=False)

    def test_nothing_is_said_where_it_goes_with_linuxcnc(self):
        result = harness.run([["mdi", "o<trans> call [5] [7] [0]"], ["mdi", "G0 X1"]], record=False)
        self.assertEqual((result.failure, result.errors), (None, []))
        self.assertNotIn("it was unloaded", result.log)


if __name__ == "__main__":
    unittest.main()
