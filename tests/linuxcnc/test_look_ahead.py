"""Look-ahead in a real LinuxCNC: G64, G61 and G61.1, what happens at moves inside blends, and what an operator does.

Q0 keeps LinuxCNC's interpreter side from merging moves before the planner sees them, which would add to the deviation.
"""

import math
import random
import unittest
from itertools import pairwise

import pytest

import harness
from contract.row import MICROMETRE, PERIOD, difference, to_segment
from test_planner import AXES, RUN, Case


def program(mode, *lines):
    return {"part.ngc": "\n".join([f"G21 G17 G90 G94 {mode} F6000", *lines, "M2"]) + "\n"}


def moves(points):
    return ["G1 " + " ".join(f"{axis.upper()}{place:.6f}" for axis, place in zip(AXES, point, strict=True)) for point in points]


def zigzag(legs, width=10.0, height=20.0):
    return [(width * n, height * (n % 2), 0.0) for n in range(1, legs + 1)]


def deviations(executed, vertices, tolerance):
    """Greatest distance of an executed point from the program, and of a vertex from what was executed.

    Both are run through in order, so that a place that the path comes by twice is compared with the right one: a leg is
    left for another one when it is farther away than the tolerance, and not ahead to one that is nearer by chance.
    """
    away, n = 0.0, 0
    for point in executed:
        ahead = range(n, min(n + 40, len(vertices) - 1))
        distances = [to_segment(point, vertices[k], vertices[k + 1]) for k in ahead]
        within = (k for k, distance in zip(ahead, distances, strict=True) if distance <= tolerance)
        n = next(within, n + distances.index(min(distances)))
        away = max(away, to_segment(point, vertices[n], vertices[n + 1]))
    missed = max(min(to_segment(vertex, a, b) for a, b in pairwise(executed)) for vertex in vertices)
    return away, missed


class LookAhead(Case):
    def motion(self, result):
        """The positions from the first to the last that differ."""
        points = result.columns(*(f"axis.{axis}" for axis in AXES))
        moving = [n for n in range(1, len(points)) if points[n] != points[n - 1]]
        return points[moving[0] - 1:moving[-1] + 1]

    def rests(self, points):
        """How many times the machine comes to rest on the way."""
        still = [a == b for a, b in pairwise(points)]
        return sum(1 for before, now in pairwise(still) if now and not before)

    def follows(self, points, vertices, tolerance):
        away, missed = deviations(points, vertices, tolerance)
        self.assertLess(away, tolerance + MICROMETRE)
        self.assertLess(missed, tolerance + MICROMETRE)
        self.assertLess(math.dist(points[-1], vertices[-1]), 1e-9)
        return away, missed


#: moves that are handed over before the machine starts
LOADED = 250


class Modes(LookAhead):
    def run_mode(self, mode, points):
        # begins with enough moves that a computer which is busy for a moment plays no part
        result = harness.run([["setp", "motion.feed-hold", 1], ["start", RUN[1]],
                              ["wait_queue", min(len(points), LOADED)], ["setp", "motion.feed-hold", 0], ["finish"],
                              ["note", "end"]], program(mode, *moves(points)))
        self.completed(result)
        self.within_limits(result)
        return self.motion(result)

    @pytest.mark.thorough
    def test_a_zigzag_in_each_mode(self):
        corners = zigzag(12)
        vertices = [(0.0, 0.0, 0.0), *corners]
        times = {}
        for mode, tolerance, rests in (("G61.1", 0.0, 11), ("G61", 0.0, 11), ("G64 P0.05", 0.05, 0),
                                       ("G64 P0.5", 0.5, 0)):
            points = self.run_mode(mode, corners)
            times[mode] = len(points) * PERIOD
            _, missed = self.follows(points, vertices, tolerance)
            if rests:
                # the periods may fall so that none has both its ends at a rest
                speeds = [math.dist(a, b) / PERIOD for a, b in pairwise(points)]
                slow = sum(1 for a, b, c in zip(speeds, speeds[1:], speeds[2:], strict=False) if b < 2 and b <= a and b <= c)
                self.assertGreaterEqual(slow, rests, mode)
            else:
                self.assertEqual(self.rests(points), 0, mode)
                # the tolerance is made use of
                self.assertGreater(missed, 0.5 * tolerance, mode)
        self.assertLess(times["G64 P0.05"], 0.98 * times["G61.1"])
        self.assertLess(times["G64 P0.5"], 0.97 * times["G64 P0.05"])

    def test_without_p_every_move_is_touched(self):
        corners = zigzag(12)
        points = self.run_mode("G64", corners)
        self.assertEqual(self.rests(points), 0)
        vertices = [(0.0, 0.0, 0.0), *corners]
        for start, end in pairwise(vertices):
            nearest = min(to_segment(point, start, end) for point in points)
            self.assertLess(nearest, MICROMETRE)

    def test_g61_passes_where_the_path_is_tangent(self):
        lines = ["G1 X20", "G1 X40", "G3 X40 Y20 I0 J10", "G1 X20", "G1 X0"]
        result = harness.run([RUN, ["note", "end"]], program("G61", *lines))
        self.completed(result)
        self.within_limits(result)
        points = self.motion(result)
        self.assertEqual(self.rests(points), 0)
        for x, y, _ in points:
            away = min(abs(y), abs(y - 20)) if x <= 40 else abs(math.hypot(x - 40, y - 10) - 10)
            self.assertLess(away, 1.5 * MICROMETRE)

    def test_dense_code_keeps_its_speed(self):
        points = []
        # at 100 mm/s a move takes two of the periods in which LinuxCNC sends one
        for n in range(1, 751):
            s = 0.2 * n
            points.append((round(30 * math.sin(s / 30), 4), round(20 * (1 - math.cos(s / 20)), 4), 0.0))
        executed = self.run_mode("G64 P0.01 Q0", points)
        self.assertEqual(self.rests(executed), 0)
        self.follows(executed, [(0.0, 0.0, 0.0), *points], 0.01)
        length = sum(math.dist(a, b) for a, b in pairwise(points))
        self.assertLess(len(executed) * PERIOD, length / 100.0 + 0.5)

    @pytest.mark.thorough
    def test_a_random_program(self):
        source = random.Random(11)
        points, place = [], [0.0, 0.0, 0.0]
        for _ in range(150):
            length = math.exp(source.uniform(math.log(0.01), math.log(15)))
            place = [max(-90.0, min(90.0, p + length * source.uniform(-1, 1))) for p in place]
            points.append(tuple(round(p, 4) for p in place))
        points = [p for p, q in zip(points, [None, *points], strict=False) if p != q]
        executed = self.run_mode("G64 P0.03 Q0", points)
        self.assertEqual(self.rests(executed), 0)
        self.follows(executed, [(0.0, 0.0, 0.0), *points], 0.03)

    def test_the_mode_changes_on_the_way(self):
        first, second, third = zigzag(6), zigzag(12)[6:], zigzag(18)[12:]
        lines = [*moves(first), "G61.1", *moves(second), "G64 P0.2", *moves(third)]
        result = harness.run([RUN, ["note", "end"]], program("G64 P0.05", *lines))
        self.completed(result)
        self.within_limits(result)
        points = self.motion(result)
        self.follows(points, [(0.0, 0.0, 0.0), *zigzag(18)], 0.2)
        for corner in zigzag(12)[6:]:
            self.assertLess(min(math.dist(point, corner) for point in points), 0.02)


class InsideBlends(LookAhead):
    def test_outputs_are_written_at_their_moves(self):
        # short collinear moves that could be merged, an output at each
        lines = [line for n in range(1, 41) for line in (f"M6{3 - n % 2} P0", f"G1 X{n}")]
        hal = "net output motion.digital-out-00 => record-output.in\n"
        hal = "loadrt conv_bit_s32 names=record-output\naddf record-output servo-thread\n" + hal
        result = harness.run([RUN, ["note", "end"]], program("G64 P0.05", *lines), hal=hal,
                             integers={"output": "record-output.out"})
        self.completed(result)
        points = [x for (x,) in result.columns("axis.x")]
        output = result.column("output")
        changes = [n for n in range(1, len(output)) if output[n] != output[n - 1]]
        self.assertEqual(len(changes), 40)
        for move, n in enumerate(changes):
            # within the period in which the move begins, and one of the recorder's
            step = abs(points[n] - points[n - 1]) + 1e-9
            self.assertLess(abs(points[n] - move), 2.5 * step + 1e-3, f"output of move {move}")

    def test_lines_of_the_program_are_reported_in_order(self):
        points = [(0.03 * n, 0.02 * math.sin(n / 4), 0.0) for n in range(1, 801)]
        result = harness.run([RUN, ["note", "end"]], program("G64 P0.02 Q0", *moves(points)))
        self.completed(result)
        lines = [line for line in result.column("line") if line > 0]
        self.assertEqual(lines, sorted(lines))
        self.assertGreater(len(set(lines)), 300)

    def test_a_dwell_a_spindle_and_an_input_end_the_look_ahead(self):
        lines = [*moves(zigzag(4)), "G4 P0.05", *moves(zigzag(8)[4:]), "M3 S100", *moves(zigzag(12)[8:]),
                 "M66 P0 L0", *moves(zigzag(16)[12:])]
        result = harness.run([RUN, ["note", "end"]], program("G64 P0.05", *lines))
        self.completed(result)
        self.within_limits(result)
        points = self.motion(result)
        for corner in (zigzag(16)[3], zigzag(16)[7], zigzag(16)[11]):
            self.assertLess(min(math.dist(point, corner) for point in points), 1e-9)
        self.assertEqual(self.rests(points), 3)
        self.follows(points, [(0.0, 0.0, 0.0), *zigzag(16)], 0.05)


class Operator(LookAhead):
    def test_pause_override_and_resume_stay_on_the_path(self):
        corners = zigzag(30)
        steps: list[list] = [["start", "PROGRAMS/part.ngc"], ["wait_moving"]]
        source = random.Random(5)
        for _ in range(8):
            steps += [["sleep", source.uniform(0.05, 0.5)], ["pause"], ["sleep", source.uniform(0.05, 0.4)], ["resume"],
                      ["feed_override", source.choice([0.3, 0.7, 1.0, 1.2])]]
        steps += [["feed_override", 1.0], ["finish"], ["note", "end"]]
        result = harness.run(steps, program("G64 P0.1", *moves(corners)))
        self.completed(result)
        self.within_limits(result)
        self.follows(self.motion(result), [(0.0, 0.0, 0.0), *corners], 0.1)

    def test_abort_rests_on_the_path_and_the_next_program_starts_there(self):
        corners = zigzag(30)
        result = harness.run([["start", "PROGRAMS/part.ngc"], ["wait_moving"], ["sleep", 0.7], ["abort"],
                              ["sleep", 0.5], ["note", "aborted"], RUN, ["note", "end"]],
                             program("G64 P0.1", *moves(corners)))
        self.completed(result)
        self.within_limits(result)
        aborted = result.answers["aborted"]["position"][:3]
        away = min(to_segment(aborted, a, b) for a, b in pairwise([(0.0, 0.0, 0.0), *corners]))
        self.assertLess(away, 0.1 + MICROMETRE)
        points = self.motion(result)
        self.assertLess(math.dist(points[-1], corners[-1]), 1e-9)

    @pytest.mark.thorough
    def test_the_shape_does_not_depend_on_the_override(self):
        corners = zigzag(8)
        paths = []
        for scale in (0.4, 1.0):
            result = harness.run([["feed_override", scale], RUN, ["note", "end"]],
                                 program("G64 P0.2", *moves(corners)))
            self.completed(result)
            paths.append(self.motion(result))
        self.assertGreater(len(paths[0]), 1.5 * len(paths[1]), "the override did nothing")
        for point in paths[1]:
            # chords between the samples of the slow run are flat
            self.assertLess(min(to_segment(point, a, b) for a, b in pairwise(paths[0])), 2e-3)

    def test_step_by_step(self):
        corners = zigzag(5)
        steps: list[list] = [["open", "PROGRAMS/part.ngc"]]
        for n in range(5):
            # on a busy computer task may come late to a step
            steps += [["step"], ["sleep", 0.8], ["wait_standing"], ["note", f"step {n}"]]
        result = harness.run([*steps, ["resume"], ["finish"], ["note", "end"]],
                             program("G64 P0.5", *moves(corners)))
        result.forgive_end_of_steps()
        self.completed(result)
        self.within_limits(result)
        places = [tuple(result.answers[f"step {n}"]["position"][:3]) for n in range(5)]
        # the first steps are lines that do not move; each of the others ends at a corner
        self.assertGreaterEqual(len(set(places)), 3, places)
        for place in places:
            self.assertLess(min(math.dist(place, corner) for corner in [(0.0, 0.0, 0.0), *corners]), 1e-6, places)

    def test_speeds_between_moves_of_mdi(self):
        steps = [["mdi", f"G1 F3000 X{x}"] for x in (10, 20, 30)]
        result = harness.run([["mdi", "G64 P0.1"], *steps, ["note", "end"]])
        self.completed(result)
        self.within_limits(result)
        v = max(abs(value) for value in difference(result.column("axis.x")))
        self.assertLess(v, 50 * 1.001)
        self.assertGreater(v, 49)


if __name__ == "__main__":
    unittest.main()
