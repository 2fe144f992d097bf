"""External offsets (axis.L.eoffset) on a running LinuxCNC, where a frame comes or goes: no joint jumps."""

import unittest

import harness

#: how much an axis may do by its offset, and a change of the offset by 30 mm, which takes a second
INI = {("AXIS_Y", "OFFSET_AV_RATIO"): ".5"}
HAL = "setp axis.y.eoffset-enable 1\nsetp axis.y.eoffset-scale 0.01\n"
NET = "net external-offset-y axis.y.eoffset => framekins.external-offset.y\n"
MOVE = [["halcmd", "setp", "axis.y.eoffset-counts", "3000"], ["sleep", 0.3]]
TURN = ["mdi", "o<rot> call [0] [0] [90]"]

#: machine units a period squared, of joints with 1000 mm/s^2
GREATEST_CHANGE = 1.1e-3


@unittest.skipIf(harness.HANDS_OVER_JERK, "LinuxCNC 2.10 takes them off itself")
class ExternalOffsets(unittest.TestCase):
    def run_steps(self, steps, hal=HAL + NET, programs=None):
        result = harness.run(steps, programs, INI, hal=hal)
        self.assertIsNone(result.failure, result.log[-3000:])
        for joint in range(3):
            places = result.column(f"joint.{joint}")
            steps = [after - before for before, after in zip(places, places[1:])]
            changes = [abs(after - before) for before, after in zip(steps, steps[1:])]
            self.assertLess(max(changes), GREATEST_CHANGE, f"joint {joint}")
        return result

    def test_a_frame_is_refused_while_one_moves(self):
        # LinuxCNC lets an offset that moves skip three periods where MDI begins
        result = self.run_steps([["mdi", "G0 X0"], *MOVE, TURN, ["recall", "moves"], ["getp", "refusal", "framekins.refusal"],
                                 ["sleep", 1.5], TURN, ["getp", "active", "framekins.active"], ["note", "end"]])
        self.assertIn("an external offset (axis.L.eoffset) moves the axes", "".join(result.answers["moves"]))
        self.assertEqual(float(result.answers["refusal"]), 21)
        self.assertEqual(result.answers["active"], "TRUE")
        self.assertAlmostEqual(result.answers["end"]["joints"][1], 30, places=6)

    def test_a_frame_that_has_to_go_waits_for_one_that_moves(self):
        program = "G21 G90\no<rot> call [0] [0] [90]\nG4 P.5\nM2\n"
        result = self.run_steps([["start", "PROGRAMS/a.ngc"], ["sleep", 0.3], *MOVE[:1], ["finish"], ["sleep", 2],
                                 ["getp", "active", "framekins.active"], ["note", "end"]], programs={"a.ngc": program})
        self.assertEqual(result.answers["active"], "FALSE")
        self.assertAlmostEqual(result.answers["end"]["joints"][0], -30, places=6)

    def test_a_pin_that_is_not_linked_is_refused_by_name(self):
        result = self.run_steps([["setp", "framekins.external-offset.x", 100], TURN, ["recall", "said"],
                                 ["getp", "refusal", "framekins.refusal"]], hal="")
        self.assertIn("framekins.external-offset.x is 100, no external offset of that axis: write net external-offset-x",
                      "".join(result.answers["said"]))
        self.assertEqual(float(result.answers["refusal"]), 22)

    def test_one_that_framekins_is_not_told_of_switches_the_machine_off(self):
        result = self.run_steps([["mdi", "G0 X10 Y5"], *MOVE, ["sleep", 1.5], TURN, ["sleep", 0.3], ["recall", "said"],
                                 ["note", "off"], ["on"], ["sleep", 0.3], ["mdi", "G0 X1 Y1"], ["note", "on"]], hal=HAL)
        self.assertIn("External offsets need net external-offset-y axis.y.eoffset => framekins.external-offset.y",
                      "".join(result.answers["said"]))
        for joint, place in enumerate((10, 35)):
            self.assertAlmostEqual(result.answers["off"]["joints"][joint], place, places=6)
        for joint in range(2):
            self.assertAlmostEqual(result.answers["on"]["joints"][joint], 1, places=6)


class SoftLimits(unittest.TestCase):
    """What is between the ends of a move is looked at where the offset leads it."""

    #: the top of the arc is at Y 85, the soft limit at 80
    ARC = "G21 G17 G90 G64 P.05 F6000\nG1 Y75\nG2 X20 I10 J0\nG1 X0 Y0\nM2\n"

    def run_arc(self, counts):
        result = harness.run([["halcmd", "setp", "axis.y.eoffset-counts", str(counts)], ["sleep", 2.5],
                              ["start", "PROGRAMS/arc.ngc"], ["finish"], ["recall", "said"]], {"arc.ngc": self.ARC},
                             {**INI, ("JOINT_1", "MAX_LIMIT"): "80", ("AXIS_Y", "MAX_LIMIT"): "80"}, hal=HAL + NET)
        self.assertIsNone(result.failure, result.log[-3000:])
        return "".join(result.answers["said"]), max(result.column("joint.1"))

    def test_an_offset_leads_back_within_the_limit(self):
        said, greatest = self.run_arc(-2000)
        self.assertNotIn("soft limit", said)
        self.assertAlmostEqual(greatest, 65, delta=0.01)

    def test_an_offset_leads_beyond_the_limit(self):
        self.ARC = self.ARC.replace("Y75", "Y65")
        said, greatest = self.run_arc(1000)
        self.assertIn("the move would take joint 1 to 85.000000 on its way, beyond its soft limit 80.000000 (line 3, with the "
                      "external offsets as they stand)", said)
        self.assertLess(greatest, 75.01)


if __name__ == "__main__":
    unittest.main()
