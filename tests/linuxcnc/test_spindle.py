"""Motion that follows a spindle, in a real LinuxCNC with a simulated spindle and encoder: Z against the spindle's angle in
every servo cycle."""

import unittest
from itertools import pairwise

import pytest

import harness
from contract.row import MICROMETRE, PERIOD
from overload import ATTEMPTS
from test_planner import RUN, Case

#: A spindle that comes to its speed with 20 turns a second squared, and its encoder with an index. Ahead of motion in the
#: servo period, as a driver is. Its angle is recorded in millionths of a turn.
SPINDLE = """
loadrt sim_spindle names=encoder
loadrt limit2 names=ramp
loadrt mult2 names=turns-scale
loadrt conv_float_s32 names=turns-out
addf ramp servo-thread 1
addf encoder servo-thread 2
addf turns-scale servo-thread
addf turns-out servo-thread
setp ramp.maxv 20
net commanded spindle.0.speed-out-rps => ramp.in
net speed ramp.out => encoder.velocity-cmd spindle.0.speed-in
net turns encoder.position-fb => spindle.0.revs turns-scale.in0
net index spindle.0.index-enable <=> encoder.index-enable
setp turns-scale.in1 1000000
net turns-scaled turns-scale.out => turns-out.in
"""
INTEGERS = {"turns": "turns-out.out"}


def program(*lines):
    return {"part.ngc": "\n".join(["G21 G64 G17 G90 G94 F3000", *lines, "M2"]) + "\n"}


class Spindle(Case):
    def run_spindle(self, steps, *lines):
        return harness.run([*steps, ["note", "end"]], program(*lines), hal=SPINDLE, integers=INTEGERS)

    def track(self, result):
        """(Z of the joint, turns) in each servo cycle."""
        return [(z, turns * 1e-6) for z, turns in result.columns("joint.2", "turns")]

    def off_the_groove(self, result, top, bottom, pitch, steady=0):
        """Greatest distance of Z from a whole number of turns, on the ways down from top to bottom; only where the
        spindle's speed has been the same for so many cycles."""
        track = self.track(result)
        speeds = [later[1] - earlier[1] for earlier, later in pairwise(track)]
        errors = []
        for n in range(steady + 1, len(track)):
            z, turns = track[n]
            if bottom < z < top and z < track[n - 1][0] \
                    and all(abs(speed - speeds[n - 1]) < 5e-6 for speed in speeds[n - 1 - steady:n]):
                phase = -z / pitch - turns
                errors.append(abs(phase - round(phase)) * pitch)
        self.assertGreater(len(errors), 50)
        return max(errors)


class Threads(Spindle):
    @pytest.mark.thorough
    def test_every_speed_cuts_the_same_groove_to_a_micrometre(self):
        for speed, pitch in ((60, 1.5), (300, 1.5), (1500, 1.5), (600, 4), (2400, 0.5)):
            result = self.run_spindle([RUN], f"M3 S{speed}", "G4 P2.5", f"G33 Z{-14 * pitch} K{pitch}", "G0 X5",
                                      "G0 Z0", f"G33 Z{-14 * pitch} K{pitch}")
            self.completed(result)
            self.within_limits(result)
            off = self.off_the_groove(result, -5 * pitch, -9 * pitch, pitch)
            print(f"\n{speed} turns a minute, pitch {pitch} mm: {off * 1000:.3f} micrometres off", end=" ")
            self.assertLess(off, MICROMETRE)

    def test_the_speed_may_change_in_the_thread(self):
        steps = [["start", "PROGRAMS/part.ngc"], ["wait_line", 4], ["sleep", 2], ["force", "ramp.in", 12], ["sleep", 1.5],
                 ["force", "ramp.in", 4], ["pause"], ["feed_override", 0.3], ["sleep", 1], ["resume"], ["finish"]]
        result = self.run_spindle(steps, "M3 S480", "G4 P1", "G33 Z-60 K1.5")
        self.completed(result)
        self.within_limits(result)
        # where the spindle begins and ends to accelerate its acceleration jumps by 30 mm/s2
        self.assertLess(self.off_the_groove(result, -3, -56, 1.5), 5 * MICROMETRE)
        self.assertLess(self.off_the_groove(result, -3, -56, 1.5, steady=150), MICROMETRE)
        self.assertAlmostEqual(result.answers["end"]["position"][2], -60, delta=1e-9)

    def rests_at(self, result, places):
        """Whether Z stands at one of them."""
        z = result.columns("joint.2")
        return any(now == before and any(abs(now[0] - place) < MICROMETRE for place in places) for before, now in pairwise(z))

    def unbroken_sequence(self):
        """One of three threads. Where the second one comes so late that the machine has come to rest behind the first, it
        begins some turns later: such a run says nothing of the count."""
        for _ in range(ATTEMPTS):
            result = self.run_spindle([RUN], "G64 P0.05", "M4 S300", "G4 P1", "G33 Z-20 K2", "G33 Z-44 K2.4", "G33 Z-60 X8 K2")
            if not self.rests_at(result, (-20, -44)):
                return result
        self.fail("it rests between the threads")

    def test_reverse_and_sequence_and_taper(self):
        result = self.unbroken_sequence()
        self.completed(result)
        self.within_limits(result)
        # turns from the start of the first thread, by where Z is; the last one measures along its path
        taper = (16 ** 2 + 8 ** 2) ** 0.5 / 16
        sections = ((-8, -18, 2, lambda z: -z / 2), (-30, -42, 2.4, lambda z: 10 - (z + 20) / 2.4),
                    (-51, -57, 2, lambda z: 20 - (z + 44) * taper / 2))
        whole = None
        for top, bottom, pitch, turns_at in sections:
            phases = [turns_at(z) + turns for z, turns in self.track(result) if bottom < z < top]
            self.assertGreater(len(phases), 100)
            whole = round(phases[0]) if whole is None else whole
            self.assertLess(max(abs(phase - whole) for phase in phases) * pitch, MICROMETRE)

    def test_multi_start_by_an_offset_of_the_start(self):
        result = self.run_spindle([RUN], "M3 S300", "G4 P1", "G33 Z-30 K3", "G0 X5", "G0 Z1.5", "G0 X0", "G33 Z-30 K3")
        self.completed(result)
        phases: list[list[float]] = [[], []]
        passes, last = 0, 0.0
        for z, turns in self.track(result):
            passes += last > -20 >= z
            if passes and -25 < z < -20 and z < last:
                phases[passes - 1].append((-z / 3 - turns) % 1)
            last = z
        self.assertGreater(min(map(len, phases)), 100)
        # measured from 0 and from 1.5 mm above: half a turn apart
        for phase in phases[0]:
            self.assertLess(min(phase, 1 - phase), 1e-3 / 3)
        for phase in phases[1]:
            self.assertAlmostEqual(phase, 0.5, delta=1e-3 / 3)

    def test_a_threading_cycle(self):
        result = self.run_spindle([RUN], "G18", "G0 X12 Z5", "M3 S500", "G4 P1.5",
                                  "G76 P1.5 Z-20 I-1 J0.4 K1 R1 Q0 H1 E1 L2")
        self.completed(result)
        self.within_limits(result)
        track = self.track(result)
        phases = [(-z + 5) / 1.5 - turns for (before, _), (z, turns) in pairwise(track) if -16 < z < -3 and z < before]
        self.assertGreater(len(phases), 2000)
        self.assertLess(max(abs(phase - round(phase)) for phase in phases) * 1.5, MICROMETRE)


class Trouble(Spindle):
    def trouble(self, speed, *words, slew=None):
        steps = [["start", "PROGRAMS/part.ngc"], ["wait_line", 4], ["sleep", 1.5]]
        if slew:
            steps.append(["setp", "ramp.maxv", slew])
        steps += [["force", "ramp.in", speed], ["sleep", 5], ["finish"], ["note", "stopped"], ["mdi", "G0 Z5"]]
        result = self.run_spindle(steps, "M3 S600", "G4 P1", "G33 Z-400 K2", "G0 X50", "G0 Z0")
        self.assertIsNone(result.failure, result.log)
        self.within_limits(result)
        for word in words:
            self.assertIn(word, result.log)
        # the rest of the program did not run, and the next command did
        stopped = result.answers["stopped"]["position"]
        self.assertAlmostEqual(stopped[0], 0)
        self.assertLess(stopped[2], -5)
        self.assertAlmostEqual(result.answers["end"]["position"][2], 5)
        self.assertEqual(result.answers["stopped"]["interp_state"], 1)
        return result

    def test_a_stall(self):
        self.trouble(0, "the spindle came to a stop in a thread")

    def test_a_sudden_stall(self):
        self.trouble(0, "the spindle came to a stop in a thread", slew=1000)

    def test_a_reversal(self):
        self.trouble(-10, "the spindle turned back in a thread")

    def test_a_spindle_that_outruns_the_axis(self):
        self.trouble(60, "the spindle is too fast for the thread", "100 at most")

    def test_an_abort_while_waiting_for_the_index(self):
        steps = [["start", "PROGRAMS/part.ngc"], ["wait_line", 4], ["sleep", 1], ["abort"], ["sleep", 0.5],
                 ["note", "aborted"], ["mdi", "G0 X10"], ["mdi", "M3 S300"], ["mdi", "G4 P1"], ["mdi", "G33 Z-30 K1.5"]]
        # one turn in 20 s: the index is far away
        result = self.run_spindle(steps, "M3 S3", "G4 P0.1", "G33 Z-30 K1.5")
        self.assertIsNone(result.failure, result.log)
        self.within_limits(result)
        self.assertAlmostEqual(result.answers["aborted"]["position"][2], 0)
        self.assertAlmostEqual(result.answers["end"]["position"][0], 10)
        self.assertAlmostEqual(result.answers["end"]["position"][2], -30)
        self.assertLess(self.off_the_groove(result, -8, -25, 1.5), MICROMETRE)


class Taps(Spindle):
    @pytest.mark.thorough
    def test_down_and_up_in_step(self):
        for direction, scale in (("M3", ""), ("M4", ""), ("M3", " I1.5")):
            sign = -1 if direction == "M4" else 1
            result = self.run_spindle([RUN], f"{direction} S400", "G4 P1", "G0 Z2", f"G33.1 Z-20 K1.25{scale}", "G1 X5")
            self.completed(result)
            self.within_limits(result)
            errors = [(2 - z) / 1.25 - sign * turns for z, turns in self.track(result) if z < -10]
            whole = round(errors[0])
            off = max(abs(error - whole) for error in errors) * 1.25
            print(f"\n{direction}{scale}: {off * 1000:.2f} micrometres off", end=" ")
            self.assertLess(off, 5 * MICROMETRE)
            lowest = min(z for z, _ in self.track(result))
            self.assertLess(lowest, -20)
            end = result.answers["end"]["position"]
            self.assertAlmostEqual(end[2], 2, delta=1e-9)
            self.assertAlmostEqual(end[0], 5, delta=1e-9)

    @pytest.mark.thorough
    def test_an_abort_anywhere_leaves_nothing_for_the_next_move(self):
        for seconds in (0.5, 2.0, 3.5, 5.5):
            steps = [["start", "PROGRAMS/part.ngc"], ["wait_line", 5], ["sleep", seconds], ["abort"], ["sleep", 1],
                     ["note", "aborted"], ["mdi", "G0 Z5"], ["mdi", "G1 F1200 X20"]]
            result = self.run_spindle(steps, "M3 S400", "G4 P1", "G0 Z2", "G33.1 Z-20 K1.25", "G0 X50")
            self.assertIsNone(result.failure, result.log)
            self.within_limits(result)
            end = result.answers["end"]["position"]
            self.assertAlmostEqual(end[0], 20)
            self.assertAlmostEqual(end[2], 5)
            x = result.column("joint.0")
            self.assertLess(max(b - a for a, b in pairwise(x)) / PERIOD, 20.01)


class FeedPerTurn(Spindle):
    def feed_at(self, result, place):
        x = result.column("joint.0")
        near = next(n for n, value in enumerate(x) if value > place)
        return (x[near + 25] - x[near - 25]) / (50 * PERIOD)

    def test_the_feed_follows_speed_and_override(self):
        steps = [["start", "PROGRAMS/part.ngc"], ["wait_place", 0, 10], ["feed_override", 0.5], ["wait_place", 0, 20],
                 ["feed_override", 1], ["force", "ramp.in", 20], ["finish"]]
        result = self.run_spindle(steps, "M3 S600", "G4 P1", "G95 F0.4", "G1 X60")
        self.completed(result)
        self.within_limits(result)
        self.assertAlmostEqual(self.feed_at(result, 6), 4, delta=0.004)
        self.assertAlmostEqual(self.feed_at(result, 16.5), 2, delta=0.002)
        self.assertAlmostEqual(self.feed_at(result, 40), 8, delta=0.008)

    @pytest.mark.thorough
    def test_constant_surface_speed(self):
        # 60 m/min at a radius of 40 mm: 239 turns a minute, at 5 mm 1910
        result = self.run_spindle([RUN], "G18 G7", "G0 X80", "G96 D2000 S60 M3", "G4 P1.5", "G95 F0.2", "G1 X10")
        self.completed(result)
        self.within_limits(result)
        rows = self.columns_of(result)
        checked = 0
        for n in range(100, len(rows) - 100, 20):
            x, _ = rows[n]
            if 8 < x < 38 and rows[n + 20][0] < x:
                fed = rows[n - 50][0] - rows[n + 50][0]
                turned = rows[n + 50][1] - rows[n - 50][1]
                self.assertAlmostEqual(fed / turned, 0.2, delta=0.004)
                checked += 1
        self.assertGreater(checked, 100)

    def columns_of(self, result):
        return [(x, turns * 1e-6) for x, turns in result.columns("joint.0", "turns")]


if __name__ == "__main__":
    unittest.main()
