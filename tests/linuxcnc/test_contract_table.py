"""Every promise of a planner towards LinuxCNC, with LinuxCNC's own planner and with blendtp; the table is printed."""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "contract"))

import table
from row import all_rows


class Contract(unittest.TestCase):
    def test_every_promise(self):
        found = table.outcomes()
        print("\n".join(table.lines(found)))
        for row in all_rows():
            with self.subTest(row.name()):
                outcome = found[table.OURS][row.name()]
                self.assertTrue(outcome.works, outcome.text)


if __name__ == "__main__":
    unittest.main()
