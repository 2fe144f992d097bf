#!/usr/bin/python3
"""Random programs with a random operator in a real LinuxCNC: soak.py [--seconds N] [--seed N] [--planner NAME]

LinuxCNC is started anew every minute or so, each time with the next seed. The first failure ends it with exit code 1
and the seed to give to --seed; what LinuxCNC's threads do in between differs a little from run to run.
"""

import argparse
import json
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "contract"))

import harness  # noqa: E402
import session  # noqa: E402
from row import ACCELERATION, JERK, VELOCITY, difference  # noqa: E402

#: Seconds of one LinuxCNC.
ROUND = 60
FILES = ["contract/" + name for name in ("row.py", "operate.py", "random_program.py", "soak_operator.py")]
#: What velocity, acceleration and jerk may exceed their limits by: differences of positions recorded in nanometres.
SHARES = (1.001, 1.002, 1.06)
ALL, JOGGING = 1, 2


class Peaks:
    """Greatest velocity, acceleration and jerk over their limits, and where."""

    def __init__(self, result):
        self.share, self.place = [0.0, 0.0, 0.0], [None, None, None]
        states = result.column("row")
        for axis in "xyzab":
            values = result.column(axis)
            limits = (VELOCITY, ACCELERATION, JERK)
            # a tenth of what Y is able to do is for external offsets
            factor = 0.9 if axis == "y" else 1.0
            order = values
            for degree, limit in enumerate(limits):
                order = difference(order)
                limit *= factor if degree < 2 else 1.0
                for n, value in enumerate(order):
                    if abs(value) > self.share[degree] * limit and self.counts(states, n, degree):
                        self.share[degree], self.place[degree] = abs(value) / limit, (axis, result.rows[n][0], n)

    @staticmethod
    def counts(states, n, degree):
        # around a change of the state the difference belongs to both
        window = states[max(0, n - 40):n + 45]
        if degree == 2:
            return all(state == ALL for state in window)
        return all(state in (ALL, JOGGING) for state in window)

    def failure(self):
        for what, share, allowed, place in zip(("velocity", "acceleration", "jerk"), self.share, SHARES, self.place):
            if share > allowed:
                return f"{what} is {share:.4f} of its limit: axis {place[0]} at {place[1]:.3f} s"
        return None


def one_round(seed, seconds, planner, keep=None):
    """What went wrong, or None; and what was done."""
    result = harness.run([["soak", seed, seconds]], sample="machine", configuration=os.path.join(session.HERE, "machine"),
                         ini={("TRAJ", "TPMOD"): planner}, hal=session.JERK_LIMITS if planner == "blendtp" else "",
                         recorder=session.Recorder(), files=FILES, display="soak_operator.py", timeout=seconds + 200)
    peaks = Peaks(result)
    failure = result.failure or (peaks.failure() if planner == "blendtp" else None)
    if "blendtp: " in result.log and not failure:
        failure = next(line for line in result.log.splitlines() if "blendtp: " in line)
    if failure:
        failure += f"\nLinuxCNC's messages: {result.messages}\nactions: " + json.dumps(result.answers.get("log")) \
            + "\nprogram:\n  " + "\n  ".join(result.answers.get("program", []))
        if keep:
            with open(os.path.join(keep, f"soak-{seed}.log"), "w", encoding="utf-8") as file:
                file.write(result.log)
            with open(os.path.join(keep, f"soak-{seed}.csv"), "w", encoding="utf-8") as file:
                file.write(",".join(result.header) + "\n")
                file.writelines(",".join(f"{value:.9g}" for value in row) + "\n" for row in result.rows)
    return failure, result.answers, peaks


def soak(seconds, seed, planner="blendtp", keep=None):
    """True if nothing went wrong in so many seconds."""
    end, rounds = time.monotonic() + seconds, 0
    total = {"programs": 0, "completed": 0, "aborted": 0, "actions": 0}
    greatest = [0.0, 0.0, 0.0]
    while rounds == 0 or time.monotonic() < end - 5:
        length = max(5, min(ROUND, end - time.monotonic()))
        failure, answers, peaks = one_round(seed + rounds, length, planner, keep)
        for key in total:
            total[key] += answers.get(key, 0)
        greatest = [max(a, b) for a, b in zip(greatest, peaks.share)]
        if failure:
            print(f"seed {seed + rounds}: {failure}\nonce more: {sys.argv[0]} --seed {seed + rounds} --seconds {ROUND}", flush=True)
            return False
        rounds += 1
        print(f"seed {seed + rounds - 1}: {total['programs']} programs, {total['completed']} run to their end, "
              f"{total['aborted']} aborted, {total['actions']} actions; velocity {greatest[0]:.4f}, acceleration "
              f"{greatest[1]:.4f}, jerk {greatest[2]:.3f} of the limits", flush=True)
    return True


def main():
    parser = argparse.ArgumentParser(description="Random programs with a random operator in a real LinuxCNC.")
    parser.add_argument("--seconds", type=float, default=7200, help="how long (default: two hours)")
    parser.add_argument("--seed", type=int, default=int(time.time()) % 1000000, help="where to start (default: the time)")
    parser.add_argument("--planner", default="blendtp", help="[TRAJ]TPMOD (default: blendtp)")
    parser.add_argument("--keep", help="folder for the recording of a failure (CSV)")
    arguments = parser.parse_args()
    return 0 if soak(arguments.seconds, arguments.seed, arguments.planner, arguments.keep) else 1


if __name__ == "__main__":
    sys.exit(main())
