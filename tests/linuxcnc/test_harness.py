"""What the tests themselves would notice."""

import tempfile
import unittest

import harness


class Harness(unittest.TestCase):
    def test_modules_that_come_to_an_end_are_noticed(self):
        with tempfile.TemporaryDirectory() as modules:
            harness.modules_with("collapse", modules)
            result = harness.run([["mdi", "G0 X1"], ["halcmd", "setp", "collapse.now", "1"]], modules=modules,
                                 hal="loadrt collapse\naddf collapse servo-thread\n", record=False)
        self.assertIn("come to an end before", str(result.failure), result.log)


if __name__ == "__main__":
    unittest.main()
