"""What a screen draws of a program with frames is where LinuxCNC then runs its joints."""

import math
import unittest

import pytest

import numpy

import harness

RUN = ["run", "PROGRAMS/part.ngc"]
PREVIEW = ["preview", "preview", "PROGRAMS/part.ngc"]

#: how exactly a joint comes to the end of a line, and to a chord of an arc, mm
LINE, ARC = 1e-6, 1e-5

#: how far a joint may be from what is drawn: chords are drawn for arcs
DRAWN = 0.01

#: motion.motion-type of moves whose every place is drawn: feed and arc; the first rapids of a program are not
DRAWN_TYPES = (2, 3)


def program(*lines):
    return {"part.ngc": "\n".join(["G21 G61.1 G17 G90 G94 G54 F500", *lines, "M2"]) + "\n"}


def view(steps, programs, **options):
    return harness.run(steps, programs, display="preview_driver.py", files=("preview_driver.py", "canon_moves.py"), **options)


def nearest(path, place):
    """How far a place is from each stretch of a path, shape (n, 3)."""
    start, way = path[:-1], numpy.diff(path, axis=0)
    square = (way * way).sum(axis=1)
    along = ((place - start) * way).sum(axis=1) / numpy.where(square > 0, square, 1.0)
    gaps = start + numpy.clip(along, 0, 1)[:, None] * way - place
    return numpy.sqrt((gaps * gaps).sum(axis=1))


class Compared(unittest.TestCase):
    """Runs a program, and compares its joints with its preview."""

    def check(self, *lines, steps=(), **options):
        self.result = result = view([*steps, PREVIEW, RUN], program(*lines), **options)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        moves = result.answers["preview"]["moves"]
        joints = numpy.array([result.commanded(joint) for joint in range(3)]).T
        self.passes_through(joints, moves)
        self.is_drawn(joints, moves)
        return moves

    def passes_through(self, joints, moves):
        """The joints come to each vertex of the preview, in its order."""
        index = 0
        for number, (kind, line, _, end, tool) in enumerate(moves):
            place = numpy.array(end[:3]) + tool
            allowed = ARC if kind == "arcfeed" else LINE
            gaps = nearest(joints[index:], place)
            reached = numpy.nonzero(gaps <= allowed)[0]
            self.assertTrue(len(reached), f"vertex {number} ({kind}, line {line}) {place}: {gaps.min():.3g} mm away")
            index += int(reached[0])

    def is_drawn(self, joints, moves):
        """Wherever the joints are in a feed, something is drawn."""
        drawn = [(numpy.array([start[:3], end[:3]]) + tool) for _, _, start, end, tool in moves]
        kinds = self.result.column("motion_type")
        shown = joints[[index for index, kind in enumerate(kinds) if kind in DRAWN_TYPES]]
        self.assertGreater(len(shown), 0)
        away = numpy.full(len(shown), math.inf)
        for line in drawn:
            way = line[1] - line[0]
            along = numpy.clip((shown - line[0]) @ way / (way @ way or 1.0), 0, 1)
            away = numpy.minimum(away, numpy.linalg.norm(line[0] + along[:, None] * way - shown, axis=1))
        self.assertLess(away.max(), DRAWN)


class Commands(Compared):
    def test_shifts_and_turns_in_the_plane(self):
        self.check("G10 L2 P1 X12 Y-7 Z3 R20", "G92 X5 Y6 Z7", "G1 X6 Y8", "o<trans> call [10] [-20] [5]", "G1 X3 Y4 Z1",
                   "o<arot_rpl> call [33]", "G1 X10 Y0", "Y10", "o<atrans> call [1] [2] [-3]", "X0 Y0 Z0", "G18",
                   "o<arot_rpl> call [-50]", "X5 Z5", "G19", "o<rot_rpl> call [15]", "Y9 Z-2", "o<frame_off> call",
                   "X1 Y1 Z1", "G92.1")

    @pytest.mark.thorough
    def test_turns_in_space_with_arcs_of_all_planes(self):
        self.check("G10 L2 P1 X2 Y3 Z4 R-35", "o<rot> call [20] [-35] [50]", "G1 X5 Y5 Z5", "G2 X15 I5 J0",
                   "G3 X5 Y5 I-5 J0 Z9", "G18", "G2 X11 Z15 I3 K3", "G19", "G3 Y15 Z11 J5 K-2", "G17",
                   "o<arot> call [10] [5] [3]", "G1 X1 Y2 Z3", "G3 X1 Y2 I4 J4", "o<frame_off> call", "G2 X20 Y20 R30")

    @pytest.mark.thorough
    def test_solid_angles(self):
        for convention in ("seed", "k2"):
            with self.subTest(convention=convention):
                self.check("o<rots_xy> call [30] [20]", "G1 X10 Y3 Z1", "o<rots_zx> call [25] [-15]", "G1 X10 Y3 Z2",
                           "o<arots_yz> call [12] [40]", "G1 X5 Y-3 Z2", "G2 X9 Y1 R5", "o<arots_xy> call [0.00004] [5]",
                           "G1 X-200 Y20", ini={("FRAMEPATH", "ROTS_CONVENTION"): convention})

    @pytest.mark.thorough
    def test_scales_and_mirrors(self):
        self.check("G10 L2 P1 X20 Y10 R15", "o<scale> call [2] [2] [2]", "G1 X4 Y5", "G2 X10 Y5 I3 J0",
                   "o<amirror> call [1] [0] [0]", "G1 X3 Y1", "G3 X6 Y4 I3 J0", "o<atrans> call [1] [2] [3]", "G1 X0 Y0 Z0",
                   "o<ascale_off> call", "G1 X4 Y3 Z2", "o<mirror> call [1] [1] [0]", "G1 X7 Y2", "G2 X9 Y4 R3",
                   "o<ascale> call [1.5] [0.5] [-3]", "G1 X2 Y9 Z1", "G3 X4 Y7 R2")

    @pytest.mark.thorough
    def test_a_tool_is_turned_and_not_scaled(self):
        for rule in ("frame", "machine"):
            with self.subTest(tool_length=rule):
                self.check("T2 M6", "G43", "o<frame_refresh> call", "G1 X1 Y1 Z1", "o<rot> call [25] [10] [70]",
                           "G1 X10 Y5 Z3", "o<ascale> call [0.5] [2] [1]", "G1 X3 Y4 Z5", "o<amirror> call [0] [0] [1]",
                           "G1 X2 Y3 Z-4", "G49", "o<frame_refresh> call", "G1 X1 Y2 Z3", "o<frame_off> call", "G43 H2",
                           "G1 X4 Y4 Z4", ini={("FRAMEPATH", "TOOL_LENGTH"): rule})

    @pytest.mark.thorough
    def test_a_tool_that_is_changed_in_a_turned_frame(self):
        self.check("o<rot> call [30] [0] [45]", "G1 X5 Y6 Z7", "T2 M6 G43", "G1 X8 Y6 Z7", "G43.1 X1 Y2 Z3", "G1 X1 Y6 Z7",
                   "G49", "G1 X2 Y2 Z2")

    @pytest.mark.thorough
    def test_codes_inches_and_increments(self):
        self.check("G77.1 X10 Y5", "G78.3 R30", "G1 X4 Y5", "G20", "G78.1 X0.5 Y-0.25 Z0.125", "G1 X1 Y1 Z0.5 F40", "G91",
                   "X0.1", "G78.2 X20 Z10", "Y0.2 Z0.1", "G78.6 X1", "X0.3", "G2 X0.2 Y0.1 R1", "G90", "G21", "G78.4 X10 Y20",
                   "G1 X5 F900", "G78.5 X0.333333333333 Y0.333333333333 Z0.333333333333", "G1 X300 Y100", "G77.1", "G1 X0 Y0")

    def test_planes_of_five_axis_programs(self):
        self.check("G10 L2 P1 X12 Y-7 Z3 R20", "G1 X5 Y5", "G68.2 X10 Y5 I30 J20 K-10", "G1 X4 Y5 Z6", "G2 X9 Y7 R6",
                   "G68.2 P1 Q321 X3 Y1 Z2 I10 J-25 K40 R15", "G1 X4 Y5 Z6", "G1 X7", "G68.2 P2 Q0 X1 Y2 Z3 R10",
                   "G68.2 P2 Q1 X0 Y0 Z0", "G68.2 P2 Q2 X9 Y1 Z2", "G68.2 P2 Q3 X1 Y8 Z-3", "G1 X3 Y4 Z5",
                   "G68.2 P3 Q1 X1 Y2 Z3 I1 J1 K0", "G68.2 P3 Q2 I0 J0.01 K1", "G1 X8 Y3 Z1", "G69", "G1 X1 Y1 Z1")

    @pytest.mark.thorough
    def test_the_tool_centre_point_with_the_table_level(self):
        # it is known of the machine: a preview takes M64 for any output
        self.check("G43.4 H2", "G1 X5 Y6 Z7", "G68.2 X10 Y5 I30 J20 K-10", "G1 X4 Y5 Z6", "G43.4 H1", "G1 X1 Y2 Z3", "G69",
                   "G1 X1 Y1 Z1", steps=[["mdi", "T2 M6"], ["mdi", "G43.4"]], sample="framepath-xyzac", joints=5, axes="xyzac")

    @pytest.mark.thorough
    def test_motion_codes_stay_across_a_frame(self):
        self.check("G1 X5 Y5 Z5", "G2 X10 Y10 R5", "o<trans> call [3] [1] [0]", "X11 Y11 R5", "G1 X6",
                   "o<arot_rpl> call [25]", "X8", "Y3", "G98 G81 X2 Y2 Z-3 R2 F600", "o<atrans> call [20] [0] [0]", "X3 Y3",
                   "o<arot> call [15] [0] [0]", "X4 Y4", "G80", "G1 Z8")

    def test_cycles(self):
        self.check("o<rot> call [20] [-15] [40]", "G1 X0 Y0 Z10", "G99 G83 X5 Y5 Z-4 R2 Q2.5 F600", "X10",
                   "G73 X12 Y9 Z-3 R1 Q1", "G98 G82 X3 Y4 Z-1 R3 P0.01", "G91 G81 X2 Y2 Z-4 R-1 L3", "G90 G80",
                   "G89 X1 Y1 Z-2 R1 P0.01", "G80 G1 X0 Y0")

    @pytest.mark.thorough
    def test_moves_of_the_machine(self):
        self.check("G10 L2 P1 X12 Y-7 Z3 R20", "G10 L2 P2 X30 Y5 Z1 R-10", "G1 X5 Y5", "G53 G1 X20 Y20", "G1 X1 Y1",
                   "o<rot> call [10] [20] [30]", "G1 X5 Y5", "G79 Z40", "G1 X6 Y6 Z6", "o<machine_move> call [50] [40] [30]",
                   "G1 X7 Y3", "o<frame_suspend> call", "G1 X1 Y2", "G55", "o<frame_refresh> call", "G1 X2 Y1",
                   "o<frame_resume> call", "G1 X3 Y3 Z3", "T1 M6",
                   "G1 X4 Y3 Z3", "o<frame_off> call", "G91 G28 Z0", "G90 G1 X5")


class WithoutY(Compared):
    def test_a_lathe(self):
        self.result = result = view([PREVIEW, RUN], program(
            "G18 G8 G0 X5 Z5", "G77.3 R30", "G1 X6 Z0", "G77", "G1 X1", "o<machine_move> call [8] [0] [3]", "G1 X2",
            "G7 G79 X20", "G1 X10", "G77.5 X2", "G1 X8"), sample="framepath-lathe", joints=2, axes="xz")
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        ends = [end for _, _, _, end, _ in result.answers["preview"]["moves"]]
        rows = result.columns("joint.0", "joint.1")
        for x, _, z in (end[:3] for end in ends):
            self.assertLess(min(math.dist((x, z), row) for row in rows), 1e-5, f"X {x} Z {z}")
        # the diameter 8, twice as large
        self.assertAlmostEqual(ends[-1][0], 8, places=6)


class Unchanged(unittest.TestCase):
    """A preview without the hook is what it was."""

    def test_a_preview_that_knows_no_frames(self):
        lines = ("G1 X5 Y5", "o<rot> call [10] [20] [30]", "G1 X10 Y6 Z7", "G2 X12 Y8 R5", "o<trans> call [1] [2] [3]",
                 "X15 Y5 R9")
        without = [line for line in lines if not line.startswith("o<")]
        result = view([["preview", "stock", "PROGRAMS/part.ngc", False], ["preview", "plain", "PROGRAMS/plain.ngc", False],
                       ["preview", "framed", "PROGRAMS/part.ngc"], ["preview", "again", "PROGRAMS/part.ngc", False],
                       ["preview", "same", "PROGRAMS/plain.ngc"]],
                      {**program(*lines), "plain.ngc": program(*without)["part.ngc"]}, record=False)
        self.assertIsNone(result.failure, result.log)
        moves = {name: [[kind, start, end] for kind, _, start, end, _ in answer["moves"]]
                 for name, answer in result.answers.items()}
        self.assertEqual(moves["stock"], moves["plain"])
        # and so it stays where another screen follows frames
        self.assertEqual(moves["again"], moves["plain"])
        self.assertNotEqual(moves["framed"], moves["plain"])
        # a program without frames is drawn as ever
        self.assertEqual(moves["same"], moves["plain"])


@pytest.mark.thorough
class Refused(unittest.TestCase):
    def test_a_frame_that_would_be_refused_ends_the_preview(self):
        for command, reason in (("o<scale> call [1] [0] [1]", "o<scale> with 1, 0, 1 would be refused, a scale factor is 0"),
                                ("o<scale> call [1] [200] [1]", "too unequal"),
                                ("o<trans> call [2000000] [0] [0]", "larger than a machine"),
                                ("o<arots_xy> call [90] [20]", "o<arots_xy> with 90, 20, 0 would be refused, no plane meets")):
            with self.subTest(command=command):
                result = view([PREVIEW, ["sleep", 0.2]], program("G1 X5", command, "G1 X10"), record=False)
                self.assertIsNone(result.failure, result.log)
                self.assertEqual(len(result.errors), 1, result.errors)
                self.assertIn(reason, result.errors[0])
                self.assertIn("the preview ends here", result.errors[0])
                self.assertEqual([end[0] for _, _, _, end, _ in result.answers["preview"]["moves"]], [5.0])


if __name__ == "__main__":
    unittest.main()
