#!/usr/bin/python3
"""Runs the test files of this folder, a few at a time: each LinuxCNC has a world of its own and mostly waits.

The output of a file is printed when it is done. Exit code 1 if a test failed.
"""

import concurrent.futures
import glob
import os
import subprocess
import sys

#: What runs several LinuxCNCs at once, or compares times, needs a machine that does nothing else: --alone runs these.
ALONE = ("test_contract_table", "test_contract_soak", "test_plan")
HERE = os.path.dirname(os.path.abspath(__file__))
AT_A_TIME = 3


def run(name):
    done = subprocess.run([sys.executable, "-B", "-m", "unittest", "-v", name], cwd=HERE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    return name, done.returncode, done.stdout


def main():
    files = sorted(glob.glob(os.path.join(HERE, "test_*.py")), key=os.path.getsize, reverse=True)
    names = [os.path.splitext(os.path.basename(file))[0] for file in files]
    alone = sys.argv[1:] == ["--alone"]
    names = list(ALONE) if alone else [name for name in names if name not in ALONE]
    failed = []
    with concurrent.futures.ThreadPoolExecutor(1 if alone else AT_A_TIME) as pool:
        for future in concurrent.futures.as_completed([pool.submit(run, name) for name in names]):
            name, code, output = future.result()
            print(f"== {name}\n{output}", flush=True)
            if code:
                failed.append(name)
    print(f"{len(names)} files of tests in a real LinuxCNC, failed: {', '.join(failed) or 'none'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
