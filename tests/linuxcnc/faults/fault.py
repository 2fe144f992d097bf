"""A row of the table of faults: what is done to a LinuxCNC that runs, what must hold, and what was seen."""

import importlib
import math
import os
import sys
from itertools import pairwise

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(os.path.dirname(HERE), "contract")]

import harness  # noqa: E402
from row import Broken, Row, from_route  # noqa: E402,F401  (what the rows of the outcome table have)

#: Of every joint of the sample: units a second, squared, cubed.
LIMITS = (100.0, 1000.0, 20000.0)
#: What velocity, acceleration and jerk may exceed them by.
SHARES = (1.001, 1.001, 1.05)
KINDS = ("velocity", "acceleration", "jerk")
#: G64 P of the programs, and what rounding and the recorder may add, mm.
TOLERANCE = 0.05
OFF = 1e-3
PERIOD = 1e-3

COUNTER = "loadrt threadtest count=1\naddf threadtest.0.increment servo-thread\n"

HEAD = f"G21 G17 G90 G94 G54 G64 P{TOLERANCE} Q0 F3000"
#: Blends and rapids from wherever the machine is; what it does shows whether everything is right again.
TRIAL = "\n".join([HEAD, "G1 X20", "G1 Y10", "G2 X30 Y0 J-10", "G0 X5 Y5 Z2", "M2"]) + "\n"
TRIAL_END = (5.0, 5.0, 2.0)


class Fault(Row):
    """The docstring says what must hold; `done` what is done. `run` returns what was seen or raises Broken."""

    done = ""
    #: less of it, for the tests of every day
    short = False

    def run(self):
        raise NotImplementedError


#: in the order of the table
MODULES = ("rows_processes", "rows_motion", "rows_ini", "rows_period", "rows_modules", "rows_disk")


def all_rows():
    """Every row, in the order of the table."""
    rows: list[type[Fault]] = []
    for name in MODULES:
        module = importlib.import_module(name)
        rows += getattr(module, "ROWS", None) or \
            [value for value in vars(module).values()
             if isinstance(value, type) and issubclass(value, Fault) and value.__module__ == name and value.done]
    return rows


def require(holds, text):
    if not holds:
        raise Broken(text)


def operated(steps, programs=None, **options):
    """A Result of harness.run with the operator of this folder, and the trial among the programs.

    The operator counts servo periods: the machine of the outcome table has a counter, the sample gets one.
    """
    if "configuration" not in options:
        options["hal"] = COUNTER + options.get("hal", "")
    options.setdefault("display", "operate_faults.py")
    options.setdefault("files", ("faults/operate_faults.py",))
    return harness.run(steps, {"trial.ngc": TRIAL, **(programs or {})}, **options)


def said(result, *words):
    """That the operator was told something with these words."""
    heard = [text for _, text in result.messages] + result.log.splitlines()
    require(any(all(word in text for word in words) for text in heard),
            f"nothing says {' .. '.join(words)!r}: {[text for _, text in result.messages][:3]}")


def without_failure(result):
    require(result.failure is None, f"{result.failure}; {'; '.join(result.errors[:2])}")


def trial_was_right(result, name="trial"):
    end = result.answers[name]["joints"][:3]
    require(math.dist(end, TRIAL_END) < 1e-5, f"the next program ended at {end} instead of {TRIAL_END}")


def differences(values, period):
    return [(b - a) / period for a, b in pairwise(values)]


class Peaks:
    """Greatest velocity, acceleration and jerk of the joints over their limits, as kinematics and planner command them."""

    def __init__(self, result, joints=range(3), period=PERIOD, until=None, limits=LIMITS):
        self.shares, self.places = [0.0] * 3, [""] * 3
        for joint in joints:
            values = result.commanded(joint)[:until]
            for degree, limit in enumerate(limits):
                values = differences(values, period)
                for n, value in enumerate(values):
                    if abs(value) > self.shares[degree] * limit:
                        self.shares[degree] = abs(value) / limit
                        self.places[degree] = f"joint {joint} at {result.rows[n][0]:.3f} s"

    def require(self, degrees=(0, 1, 2)):
        for degree in degrees:
            require(self.shares[degree] <= SHARES[degree],
                    f"{KINDS[degree]} {self.shares[degree]:.3f} of its limit, {self.places[degree]}")
        return self

    def __str__(self):
        return "v {:.3f}, a {:.3f}, j {:.3f}".format(*self.shares)


def at_rest_from(result, joints=range(3)):
    """The servo period from which on no joint moves any more."""
    places = result.columns(*(f"joint.{joint}" for joint in joints))
    return next((n for n in range(len(places) - 1, 0, -1) if places[n] != places[n - 1]), 0)


def recovered(programs=None):
    """What an operator does after LinuxCNC has ended: starts it again, and runs a program."""
    result = operated([["run", "PROGRAMS/trial.ngc"], ["note", "trial"]], programs, record=False)
    without_failure(result)
    require(not result.errors, f"started again, LinuxCNC says: {result.errors}")
    trial_was_right(result)
