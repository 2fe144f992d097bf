"""What frame_guard tells the operator: of every frame that goes before its program ends."""

import unittest

import harness
from test_gcode import QUICK
from test_operation import KNOWN, OFF, ON, Case, programs, run

# isort: split
# test_operation has put its folder into the path
from frame_gone import REMOVED

class Removed(Case):
    def test_by_whatever_but_the_end_of_its_program(self):
        cases: tuple[tuple[str, list[list], int], ...] = (
            ("a mistyped line", [["forget"], ["mdi", "G0 XX"], OFF, KNOWN, ["recall", "said"]], 1),
            ("an abort", [["abort"], OFF, KNOWN], 1),
            ("machine off", [["machine_off"], OFF, ["sleep", 0.3], ["on"], KNOWN], 1),
            ("its own end", [["mdi", "o<frame_off> call"], run("part"), OFF, KNOWN], 0))
        for name, steps, times in cases:
            with self.subTest(name):
                result = harness.run([["mdi", "o<trans> call [0] [50] [0]"], ON, *steps, ["sleep", 0.3]],
                                     programs(part="o<trans> call [1] [0] [0]\nG0 X1\nM2\n"), ini=QUICK, record=False)
                self.fine(result)
                self.assertEqual(sum(REMOVED in text for _, text in result.messages), times, result.messages)

    def test_by_the_programs_own_use_of_their_outputs(self):
        frame = "o<rot> call [0] [0] [90]\nG1 X10\n"
        steps = []
        for name in ("m67", "m68"):
            steps += [["forget"], run(name), OFF, KNOWN, ["recall", name], ["note", f"{name} place"], ["mdi", "G0 X0 Y0"]]
        result = harness.run(steps, programs(m68=f"{frame}M68 E0 Q0\nG4 P0.1\nG1 X20\nM2\n",
                                             m67=f"{frame}M67 E0 Q0\nG1 X12\nM67 E0 Q80\nG1 X20\nM2\n"))
        self.fine(result)
        for name in ("m67", "m68"):
            self.assertIn("motion.analog-out-00 to 0", "\n".join(result.answers[name]), name)
        self.assertLess(result.answers["m68 place"]["joints"][1], 15)


if __name__ == "__main__":
    unittest.main()
