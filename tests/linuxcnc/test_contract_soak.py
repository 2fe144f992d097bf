"""Two minutes of random programs with a random operator, see soak.py; always the same seeds."""

import unittest

import pytest

import soak

pytestmark = pytest.mark.thorough


class Soak(unittest.TestCase):
    def test_two_minutes(self):
        self.assertTrue(soak.soak(seconds=120, seed=1))


if __name__ == "__main__":
    unittest.main()
