#!/usr/bin/python3
"""Each sample in AXIS without a monitor, and one in gmoccapy and qtdragon, homed, a program with frames run: screens.py FOLDER,
which gets the pictures."""

import base64
import os
import sys

import harness
import screen_checks
from test_preview import program
from test_samples import own_program

SAMPLES = {"framepath-sim": (3, "xyz"), "framepath-fagor": (3, "xyz"), "framepath-mefi": (3, "xyz"),
           "framepath-isg": (3, "xyz"), "framepath-xyzac": (5, "xyzac"), "framepath-lathe": (2, "xz"),
           "framepath-gantry": (4, "xyz"), "framepath-inch": (3, "xyz")}

#: Samples with a program of their own, which they run to its end.
OWN_PROGRAMS = {"framepath-lathe": "thread.ngc", "framepath-gantry": "sheet.ngc", "framepath-inch": "plate.ngc"}

PROGRAM = program(
    "G0 Z10", "o<trans> call [20] [30] [5]", "o<arot> call [15] [20] [30]", "G1 X0 Y0 Z0 F3000", "X40", "Y30", "G2 X40 Y60 R20",
    "G1 X0", "Y0", "o<atrans> call [60] [0] [0]", "o<ascale> call [0.5] [0.5] [0.5]", "G1 X0 Y0 Z0", "X40", "Y30", "M0", "X0")

#: other screens than AXIS, on the sample of a mill: command, and the hook in the folder of previews
SCREENS = {"gmoccapy": (["gmoccapy"], "frame_gmoccapy.py"), "qtdragon": (["qtvcp", "qtdragon"], "frame_qtvcp.py")}

RUN = [["start", "PROGRAMS/part.ngc"], ["wait_paused"], ["sleep", 1], ["picture", "picture"], ["resume"], ["finish"]]


def program_of(sample):
    """The program, with a pause where the picture is taken."""
    if sample not in OWN_PROGRAMS:
        return PROGRAM
    own = own_program(sample, OWN_PROGRAMS[sample])
    return {name: text.replace("\nM2\n", "\nM0\nM2\n") for name, text in own.items()}


def keep(folder, name, steps, files, **options):
    """Runs the steps, and writes the picture that they take."""
    result = harness.run(steps, files, display="screen_driver.py", files=("screen_driver.py",), record=False, timeout=180,
                         **options)
    if result.failure or any(not error.startswith(screen_checks.QTVCP_READS) for error in result.errors):
        raise SystemExit(f"{name}: {result.failure} {result.errors}\n{result.log}")
    path = os.path.join(folder, f"{name}.png")
    with open(path, "wb") as file:
        file.write(base64.b64decode(result.answers["picture"]))
    print(path)


def main(folder):
    os.makedirs(folder, exist_ok=True)
    for sample, (joints, axes) in SAMPLES.items():
        # the program is on AXIS's command line, and AXIS reads it again as soon as it knows of frames
        steps = [["show", "axis", "PROGRAMS/part.ngc"], ["wait_pin", "axisui.abort"], ["sleep", 15], *RUN]
        keep(folder, sample, steps, program_of(sample), sample=sample, joints=joints, axes=axes)
    for name, (command, hook) in SCREENS.items():
        first = [["show", *command], ["wait_pin", "frame-preview.answer"], ["sleep", 10], ["on_for_good"], ["home"]]
        keep(folder, name, [["sleep", 5], ["open", "PROGRAMS/part.ngc"], ["sleep", 5], *RUN], PROGRAM, first=first,
             ini={("DISPLAY", "USER_COMMAND_FILE"): f"../../preview/{hook}"})


if __name__ == "__main__":
    main(sys.argv[1])
