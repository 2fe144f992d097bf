"""Every promise of a planner towards LinuxCNC, with LinuxCNC's own planner and with blendtp; the table is printed. And those
that a frame could break, with a turned one on."""

import os
import re
import sys
import unittest

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "contract"))

import harness
import table
from overload import ATTEMPTS, is_overloaded
from row import all_rows

#: `contract/table.py --frame` has all of them
IN_A_FRAME = ("AbortOnThePath", "AtTheirMoves", "DistanceToGo", "ExternalOffsetInFrame", "FeedHold", "Index", "InPosition",
              "JogInFrame", "LimitsInFrame", "MachineOff", "OverrideInBlends", "PauseAndResume", "ProbingInFrame", "ReverseRun",
              "RigidTap", "RunFromLine", "SoftLimitInFrame", "Steps", "ThreadUnderScale", "TouchInFrame", "Velocity")


class Case(unittest.TestCase):
    def outcomes(self, names=None, **options):
        """Of all planners; what fails with ours where the computer is overloaded is run again."""
        found = table.outcomes(names, **options)
        for _ in range(ATTEMPTS - 1):
            late = [name for name, outcome in found[table.OURS].items() if not outcome.works]
            if not late or not is_overloaded():
                break
            print(f"failed on an overloaded computer, and run again: {late}")
            for planner, outcomes in table.outcomes(late, **options).items():
                found[planner].update(outcomes)
        return found

    def assert_kept(self, found, names):
        for name in names:
            with self.subTest(name):
                outcome = found[table.OURS][name]
                self.assertTrue(outcome.works, outcome.text)


class Contract(Case):
    def test_every_promise_with_blendtp(self):
        names = [row.name() for row in all_rows("plain")]
        self.assert_kept(self.outcomes(planners=(table.OURS,)), names)

    @pytest.mark.thorough
    def test_every_promise(self):
        found = self.outcomes()
        print("\n".join(table.lines(found)))
        self.assert_kept(found, [row.name() for row in all_rows("plain")])


@pytest.mark.thorough
class Framed(Case):
    def test_promises_in_a_turned_frame(self):
        found = self.outcomes(list(IN_A_FRAME), behind="frame", planners=(table.OURS,))
        self.assert_kept(found, IN_A_FRAME)


class Documents(unittest.TestCase):
    """README and docs/promises.md have the promises that there are, and count them rightly."""

    def setUp(self):
        self.readme, page = (self.text(name) for name in ("README.md", "docs/promises.md"))
        self.page, written = page.split("## Promise by promise")
        self.introduction, lines = written.split("|---|---|---|\n")
        rows = [line.strip("| ").split(" | ") for line in lines.splitlines() if not line.startswith("| **")]
        self.rows = {promise: (ours, stock) for promise, ours, stock in rows}

    def text(self, name):
        with open(os.path.join(harness.ROOT, name), encoding="utf-8") as file:
            return file.read()

    def outcomes(self, behind):
        """How many rows work with both planners, work better with blendtp, and fail with LinuxCNC's."""
        rows = [self.rows[row.promise()] for row in all_rows(behind)]
        fails = sum(stock.startswith("fails") for _, stock in rows)
        better = sum(ours.startswith("works better") for ours, stock in rows if not stock.startswith("fails"))
        return [len(rows) - fails - better, better, fails]

    def numbers(self, pattern, text):
        found = re.search(pattern, " ".join(text.split()))
        assert found, pattern
        return [int(number) for number in found.groups()]

    def test_the_table_has_the_promises_that_are_tried(self):
        self.assertEqual(sorted(self.rows), sorted(row.promise() for row in all_rows()))

    def test_numbers_are_those_of_the_table(self):
        plain, framekins, frame = ({row.name() for row in all_rows(behind)} for behind in ("plain", "framekins", "frame"))
        self.assertEqual(self.numbers(r"planner fails \| (\d+) of (\d+); (\d+) \|", self.readme),
                         [len(self.rows), len(self.rows), self.outcomes(None)[2]])
        self.assertEqual(self.numbers(r"\| (\d+) promises of LinuxCNC's motion", self.page), [len(self.rows)])
        self.assertEqual(self.numbers(r": (\d+) promises work with both, (\d+) work better with blendtp, (\d+) fail",
                                      self.introduction), self.outcomes("plain"))
        self.assertEqual(self.numbers(r"(\d+) of these work with both, (\d+) work better with blendtp, (\d+) fail",
                                      self.introduction), self.outcomes("frame"))
        self.assertEqual(plain, framekins)
        self.assertEqual(self.numbers(r"the same (\d+)\. .* it keeps (\d+): (\d+) of the (\d+), for (\d+) .* and (\d+) about",
                                      self.introduction),
                         [len(plain), len(frame), len(plain & frame), len(plain), len(plain - frame), len(frame - plain)])


if __name__ == "__main__":
    unittest.main()
