#!/usr/bin/python3
"""Runs a program with a frame on the installed sample, with what a package has installed and nothing of this folder."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "linuxcnc"))

import harness  # from the folder beside this one

SAMPLE = "/usr/share/framepath/configs/framepath-sim"
PROGRAM = "G21 G90 G17 G61.1\no<trans> call [10] [5] [0]\nG1 X20 Y5 F1500\no<frame_off> call\nM2\n"


def main():
    result = harness.run([["getp", "version", "blendtp.version"], ["run", "PROGRAMS/part.ngc"], ["note", "end"]],
                         {"part.ngc": PROGRAM}, configuration=SAMPLE, modules="/usr/lib/linuxcnc/modules", record=False)
    if result.failure or result.errors:
        sys.exit(f"{result.failure}\n{result.errors}\n{result.log}")
    place = [round(joint, 6) for joint in result.answers["end"]["joints"][:2]]
    if place != [30, 10]:
        sys.exit(f"the machine is at {place}, not at [30, 10]")
    print(f"the installed sample has run a frame to {place}, blendtp.version {result.answers['version']}")


if __name__ == "__main__":
    main()
