#!/usr/bin/python3
"""A long program through `framepath filter` and through nc-gcode-interpreter, the only other free reader of this language
that was found: seconds and the most memory that each takes. The second program has one IF.

peer.py FRAMEPATH PYTHON, where PYTHON has the package: python3 -m venv peer; peer/bin/pip install nc-gcode-interpreter
"""

import argparse
import math
import os
import subprocess
import tempfile
import time

PEER = "import sys, nc_gcode_interpreter as peer; peer.nc_to_dataframe(open(sys.argv[1]).read(), iteration_limit=10**9)"


def write_program(path, size, branch):
    """A surface in rows, with some digits as a CAM system writes them."""
    with open(path, "w", encoding="ascii") as file:
        if branch:
            file.write("DEF INT LOW=1\n")
        file.write("G17 G90\nG0 X0 Y0 Z5\n")
        if branch:
            file.write("IF (LOW==1)\nG0 Z4\nENDIF\n")
        file.write("G1 Z0 F2000\n")
        number = 0
        while file.tell() < size:
            x, y = number % 4000 * 0.05, number // 4000 * 0.1
            file.write(f"N{number} G1 X{x:.3f} Y{y:.3f} Z{math.sin(x * 0.11) + math.cos(y * 0.07) - 2:.4f}\n")
            number += 1
        file.write("M30\n")


def measured(command):
    """Seconds, and the most memory in MB."""
    begun = time.monotonic()
    with tempfile.TemporaryFile("w+") as said:
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said) as process:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            said.seek(0)
            raise SystemExit(f"{command[0]} ends with {process.returncode}: {said.read()[-2000:]}")
    return time.monotonic() - begun, usage.ru_maxrss * 1024 / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("framepath", help="the command, built for release")
    parser.add_argument("python", help="a Python with nc-gcode-interpreter")
    parser.add_argument("--size", type=float, default=50e6, help="bytes of the program")
    options = parser.parse_args()
    print("| program | framepath filter | nc-gcode-interpreter | times as long |\n| --- | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "surface.mpf")
        for name, branch in (("plain motions", False), ("the same with one IF", True)):
            write_program(path, options.size, branch)
            ours = measured([options.framepath, "filter", "--dialect", "sinumerik", path])
            peers = measured([options.python, "-c", PEER, path])
            cells = [f"{seconds:.2f} s, {memory:.0f} MB" for seconds, memory in (ours, peers)]
            print(f"| {name}, {options.size / 1e6:.0f} MB | {' | '.join(cells)} | {peers[0] / ours[0]:.0f} |", flush=True)


if __name__ == "__main__":
    main()
