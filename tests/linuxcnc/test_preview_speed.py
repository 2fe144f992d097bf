"""A preview that follows frames loads nearly as fast as one that does not: the screens hand the same canon to the
interpreter."""

import unittest

import preview_speed
from overload import ATTEMPTS

#: how much longer it may take
MOST = 1.2


class Speed(unittest.TestCase):
    def test_a_program_of_100000_lines(self):
        for name, frames in preview_speed.CASES.items():
            with self.subTest(name):
                found = []
                # the least of few may be off where the computer does more: then of more
                for _ in range(ATTEMPTS):
                    found.append(preview_speed.measure(frames))
                    stock, hook = (min(column) for column in zip(*found, strict=True))
                    if hook < MOST * stock:
                        break
                self.assertLess(hook, MOST * stock)


if __name__ == "__main__":
    unittest.main()
