"""When a computer has too much to do to keep time for LinuxCNC, so that a test which fails says little."""

import os

#: Processes a processor, the mean of a minute, from which on it has: eight busy ones on two processors are so many, and a
#: test of a few seconds then waits for more than a second now and again.
OVERLOADED = 4.0
#: How often a test is run at most, where it fails on such a computer. That is said at the end.
ATTEMPTS = 3


def is_overloaded():
    return os.getloadavg()[0] > OVERLOADED * (os.cpu_count() or 1)
