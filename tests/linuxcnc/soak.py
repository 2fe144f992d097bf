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
from soak_checks import Peaks, Reverse  # noqa: E402

#: Seconds of one LinuxCNC.
ROUND = 60
#: Said where a reverse run is asked for without a move behind, or behind a thread or an indexer, or a turn in motion.
EXPECTED = ("blendtp: there is no way back from here", "blendtp: the run is not turned, since the machine moves")
#: [TRAJ]MAX_LINEAR_VELOCITY by the seed: a velocity that binds, none, and one that no machine has.
PATH_VELOCITIES = (100, None, 10000)
FILES = ["contract/" + name for name in ("row.py", "operate.py", "delays.py", "random_program.py", "soak_checks.py",
                                    "soak_operator.py")]


def one_round(seed, seconds, planner, keep=None):
    """What went wrong, or None; and what was done."""
    result = harness.run([["soak", seed, seconds]], sample="machine", configuration=os.path.join(session.HERE, "machine"),
                         ini={("TRAJ", "TPMOD"): planner,
                              ("TRAJ", "MAX_LINEAR_VELOCITY"): PATH_VELOCITIES[seed % len(PATH_VELOCITIES)]},
                         hal=session.JERK_LIMITS if planner == "blendtp" else "",
                         recorder=session.Recorder(), files=FILES, display="soak_operator.py", timeout=seconds + 200)
    peaks, reverse = Peaks(result), Reverse(result)
    said = [line for line in result.log.splitlines() if "blendtp: " in line and not any(expected in line for expected in EXPECTED)]
    log, number = result.answers.get("log", []), result.answers.get("programs", 0)
    failure = result.failure
    if not failure and not (number and any(peaks.share)):
        failure = f"nothing was shown: {number} programs, {len(result.rows)} servo periods recorded"
    if planner == "blendtp" and not failure:
        checks: tuple[Peaks | Reverse, ...] = (peaks, reverse)
        for found in checks:
            if not failure and found.failure():
                failure, number = found.failure(), found.program
        failure = failure or (said[0] if said else None)
    if failure:
        failure += f"\nLinuxCNC's messages: {result.messages}"
        if 0 < number <= len(log):
            failure += f"\nactions in program {number}: {json.dumps(log[number - 1]['actions'])}\nprogram:\n  " \
                + "\n  ".join(log[number - 1]["program"])
        if keep:
            with open(os.path.join(keep, f"soak-{seed}.log"), "w", encoding="utf-8") as file:
                file.write(result.log)
            with open(os.path.join(keep, f"soak-{seed}.csv"), "w", encoding="utf-8") as file:
                file.write(",".join(result.header) + "\n")
                file.writelines(",".join(f"{value:.9g}" for value in row) + "\n" for row in result.rows)
    return failure, result.answers, peaks, reverse


def soak(seconds, seed, planner="blendtp", keep=None):
    """True if nothing went wrong in so many seconds."""
    end, rounds = time.monotonic() + seconds, 0
    total = dict.fromkeys(("programs", "completed", "aborted", "actions", "reversed", "turned", "no_way_back"), 0)
    greatest, off, way_back = [0.0, 0.0, 0.0], 0.0, 0.0
    while rounds == 0 or time.monotonic() < end - 5:
        length = max(5, min(ROUND, end - time.monotonic()))
        failure, answers, peaks, reverse = one_round(seed + rounds, length, planner, keep)
        for key in total:
            total[key] += answers.get(key, 0)
        greatest = [max(a, b) for a, b in zip(greatest, peaks.share, strict=True)]
        off, way_back = max(off, reverse.off), way_back + reverse.length
        if failure:
            print(f"seed {seed + rounds}: {failure}\n"
                  f"once more: {sys.argv[0]} --seed {seed + rounds} --seconds {ROUND}", flush=True)
            return False
        rounds += 1
        print(f"seed {seed + rounds - 1}: {total['programs']} programs, {total['completed']} run to their end, "
              f"{total['aborted']} aborted, {total['actions']} actions; {total['reversed']} reverse runs, {total['turned']} "
              f"turned forward again, {total['no_way_back']} refused, {way_back:.0f} mm back within {off * 1000:.2f} "
              f"micrometres; velocity {greatest[0]:.4f}, acceleration {greatest[1]:.4f}, jerk {greatest[2]:.3f} of the limits",
              flush=True)
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
