"""A frame does not outlive its program, nor frame_guard; a net that is missing is no wrong frame."""

import itertools
import unittest
from typing import ClassVar

import pytest

import harness
from screen_checks import READS_IN_AUTO
from test_gcode import QUICK
from test_operation import OFF, ON, Case, clearing, programs

# isort: split
# test_operation has put its folder into the path
from frame_offsets import Offsets

#: servo periods in which a frame is gone: behind an error, an abort, machine off; behind the end under a screen
AT_ONCE, UNDER_A_SCREEN = 10, 50

#: seconds from the last sign of life to the hold, and servo periods from there to the rest
HELD, REST = 3.0, 1000

#: the interpreter has its position without the frame
KNOWN = ["expect", "framekins.hold", "FALSE"]

#: what is recorded beside the joints, from signals of the sample
WATCHED = {"command": ("conv-float-s32.0", "frame-command"), "in_position": ("conv-bit-s32.0", "motion-in-position"),
           "on": ("conv-bit-s32.1", "motion-on"), "teleop": ("conv-bit-s32.2", "motion-teleop"),
           "held": ("conv-bit-s32.3", "frame-hold"), "beat": ("conv-u32-s32.0", "frame-guard-heartbeat")}
WATCH = ("loadrt conv_float_s32\nloadrt conv_bit_s32 count=4\nloadrt conv_u32_s32\nloadrt timedelta\n"
         "addf timedelta.0 servo-thread\n" + "".join(
             f"net {net} => {converter}.in\naddf {converter} servo-thread\n" for converter, net in WATCHED.values()))
#: nanoseconds since the period before
TOOK = {"took": "timedelta.0.out"}

REFUSED = "G0 X0 Y0 Z5\no<trans> call [10] [0] [0]\nG1 X10 F1000\no<scale> call [0] [1] [1]\nG1 X20\nM2\n"


def watched(steps, texts, ini=None, **options):
    return harness.run(steps, programs(**texts), ini={**QUICK, **(ini or {})}, hal=WATCH,
                       integers={name: f"{converter}.out" for name, (converter, _) in WATCHED.items()} | TOOK, **options)


def rows_of(flags):
    """The lengths of the rows of periods in which something holds."""
    return [sum(1 for _ in row) for flag, row in itertools.groupby(flags, bool) if flag]


def listened(result, first, last):
    """Seconds in which the guard could be heard between two periods. On a loaded machine periods come late and then in a hurry:
    one that was slept through counts as one, those that make up for it count what they took."""
    took = result.column("took")
    if max(took) <= 0:
        raise AssertionError("timedelta does not tell what periods took")
    return sum(min(nanoseconds, 1e6) for nanoseconds in took[first:last]) * 1e-9


def silences(result):
    """How long the heartbeat was not heard each time, in seconds."""
    beats = result.column("beat")
    heard = [n for n in range(1, len(beats)) if beats[n] != beats[n - 1]]
    return [listened(result, first, last) for first, last in itertools.pairwise([0, *heard, len(beats)])]


def longest(flags):
    """The longest row of periods in which something holds."""
    return max(rows_of(flags), default=0)


def at_switches(result):
    """The greatest travel of a joint at any change of the frame: from its request on where it goes, which may be in the
    period behind a stop; up to the change where it comes, behind which the program moves on."""
    joints = list(zip(*(result.column(f"joint.{n}") for n in range(3)), strict=True))
    slots = result.column("slot")
    worst = 0.0
    for n in range(3, len(slots) - 3):
        if slots[n] != slots[n - 1]:
            first, last = (n - 1, n + 3) if slots[n] == 0 else (n - 3, n)
            worst = max(worst, *(abs(a - b) for a, b in zip(joints[first], joints[last], strict=True)))
    return worst


class EndOfAFrame(Case):
    def gone_at_once(self, result):
        """A frame that has to go, with the machine at rest, goes."""
        rows = result.columns("slot", "command", "on", "in_position")
        self.assertTrue(any(slot for slot, *_ in rows))
        worst = longest(slot and (not command or not on) and still for slot, command, on, still in rows)
        self.assertLessEqual(worst, AT_ONCE)
        self.assertLess(at_switches(result), 1e-9)

    def test_a_refused_frame_and_touch_off_behind_it(self):
        steps = [["forget"]]
        for number in range(8):
            steps += [["run_as_a_screen", "PROGRAMS/refused.ngc"], OFF, KNOWN, ["touch_off", "X0"],
                      ["note", f"touched {number}"], ["mdi", "G10 L2 P1 X0"], ["switch_mode", "auto"]]
        result = watched([*steps, ["recall", "errors"], OFF], {"refused": REFUSED})
        self.fine(result)
        self.assertIn("frame was refused", "\n".join(result.answers["errors"]))
        self.assertNotIn("put back", "\n".join(result.answers["errors"]))
        for number in range(8):
            self.at(result, f"touched {number}", (20, 0, 5), (20, 0, 5))
            self.assertAlmostEqual(result.answers[f"touched {number}"]["g5x_offset"][0], 20, places=6)
        self.gone_at_once(result)

    def test_the_end_of_a_program_under_a_screen(self):
        steps = []
        for _ in range(12):
            steps += [["run_as_a_screen", "PROGRAMS/leave.ngc"], ["sleep", 0.3], OFF]
        result = watched([*steps, ["note", "end"], ["mdi", "G0 X1"], ["note", "moved"]],
                         {"leave": "o<trans> call [10] [20] [0]\nG0 X1 Y2 Z3\nM2\n"})
        # LinuxCNC says it of frame_guard's reading, if it comes to it behind the next start: that has read the position itself
        result.errors = [error for error in result.errors if not error.startswith(READS_IN_AUTO)]
        self.fine(result)
        self.at(result, "end", (11, 22, 3), (11, 22, 3))
        self.at(result, "moved", (1, 22, 3), (1, 22, 3))
        rows = result.columns("slot", "teleop", "held")
        # user space leaves teleop: on a loaded machine it may be late at times
        late = [n for n in rows_of(slot and teleop for slot, teleop, _ in rows) if n > UNDER_A_SCREEN]
        self.assertLessEqual(len(late), 3, late)
        self.assertLess(at_switches(result), 1e-9)
        # the machine is free again
        self.assertFalse(result.column("held")[-1])

    def test_abort_and_machine_off_in_motion(self):
        steps = []
        for end in (["abort"], ["machine_off"], ["estop"]):
            steps += [["start", "PROGRAMS/long.ngc"], ON, ["wait_moving"], ["sleep", 0.2], end, OFF, ["on"], KNOWN,
                      ["switch_mode", "mdi"], ["mdi", "G0 Y0"], ["mdi", "G0 X0"]]
        result = watched([*steps, ["note", "end"]], {"long": "o<trans> call [10] [20] [0]\nG1 X1 Y2\nG1 X400\nM2\n"})
        self.fine(result)
        self.at(result, "end", (0, 0, 0), (0, 0, 0))
        self.gone_at_once(result)

    def test_in_teleop_with_the_machine_off(self):
        result = watched([["mdi", "o<trans> call [0] [50] [0]"], ["mdi", "G0 X1 Y2"], ["teleop", True], ["machine_off"],
                          OFF, ["sleep", 0.2], ["note", "off"], ["on"], ["jog_along", 0, 20, 5], ["note", "jogged"]], {})
        self.fine(result)
        self.at(result, "off", (1, 52, 0), (1, 52, 0))
        for key in ("joints", "position"):
            for got, wanted in zip(result.answers["jogged"][key][:3], (6, 52, 0), strict=True):
                self.assertAlmostEqual(got, wanted, delta=1e-3)

    def test_a_jog_is_not_disturbed(self):
        # LinuxCNC refuses another mode while it jogs, and says so each time
        result = watched([["mdi", "o<trans> call [0] [50] [0]"], ["mdi", "G0 X1 Y2"], ["teleop", True], ["jog", 0, 10, 20],
                          ["force", "framekins.command", 0], ["sleep", 1], ON, ["wait_place", 0, 20.99], OFF,
                          ["sleep", 0.3], ["note", "end"]], {})
        self.fine(result)
        for key in ("joints", "position"):
            for got, wanted in zip(result.answers["end"][key][:3], (21, 52, 0), strict=True):
                self.assertAlmostEqual(got, wanted, delta=1e-3)
        self.assertLess(at_switches(result), 1e-6)

    def test_a_program_that_starts_too_early_does_not_move(self):
        # the interpreter still has the position in the frame: its first move would go somewhere else
        steps: list[list] = [["mdi", "G0 X0 Y7 Z3"], ["open", "PROGRAMS/part.ngc"], ["forget"]]
        for _ in range(3):
            steps += [["start", "PROGRAMS/part.ngc"], ON, ["wait_place", 0, 15], ["guard", "STOP"], ["abort"], OFF,
                      ["cycle_start"], ["sleep", 0.3], ["guard", "CONT"], ["sleep", 0.5], KNOWN, ["finish"]]
        result = watched([*steps, ["recall", "errors"], OFF],
                         {"part": "G1 X5\no<trans> call [10] [20] [0]\nG1 X1\nG1 X400 F600\nM2\n"})
        self.fine(result)
        self.assertEqual(sum("start the program again" in text for text in result.answers["errors"]), 3)
        y = result.column("joint.1")
        y = y[next(n for n, place in enumerate(y) if abs(place - 7) < 1e-9):]
        self.assertLess(max(y) - min(y), 1e-9)


@pytest.mark.thorough
class BehindAProgram(Case):
    """What is given right behind the end of a program with a frame: it is done, or the operator is told that it was not."""

    PROGRAM: ClassVar = {"part": "o<rot> call [0] [0] [0]\nG0 X1 Z0\nG1 X2 F3000\nM2\n"}
    #: s behind the end
    DELAYS = tuple(0.004 * n for n in range(20))

    def lost(self, step, joint, place):
        """Of how many nothing came, of which none may be lost without a word."""
        steps: list[list] = []
        for delay in self.DELAYS:
            name = f"{delay:.3f}"
            steps += [["forget"], [step[0], "PROGRAMS/part.ngc", delay, *step[1:]], ["recall", f"{name} said"], ["note", name]]
        result = watched(steps, self.PROGRAM)
        self.fine(result)
        lost = 0
        for delay in self.DELAYS:
            name = f"{delay:.3f}"
            if abs(result.answers[name]["joints"][joint] - place) > 1e-3:
                lost += 1
                self.assertIn("give it again", "\n".join(result.answers[f"{name} said"]), name)
        return lost

    def test_a_line_of_mdi(self):
        self.assertLessEqual(self.lost(["mdi_behind", "G0 X20"], 0, 20), 4)

    def test_a_jog(self):
        self.assertLessEqual(self.lost(["jog_behind", 2, 50, 5], 2, 5), 4)


class WorkOffsets(Case):
    def test_one_that_is_set_while_a_frame_has_to_go_is_put_back(self):
        # without the net motion is never seen to stand, and the frame cannot go
        result = watched([
            ["mdi", "G10 L2 P1 X3"], ["mdi", "o<trans> call [10] [0] [0]"], ["mdi", "G0 X5"], ["note", "frame"], ["forget"],
            ["force", "framekins.in-position", 0], ["abort"], ["sleep", 2], ON, ["recall", "stays"], ["forget"],
            ["touch_off", "X0"], ["note", "wrong"], ["setp", "framekins.in-position", 1], OFF, ["sleep", 0.5],
            ["recall", "errors"], ["note", "back"], ["mdi", "G0 X5"], ["note", "moved"]], {})
        self.fine(result)
        self.assertIn("framekins does not remove it", "\n".join(result.answers["stays"]))
        self.at(result, "frame", (18, 0, 0))
        self.assertAlmostEqual(result.answers["wrong"]["g5x_offset"][0], 8, places=6)
        self.assertIn("put back", "\n".join(result.answers["errors"]))
        self.assertAlmostEqual(result.answers["back"]["g5x_offset"][0], 3, places=6)
        self.at(result, "back", (18, 0, 0))
        self.at(result, "moved", (8, 0, 0))
        self.assertLess(at_switches(result), 1e-9)


    def test_one_that_is_set_is_noticed_behind_a_refused_command_too(self):
        # which has sent it along
        result = harness.run([["mdi", "G10 L2 P2 X50 Y0"], ["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G0 X10"],
                              ["mdi", "G55"], ["forget"], ["mdi", "o<ascale> call [0] [1] [1]"], ["mdi", "G1 X20 Y0 F600"], ["sleep", 0.1],
                              ["recall", "errors"], ["note", "end"], ["mdi", "o<frame_off> call"], ["mdi", "G10 L2 P2 X0 Y0"],
                              ["mdi", "G54"], OFF], programs(), ini={**QUICK, **clearing(1, 1, 0)})
        self.fine(result)
        self.assertIn("the work offset has changed while a frame is active", "\n".join(result.answers["errors"]))
        self.assertLess(result.answers["end"]["joints"][1], 40)


class Status:
    """LinuxCNC's status as far as offsets are concerned."""

    def __init__(self, **values):
        self.g5x_index, self.rotation_xy, self.axis_mask, self.program_units = 1, 0.0, 0b111, 2
        self.g5x_offset, self.g92_offset = (0.0,) * 9, (0.0,) * 9
        self.__dict__.update(values)


class PutBack(unittest.TestCase):
    def test_another_offset_that_is_chosen_is_not_one_that_is_set(self):
        before = Offsets(Status())
        set_x = Status(g5x_offset=(5.0,) + (0.0,) * 8)
        self.assertTrue(Offsets(set_x).was_set_since(before))
        self.assertTrue(Offsets(Status(rotation_xy=1.0)).was_set_since(before))
        self.assertFalse(Offsets(Status(g5x_index=2, g5x_offset=set_x.g5x_offset)).was_set_since(before))
        self.assertFalse(Offsets(Status()).was_set_since(before))
        self.assertTrue(Offsets(Status(g92_offset=set_x.g5x_offset)).was_shifted_since(before))
        self.assertFalse(Offsets(set_x).was_shifted_since(before))

    def test_the_command_is_in_the_units_of_the_program(self):
        status = Status(g5x_index=3, g5x_offset=(25.4, -5.08, 0.0, 30.0, 7.0, -45.0, 0.0, 0.0, 0.0), rotation_xy=12.5,
                        axis_mask=0b101111, program_units=1)
        self.assertEqual(Offsets(status).command(status, 1.0), "G10 L2 P3 X1.000000000 Y-0.200000000 Z0.000000000 "
                         "A30.000000000 C-45.000000000 R12.500000000")
        # a machine in inches, a program in millimetres
        status = Status(g5x_offset=(1.0,) + (0.0,) * 8)
        self.assertTrue(Offsets(status).command(status, 1 / 25.4).startswith("G10 L2 P1 X25.400000000 "))


@pytest.mark.thorough
class Dead(Case):
    LONG: ClassVar = {"long": "o<trans> call [10] [20] [0]\nG1 X1 Y2\nG1 X400 F1800\nM2\n",
                      "dwell": "o<trans> call [10] [20] [0]\nG1 X1 Y2\nG4 P1000\nG1 X400\nM2\n"}

    def at_rest_in_time(self, result, acceleration=1.05 * 20000):
        """From the last beat on: held, and at rest in time, no harder than the machine brakes."""
        beats = result.column("beat")
        last = max(n for n in range(1, len(beats)) if beats[n] != beats[n - 1])
        held = result.column("held").index(1, last)
        self.assertLess(listened(result, last, held), HELD)
        x = result.commanded(0)
        moving = [n for n in range(last + 2, len(x)) if abs(x[n] - x[n - 1]) > 1e-7]
        self.assertLess(max(moving, default=held) - held, REST)
        worst = max(abs(x[n + 1] - 2 * x[n] + x[n - 1]) for n in range(last, len(x) - 1)) * 1e6
        self.assertLess(worst, acceleration)
        y = result.column("joint.1")[last:]
        self.assertLess(max(y) - min(y), 1e-9)

    def test_killed_in_a_move(self):
        result = watched([["start", "PROGRAMS/long.ngc"], ON, ["wait_place", 0, 30], ["forget"], ["guard", "KILL"], OFF,
                          ["sleep", 1], ["recall", "errors"], ["note", "dead"]], self.LONG)
        self.fine(result)
        self.at_rest_in_time(result)
        self.assertIn("frame_guard does not live any more", "\n".join(result.answers["errors"]))
        self.assertLess(result.answers["dead"]["joints"][0], 400)
        self.at(result, "dead", result.answers["dead"]["position"][:3])

    def test_a_dead_one_leaves_the_machine_without_frames(self):
        result = watched([["mdi", "o<trans> call [10] [20] [0]"], ["mdi", "G0 X1 Y2"], ["guard", "KILL"], OFF, ["forget"],
                          ["on"], ["jog_along", 2, 20, 5], ["note", "jogged"], ["mdi", "G0 X3"], ["note", "moved"],
                          ["mdi", "o<trans> call [1] [1] [1]"], ["recall", "errors"], OFF], {}, ini=clearing(1, 1, 0))
        self.assertIsNone(result.failure, result.log)
        self.at(result, "moved", (3, 22, result.answers["jogged"]["joints"][2]))
        self.assertIn("frame_guard does not live", "\n".join(result.answers["errors"]))

    def test_killed_in_a_dwell(self):
        # the frame stays while the program may go on
        result = watched([["start", "PROGRAMS/dwell.ngc"], ON, ["sleep", 0.5], ["forget"], ["guard", "KILL"], OFF,
                          ["sleep", 0.5], ["recall", "errors"], ["note", "dead"]], self.LONG)
        self.fine(result)
        rows = result.columns("slot", "on")
        gone = max(n for n in range(1, len(rows)) if rows[n - 1][0] and not rows[n][0])
        self.assertFalse(rows[gone - 1][1])
        self.at(result, "dead", (11, 22, 0), (11, 22, 0))

    @pytest.mark.thorough
    def test_others_never_wait_for_it(self):
        # killed with HAL's lock, it would leave halcmd, screens and LinuxCNC's own end waiting for ever
        result = watched([["start", "PROGRAMS/long.ngc"], ON, ["stop_guard_often", 1200], ["abort"], OFF], self.LONG)
        # a busy computer may keep it silent for so long that the machine is held, and says so
        self.assertIsNone(result.failure, result.log)

    def test_stopped_and_resumed(self):
        result = watched([["start", "PROGRAMS/long.ngc"], ON, ["wait_place", 0, 30], ["forget"], ["guard", "STOP"],
                          ["expect", "framekins.hold", "TRUE"], ["guard", "CONT"], ["recall", "late"],
                          ["wait_place", 0, 100], ["abort"], OFF, ["sleep", 0.3],
                          # for longer: the machine goes off, and comes back with frames
                          ["start", "PROGRAMS/long.ngc"], ON, ["wait_place", 0, 30], ["guard", "STOP"], OFF,
                          ["sleep", 1], ["guard", "CONT"], ["sleep", 0.5], ["recall", "lost"], ["on"],
                          ["mdi", "o<trans> call [10] [0] [0]"], ["mdi", "G0 X1 Y2"], ["note", "end"]], self.LONG)
        self.fine(result)
        self.assertIn("the machine is held", "\n".join(result.answers["late"]))
        self.assertIn("does not live any more", "\n".join(result.answers["lost"]))
        self.at(result, "end", (11, 2, 0), (1, 2, 0))

    def test_jogging_in_a_frame(self):
        result = watched([["mdi", "o<rot> call [0] [0] [90]"], ["mdi", "G0 X0 Y0"], ["teleop", True], ["guard", "STOP"],
                          ["jog", 0, 10, 300], OFF, ["sleep", 0.5], ["note", "dead"]], {}, ini=clearing(1, 1, 0))
        self.assertIsNone(result.failure, result.log)
        self.assertIn("does not live any more", "\n".join(result.errors))
        self.assertLess(result.answers["dead"]["joints"][1], 30)
        self.at(result, "dead", result.answers["dead"]["position"][:3])


class Living(Case):
    def test_it_beats_while_it_waits_for_linuxcnc(self):
        # in teleop the guard has to ask the task for another mode, which does not answer for four seconds
        result = watched([["mdi", "o<trans> call [10] [20] [0]"], ["teleop", True], ["sleep", 0.2], ["task", "STOP"],
                          ["force", "framekins.command", 0], ["sleep", 4], ON, ["task", "CONT"], OFF,
                          ["sleep", 0.3], ["note", "end"]], {})
        self.fine(result)
        self.assertLess(max(silences(result)), 1)
        rows = result.columns("slot", "on", "teleop")
        self.assertTrue(all(on for slot, on, _ in rows if slot))
        # the frame was in force all the while
        self.assertGreater(sum(1 for slot, _, teleop in rows if slot and teleop), 3000)
        self.at(result, "end", (0, 0, 0), (0, 0, 0))

    def test_it_can_be_loaded_again(self):
        result = watched([["mdi", "o<trans> call [10] [0] [0]"], ["halcmd", "unloadusr", "frame-guard"], OFF, ["on"],
                          ["halcmd", "loadusr", "-Wn", "frame-guard", "../../subroutines/frame_guard.py"], ["forget"],
                          ["mdi", "o<trans> call [10] [0] [0]"], ["mdi", "G0 X1"], ["note", "end"], ["abort"], OFF],
                         {}, record=False)
        self.assertIsNone(result.failure, result.log)
        self.at(result, "end", (11, 0, 0), (1, 0, 0))


class Nets(Case):
    ENABLED = "setp axis.y.eoffset-enable 1\n"
    NET = "net external-offset-y axis.y.eoffset => framekins.external-offset.y"

    def test_each_that_is_missing_is_named(self):
        missing = {"framekins.value.1": "frame-value-1", "framekins.value.2": "frame-value-2",
                   "framekins.value.3": "frame-value-3", "framekins.work-offset.x": "frame-work-x",
                   "framekins.work-offset.y": "frame-work-y", "framekins.work-offset.z": "frame-work-z",
                   "framekins.work-offset.rotation": "frame-work-r", "framekins.check": "frame-check"}
        steps: list[list] = [["mdi", "G10 L2 P1 X1 Y2 Z3 R4"], ["mdi", "G54"]]
        for pin, net in missing.items():
            steps += [["force", pin, 0], ["forget"], ["mdi", "o<trans> call [10] [5] [1]"], ["sleep", 0.05],
                      ["recall", pin], OFF, ["halcmd", "net", net, pin]]
        result = harness.run([*steps, ["mdi", "o<trans> call [10] [5] [1]"], ON, ["mdi", "o<frame_off> call"],
                              ["mdi", "G10 L2 P1 X0 Y0 Z0 R0"]], ini=QUICK)
        self.fine(result)
        for pin, net in missing.items():
            text = "\n".join(result.answers[pin])
            self.assertIn(f"net {net} motion.analog-out-0", text, text)
            self.assertIn(f"=> {pin}", text)

    def test_swapped_ones_are_refused(self):
        result = harness.run([["halcmd", "unlinkp", "framekins.value.1"], ["halcmd", "unlinkp", "framekins.value.2"],
                              ["halcmd", "net", "frame-value-1", "framekins.value.2"],
                              ["halcmd", "net", "frame-value-2", "framekins.value.1"], ["forget"],
                              ["mdi", "o<trans> call [10] [5] [0]"], ["sleep", 0.05], ["recall", "errors"], OFF], ini=QUICK)
        self.fine(result)
        self.assertIn("net frame-value-1 motion.analog-out-01", "\n".join(result.answers["errors"]))

    def test_a_net_of_the_supervision_that_is_missing_is_told_at_the_start(self):
        result = harness.run([["sleep", 0.5], ["recall", "errors"]], ini=QUICK,
                             hal="unlinkp motion.enable\nunlinkp framekins.enabled\n")
        self.fine(result)
        text = "\n".join(result.answers["errors"])
        self.assertIn("net frame-guarded framekins.guarded => motion.enable", text)
        self.assertIn("net motion-on motion.motion-enabled => framekins.enabled", text)
        self.assertNotIn("motion.feed-inhibit", text)

    def test_one_that_is_missing_for_an_external_offset_is_told(self):
        # later ones need none
        old = not harness.HANDS_OVER_JERK
        for hal, is_told in (("", False), (self.ENABLED, old), (f"{self.ENABLED}{self.NET}\n", False),
                             ("net frame-hold => axis.y.eoffset-enable\n", old)):
            result = harness.run([["sleep", 0.3], ["recall", "errors"]], hal=hal, record=False)
            self.fine(result)
            said = "\n".join(result.answers["errors"])
            self.assertEqual(self.NET in said, is_told, (hal, said))
            self.assertEqual(said == "", not is_told, said)


if __name__ == "__main__":
    unittest.main()
