"""Cutter compensation under scales: frame_guard stops what would scale the tool's radius, and nothing else."""

import unittest

import harness
import test_machine_moves

#: a way of 60 mm to the part, and G40 before the frame goes
COMPENSATED = "G0 X-20 Y-20\n{plane}{code}\nG1 X0 {second}10 F3000\n{second}40\nG40\nG1 X-20\n"

#: the commands that make the frame, the plane, the code of the compensation
STOPPED = {
    "equal": ("o<scale> call [2] [2] [2]", "", "G41.1 D6"),
    "unequal": ("o<scale> call [1] [0.5] [1]", "", "G42.1 D6"),
    "right": ("o<rot> call [0] [0] [20]\no<ascale> call [1.5] [1] [1]", "", "G42 D1"),
    "left": ("o<scale> call [1] [1] [3]", "G18 ", "G41 D1"),
}
TAKEN = {
    "normal": ("o<scale> call [1] [1] [3]", "", "G41.1 D6"),
    "mirror": ("o<mirror> call [1] [0] [0]\no<arot> call [10] [20] [30]", "", "G42.1 D6"),
    "negative": ("o<scale> call [-1] [1] [1]", "", "G41 D1"),
    "plane": ("G10 L2 P1 R20\no<scale> call [1] [3] [1]\no<arot> call [0] [0] [0]", "G18 ", "G40"),  # no compensation
}


def text(commands, plane, code):
    way = COMPENSATED.format(plane=plane, code=code, second="Z" if plane else "Y")
    return f"G21 G90 G17 G61 F3000\n{commands}\n{way}G17\no<frame_off> call\nM2\n"


class Scales(unittest.TestCase):
    def test_the_radius_of_the_tool_is_never_scaled(self):
        for planner, (ini, edit) in test_machine_moves.BackInTheFrame.PLANNERS.items():
            with self.subTest(planner):
                steps: list[list] = []
                for name in (*STOPPED, *TAKEN):
                    steps += [["mdi", "G10 L2 P1 R0 G40 G17"], ["forget"], ["run", f"PROGRAMS/{name}.ngc"], ["sleep", 0.2],
                              ["expect", "framekins.active", "FALSE"], ["recall", name]]
                programs = {f"{name}.ngc": text(*parts) for name, parts in {**STOPPED, **TAKEN}.items()}
                result = harness.run(steps, programs, ini=ini, edit_hal=edit, record=False)
                self.assertIsNone(result.failure, result.log)
                for name in STOPPED:
                    found = "\n".join(result.answers[name])
                    self.assertIn("cutter compensation (G41, G42) in a frame that scales its plane", found, name)
                    self.assertIn("--backend program", found, name)
                for name in TAKEN:
                    self.assertEqual(result.answers[name], [], name)


if __name__ == "__main__":
    unittest.main()
