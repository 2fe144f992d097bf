"""What holds for every screen that follows frames: AXIS (test_preview_axis.py), gmoccapy and qtdragon
(test_preview_screens.py)."""

import unittest
from typing import ClassVar

import numpy

import harness
from test_preview import ARC, nearest, program

#: how exactly the live plot is on the path of the joints, mm
TRAIL = 1e-5

#: .. while a table turns: LinuxCNC smooths the joints in between, mm
TURNING = 1e-3

#: the way of a servo period at the feed of these programs, mm
PERIOD = 500 / 60 * 0.001

#: half of the last digit of a position display, mm
SHOWN = 6e-4

#: how LinuxCNC begins what it says when its position is to be read anew in AUTO, as a screen of qtvcp does to read a program
READS_IN_AUTO = "can't do that (EMC_TASK_PLAN_SYNCH) in auto mode"

#: pins of the panel, in the frame of the program of OnTheScreen and behind it
PANEL = {"frame.active": ("TRUE", "FALSE"), "frame.guarded": ("TRUE", "TRUE"), "frame.hold": ("FALSE", "FALSE"),
         "frame.x": ("20", "0"), "frame.y": ("30", "0"), "frame.z": ("5", "0"), "frame.operations": ("2", "0"),
         "limit.feed": ("FALSE", "FALSE"), "limit.x": ("FALSE", "FALSE"), "queued.moves": ("0", "0"),
         "left.minutes": ("0", "0"), "left.seconds": ("0", "0"), "left.whole-program": ("FALSE", "FALSE")}


def read_panel(when, pins=tuple(PANEL)):
    """Steps that keep what the panel gets: "PIN WHEN"."""
    return [["getp", f"{pin} {when}", f"pyvcp.{pin}"] for pin in pins]


def panel_shows(test, result, pins=tuple(PANEL)):
    """The panel got what it is named for, in the frame, at the feed, and behind the program."""
    test.assertEqual(result.answers["at feed"], "TRUE")
    for pin in pins:
        shown = tuple(result.answers[f"{pin} {when}"] for when in ("in the frame", "behind it"))
        test.assertEqual(shown, PANEL.get(pin, ("FALSE", "FALSE")), pin)


#: What docs/operator.md has screens other than AXIS write for the panel: gmoccapy gets it as a tab, qtdragon as a window.
TAB = "gladevcp -x {XID} -c pyvcp -H ../../panel/panel.hal ../../panel/panel.ui"
PANELS: dict[str, dict[tuple[str, str], str | None]] = {
    "axis": {},
    "gmoccapy": {("DISPLAY", "PYVCP"): None, ("HAL", "POSTGUI_HALFILE"): None, ("DISPLAY", "EMBED_TAB_NAME"): "Frames",
                 ("DISPLAY", "EMBED_TAB_LOCATION"): "ntb_preview", ("DISPLAY", "EMBED_TAB_COMMAND"): TAB},
    "qtvcp": {("DISPLAY", "PYVCP"): None, ("HAL", "POSTGUI_HALFILE"): "../../panel/panel_window.hal"}}

#: The same tab on a machine with A and C, which has lamps of these axes.
TAB_OF_A_TABLE = TAB.replace("panel.hal", "panel_ui_xyzac.hal")


#: The sample with a tilting table, and what it takes.
TABLE = {"sample": "framepath-xyzac", "joints": 5, "axes": "xyzac"}

#: Screens read a program that somebody else has opened.
START = [["open", "PROGRAMS/part.ngc"], ["sleep", 2], ["start_to_pause", "PROGRAMS/part.ngc"]]


class Screen:
    """A screen in tests."""

    def __init__(self, command, probe, files=(), own_errors: tuple[str, ...] = ()):
        """command: its words. probe: its USER_COMMAND_FILE; files: what that imports. own_errors: how that begins what LinuxCNC
        says of this screen without frames, too."""
        self.first = [["show", *command], ["wait_pin", "frame-preview.answer"], ["ask", "up", "notes"], ["on_for_good"],
                      ["home"], ["ask", "ready", "ready"]]
        self.probe = probe
        self.panel = PANELS[command[0]]
        #: frame_guard knows the screen by its name
        self.display = {("DISPLAY", "DISPLAY"): f"./screen_driver.py {command[0]}"}
        self.own_errors = own_errors
        self.files = ("screen_driver.py", "screen_probe.py", "canon_moves.py", probe, *files)

    def watch(self, steps, programs, ini=None, **options):
        """Runs steps in front of the screen."""
        changes: dict[tuple[str, str], str | None] = {("DISPLAY", "USER_COMMAND_FILE"): f"./{self.probe}", **self.panel,
                                                      **self.display, **(ini or {})}
        result = harness.run([*steps, ["ask", "notes", "notes"]], programs, display="screen_driver.py", files=self.files,
                           ini=changes, first=self.first, **options)
        result.errors = [error for error in result.errors if not error.startswith(self.own_errors)]
        return result


class OnTheScreen(unittest.TestCase):
    """One program with shifts, turns and a scale, watched from its opening to its end."""

    screen: Screen
    #: looked at before the program is opened
    before: tuple[list, ...] = ()
    result: harness.Result

    @classmethod
    def setUpClass(cls):
        cls.result = cls.screen.watch(
            [*cls.before, ["ask", "drawn", "open", "PROGRAMS/part.ngc"], ["wait_pin", "pyvcp.frame.guarded"], *START,
             ["wait_paused"], *read_panel("in the frame"), ["ask", "relative", "display", 1], ["ask", "machine", "display", 0],
             ["note", "place"], ["resume"], ["wait_moving"], ["sleep", 0.4], ["getp", "at feed", "pyvcp.limit.feed"],
             ["finish"], ["expect", "framekins.hold", "FALSE"], ["expect", "pyvcp.frame.active", "FALSE"],
             *read_panel("behind it"),
             ["sleep", 0.3], ["ask", "trail", "trail"], ["ask", "plotted", "plotted"]],
            program("T2 M6 G43", "G1 X1 Y1 Z1", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]",
                    "G1 X7 Y8 Z9", "G1 X0 Y0 Z0", "M0", "G1 X40", "G2 X40 Y20 R10", "G1 X0", "G4 P0.1",
                    "o<ascale> call [0.5] [0.5] [0.5]", "G3 X40 Y20 R30", "G49", "o<frame_refresh> call", "G1 X3 Y4 Z5",
                    "o<frame_off> call", "G1 X5"))

    def setUp(self):
        good(self, self.result)
        self.joints = numpy.array([self.result.commanded(joint) for joint in range(3)]).T

    def test_the_preview_is_where_the_joints_run(self):
        self.assertGreater(len(self.result.answers["drawn"]), 20)
        for place in self.result.answers["drawn"]:
            self.assertLess(nearest(self.joints, place).min(), ARC, place)

    def test_the_panel_gets_what_it_is_named_for(self):
        panel_shows(self, self.result)

    def test_frames_and_live_plot_are_drawn(self):
        self.assertGreater(self.result.answers["plotted"], 2)

    def test_the_live_plot_ends_at_the_tip_of_the_tool(self):
        # without a tool now, that is where the axes are
        place = self.result.answers["trail"][-1]
        for value, joint in zip(place, self.joints[-1], strict=True):
            self.assertAlmostEqual(value, joint, delta=TRAIL)

    def test_the_live_plot_is_drawn_at_the_tip_of_a_turned_tool(self):
        # the tool, 20 mm long, stands in the frame: at its origin the plot is there, and the axes are elsewhere
        trail = numpy.array(self.result.answers["trail"])
        self.assertLess(numpy.abs(trail - (20, 30, 5)).max(axis=1).min(), TRAIL)
        self.assertGreater(nearest(self.joints, (20, 30, 5)).min(), 1)

    def test_relative_positions_are_those_of_the_program(self):
        numbers, line = self.result.answers["relative"]
        self.assertLess(max(abs(number) for number in numbers), SHOWN)
        self.assertEqual(line, "FRAME X20.000 Y30.000 Z5.000 turned 36.762")

    def test_machine_positions_are_those_of_the_joints(self):
        shown, _ = self.result.answers["machine"]
        for value, joint in zip(shown, self.result.answers["place"]["joints"][:3], strict=True):
            self.assertAlmostEqual(value, joint, delta=SHOWN)


class Trail(unittest.TestCase):
    """The live plot, between its places too."""

    screen: Screen
    #: the sample, and what it takes
    machine: ClassVar[dict] = {}
    #: of the program, behind its frames
    more: tuple[str, ...] = ()
    #: looked at behind that
    looks: tuple[list, ...] = ()

    def test_the_live_plot_is_on_the_path_of_the_joints(self):
        result = self.screen.watch(
            [*START, ["wait_paused"], ["ask", "trail", "trail"], *self.looks, ["resume"], ["finish"]],
            program("G1 X10 Y5", "G4 P0.1", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]", "G1 X0 Y0 Z0",
                    "G4 P0.1", "G1 X40", "G4 P0.1", "G2 X40 Y20 R10", "o<amirror> call [1] [0] [0]", "G1 X3 Y4 Z2", "G4 P0.1",
                    "M0", *self.more), **self.machine)
        good(self, result)
        joints = numpy.array([result.commanded(joint) for joint in range(3)]).T
        trail = result.answers["trail"]
        self.assertGreater(len(trail), 20)
        *gaps, greatest = sorted(nearest(joints, place).min() for place in trail)
        self.assertLess(gaps[-1], TRAIL)
        # a servo thread without real-time rights may be interrupted while it writes X, Y and Z: one of them is a period older
        self.assertLess(greatest, PERIOD)
        # where the machine rests the plot has its place
        points = numpy.array(trail)
        for rest in ((10, 5, 0), (20, 30, 5)):
            self.assertLess(numpy.abs(points - rest).max(axis=1).min(), 2e-6, rest)
        self.check_more(result)

    def check_more(self, result):
        """What `looks` have seen."""


class TrailOnATable(Trail):
    """The same on a machine with a tilting table; and the tool centre point, with the table turned."""

    machine = TABLE
    more = ("o<frame_off> call", "T2 M6", "G43.4 H2", "G1 X10 Y5 Z25 F3000", "G4 P0.1", "A20 C30", "X30 Y10 Z26", "M0")
    looks = (["resume"], ["wait_moving"], ["wait_paused"], ["ask", "centre", "trail"], ["ask", "relative", "display", 1],
             ["ask", "machine", "display", 0], ["note", "place"])

    def check_more(self, result):
        points = numpy.array(result.answers["centre"])
        # the tip stays where it is in the workpiece while the table turns
        turns = numpy.nonzero(numpy.abs(points - (10, 5, 25)).max(axis=1) < TRAIL)[0][0]
        path = numpy.array([(10.0, 5.0, 25.0), (30.0, 10.0, 26.0)])
        for place in points[turns:]:
            self.assertLess(nearest(path, place).min(), TURNING, place)
        for found, place in zip(points[-1], path[-1], strict=True):
            self.assertAlmostEqual(found, place, delta=TRAIL)
        shown, _ = result.answers["relative"]
        for value, place in zip(shown, path[-1], strict=True):
            self.assertAlmostEqual(value, place, delta=SHOWN)
        shown, _ = result.answers["machine"]
        joints = result.answers["place"]["joints"]
        self.assertGreater(abs(joints[0] - 30), 1)
        for value, joint in zip(shown, joints[:3], strict=True):
            self.assertAlmostEqual(value, joint, delta=SHOWN)


def good(test, result):
    """Nothing went wrong, and the operator was told nothing."""
    test.assertIsNone(result.failure, result.log)
    test.assertEqual(result.errors, [], result.log)
    test.assertEqual(result.answers["notes"], [])
