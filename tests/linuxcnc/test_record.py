"""framepath record in a real LinuxCNC: what it records, and that nothing of it stays in HAL."""

import csv
import itertools
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import pytest

import harness

pytestmark = pytest.mark.thorough

#: Its first move takes seconds, in which all others up to the dwell are queued, so that a busy computer rounds the same corners.
PROGRAM = """G21 G90 G64 P0.05 F300
G1 X10 Y5
G1 X40 F3000
G3 X50 Y15 J10
G1 Y40 Z-5
G4 P1
G1 X10 Y10 Z0
M2
"""
#: A dwell that is longer than what counts as the end where nobody knows of the program.
DWELL = "G21 F1000\nG1 X5\nG4 P7\nG1 X9\nM2\n"
DRIVER = [harness.TOOL, "record_driver.py"]
INI = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")


def run(steps, **more):
    return harness.run(steps, {"part.ngc": PROGRAM, "dwell.ngc": DWELL}, files=DRIVER, display="record_driver.py", **more)


def report(recording, ini):
    """What `framepath report` finds in a recording."""
    done = subprocess.run([harness.TOOL, "report", "--recording", recording, "--ini", ini, "--json"], capture_output=True,
                          text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


def rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Folder(unittest.TestCase):
    """With a folder that LinuxCNC, which runs as another user, may write to."""

    folder: tempfile.TemporaryDirectory

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        os.chmod(cls.folder.name, 0o777)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)


class Record(Folder):
    """On the sample as it is: no halui, joints linked, axes not."""

    reference: harness.Result
    result: harness.Result

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        path = cls.path
        # what the tests' own recorder says, which needs sampler for itself
        reference = run([["wiring", "before"], ["record", "refused", "--output", path("refused.csv")], ["end", "refused"],
                         ["wiring", "after"], ["run", "PROGRAMS/part.ngc"]])
        cls.reference = reference
        harness.write_csv(reference, path("reference.csv"))
        cls.result = run([
            ["wiring", "before"], ["memory", "first"],
            ["record", "killed", "--output", path("killed.csv")], ["sleep", 0.5], ["end", "killed", "KILL"],
            ["wait_unread"], ["wiring", "left"],
            ["record", "whole", "--output", path("whole.csv"), "--until-done"],
            ["record", "second", "--output", path("second.csv")], ["end", "second"],
            ["run", "PROGRAMS/part.ngc"], ["end", "whole"], ["wiring", "recovered"],
            ["record", "short", "--output", path("short.csv"), "--seconds", "0.5"], ["end", "short"],
            ["record", "interrupted", "--output", path("interrupted.csv")], ["sleep", 0.5], ["end", "interrupted", "INT"],
            ["record", "terminated", "--output", path("terminated.csv")], ["sleep", 0.5], ["end", "terminated", "TERM"],
            ["memory", "fourth"],
            ["record", "lost", "--output", path("lost.csv"), "--buffer", "0.1"], ["stop_reading", 1], ["sleep", 0.3],
            ["end", "lost", "INT"], ["memory", "last"],
            ["record", "unwritable", "--output", "/dev/full"], ["end", "unwritable"],
            ["record", "unread", "--output", path("unread.csv")], ["sleep", 0.3], ["end_reading"], ["end", "unread"],
            ["wiring", "after"],
        ], record=False)

    def test_the_scenarios_come_to_their_end(self):
        for result in (self.reference, self.result):
            self.assertIsNone(result.failure, result.log)
            self.assertEqual(result.errors, [], result.log)

    def test_a_sampler_of_others_is_left_to_them(self):
        answers = self.reference.answers
        self.assertEqual(answers["refused"]["status"], 1)
        self.assertIn("the component sampler is in use", answers["refused"]["err"])
        self.assertFalse(os.path.exists(self.path("refused.csv")))
        self.assertEqual(answers["before"], answers["after"])

    def test_the_report_says_the_same_as_of_the_tests_recorder(self):
        ours, reference = (report(self.path(name), INI) for name in ("whole.csv", "reference.csv"))
        for key in ("machine", "verdict", "findings", "servo_period", "frame_changes", "gaps"):
            self.assertEqual(ours[key], reference[key], key)
        self.assertAlmostEqual(ours["path_length"], reference["path_length"], delta=1e-6)
        self.assertAlmostEqual(ours["time"]["in_motion"], reference["time"]["in_motion"], delta=0.01)
        for kind in ("joints", "axes"):
            self.assertEqual([member["name"] for member in ours[kind]], [member["name"] for member in reference[kind]])
            for member, other in zip(ours[kind], reference[kind], strict=True):
                for peak, same in zip(member["peaks"], other["peaks"], strict=True):
                    self.assertAlmostEqual(peak["peak"] / (same["peak"] or 1), 1 if same["peak"] else 0, delta=0.01)
                    self.assertEqual(peak["judgement"], same["judgement"])

    def test_the_lines_and_the_motions_are_those_of_the_program(self):
        lines = list(dict.fromkeys(int(row["line"]) for row in rows(self.path("whole.csv"))))
        self.assertEqual([line for line in lines if line], [2, 3, 4, 5, 7])
        ids = [int(row["id"]) for row in rows(self.path("whole.csv"))]
        self.assertEqual(ids, sorted(ids))

    def test_one_that_was_killed_is_taken_away_by_the_next(self):
        answers = self.result.answers
        left = [name for name, *_ in answers["left"]["signals"] if name.startswith("framepath-record")]
        self.assertIn("framepath-record", left)
        self.assertIn("sampler", answers["left"]["components"])
        self.assertNotIn("halsampler", str(answers["left"]["components"]))
        self.assertIn("taken away what a recording had left", answers["whole"]["err"])
        self.assertEqual(answers["recovered"], answers["before"])
        self.assertEqual(answers["whole"]["status"], 0)

    def test_nothing_stays_however_it_ends(self):
        answers = self.result.answers
        self.assertEqual(answers["after"], answers["before"])
        for name in ("short", "interrupted", "terminated"):
            self.assertEqual(answers[name]["status"], 0, answers[name])
            self.assertIn("servo cycles", answers[name]["out"])
        self.assertEqual(answers["unwritable"]["status"], 1)
        self.assertIn("/dev/full: cannot be written", answers["unwritable"]["err"])

    def test_somebody_else_ends_halsampler(self):
        unread = self.result.answers["unread"]
        self.assertEqual(unread["status"], 1)
        self.assertIn("the recording ends here because halsampler was ended by somebody else", unread["err"])
        self.assertGreater(len(rows(self.path("unread.csv"))), 100)

    def test_only_one_records_at_a_time(self):
        second = self.result.answers["second"]
        self.assertEqual(second["status"], 1)
        self.assertIn("framepath record runs already", second["err"])
        self.assertFalse(os.path.exists(self.path("second.csv")))

    def test_the_time_is_what_was_asked_for(self):
        times = [float(row["time"]) for row in rows(self.path("short.csv"))]
        self.assertEqual((times[0], times[-1], len(times)), (0.0, 0.5, 501))
        for before, after in itertools.pairwise(times):
            self.assertAlmostEqual(after - before, 0.001, delta=1e-9)

    def test_what_is_lost_is_said(self):
        lost = self.result.answers["lost"]
        self.assertEqual(lost["status"], 1, lost)
        self.assertRegex(lost["err"], r"\d+ servo cycles are missing in the recording")
        self.assertTrue(rows(self.path("lost.csv")))

    def test_hal_has_memory_for_many_recordings(self):
        (before, total), (last, _) = self.result.answers["fourth"], self.result.answers["last"]
        self.assertLess(last - before, 0.02 * total)


class WithOwnWiring(Folder):
    """A machine whose HAL uses much of what a recording takes, and with halui."""

    result: harness.Result

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        path = cls.path
        cls.result = run([
            ["wiring", "before"],
            ["record", "dwell", "--output", path("dwell.csv"), "--until-done"], ["run", "PROGRAMS/dwell.ngc"],
            ["end", "dwell"], ["wiring", "after"],
        ], record=False, ini={("HAL", "HALUI"): "halui"},
            hal="loadrt scale count=1\nnet mine axis.x.pos-cmd => scale.0.in\nnet line motion.program-line\n"
                "addf scale.0 servo-thread\n")

    def test_its_own_wiring_stays_as_it_was(self):
        self.assertIsNone(self.result.failure, self.result.log)
        self.assertEqual(self.result.answers["after"], self.result.answers["before"])

    def test_halui_says_when_the_program_has_ended(self):
        dwell = self.result.answers["dwell"]
        self.assertEqual(dwell["status"], 0, dwell)
        self.assertNotIn("halui is not loaded", dwell["err"])
        recorded = rows(self.path("dwell.csv"))
        self.assertAlmostEqual(float(recorded[-1]["axis.x"]), 9, delta=1e-9)
        # behind the dwell, and not long behind the end
        moving = [float(row["time"]) for row, last in zip(recorded[1:], recorded, strict=False)
                  if row["joint.0"] != last["joint.0"]]
        self.assertGreater(moving[-1] - moving[0], 7)
        self.assertLess(float(recorded[-1]["time"]) - moving[-1], 1)


class EndOfLinuxCNC(Folder):
    def test_the_recording_ends_with_it_and_is_there(self):
        name = self.path("last")
        result = run([["record_beyond", name, "--output", f"{name}.csv"], ["sleep", 0.5]], record=False, linger=6)
        self.assertIsNone(result.failure, result.log)
        self.assertIn("Shutting down and cleaning up LinuxCNC", result.log)
        self.assertNotIn("terminated with an error", result.log)
        with open(f"{name}.status", encoding="utf-8") as status, open(f"{name}.err", encoding="utf-8") as errors:
            self.assertEqual(status.read(), "1\n")
            self.assertIn("the recording ends here because LinuxCNC has ended", errors.read())
        self.assertGreater(len(rows(f"{name}.csv")), 300)


class WithoutLinuxCNC(unittest.TestCase):
    def test_there_is_nothing_to_record(self):
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o755)
            tool = shutil.copy(harness.TOOL, folder)
            done = subprocess.run([os.path.join(harness.HERE, "isolated"), harness.MODULES, tool, "record",
                                   "--output", "/dev/null"], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no LinuxCNC is running here", done.stderr)


if __name__ == "__main__":
    unittest.main()
