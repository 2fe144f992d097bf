"""What an operator sees of blendtp, in a real LinuxCNC: what limits the speed, how far it looks ahead, how long it takes.

What is said of each servo period is compared with the recorded motion, and the time left with the time that it then took.
"""

import math
import os
import random
import subprocess
import sys
import tempfile
import unittest
from itertools import groupby, pairwise
from typing import ClassVar

import pytest

import harness
import screen_checks

sys.path.insert(0, os.path.join(harness.SAMPLES, "panel"))

from contract.row import PERIOD
from ten_programs import ATTEMPTS, PROGRAMS, program
from time_table import TimesError, TimeTable

INI = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")
AXES = "xyz"

#: blendtp.limit.kind
NOTHING, REST, HOLD, SPINDLE, FEED, OVERRIDE, PATH_VELOCITY, VELOCITY, ACCELERATION, JERK, BETWEEN = range(11)
#: of the axes of the sample, by kind
LIMITS = {VELOCITY: 100.0, ACCELERATION: 1000.0, JERK: 20000.0}

#: moments of each program at which the time left is looked at
MOMENTS = 1000
#: of what is left, and servo periods
SHARE, PERIODS = 0.005, 3

FLOATS = ["blendtp.time-left", "blendtp.ahead.seconds", "blendtp.queued.seconds"]

HAL = """loadrt conv_bit_s32
addf conv-bit-s32.0 servo-thread
net whole-program blendtp.time-left.whole-program => conv-bit-s32.0.in
"""

TIMED = {
    **{name: PROGRAMS[name] for name in ("3D_Chips", "tort", "stops", "corners", "dense", "merged")},
    # lines that run again and again, and a dwell
    "loops": program("G64 P0.02 F4000", "o100 repeat [6]", "  G91 G1 X3 Y2", "  X2 Y-2", "  o200 repeat [20]", "    X0.1 Y0.03",
                     "  o200 endrepeat", "  X-2", "o100 endrepeat", "G90 G4 P0.7", "G1 X0 Y0", "G4 P0.2", "G0 Z5"),
}


#: s, a rest that is no dwell
SHORT = 0.1

#: where else than at 0, from where it was planned, a program begins
PLACES = {"corners": "X4"}


class Recorder(harness.Recorder):
    """Records what blendtp says, too."""

    def __init__(self):
        super().__init__(3, AXES, {"program": "", "kind": "blendtp.limit.kind", "axis": "blendtp.limit.axis",
                                   "whole": "conv-bit-s32.0.out"})
        self.signals += FLOATS
        self.header += FLOATS


def with_times(name, text):
    """A program and its times, by file name."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, f"{name}.ngc")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        subprocess.run([harness.TOOL, "plan", path, "--ini", INI, "--times", f"{path}.times"], check=True,
                       stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with open(f"{path}.times", encoding="utf-8") as file:
            return {f"{name}.ngc": text, f"{name}.ngc.times": file.read()}


class Operator(unittest.TestCase):
    def recorded(self, steps, programs):
        result = harness.run(steps, programs, recorder=Recorder(), hal=HAL)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        return result


def planned_dwells(times):
    """Seconds of each dwell in a text of times."""
    rows = [row.split(",") for row in times.splitlines()[2:]]
    rests = [float(after[0]) - float(row[0]) for row, after in pairwise(rows) if not row[3] and after[3]]
    return [seconds for seconds in rests if seconds > SHORT]


@pytest.mark.thorough
class TimeLeft(Operator):
    def setUp(self):
        #: {name: seconds of each dwell}
        self.planned: dict[str, list[float]] = {}

    def test_of_the_whole_program_at_random_moments(self):
        left = list(TIMED)
        for attempt in range(ATTEMPTS):
            left = [name for name, worst in self.worst(left).items() if worst >= 1]
            if not left:
                return
            print(f"attempt {attempt + 1}: {left} took another time than planned", flush=True)
        self.fail(f"{left} took another time than was said, {ATTEMPTS} times")

    def worst(self, names):
        """How far the time of each program is off, at most, over what is allowed."""
        programs: dict[str, str] = {}
        steps: list[list] = [["mdi", "G0 X1"]]
        for number, name in enumerate(names, 1):
            programs |= with_times(name, TIMED[name])
            self.planned[name] = planned_dwells(programs[f"{name}.ngc.times"])
            steps += [["mdi", f"G61.1 G21 G90 G54 G53 G0 {PLACES.get(name, 'X0')} Y0 Z0"],
                      ["halcmd", "sets", "record-program", str(number)], ["run", f"PROGRAMS/{name}.ngc"], ["sleep", 0.1],
                      ["halcmd", "sets", "record-program", "0"]]
        result = self.recorded(steps, programs)
        rows = result.columns("program", "whole", *FLOATS[:1], *(f"axis.{axis}" for axis in AXES))
        return {name: self.check(name, [row[1:] for row in rows if row[0] == number]) for number, name in enumerate(names, 1)}

    def check(self, name, rows):
        """Rows: whether the time is that of the whole program, the time, the axes."""
        still = [n == 0 or rows[n][2:] == rows[n - 1][2:] for n in range(len(rows))]
        begin, end = still.index(False), len(still) - 1 - still[::-1].index(False)
        known = next(n for n in range(begin, end) if rows[n][0])
        self.assertLess(known - begin, 100, f"{name}: it takes too long until the time is known")
        # how long the first move takes from there the plan cannot know
        known += 300 if name in PLACES else 0
        dwells = [(start, start + len(rows)) for start, rows in stretches_of(still[begin:end]) if len(rows) * PERIOD > SHORT]
        if len(dwells) != len(self.planned[name]):
            print(f"{name}: {len(dwells)} dwells, {len(self.planned[name])} planned", flush=True)
            return math.inf
        # LinuxCNC counts dwells by another clock: how much longer than planned each was
        longer = [(start, stop, (stop - start) * PERIOD - seconds)
                  for (start, stop), seconds in zip(dwells, self.planned[name], strict=True)]
        worst = 0.0
        for n in random.Random(name).choices(range(known, end + 1), k=MOMENTS):
            if any(start <= n - begin < stop for start, stop, _ in longer):
                continue
            left = (end - n) * PERIOD - sum(seconds for start, _, seconds in longer if start >= n - begin)
            if not rows[n][0]:
                # as where moves come so late that the machine waits for them
                print(f"{name}: unknown {left} s before the end", flush=True)
                return math.inf
            worst = max(worst, abs(rows[n][1] - left) / (SHARE * left + PERIODS * PERIOD))
        print(f"{name:10} {(end - begin) * PERIOD:7.3f} s, known after {known - begin} periods; "
              f"off by {worst:.2f} of what is allowed",
              flush=True)
        # nothing is left behind the end
        self.assertEqual(rows[-1][:2], (0, 0.0))
        return worst


def stretches_of(still):
    """Each stretch of standstill: its start, and its rows."""
    start = 0
    for stands, stretch in groupby(still):
        rows = list(stretch)
        if stands:
            yield start, rows
        start += len(rows)


class Gone(Operator):
    def test_what_is_said_holds_for_a_second(self):
        result = self.recorded([["start", "PROGRAMS/part.ngc"], ["wait_moving"],
                                ["expect", "blendtp.time-left.whole-program", "TRUE"],
                                ["halcmd", "unloadusr", "program-time"],
                                ["expect", "blendtp.time-left.whole-program", "FALSE"], ["getp", "left", "blendtp.time-left"],
                                ["finish"]], with_times("part", program("F600", "G1 X30", "X60")))
        # of what is queued: both moves
        self.assertGreater(float(result.answers["left"]), 2)
        self.assertLess(float(result.answers["left"]), 6)


class Table(unittest.TestCase):
    #: a rest, a move, a move of less than a period, a dwell, the first line again
    ROWS: ClassVar = [(0.0, 0, 0, None), (0.1, 7, 0, 10.0), (0.3, 7, 0, 6.0), (0.4, 7, 0, 1.0), (0.5, 9, 2, 5.0),
                      (0.9, 9, 2, 0.0),
                      (1.0, 9, 3, None), (2.0, 7, 3, 8.0), (2.8, 7, 3, 0.0)]

    def setUp(self):
        self.table = TimeTable(self.ROWS, 3.0)

    def test_places_between_rows(self):
        for move, to_go, stands, times in (
                (0, 10.0, True, (0.0, 0.1)), (0, 8.0, False, (0.2, 0.2)), (0, 6.0, True, (0.3, 0.3)),
                (0, 12.0, False, (0.1, 0.1)),
                (0, 0.5, False, (0.45, 0.45)), (1, 0.2, False, (0.5, 0.5)), (2, 2.5, False, (0.7, 0.7)),
                (3, 0.0, True, (1.0, 2.0)),
                (3, 8.0, True, (1.0, 2.0)), (3, 4.0, True, (2.4, 2.4)), (4, 0.0, True, (3.0, 3.0)),
                (90, 0.0, False, (3.0, 3.0))):
            with self.subTest(move=move, to_go=to_go, stands=stands):
                for found, expected in zip(self.table.find(move, to_go, stands), times, strict=True):
                    self.assertAlmostEqual(found, expected)

    def test_a_move_is_of_its_line(self):
        self.assertTrue(self.table.has(0, 7) and self.table.has(2, 9) and self.table.has(3, 7))
        self.assertFalse(self.table.has(0, 9) or self.table.has(3, 9) or self.table.has(4, 7))
        # it has no row
        self.assertTrue(self.table.has(1, 8))
        self.assertEqual([self.table.nearest(7, move) for move in (0, 1, 2, 9)], [0, 0, 3, 3])
        self.assertIsNone(self.table.nearest(8, 1))

    def test_what_is_damaged_is_refused(self):
        programs = with_times("part", program("F1000", "G1 X3"))
        with tempfile.TemporaryDirectory() as folder:
            path, times = os.path.join(folder, "part.ngc"), os.path.join(folder, "part.ngc.times")
            with open(path, "w", encoding="utf-8") as file:
                file.write(programs["part.ngc"])
            whole = programs["part.ngc.times"]
            for text, word in ((whole, None), (whole[:-9], "damaged"), (whole.replace("0.0", "x.0"), "damaged"),
                               ("", "another program")):
                with open(times, "w", encoding="utf-8") as file:
                    file.write(text)
                if word is None:
                    self.assertGreater(TimeTable.read(times, path).total, 0.1)
                    continue
                with self.assertRaisesRegex(TimesError, f"{word}.* write it anew: framepath plan "):
                    TimeTable.read(times, path)


class SpeedLimit(Operator):
    PROGRAM = program("G64 P0.05 F3000", "G1 X40", "Y30", "G3 X40 Y38 I0 J4", "G1 X5", "G3 X1 Y34 I0 J-4", "G1 Y4", "X0 Y0",
                      "G0 X60 Y5", "X0")

    def test_every_period_is_what_the_recording_shows(self):
        result = self.recorded([["halcmd", "sets", "record-program", "1"], ["run", "PROGRAMS/part.ngc"], ["feed_override", 0.3],
                                ["mdi", "G1 X0 Y0 F3000"], ["sleep", 0.1]], {"part.ngc": self.PROGRAM})
        rows = result.columns("kind", "axis", *(f"axis.{axis}" for axis in AXES), *FLOATS)
        counts = dict.fromkeys(range(11), 0)
        for n in range(3, len(rows)):
            counts[rows[n][0]] += 1
            self.check(n, rows)
            ahead, queued = rows[n][-2:]
            self.assertLessEqual(ahead, queued + 1e-6)
            self.assertEqual(queued > 0, rows[n][0] != NOTHING, rows[n])
        print(counts)
        for kind in (NOTHING, FEED, OVERRIDE, PATH_VELOCITY, VELOCITY, ACCELERATION, JERK):
            self.assertGreater(counts[kind], 5, f"{kind} in {counts}")

    def check(self, n, rows):
        kind, axis = rows[n][:2]
        d, c, b, a = (rows[n - k][2:5] for k in range(4))
        rates = {VELOCITY: [(d[x] - c[x]) / PERIOD for x in range(3)],
                 ACCELERATION: [(d[x] - 2 * c[x] + b[x]) / PERIOD ** 2 for x in range(3)],
                 JERK: [(d[x] - 3 * c[x] + 3 * b[x] - a[x]) / PERIOD ** 3 for x in range(3)]}
        shares = {(quantity, x): abs(values[x]) / LIMITS[quantity] for quantity, values in rates.items() for x in range(3)}
        speed = math.hypot(*rates[VELOCITY])
        place = f"row {n}: {rows[n]}, {speed} mm/s, {shares}"
        if kind in LIMITS:
            # the recording has 1e-12 mm, which is .001 mm/s3
            self.assertGreater(shares[kind, axis], max(shares.values()) - 1e-5, place)
            self.assertGreater(shares[kind, axis], 0.5, place)
            return
        self.assertEqual(axis, -1, place)
        if kind == FEED:
            # within a period the machine comes to this speed
            self.assertAlmostEqual(speed / 50, 1, delta=0.03, msg=place)
        elif kind == OVERRIDE:
            self.assertAlmostEqual(speed / 15, 1, delta=0.03, msg=place)
        elif kind == PATH_VELOCITY:
            self.assertAlmostEqual(speed / 100, 1, delta=0.03, msg=place)
        elif kind == BETWEEN:
            self.assertLess(max(shares.values()), 0.5, place)
        else:
            self.assertIn(kind, (NOTHING, REST), place)
            # in the last period it comes to the end
            self.assertLess(speed, 0.01, place)

    def test_a_hold(self):
        result = self.recorded([["start", "PROGRAMS/part.ngc"], ["wait_moving"], ["sleep", 0.3], ["pause"], ["sleep", 1],
                                ["getp", "kind", "blendtp.limit.hold"], ["getp", "left", "blendtp.time-left"], ["sleep", 0.5],
                                ["getp", "left later", "blendtp.time-left"], ["getp", "stands", "blendtp.move.stands"],
                                ["resume"], ["finish"], ["sleep", 0.2], ["getp", "end", "blendtp.limit.nothing"],
                                ["getp", "queue", "blendtp.queued.moves"]], with_times("part", self.PROGRAM))
        self.assertEqual([result.answers[name] for name in ("kind", "stands", "end", "queue")], ["TRUE", "TRUE", "TRUE", "0"])
        # one look at the program more or less
        self.assertAlmostEqual(float(result.answers["left"]), float(result.answers["left later"]), delta=0.1)


class Stale(Operator):
    def test_times_of_another_program_are_said_and_not_shown(self):
        programs = with_times("part", program("F1000", "G1 X30"))
        programs["part.ngc"] = program("F1000", "G1 X31")
        result = self.recorded([["start", "PROGRAMS/part.ngc"], ["wait_moving"],
                                ["getp", "whole", "blendtp.time-left.whole-program"],
                                ["getp", "left", "blendtp.time-left"], ["finish"]], programs)
        self.assertEqual(result.answers["whole"], "FALSE")
        # then it is that of what is queued
        self.assertGreater(float(result.answers["left"]), 1)
        self.assertIn("program-time: no time of the whole program is shown: ", result.log)
        self.assertIn("was written for another program, or for an older state of this one: write it anew: framepath plan",
                      result.log)


@pytest.mark.thorough
class Panel(unittest.TestCase):
    """The panel of AXIS for a table: each of its pins gets what it is named for. That of a mill: screen_checks.OnTheScreen."""

    PROGRAM = program("F2000", "o<trans> call [20] [30] [5]", "o<arot> call [0] [0] [30]", "G1 X5 Y0 Z0", "M0", "X30")

    def test_of_a_mill_with_a_table(self):
        pins = (*screen_checks.PANEL, "limit.a", "limit.c", "frame.centre-point")
        steps = [["show", "axis"], ["wait_pin", "axisui.abort"], ["wait_pin", "pyvcp.frame.guarded"],
                 ["expect", "pyvcp.frame.guarded", "TRUE", 60],
                 *screen_checks.START, ["wait_paused"], *screen_checks.read_panel("in the frame", pins), ["resume"],
                 ["wait_moving"], ["sleep", 0.4], ["getp", "at feed", "pyvcp.limit.feed"], ["finish"],
                 ["expect", "framekins.active", "FALSE"], ["expect", "framekins.hold", "FALSE"],
                 *screen_checks.read_panel("behind it", pins)]
        result = harness.run(steps, {"part.ngc": self.PROGRAM}, display="screen_driver.py", files=("screen_driver.py",),
                             sample="framepath-xyzac", joints=5, axes="xyzac", record=False, timeout=180)
        self.assertIsNone(result.failure, result.log)
        screen_checks.panel_shows(self, result, pins)


if __name__ == "__main__":
    unittest.main()
