"""blendtp under LinuxCNC's task, interpreter and motion controller: times, limits, events, refusals."""

import math
import random
import unittest
from itertools import pairwise

import harness
from contract.row import ACCELERATION, JERK, PERIOD, VELOCITY, peaks

#: [TRAJ]MAX_LINEAR_VELOCITY of the sample
PATH_VELOCITY = 100.0
AXES = "xyz"
RUN = ["run", "PROGRAMS/part.ngc"]
#: mm, less than the way of the last period before a rest
AT_END = 1e-8
#: how often a program is run in which the machine must not come to rest
TRIES = 3


def program(*lines):
    return {"part.ngc": "\n".join(["G21 G61.1 G17 G90 G94 F60000", *lines, "M2"]) + "\n"}


def rest_to_rest(length, velocity, acceleration, jerk):
    """The least time from rest to rest within these limits (Biagiotti and Melchiorri, chapter 3)."""
    # the peak speed that the length allows, with or without a phase of constant acceleration
    if acceleration ** 2 / jerk >= velocity:
        ramp = 2 * math.sqrt(velocity / jerk)
    else:
        ramp = velocity / acceleration + acceleration / jerk
    if length >= velocity * ramp:
        return length / velocity + ramp
    # no cruise: two ramps to a lower peak
    peak = (math.sqrt((acceleration ** 2 / jerk) ** 2 + 4 * acceleration * length) - acceleration ** 2 / jerk) / 2
    if peak >= acceleration ** 2 / jerk:
        return 2 * (peak / acceleration + acceleration / jerk)
    return 4 * (length / (2 * jerk)) ** (1 / 3)


class Case(unittest.TestCase):
    def completed(self, result):
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)

    def within_limits(self, result, jerk=1.05):
        for axis in AXES:
            v, a, j = peaks(result.column(f"axis.{axis}"))
            self.assertLess(v, VELOCITY * 1.001, axis)
            self.assertLess(a, ACCELERATION * 1.001, axis)
            self.assertLess(j, JERK * jerk, axis)


class SingleMoves(Case):
    def test_times_are_the_optimum_to_one_cycle(self):
        source = random.Random(2)
        moves: list[tuple[tuple[float, ...], tuple[float, ...]]] = []
        position: tuple[float, ...] = (0.0, 0.0, 0.0)
        for length in (0.001, 0.01, 0.1, 0.5, 1, 3, 10, 40, 200):
            direction = [source.gauss(0, 1) for _ in AXES]
            size = math.hypot(*direction)
            end = tuple(round(p + length * d / size, 9) for p, d in zip(position, direction, strict=True))
            moves.append((position, end))
            position = end
        moves.append((position, (-300.0, -200.0, -400.0)))
        moves.append(((-300.0, -200.0, -400.0), (400.0, 300.0, 100.0)))
        lines = []
        for _, end in moves:
            lines += ["G1 " + " ".join(f"{a.upper()}{e:.9f}" for a, e in zip(AXES, end, strict=True)), "G4 P0.05"]
        result = harness.run([RUN], program(*lines))
        self.completed(result)
        self.within_limits(result, jerk=1.001)
        positions = result.columns(*(f"axis.{axis}" for axis in AXES))
        cycle = 0
        for start, end in moves:
            direction = [e - s for s, e in zip(start, end, strict=True)]
            length = math.hypot(*direction)
            share = max(abs(d) for d in direction) / length
            expected = rest_to_rest(length, min(VELOCITY / share, PATH_VELOCITY), ACCELERATION / share, JERK / share)
            while positions[cycle] == positions[cycle + 1]:
                cycle += 1
            first = cycle
            # not until it stands: on a busy computer the servo thread may sleep through the dwell
            while math.dist(positions[cycle], end) > AT_END:
                cycle += 1
            self.assertAlmostEqual((cycle - first) * PERIOD, expected, delta=1.01 * PERIOD, msg=f"{length} mm")
            for value, target in zip(positions[cycle], end, strict=True):
                self.assertAlmostEqual(value, target, delta=1e-9)

    def test_arcs_and_helices(self):
        result = harness.run([RUN, ["note", "end"]], program(
            "G2 X20 Y0 I10 J0", "G3 X20 Y0 Z5 I-10 J0 P2", "G18 G2 X20 Z15 I0 K5", "G17 G3 X20 Y0.5 I0 J0.25",
            "G2 X60 Y0.5 R300"))
        self.completed(result)
        self.within_limits(result)
        for value, target in zip(result.answers["end"]["joints"][:3], (60, 0.5, 15), strict=True):
            self.assertAlmostEqual(value, target, delta=1e-9)


class Events(Case):
    #: a zig-zag with a long leg, arcs and a rapid
    PROGRAM = program("G1 X80 Y10", "G2 X80 Y30 I0 J10 F3000", "G1 X10 Y30 Z5", "G0 X90 Y-40 Z0", "G1 X0 Y0 F2000")

    def run_with(self, *steps):
        result = harness.run([["start", "PROGRAMS/part.ngc"], *steps, ["finish"], ["note", "end"]], self.PROGRAM)
        self.assertIsNone(result.failure, result.log)
        self.within_limits(result)
        return result

    def at_end(self, result):
        self.assertEqual(result.errors, [])
        for value, target in zip(result.answers["end"]["joints"][:3], (0, 0, 0), strict=True):
            self.assertAlmostEqual(value, target, delta=1e-9)

    def test_pause_and_resume(self):
        steps = []
        for n in range(6):
            steps += [["sleep", 0.23], ["pause"], ["sleep", 0.3], ["note", f"paused {n}"], ["sleep", 0.1],
                      ["note", f"still paused {n}"], ["resume"]]
        result = self.run_with(["wait_moving"], *steps)
        self.at_end(result)
        stood = 0
        for n in range(6):
            before, after = result.answers[f"paused {n}"], result.answers[f"still paused {n}"]
            self.assertEqual(before["joints"], after["joints"])
            stood += before["paused"]
        self.assertGreaterEqual(stood, 4)

    def test_a_run_that_does_not_turn_is_said(self):
        # it takes a second to come to rest
        slow = {(section, "MAX_ACCELERATION"): "100" for section in ("AXIS_X", "JOINT_0")}
        lines = {"part.ngc": "G21 G90 G17 G94 G64 F6000\nM0\nG1 X200\nX400\nX0\nM2\n"}
        steps = [["reverse"], ["sleep", 0.1], ["recall", "no way"], ["resume"], ["wait_place", 0, 120], ["pause"], ["reverse"],
                 ["sleep", 2], ["recall", "forward"], ["reverse"], ["sleep", 0.2], ["resume"], ["sleep", 1], ["pause"],
                 ["forward"], ["sleep", 2], ["recall", "reverse"], ["forward"], ["sleep", 0.2], ["resume"]]
        result = harness.run([["start", "PROGRAMS/part.ngc"], ["sleep", 0.5], *steps, ["finish"], ["note", "end"]], lines, slow)
        self.assertIsNone(result.failure, result.log)
        self.at_end(result)
        for name, words in (("no way", "indexers. A resume runs forward"),
                            ("forward", "reverse it once it stands. A resume goes on forward"),
                            ("reverse", "run it forward once it stands. A resume goes on in reverse")):
            self.assertEqual(len(result.answers[name]), 1, result.answers[name])
            self.assertIn(words, result.answers[name][0])

    def test_feed_and_rapid_override(self):
        steps = []
        for scale in (0.5, 2.0, 0.0, 0.1, 1.3, 0.7, 1.0):
            steps += [["feed_override", scale], ["rapid_override", min(scale, 1.0)], ["sleep", 0.4]]
        self.at_end(self.run_with(["wait_moving"], *steps))

    def test_the_slider_for_the_greatest_velocity(self):
        result = self.run_with(["wait_moving"], ["max_velocity", 20], ["sleep", 1.0],
                               ["getp", "velocity", "motion.current-vel"], ["max_velocity", 100])
        self.at_end(result)
        self.assertAlmostEqual(float(result.answers["velocity"]), 20, delta=0.02)

    def test_the_slider_where_the_machine_has_no_greatest_velocity(self):
        # LinuxCNC says 1e9 or more then: of such a share of it a rotary move once never came to its end
        result = harness.run([["max_velocity", 30], ["mdi", "G0 C60"], ["note", "end"]], sample="framepath-xyzac", joints=5,
                             axes="xyzac", ini={("TRAJ", "MAX_LINEAR_VELOCITY"): None}, timeout=60)
        self.completed(result)
        self.assertAlmostEqual(result.answers["end"]["joints"][4], 60, delta=1e-6)
        v, _, _ = peaks(result.column("axis.c"))
        self.assertAlmostEqual(v, 60 * 30 / math.hypot(100, 100, 100), delta=0.1)

    def test_abort_and_a_new_program(self):
        result = harness.run([["start", "PROGRAMS/part.ngc"], ["wait_moving"], ["sleep", 0.3], ["abort"],
                              ["sleep", 0.3], ["note", "stopped"], ["mdi", "G90 G1 X5 Y6 Z7 F3000"], ["note", "end"]],
                             self.PROGRAM)
        self.assertIsNone(result.failure, result.log)
        self.within_limits(result)
        stopped = result.answers["stopped"]
        self.assertEqual(stopped["queue"], 0)
        # stopped on the first line
        x, y, _ = stopped["joints"][:3]
        self.assertGreater(x, 1)
        self.assertAlmostEqual(y, x / 8, delta=1e-6)
        for value, target in zip(result.answers["end"]["joints"][:3], (5, 6, 7), strict=True):
            self.assertAlmostEqual(value, target, delta=1e-9)

    def test_single_steps(self):
        result = harness.run([["open", "PROGRAMS/part.ngc"], *[["step"], ["sleep", 0.15]] * 5,
                              ["resume"], ["finish"], ["note", "end"]], self.PROGRAM)
        self.assertIsNone(result.failure, result.log)
        self.within_limits(result)
        result.forgive_end_of_steps()
        self.at_end(result)

    def test_machine_off_in_motion(self):
        result = harness.run([["start", "PROGRAMS/part.ngc"], ["wait_moving"], ["sleep", 0.2], ["machine_off"],
                              ["sleep", 0.2], ["on"], ["mdi", "G90 G0 X1 Y2 Z3"], ["note", "end"]], self.PROGRAM)
        self.assertIsNone(result.failure, result.log)
        for value, target in zip(result.answers["end"]["joints"][:3], (1, 2, 3), strict=True):
            self.assertAlmostEqual(value, target, delta=1e-9)


class Found(Case):
    def test_a_first_move_of_nanometres_loses_no_retract(self):
        # the planner once gave up the moves in its queue here, and the rapid went through the work
        lines = ["G21 G90 G17 G94 G64", "G1 Y0.00001 F1658", "G1 Y0.00001 Z-0.00089 F1106.6", "G1 X1 Z-0.00089 F1200",
                 "G0 Z50", "G4 P0.1", "G0 X100 Y0", "M2"]
        result = harness.run([RUN, ["note", "end"]], {"part.ngc": "\n".join(lines) + "\n"},
                             hal="".join(f"setp blendtp.axis.{axis}.max-jerk 0\n" for axis in AXES))
        self.completed(result)
        for value, target in zip(result.answers["end"]["joints"][:3], (100, 0, 50), strict=True):
            self.assertAlmostEqual(value, target, delta=1e-9)
        for x, z in result.columns("axis.x", "axis.z"):
            self.assertTrue(x < 1.01 or z > 49.99, f"X {x} at Z {z}")


    def test_a_tool_that_is_prepared_in_a_contour_brings_no_rest(self):
        # the move behind T comes some periods late, when the machine has just begun with a long line
        contour = ["G64 P0.05", "G1 X2 Y1 F1200", "X30 Y0", "X60 Y5", "T2", "X90 Y3", "X120 Y0"]
        result = harness.run([RUN], program(*contour))
        self.completed(result)
        places = [place for place in result.columns("axis.x", "axis.y") if 3 < place[0] < 115]
        slowest = min(math.dist(*pair) for pair in pairwise(places)) / PERIOD
        self.assertGreater(slowest, 15, f"mm/s, of {1200 / 60}")


class Refused(Case):
    def nothing_moves(self, result):
        for axis in AXES:
            values = result.column(f"axis.{axis}")
            self.assertEqual(max(values), min(values), axis)

    def test_a_jerk_that_makes_no_sense(self):
        # 1000 mm/s2 in more than 5 s is taken for a slip
        for value in ("-5", "nan", "199", "1e-300"):
            result = harness.run([["mdi", "G0 X10"], ["note", "end"]],
                                 hal=f"setp blendtp.axis.y.max-jerk {value}\n")
            self.assertIn("blendtp.axis.y.max-jerk", result.log)
            self.assertIn("must be 0 (not limited) or, in machine units per second cubed, at least 200", result.log)
            self.assertTrue(any("can't add linear move" in error for error in result.errors), result.errors)
            self.nothing_moves(result)

    def test_a_jerk_that_makes_no_sense_of_an_axis_that_is_not_there(self):
        # the machine has X Y Z
        for value in ("-5", "nan"):
            result = harness.run([["mdi", "G0 X10"]], hal=f"setp blendtp.axis.a.max-jerk {value}\n")
            self.assertIn(f"blendtp.axis.a.max-jerk is {value}, and the machine has no axis A, or one without "
                          "[AXIS_A]MAX_ACCELERATION: set the pin to 0", result.log)
            self.nothing_moves(result)

    def test_a_tolerance_that_makes_no_sense(self):
        for pin, value, words in (("millimetre", "0", "length of a millimetre"),
                                  ("rotary-tolerance", "-0.1", "number of degrees"),
                                  ("default-tolerance", "nan", "a number of machine units from 0")):
            result = harness.run([["mdi", "G0 X10"], ["note", "end"]], hal=f"setp blendtp.{pin} {value}\n")
            self.assertIn(f"blendtp.{pin} is", result.log)
            self.assertIn(words, result.log)
            self.assertTrue(any("can't add linear move" in error for error in result.errors), result.errors)
            self.nothing_moves(result)

    def test_an_output_that_motion_has_not(self):
        # beyond num_dio and num_aio when the move begins; beyond 63 motion has none at all
        outputs = (("M62 P5", "5"), ("M63 P64", "64"), ("M62 P255", "255"),
                   ("M67 E20 Q1", "20"), ("M67 E64 Q1", "64"), ("M67 E255 Q1", "255"))
        lines = [text for n, (line, _) in enumerate(outputs) for text in (line, f"G1 X{n + 1}")]
        result = harness.run([RUN, ["note", "end"]], program(*lines), record=False)
        self.assertIsNone(result.failure, result.log)
        said = [error for error in result.errors if "index out of range" in error]
        self.assertEqual(len(said), len(outputs), result.errors)
        for line, number in outputs:
            self.assertTrue(any(f"out of range, {number} " in error for error in said), line)
        self.assertAlmostEqual(result.answers["end"]["joints"][0], len(outputs), delta=AT_END)

    def test_a_jerk_that_changes_in_motion_holds_from_the_next_rest_on(self):
        # moves still come when the pin changes; 400 mm/s3 would lengthen the stop from some 0.15 s to 0.8
        lines = ["G64 P0.1 Q0.0001", *(f"G1 X{n} Y{0.01 * (n % 2)}" for n in range(1, 401))]
        changes: tuple[list, list] = ([], [["setp", "blendtp.axis.x.max-jerk", 400]])
        for change in changes:
            for _ in range(TRIES):
                result = harness.run([["start", "PROGRAMS/part.ngc"], ["wait_place", 0, 8], ["note", "change"], *change,
                                      ["wait_place", 0, 60], ["abort"], ["sleep", 1.0], ["note", "end"]], program(*lines))
                self.completed(result)
                self.assertLess(result.answers["change"]["queue"], 389, "all moves had come before the change")
                places = result.column("axis.x")
                speeds = [(b - a) / PERIOD for a, b in pairwise(places)]
                # where a busy computer is so late with moves that the machine comes to rest, the change holds from there on
                if all(speed > 1 for place, speed in zip(places[1:], speeds, strict=True) if 8 < place < 60):
                    break
            else:
                self.fail("the machine came to rest in the program each time")
            last = max(n for n, speed in enumerate(speeds) if speed > 1e-3)
            first = last
            while speeds[first - 1] >= speeds[first]:
                first -= 1
            self.assertGreater(speeds[first], 50)
            self.assertLess(last - first, 250, change)

    def test_more_jerk_than_a_period_can_use_is_no_limit_and_said_once(self):
        result = harness.run([["mdi", "G0 X10"], ["mdi", "G0 X0"], ["note", "end"]],
                             hal="setp blendtp.axis.x.max-jerk 1e9\n")
        self.completed(result)
        self.assertEqual(result.log.count("blendtp.axis.x.max-jerk is 1e+09"), 1, result.log)

    def test_jerk_not_limited(self):
        result = harness.run([RUN, ["note", "end"]], program("G1 X50 Y20", "G1 X0", "G0 Y0"),
                             hal="".join(f"setp blendtp.axis.{axis}.max-jerk 0\n" for axis in AXES))
        self.completed(result)
        for axis in AXES:
            v, a, _ = peaks(result.column(f"axis.{axis}"))
            self.assertLess(v, VELOCITY * 1.001)
            self.assertLess(a, ACCELERATION * 1.001)


if __name__ == "__main__":
    unittest.main()
