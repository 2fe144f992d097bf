"""Work and tool offsets that change while a frame is active: what is stopped, and what to write instead."""

import unittest

import pytest

import harness
from test_operation import KNOWN, OFF, Case, programs, run

pytestmark = pytest.mark.thorough

MACHINE = {("FRAMEPATH", "TOOL_LENGTH"): "machine"}
BY_PARAMETER = {("KINS", "KINEMATICS"): "framekins coordinates=XYZ tool_length=machine"}
SET = "setp framekins.tool-length-machine 1\n"
LINKED = "net upright => framekins.tool-length-machine\nsets upright 1\n"


def before_guard(lines):
    """Puts lines in front of frame_guard."""
    return lambda text: text.replace("loadusr -Wn frame-guard", f"{lines}loadusr -Wn frame-guard")


class ToolLengthAlongTheMachine(Case):
    TILT, LENGTH = "o<rot> call [30] [0] [0]\n", "T2 M6 G43\n"
    TEXTS = {
        "tilted": TILT + LENGTH + "G1 X-60\n",
        "refreshed": TILT + LENGTH + "o<frame_refresh> call\nG1 X-10 Y0 Z0\n",
        "shifted": "o<trans> call [0] [0] [30]\n" + LENGTH + "G1 X-10 Y0 Z0\n",
    }

    def check(self, **change):
        steps = []
        for name in self.TEXTS:
            steps += [["forget"], run(name), OFF, KNOWN, ["recall", name], ["note", f"{name} after"], ["mdi", "G49"],
                      ["mdi", "G53 G0 X0 Y0 Z0"]]
        texts = {name: text + "o<frame_off> call\nM2\n" for name, text in self.TEXTS.items()}
        result = harness.run(steps, programs(**texts), **change)
        self.fine(result)
        said = {name: "\n".join(result.answers[name]) for name in self.TEXTS}
        self.assertIn("tool offset has changed", said["tilted"])
        self.assertIn("tilts", said["tilted"])
        self.assertEqual((said["refreshed"], said["shifted"]), ("", ""))
        # 20 mm of tool, upright
        self.at(result, "refreshed after", (-10, 0, 20))
        self.at(result, "shifted after", (-10, 0, 50))

    def test_chosen_in_the_ini(self):
        self.check(ini=MACHINE)

    def test_chosen_where_framekins_is_loaded(self):
        self.check(ini=BY_PARAMETER)

    def test_chosen_by_the_pin(self):
        self.check(edit_hal=before_guard(SET))

    def test_chosen_by_a_net(self):
        self.check(edit_hal=before_guard(LINKED))


class PinsOfTheGuard(unittest.TestCase):
    def refused(self, lines, *words, ini=None):
        with self.assertRaises(RuntimeError) as caught:
            harness.run([], edit_hal=before_guard(lines), ini=ini, record=False)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("Traceback", str(caught.exception))

    def test_what_it_sets_is_not_linked(self):
        self.refused(LINKED, "framekins.tool-length-machine is linked", "[FRAMEPATH]TOOL_LENGTH = machine", ini=MACHINE)
        self.refused("net mine => framekins.release-on-abort\n", "framekins.release-on-abort is linked", "CLEAR_ON_ABORT")

    def test_what_it_links_is_not_linked(self):
        self.refused("net mine => framekins.release\n", "framekins.release is linked", "take that net away")


class StartupCode(Case):
    """LinuxCNC's status does not have the work offset of its startup code."""

    CODE = "G17 G21 G40 G49 G54 G61.1 G80 G90 G94 G10 L2 P1 X10"
    FRAME = "G90 G17 G61.1\no<trans> call [1] [2] [0]\nG1 X5 Y0 F600\n"

    def test_its_work_offset_is_no_change(self):
        texts = {"stays": self.FRAME, "changes": self.FRAME + "G10 L2 P1 X20\nG1 X6\nM66 E0 L0\n"}
        steps = []
        for name in texts:
            steps += [["forget"], run(name), ["note", name], OFF, KNOWN, ["recall", name]]
        result = harness.run(steps, programs(**{name: text + "o<frame_off> call\nM2\n" for name, text in texts.items()}),
                             ini={("RS274NGC", "RS274NGC_STARTUP_CODE"): self.CODE})
        self.fine(result)
        said = {name: "\n".join(result.answers[name]) for name in texts}
        self.assertEqual(said["stays"], "")
        self.assertIn("work offset has changed", said["changes"])


class BehindOneCommand(Case):
    """A work offset or G92 that changes directly behind the only command for frames, between two looks of frame_guard."""

    TEXTS = {
        "chosen": "G54\no<rot> call [0] [0] [90]\nG55\nG1 X-60 Y5\n",
        "set": "G54\no<rot> call [0] [0] [90]\nG10 L2 P1 X1\nG1 X-60 Y5\nM66 E0 L0\n",
        "g92": "G54\no<rot> call [0] [0] [90]\nG92 X7\nG1 X-60 Y5\nM66 E0 L0\n",
        "refreshed": "G55\no<rot> call [0] [0] [90]\nG54\no<frame_refresh> call\nG55\nG1 X-60 Y5\n",
    }

    def test_it_is_noticed(self):
        steps: list[list] = [["mdi", "G10 L2 P2 X100 Y0 Z0 R0"]]
        names = [f"{name} {turn}" for turn in range(6) for name in self.TEXTS]
        for name in names:
            # an abort may leave LinuxCNC's status with an offset that its interpreter does not have
            steps += [["forget"], run(name.split()[0]), OFF, KNOWN, ["sleep", 0.1], ["recall", name],
                      ["mdi", "G54 G92.1"], ["mdi", "G10 L2 P1 X0 Y0 Z0"], ["mdi", "G53 G0 X0 Y0 Z0"]]
        result = harness.run(steps, programs(**{name: f"{text}o<frame_off> call\nM2\n" for name, text in self.TEXTS.items()}))
        self.fine(result)
        for name in names:
            self.assertIn("work offset has changed", "\n".join(result.answers[name]), name)

    def test_what_an_abort_leaves_is_told_anew(self):
        # the second time the status has G55 of the first, where the interpreter is back in G54 and finds nothing to do
        steps: list[list] = [["mdi", "G10 L2 P2 X100 Y0 Z0 R0"]]
        for turn in range(8):
            steps += [["forget"], run("chosen"), OFF, KNOWN, ["sleep", 0.1], ["recall", str(turn)]]
        result = harness.run(steps, programs(chosen=self.TEXTS["chosen"] + "M2\n"))
        self.fine(result)
        for turn in range(8):
            self.assertIn("work offset has changed", "\n".join(result.answers[str(turn)]), turn)


class TouchingOff(Case):
    FRAME = "o<rot> call [0] [0] [90]\no<ascale> call [2] [2] [2]\nG0 X10 Y20 Z5\n"
    END = "M66 E0 L0\n(DEBUG, AT #<_x> #<_y> #<_z>)\nG0 X0 Y0 Z0\n"

    def test_between_suspend_and_resume(self):
        ends = {"g10": "G10 L20 P1 X0 Y0 Z0\n", "g92": "G92 X0 Y0 Z0\n"}
        texts = {name: f"{self.FRAME}o<frame_suspend> call\n{words}o<frame_resume> call\n{self.END}"
                       "o<frame_off> call\nG10 L2 P1 X0 Y0 Z0\nG92.1\nM2\n" for name, words in ends.items()}
        steps = []
        for name in texts:
            steps += [["mdi", "G53 G0 X0 Y0 Z0"], run(name), ["note", name]]
        result = harness.run(steps, programs(**texts))
        self.fine(result)
        places = [[float(word) for word in words.split()[1:]] for _, words in result.messages if words.startswith("AT")]
        self.assertEqual(len(places), 2)
        for place in places:
            for coordinate in place:
                self.assertAlmostEqual(coordinate, 0, places=5)
        for name in texts:
            # where it was touched off
            self.at(result, name, (-40, 20, 10))

    def test_otherwise_it_is_stopped_with_the_way(self):
        steps = []
        texts = {"g10": "G10 L20 P1 X0 Y0 Z0\n", "g92": "G92 X0 Y0 Z0\n"}
        for name in texts:
            steps += [["forget"], run(name), OFF, KNOWN, ["sleep", 0.1], ["recall", name], ["mdi", "G92.1"],
                      ["mdi", "G10 L2 P1 X0 Y0 Z0"]]
        result = harness.run(steps, programs(**{name: f"{self.FRAME}{words}G1 X-60\nM2\n" for name, words in texts.items()}))
        self.fine(result)
        for name in texts:
            said = "\n".join(result.answers[name])
            self.assertIn("work offset has changed", said, name)
            self.assertIn("o<frame_suspend> before it and o<frame_resume> behind it", said, name)

    def test_what_outlives_its_frame_is_told_and_holds_a_program_once(self):
        frame = [["mdi", "G53 G0 X10 Y20"], ["mdi", "o<rot> call [0] [0] [90]"], ["forget"]]
        touched = [["touch_off", "X0 Y0"], ["sleep", 0.1]]
        start = [["forget"], ["start", "PROGRAMS/part.ngc"], ["sleep", 0.5], ["finish"]]
        back = [["mdi", "G10 L2 P1 X0 Y0 Z0"]]
        result = harness.run([
            *frame, *touched, ["switch_mode", "auto"], OFF, KNOWN, ["sleep", 0.1], ["recall", "gone"], *start,
            ["recall", "held"], ["note", "held place"], *start, ["recall", "meant"], *back,
            *frame, *touched, ["abort"], OFF, KNOWN, ["sleep", 0.1], ["recall", "aborted"], *back, *start, ["recall", "anew"],
            # taken over, or put back as it was
            *frame, *touched, ["mdi", "o<frame_refresh> call"], ["switch_mode", "auto"], OFF, KNOWN, *start,
            ["recall", "refreshed"],
            *back, *frame, *touched, *back, ["switch_mode", "auto"], OFF, KNOWN, *start, ["recall", "back"],
        ], programs(part="G1 X15 Y0 F600\nM2\n"))
        self.fine(result)
        for name in ("gone", "aborted"):
            self.assertIn("was set in a frame that is gone now", "\n".join(result.answers[name]), name)
        self.assertIn("was touched off in a frame that is gone", "\n".join(result.answers["held"]))
        # G10 L20 has set the zero to X20 Y-10: it has hardly begun to go there
        self.assertGreater(result.answers["held place"]["joints"][1], 15)
        for name in ("meant", "anew", "refreshed", "back"):
            self.assertEqual(result.answers[name], [], name)

    def steps(self, touched, follower, *between):
        """A name, and steps in MDI: a frame, what is set in it, a command for frames."""
        name = f"{touched}, {follower}"
        before = ("G54", "G92.1", "G10 L2 P1 X0 Y0 Z0 R0", "G10 L2 P2 X0 Y0 Z0", "o<rot> call [0] [0] [90]")
        return name, [*(["mdi", line] for line in before), ["forget"],
                      *(["mdi", line] for line in (touched, *between, follower)), ["sleep", 0.2], KNOWN,
                      ["mdi", "o<frame_off> call"], OFF, ["recall", name]]

    def test_no_command_for_frames_takes_it_over(self):
        wrong = dict([self.steps("G10 L20 P1 X5", follower) for follower in (
            "o<frame_off> call", "o<arot> call [0] [0] [1]", "T1 M6", "G79 Z1", "o<tool_centre_off> call")] + [
                self.steps("G92 X5", "o<rot> call [0] [0] [45]"), self.steps("G10 L20 P2 X5", "o<frame_off> call"),
                self.steps("G10 L2 P1 R10", "o<frame_off> call")])
        right = dict([self.steps("G10 L2 P1 X5", "o<frame_off> call", "o<frame_refresh> call"),
                      self.steps("G55", "o<frame_off> call"), self.steps("G55", "o<rot> call [0] [0] [45]"),
                      self.steps("o<frame_suspend> call", "o<arot> call [0] [0] [1]", "G10 L20 P1 X5", "o<frame_resume> call")])
        result = harness.run([step for steps in (wrong | right).values() for step in steps])
        self.fine(result)
        for name in wrong:
            self.assertIn("a work offset or G92 was set while a frame was active", "\n".join(result.answers[name]), name)
        for name in right:
            self.assertEqual(result.answers[name], [], name)


if __name__ == "__main__":
    unittest.main()
