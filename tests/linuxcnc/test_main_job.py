"""The seed's own program, from the part program to the joints of a real LinuxCNC with both modules."""

import os
import subprocess
import unittest

import harness
from contract.row import ACCELERATION, JERK, VELOCITY, peaks
from geometry import Frame, chained, follow

PROGRAM = os.path.join(harness.ROOT, "demo", "programs", "seed2d.mpf")
TOOL = harness.TOOL


def subprogram(frame):
    """L10.spf by hand, in the coordinates of a frame: its shapes from the first point to the last."""
    line, arc = frame.line, frame.arc
    return [
        line((0, 0, 5), (0, 0, -1)),
        line((0, 0, -1), (10, 0, -1)),
        arc((10, 5, -1), (0, -5, 0), (5, 0, 0), 180),
        line((10, 10, -1), (0, 10, -1)),
        line((0, 10, -1), (0, 0, -1)),
        line((0, 0, -1), (0, 0, 5)),
        line((0, 0, 5), (5, 8, 5)),
        line((5, 8, 5), (5, 8, -1)),
        # three quarters of a turn, clockwise, about (5, 5)
        arc((5, 5, -1), (0, 3, 0), (3, 0, 0), 270),
        line((2, 5, -1), (2, 5, 5)),
    ]


def expected():
    """The whole path of the tip: three frames, a rapid between them, the retraction in the last frame."""
    frames = [Frame((20, 10, 0)), Frame.turned((55, 35, 0), 45), Frame.turned((20, 40, 0), 60)]
    shapes, last = [], [0.0, 0.0, 0.0]
    for frame in frames:
        contour = subprogram(frame)
        shapes += chained(last, contour[0].start) + contour
        last = contour[-1].end
    return shapes + chained(last, frames[-1].point((100, 100, 5)))


def filtered():
    """The part program as LinuxCNC gets it."""
    done = subprocess.run([TOOL, "filter", "--dialect", "sinumerik", "--backend", "kinematics",
                           "--path-mode", "G61.1", PROGRAM],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


class MainJob(unittest.TestCase):
    result: harness.Result

    @classmethod
    def setUpClass(cls):
        cls.result = harness.run([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": filtered()})

    def test_runs_to_its_end_without_a_message(self):
        self.assertIsNone(self.result.failure, self.result.log)
        self.assertEqual(self.result.errors, [], self.result.log)

    def test_the_frames_of_the_specification(self):
        # (10, 0) and (0, 10) of the turned frames, as the specification has them in four decimals
        for frame, x10, y10 in [(Frame.turned((55, 35, 0), 45), (62.0711, 42.0711), (47.9289, 42.0711)),
                                (Frame.turned((20, 40, 0), 60), (25, 48.6603), (11.3397, 45))]:
            for point, value in [((10, 0, 0), x10), ((0, 10, 0), y10)]:
                for a, b in zip(frame.point(point)[:2], value, strict=True):
                    self.assertAlmostEqual(a, b, delta=5.1e-5)

    def test_the_joints_follow_the_expected_path(self):
        joints = list(zip(*(self.result.commanded(joint) for joint in range(3)), strict=True))
        worst, missed = follow(joints, expected())
        self.assertLess(worst, 1e-6)
        self.assertLess(missed, 1e-6)

    def test_a_wrong_path_would_be_noticed(self):
        joints = list(zip(*(self.result.commanded(joint) for joint in range(3)), strict=True))
        moved = expected()
        # the first contour five micrometres aside; the second contour left out
        moved[4].end = moved[5].start = [moved[4].end[0] + 5e-3, *moved[4].end[1:]]
        self.assertGreater(follow(joints, moved)[0], 1e-4)
        shapes = expected()
        del shapes[12]
        self.assertGreater(max(follow(joints, shapes)), 1e-2)

    def test_no_joint_moves_at_a_frame_change(self):
        slots = self.result.column("slot")
        joints = self.result.columns("joint.0", "joint.1", "joint.2")
        changes = [n for n in range(1, len(slots)) if slots[n] != slots[n - 1]]
        # the frames of the program, of which TRANS and AROT are two commands, and off at the end
        self.assertGreaterEqual(len(changes), 6)
        for n in changes:
            # the next move may begin in the third period after the switch
            around = joints[max(0, n - 5):n + 3]
            for joint in range(3):
                values = [row[joint] for row in around]
                self.assertLess(max(values) - min(values), 1e-9, f"joint {joint} at cycle {n}")

    def test_limits(self):
        # of the joints: they hold in the turned frames as well
        for joint in range(3):
            v, a, j = peaks(self.result.column(f"joint.{joint}"))
            self.assertLess(v, VELOCITY * 1.001, f"joint {joint}")
            self.assertLess(a, ACCELERATION * 1.001, f"joint {joint}")
            self.assertLess(j, JERK * 1.001, f"joint {joint}")


if __name__ == "__main__":
    unittest.main()
