#!/usr/bin/python3
"""Each sample in AXIS without a monitor, one in gmoccapy and qtdragon with their panels, the one with a table in gmoccapy;
homed, a program with frames run; and two simulated machines of LinuxCNC in a frame: screens.py FOLDER [NAME ...], which gets
the pictures."""

import base64
import os
import sys

import harness
import sample_machines
import sample_table
import screen_checks
from test_preview import program
from test_preview_screens import GMOCCAPY, QTDRAGON
from test_samples import own_program

SAMPLES = {"framepath-sim": (3, "xyz"), "framepath-fagor": (3, "xyz"), "framepath-mefi": (3, "xyz"),
           "framepath-isg": (3, "xyz"), "framepath-xyzac": (5, "xyzac"), "framepath-lathe": (2, "xz"),
           "framepath-gantry": (4, "xyz"), "framepath-inch": (3, "xyz")}

#: Samples with a program of their own, which they run to its end.
OWN_PROGRAMS = {"framepath-lathe": "thread.ngc", "framepath-gantry": "sheet.ngc", "framepath-inch": "plate.ngc"}

PROGRAM = program(
    "G0 Z10", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]", "G1 X0 Y0 Z0 F3000", "X40", "Y30", "G2 X40 Y60 R20",
    "G1 X0", "Y0", "o<atrans> call [60] [0] [0]", "o<ascale> call [0.5] [0.5] [0.5]", "G1 X0 Y0 Z0", "X40", "Y30", "M0", "X0")

#: other screens than AXIS, on the sample of a mill
SCREENS = {"gmoccapy": GMOCCAPY, "qtdragon": QTDRAGON}

#: the sample with a table, in gmoccapy: while its picture is taken C turns
TABLE = "gmoccapy-xyzac"
TURNS = program("G0 Z10", "o<trans> call [20] [30] [5]", "o<arot> call [0] [0] [30]", "G1 X0 Y0 Z0 A-20 F3000", "M0", "G0 C720")
TURNS_STEPS = [["wait_paused"], ["ask", "shown", "panel"], ["sleep", 1], ["resume"], ["expect", "pyvcp.limit.c", "TRUE"],
               ["sleep", 0.5], ["picture", "picture"], ["finish"]]

#: how a picture is taken, and the end of the program
PICTURE = [["wait_paused"], ["sleep", 1], ["picture", "picture"]]
END = [["resume"], ["finish"]]


def program_of(sample):
    """The program, with a pause where the picture is taken."""
    if sample not in OWN_PROGRAMS:
        return PROGRAM
    own = own_program(sample, OWN_PROGRAMS[sample])
    return {name: text.replace("\nM2\n", "\nM0\nM2\n") for name, text in own.items()}


#: samples of LinuxCNC whose machine is drawn; those of the tables want a font of X that Xvfb comes without
DRAWN = ("5axis", "ldelta")

ON_A_SCREEN = {"display": "screen_driver.py", "files": ("screen_driver.py",), "record": False, "timeout": 600}


def keep(folder, name, result):
    """Writes the pictures that a run has taken."""
    if result.failure or result.errors:
        raise SystemExit(f"{name}: {result.failure} {result.errors}\n{result.log}")
    for kind, ending in (("picture", ""), ("panel", "-panel")):
        if kind in result.answers:
            path = os.path.join(folder, f"{name}{ending}.png")
            with open(path, "wb") as file:
                file.write(base64.b64decode(result.answers[kind]))
            print(path)


def draw(name):
    """The machine of a sample in a frame."""
    machine = sample_table.machine(name)
    steps = sample_machines.frame_steps(machine)
    there = next(number for number, step in enumerate(steps) if step == ["note", "framed"])
    steps = [["show_machine", machine.picture, sample_machines.PICTURE], *steps[:there], ["sleep", 8], ["picture", "picture"]]
    return sample_machines.run(machine, steps, "blendtp", framed=True, **ON_A_SCREEN)


def main(folder, names):
    os.makedirs(folder, exist_ok=True)
    for name in DRAWN:
        if not names or name in names:
            keep(folder, name, draw(name))
    for sample, (joints, axes) in SAMPLES.items():
        if names and sample not in names:
            continue
        # the program is on AXIS's command line, and AXIS reads it again as soon as it knows of frames
        steps = [["show", "axis", "PROGRAMS/part.ngc"], ["wait_pin", "axisui.abort"], ["sleep", 15],
                 ["start", "PROGRAMS/part.ngc"], *PICTURE, *END]
        keep(folder, sample, harness.run(steps, program_of(sample), sample=sample, joints=joints, axes=axes, **ON_A_SCREEN))
    for name, screen in SCREENS.items():
        if names and name not in names:
            continue
        steps = [["ask", "drawn", "open", "PROGRAMS/part.ngc"], *screen_checks.START, *PICTURE, ["ask", "shown", "panel"],
                 ["sleep", 1], ["picture", "panel"], *END]
        keep(folder, name, screen.watch(steps, PROGRAM, record=False, timeout=600))
    if not names or TABLE in names:
        steps = [["ask", "drawn", "open", "PROGRAMS/part.ngc"], *screen_checks.START, *TURNS_STEPS]
        tab = {("DISPLAY", "EMBED_TAB_COMMAND"): screen_checks.TAB_OF_A_TABLE}
        keep(folder, TABLE, GMOCCAPY.watch(steps, TURNS, record=False, timeout=600, ini=tab, **screen_checks.TABLE))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
