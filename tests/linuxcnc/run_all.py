#!/usr/bin/python3
"""Runs the test files of this folder, a few at a time: each LinuxCNC has a world of its own and mostly waits.

The output of a file is printed when it is done, and at the end what failed and what was skipped, with the reason.
Exit code 1 if a test failed.
"""

import argparse
import concurrent.futures
import glob
import os
import re
import subprocess
import sys
import time

#: What runs several LinuxCNCs at once, or wants to know when moves come: side by side, when all the others are done.
LAST = ("test_contract_table", "test_contract_soak", "test_plan", "test_compare", "test_short_programs", "test_faults_table")
#: What takes longest comes first.
FIRST = ("test_dialect_examples", "test_spindle", "test_look_ahead")
HERE = os.path.dirname(os.path.abspath(__file__))
AT_A_TIME = 4


def run(name):
    start = time.monotonic()
    done = subprocess.run([sys.executable, "-B", "-m", "unittest", "-v", name], cwd=HERE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    return name, done.returncode, done.stdout, time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description="Runs the tests in a real LinuxCNC.")
    parser.add_argument("--last", action="store_true", help=f"only what comes last: {', '.join(LAST)}")
    arguments = parser.parse_args()
    files = sorted(glob.glob(os.path.join(HERE, "test_*.py")), key=os.path.getsize, reverse=True)
    names = [os.path.splitext(os.path.basename(file))[0] for file in files]
    names.sort(key=lambda name: name not in FIRST)
    parts = [LAST] if arguments.last else [[name for name in names if name not in LAST], LAST]
    failed, skipped = [], []
    for part in parts:
        with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
            for future in concurrent.futures.as_completed([pool.submit(run, name) for name in part]):
                name, code, output, seconds = future.result()
                print(f"== {name}, {seconds:.0f} s\n{output}", flush=True)
                if code:
                    failed.append(name)
                skipped += [f"{name}: {reason}" for reason in re.findall(r"skipped ['\"](.*)['\"]$", output, re.MULTILINE)]
    print(f"{sum(map(len, parts))} files of tests in a real LinuxCNC, failed: {', '.join(failed) or 'none'}")
    for reason in skipped:
        print(f"not shown, skipped: {reason}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
