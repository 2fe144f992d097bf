#!/usr/bin/python3
"""LinuxCNC's sample configurations with both modules beside stock, as a table in Markdown: machines.py [SAMPLE ...]. Exit code
1 if a row does not hold."""

import os
import sys

from machine_row import Broken, row
from sample_table import MACHINES

HEADING = """\
# Machines

LinuxCNC's own sample configurations, headless, with `loadrt framekins inner=` before their kinematics, and with
`TPMOD = blendtp`; printed by

    make machines

which fails where a row does not hold. Each sample runs a program four times: with LinuxCNC's planner and with blendtp, each by
itself and behind framekins. Behind framekins without a frame every joint is in each period where it is without (exact stop
mode), and the program takes as long (G64 P0.05, whose seconds stand here). Then a frame is shifted and turned by 90 degrees
(with the tool centre point on where the sample has one): a place in it, and the same place without it, have the same joints;
the column says how far apart they were. LinuxCNC ends with exit status 0, and all modules are unloaded.

Joints with limits of their own (`blendtp.joint.*`) follow kinematics that bend: a move is refused, before the machine comes to it, that
leads through a place where a joint would jump (the turn of a joint of scarakins or pumakins begins anew, a wrist turns over) or that
no joints lead to; see `man blendtp`.

| sample | kinematics | seconds, LinuxCNC's planner | seconds, blendtp | periods compared | off in the frame |
|---|---|---|---|---|---|"""


def line(machine):
    """A row of the table, and whether it holds."""
    cells = [os.path.normpath(f"{machine.folder}/{machine.ini}.ini"), machine.kinematics]
    try:
        found = row(machine)
    except (Broken, RuntimeError) as error:
        print(f"{machine.ini}: {error}", file=sys.stderr)
        return f"| {' | '.join(cells)} | DOES NOT HOLD: {str(error).splitlines()[0]} | | | |", False
    cells += [*(f"{seconds:.2f}" for seconds in found.seconds.values()), str(found.periods), f"{found.off:.0e}"]
    return f"| {' | '.join(cells)} |", True


def main(names):
    chosen = [machine for machine in MACHINES if not names or machine.ini in names]
    print(HEADING, flush=True)
    holds = True
    for machine in chosen:
        text, held = line(machine)
        print(text, flush=True)
        holds &= held
    return not holds


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
