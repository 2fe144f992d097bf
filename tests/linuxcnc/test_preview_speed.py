"""A preview that follows frames loads nearly as fast as one that does not: the screens hand the same canon to the
interpreter."""

import unittest

import preview_speed

#: how much longer it may take
MOST = 1.2


class Speed(unittest.TestCase):
    def test_a_program_of_100000_lines(self):
        for name, frames in preview_speed.CASES.items():
            with self.subTest(name):
                stock, hook = preview_speed.measure(frames)
                self.assertLess(hook, MOST * stock)


if __name__ == "__main__":
    unittest.main()
