"""Frames from G-code: the subroutines and the short codes, in programs and in MDI, and what they say to wrong use."""

import unittest

import harness

#: A quick machine, so that many small moves take little time.
QUICK = {}
for _letter, _joint in zip("XYZ", "012", strict=True):
    for _section in (f"AXIS_{_letter}", f"JOINT_{_joint}"):
        QUICK[(_section, "MAX_VELOCITY")] = "500"
        QUICK[(_section, "MAX_ACCELERATION")] = "20000"
    QUICK[(f"AXIS_{_letter}", "MAX_JERK")] = "2000000"
QUICK[("TRAJ", "MAX_LINEAR_VELOCITY")] = "500"

#: Shows where the joints are, from inside a program, under a number.
SAY = """\
o<say> sub
G4 P0.01
M66 E0 L0
(DEBUG, AT #1 #<_hal[joint.0.pos-cmd]> #<_hal[joint.1.pos-cmd]> #<_hal[joint.2.pos-cmd]>)
o<say> endsub
"""

#: (frame commands, point of the program, point of the machine), from the manual of the imitated control
CASES = [
    (["o<trans> call [55] [35] [0]", "o<arot_rpl> call [45]"], (10, 0, 0), (62.071068, 42.071068, 0)),
    (["G77.1 X55 Y35", "G78.3 R45"], (0, 10, 0), (47.928932, 42.071068, 0)),
    (["o<trans> call [1] [2] [3]", "o<atrans> call [10] [20] [30]"], (1, 1, 1), (12, 23, 34)),
    (["G77.1 X1 Y2 Z3", "G78.1 Z30"], (1, 1, 1), (2, 3, 34)),
    (["G18", "o<rot_rpl> call [-50]"], (10, 0, 0), (6.427876, 0, 7.660444)),
    (["G18", "G77.3 R-50"], (0, 0, 10), (-7.660444, 0, 6.427876)),
    (["G19", "o<rot_rpl> call [90]"], (0, 10, 0), (0, 0, 10)),
    (["o<rot> call [30] [20] [10]"], (10, 0, 0), (9.254166, 1.631759, -3.420201)),
    (["G77.2 X30 Y20 Z10"], (0, 10, 0), (0.180283, 8.825641, 4.698463)),
    (["o<rot> call [30] [0] [0]", "o<arot> call [0] [0] [-50]", "G78.2 Y15"], (10, 0, 0),
     (6.208852, -5.113991, -5.941149)),
    (["o<trans> call [10] [10] [0]", "o<atrans> call [35] [0] [0]", "G78.2 Y30", "G78.1 X5"], (10, 0, 0),
     (57.990381, 10, -7.5)),
    (["o<rots_xy> call [30] [20]"], (0, 10, 0), (1.503133, 9.537419, 2.603503)),
    (["G77.4 X30 Y20"], (0, 0, 10), (4.768710, -3.006266, 8.259647)),
    # the cyclic siblings: the letters, and with them the axes, move on by one and by two
    (["o<rots_zx> call [30] [20]"], (10, 0, 0), (9.537419, 2.603503, 1.503133)),
    (["G77.4 Z20 Y30"], (0, 0, 10), (2.603503, 1.503133, 9.537419)),
    (["o<arots_yz> call [30] [20]"], (0, 10, 0), (-5, 8.660254, 0)),
    (["G77.4 Y30"], (10, 0, 0), (8.660254, 0, -5)),
    (["o<trans> call [40] [20] [0]", "o<arot_rpl> call [35]", "o<ascale> call [0.7] [0.7] [1]"], (10, 0, 0),
     (45.734064, 24.015035, 0)),
    (["G77.5 X2 Y2", "G78.1 X2.5 Y18"], (0, 0, 4), (5, 36, 4)),
    (["o<scale> call [2] [2] [1]", "G78.1 X1", "G78.5"], (3, 3, 3), (4, 3, 3)),
    (["o<mirror> call [1] [0] [0]", "o<atrans> call [10] [0] [0]"], (5, 0, 0), (-15, 0, 0)),
    (["G77.1 X10", "G78.6 X0"], (5, 0, 0), (5, 0, 0)),
    (["G77.6 X0", "o<arot_rpl> call [30]"], (10, 0, 0), (-8.660254, 5, 0)),
    (["G77.1 X10", "G77.2"], (1, 2, 3), (1, 2, 3)),
    # a diameter is halved, a factor or an angle is none
    (["G7", "G77.1 X20", "G78.5 X2", "G8"], (10, 0, 0), (30, 0, 0)),
    (["G7", "G77.5 X2 Y2", "G78.1 X5 Y18", "G8"], (0, 0, 4), (5, 36, 4)),
    (["G7", "G77.2 X30 Y20 Z10", "G8"], (0, 10, 0), (0.180283, 8.825641, 4.698463)),
    (["G7", "G77.2 Z0", "G78.2 X30", "G8"], (0, 10, 0), (0, 8.660254, 5)),
    (["G7", "G77.4 X30 Y20", "G8"], (0, 0, 10), (4.768710, -3.006266, 8.259647)),
    (["G7", "G77.1 Z0", "G78.4 X30 Y20", "G8"], (0, 0, 10), (4.768710, -3.006266, 8.259647)),
    (["G7", "G77.4 X30", "G8"], (0, 10, 0), (0, 8.660254, 5)),
    (["G7", "G77.1 Z0", "G78.4 X30", "G8"], (0, 10, 0), (0, 8.660254, 5)),
    (["G7", "G77.6 X1", "G8"], (5, 0, 0), (-5, 0, 0)),
    (["#<shift> = 7", "o<trans> call [#<shift> * 2] [SQRT[9]] [0]"], (1, 1, 1), (15, 4, 1)),
]


def move(point):
    return "G0 X{} Y{} Z{}".format(*point)


def said(result):
    """{number: joints} of what o<say> showed."""
    places = {}
    for _, text in result.messages:
        if text.startswith("AT "):
            number, *joints = (float(word) for word in text.split()[1:])
            places[int(number)] = joints
    return places


class Positions(unittest.TestCase):
    def check(self, result, expected, places=5):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        found = said(result)
        for number, joints in expected.items():
            self.assertIn(number, found, result.messages)
            for got, wanted in zip(found[number], joints, strict=True):
                self.assertAlmostEqual(got, wanted, places=places, msg=f"{number}: {found[number]} {joints}")

    def test_the_frames_of_the_manual_in_a_program(self):
        lines = [SAY, "G21 G61.1 G17 G90 G94 F30000"]
        for number, (commands, point, _) in enumerate(CASES):
            lines += [*commands, move(point), f"o<say> call [{number}]", "G17", "o<frame_off> call"]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join([*lines, "M2"]) + "\n"}, ini=QUICK)
        self.check(result, {number: joints for number, (_, _, joints) in enumerate(CASES)})

    def test_the_same_in_mdi(self):
        steps = [["mdi", "G21 G61.1 G17 G90"]]
        chosen = [0, 1, 5, 9, 12, 19, 22, 23]
        for number in chosen:
            commands, point, _ = CASES[number]
            steps += [["mdi", line] for line in [*commands, move(point)]]
            steps += [["note", str(number)], ["mdi", "G17"], ["mdi", "o<frame_off> call"]]
        result = harness.run(steps, ini=QUICK)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        for number in chosen:
            joints = result.answers[str(number)]["joints"][:3]
            for got, wanted in zip(joints, CASES[number][2], strict=True):
                self.assertAlmostEqual(got, wanted, places=5, msg=f"{number}: {joints}")

    def test_offsets_units_loops_and_read_ahead(self):
        lines = [SAY, """\
G21 G61.1 G17 G90 G94 F30000
G10 L2 P1 X0 Y0 Z0 R0
G10 L2 P2 X100 Y50 Z-10 R90
G10 L2 P9 X-20 Y10 Z5 R30
(a frame turns about the work offset, whichever is active)
G55
o<rot> call [0] [0] [90]
G0 X10 Y0 Z0
o<say> call [1]
o<frame_off> call
G59.3
o<trans> call [10] [0] [0]
G0 X0 Y0 Z0
o<say> call [2]
(G92 turns with the offset)
o<frame_off> call
G0 X0 Y0 Z0
G92 X5 Y0
o<arot> call [0] [0] [60]
G0 X10 Y0 Z0
o<say> call [3]
o<frame_off> call
G92.1
(G52 in G54)
G54
G52 X3 Y4
o<scale> call [2] [2] [2]
G0 X1 Y1 Z1
o<say> call [4]
o<frame_off> call
G52 X0 Y0
(tool length: it is neither scaled nor mirrored)
T2 M6 G43
o<scale> call [2] [2] [2]
G0 X1 Y1 Z1
o<say> call [5]
o<frame_off> call
G49
(inches of the program)
G20
o<trans> call [1] [2] [0]
G0 X1 Y0 Z0
o<say> call [6]
G77.1 Z0.5
G0 X1 Y0 Z0
o<say> call [7]
G21
o<frame_off> call
(increments, and values given before moves that are still queued)
G0 X0 Y0 Z0
#<x> = 10
G1 X5
G1 Y5
o<atrans> call [#<x>] [0] [0]
#<x> = 99
G91
o<atrans> call [#<x> - 98] [0] [0]
G1 X2
o<say> call [8]
G90
o<frame_off> call
(loops, and calls from other subroutines)
o<row> sub
  o<atrans> call [#1] [0] [0]
  G1 X1 Y1 Z0
o<row> endsub
o100 repeat [20]
  o<row> call [2]
o100 endrepeat
o<say> call [9]
o101 while [#<_hal[framekins.operations]> LT 30]
  G78.3 R36
o101 endwhile
G1 X1 Y1 Z0
o<say> call [10]
M30
"""]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join(lines)}, ini=QUICK)
        self.check(result, {
            1: (90, 50, -10),
            2: (-20 + 8.660254, 15, 5),
            # zero of G92 is at -5 along the turned X; there the frame turns by 60 degrees, together 90
            3: (-20 - 5 * 0.866025, 10 - 2.5 + 10, 5),
            4: (5, 6, 2),
            5: (2, 2, 22),
            6: (50.8, 50.8, 0),
            7: (25.4, 0, 12.7),
            # an increment counts from where the tool is
            8: (7, 5, 0),
            9: (41, 1, 0),
            10: (41, 1, 0),
        })

    def test_a_machine_in_inches(self):
        inches = {("TRAJ", "LINEAR_UNITS"): "inch"}
        lines = [SAY, """\
G21 G61.1 G17 G90 G94 F3000
G10 L2 P1 X1 Y0 Z0 R0
o<trans> call [25.4] [0] [0]
o<arot_rpl> call [90]
G0 X25.4 Y0
o<say> call [1]
G20
G77.1 Y2
G0 X1 Y1
o<say> call [2]
G10 L2 P1 X0
M2
"""]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join(lines)}, ini=inches)
        # G10 in G21: 1 mm; the pins are in inches
        self.check(result, {1: (1 / 25.4 + 1, 1, 0), 2: (1 / 25.4 + 1, 3, 0)})

    def test_settings_reach_the_frames(self):
        # outputs from 3 on, and the angles of ROTS the other way round
        pins = ["command", "value.1", "value.2", "value.3", *(f"work-offset.{n}" for n in ("x", "y", "z", "rotation")), "check"]
        outputs = range(3, 3 + len(pins))
        hal = "".join(f"unlinkp framekins.{pin}\n" for pin in pins)
        hal += "".join(f"unlinkp motion.analog-out-{n:02}\n" for n in range(max(outputs) + 1))
        hal += "".join(f"net test-{n} motion.analog-out-{n:02} => framekins.{pin}\n"
                       for n, pin in zip(outputs, pins, strict=True))
        lines = [SAY, "G21 G61.1 G17 G90 G94 F30000", "o<rots_xy> call [30] [20]", "G0 X10 Y0 Z0", "o<say> call [1]",
                 "M2", ""]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join(lines)}, hal=hal,
                             ini={**QUICK, ("FRAMEPATH", "ANALOG_OUTPUT"): "3", ("FRAMEPATH", "ROTS_CONVENTION"): "k2"})
        # the other way round: X turns by the second angle about Y
        self.check(result, {1: (9.396926, 0, -3.420201)})

    def test_the_tool_length_that_does_not_turn(self):
        lines = [SAY, "G21 G61.1 G17 G90 G94 F30000", "T2 M6 G43", "o<rot> call [90] [0] [0]", "G0 X0 Y0 Z10",
                 "o<say> call [1]", "M2", ""]
        result = harness.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": "\n".join(lines)},
                             ini={**QUICK, ("FRAMEPATH", "TOOL_LENGTH"): "machine"})
        # the tip is 10 along the frame's Z, which points to -Y, and the tool's 20 mm stay upright
        self.check(result, {1: (0, -10, 20)})


class WrongUse(unittest.TestCase):
    def test_each_is_an_error_with_the_remedy(self):
        wrong = [
            ("o<trans> call [10] [20]", "o<trans> takes three values"),
            ("o<rot_rpl> call", "o<rot_rpl> takes one value"),
            ("o<frame_off> call [1]", "o<frame_off> takes no value"),
            ("o<rots_xy> call [1] [2] [3]", "o<rots_xy> takes two values"),
            ("o<scale> call [0] [1] [1]", "frame was refused"),
            ("o<trans> call [1] [1] [1000000000]", "frame was refused"),
            ("G77.4 X1 Y2 Z3", "one or two of X, Y and Z"),
            ("G78.1", "G78.1 needs X, Y or Z"),
            ("G78.3", "G78.3 needs R"),
            ("G79", "G79 needs X, Y or Z"),
            ("G77.1 X1 P5", "G77.1 takes X, Y and Z only"),
            ("G77 X5", "G77 takes no words"),
            # the reason and the remedy each time
            *[("G77.5 X0", "framekins: frame refused: a scale factor is 0; use 1 for an axis that keeps its size")] * 2,
        ]
        steps: list[list] = [["mdi", "G21 G61.1 G17 G90"]]
        for number, (line, _) in enumerate(wrong):
            steps += [["forget"], ["mdi", line], ["sleep", 0.05], ["recall", str(number)]]
        # with cutter compensation on, nothing may change
        compensated = [("o<trans> call [1] [1] [1]", "o<trans> and G77.1"), ("G78.2 X5", "o<arot> and G78.2"),
                       ("G77.4 X5 Y5", "its siblings and G77.4"), ("G77", "o<frame_off>, G77 and G69"),
                       ("G78", "o<frame_refresh> and G78"), ("G79 X5", "G79 and o<machine_move>")]
        for line, _ in compensated:
            steps += [["forget"], ["mdi", "G41 D1"], ["mdi", line], ["sleep", 0.05], ["recall", line]]
        steps += [["mdi", "G40"], ["mdi", "G17.1"], ["forget"], ["mdi", "o<rot_rpl> call [5]"], ["recall", "plane"],
                  ["note", "end"], ["getp", "active", "framekins.active"]]
        result = harness.run(steps, ini=QUICK)
        self.assertIsNone(result.failure, result.log)
        for number, (line, words) in enumerate(wrong):
            text = "\n".join(result.answers[str(number)])
            self.assertTrue(text, f"{line}: nothing was said")
            self.assertIn(words, text, line)
        for line, words in compensated:
            self.assertEqual(len(result.answers[line]), 1, result.answers[line])
            self.assertIn(words, result.answers[line][0])
            self.assertIn("end the cutter compensation with G40 first", result.answers[line][0])
        self.assertIn("G17, G18 and G19 only", "\n".join(result.answers["plane"]))
        self.assertEqual(result.answers["active"], "FALSE")
        for joint in result.answers["end"]["joints"][:3]:
            self.assertAlmostEqual(joint, 0, places=9)


if __name__ == "__main__":
    unittest.main()
