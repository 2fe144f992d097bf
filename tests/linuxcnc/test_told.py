"""What frame_guard tells the operator: of every frame that goes before its program ends, and in words that arrive whole."""

import ast
import glob
import os
import unittest

import pytest

import harness
from test_gcode import QUICK
from test_operation import KNOWN, OFF, ON, Case, programs, run

# isort: split
# test_operation has put its folder into the path
import frame_nets
import frame_stays
from frame_gone import REMOVED, outputs_taken

#: letters of a message that LinuxCNC passes on
LETTERS = 254

#: what frame_guard writes in front of each
PREFIX = "framepath: "

#: letters that a value in a text has; those with longer ones are put together below
VALUE = 10


def literals(path):
    """The texts in a file, without those that explain it."""
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    explained = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in explained:
            yield node.value
        elif isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else "#" * VALUE for part in node.values)


class Words(unittest.TestCase):
    def fits(self, text):
        self.assertLessEqual(len(PREFIX + text), LETTERS, text)

    def test_each_text_arrives_whole(self):
        files = glob.glob(os.path.join(harness.SAMPLES, "subroutines", "frame_*.py"))
        texts = [text for path in files if not path.endswith("frame_settings.py") for text in literals(path)]
        self.assertGreater(len(texts), 50)
        for text in [*texts, outputs_taken(55)]:
            self.fits(text)

    def test_those_that_are_put_together_too(self):
        value = frame_stays.hal.get_value
        try:
            for refusal in (0, *frame_stays.REASONS):
                frame_stays.hal.get_value = lambda _, refusal=refusal: refusal
                self.fits(frame_stays.complaint())
                for one in (False, True):
                    self.fits(frame_stays.work_offset_changed(one))
                    for other in (False, True):
                        self.fits(frame_stays.late_start(one, other))
        finally:
            frame_stays.hal.get_value = value
        for pin, net, loss in frame_nets.NETS:
            self.fits(frame_nets.told(pin, net, loss))


class Removed(Case):
    @pytest.mark.thorough
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
                                             m67=f"{frame}M67 E0 Q0\nG1 X12\nM67 E0 Q80\nG1 X40 F2000\nM2\n"))
        self.fine(result)
        for name in ("m67", "m68"):
            self.assertIn("motion.analog-out-00 to 0", "\n".join(result.answers[name]), name)
        self.assertLess(result.answers["m68 place"]["joints"][1], 15)


class ToolChange(Case):
    def test_with_cutter_compensation_on(self):
        result = harness.run([["forget"], run("part"), OFF, KNOWN, ["recall", "said"]],
                             programs(part="o<rot> call [0] [0] [90]\nG41.1 D1\nG1 X10 Y5\nT1 M6\nM2\n"), ini=QUICK,
                             record=False)
        self.fine(result)
        self.assertIn("M6 takes the frame off for the tool change", "\n".join(result.answers["said"]))


if __name__ == "__main__":
    unittest.main()
