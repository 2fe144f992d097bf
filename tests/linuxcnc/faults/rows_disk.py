"""The tool writes to a disk that is full."""

import os
import subprocess
import tempfile

from fault import Fault, harness, require

SECTION = "Disk"
INI = os.path.join(harness.SAMPLES, "configs", "framepath-sim", "framepath-sim.ini")
#: KB of the disk, all of which is taken before the tool comes.
ROOM = 64
COUNT = 3000
GCODE = "G21 G90 G64 P0.01 F3000\n" + "".join(f"G1 X{n % 100} Y{n % 7}\n" for n in range(COUNT)) + "M2\n"
PART = "".join(f"N{n} G1 X{n % 100} Y{n % 7} F3000\n" for n in range(COUNT)) + "M30\n"
#: With what is there before, to be left as it is.
BEFORE = "as it was before\n"
SCRIPT = """
mount -t tmpfs -o size={room}k tmpfs "$DISK"
cd "$DISK"
printf '{before}' > out
cat /dev/zero > filler 2> /dev/null
{command}
code=$?
echo "code $code"
echo "left $(ls -A | tr '\\n' ' ')"
echo "out $(cat out)"
"""


class Full(Fault):
    """Exit code 1, a message that names the file and why; what was there before is as it was, nothing half written"""

    section = SECTION
    command, replaces = "", True

    def run(self):
        with tempfile.TemporaryDirectory() as folder:
            disk = os.path.join(folder, "disk")
            os.mkdir(disk)
            for name, text in (("part.ngc", GCODE), ("part.mpf", PART)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            self.prepare(folder)
            command = self.command.format(tool=harness.TOOL, folder=folder, ini=INI, modules=harness.MODULES)
            text = SCRIPT.format(room=ROOM, before=BEFORE.strip() + "\\n", command=command)
            as_root = [] if os.getuid() == 0 else ["--user", "--map-root-user"]
            done = subprocess.run(["unshare", "--mount", *as_root, "bash", "-c", text],
                                  env=dict(os.environ, DISK=disk), capture_output=True, text=True, timeout=300, check=False)
        require("code 1" in done.stdout, f"{done.stdout} {done.stderr[-200:]}")
        require("No space left" in done.stderr, f"it says: {done.stderr[-200:]}")
        if self.replaces:
            require(f"out {BEFORE.strip()}" in done.stdout and "left filler out \n" in done.stdout, f"it leaves {done.stdout}")
        return "\"" + " ".join(done.stderr.strip().splitlines()[-1].split())[:120] + "\""

    def prepare(self, folder):
        """What the command reads."""


def row(name, command, done, replaces=True, promise=Full.__doc__):
    return type(name, (Full,), {"__doc__": promise, "command": command, "done": done, "replaces": replaces})


#: What goes to standard output is the shell's file: nobody can put back what it has cut off.
TO_A_SHELL = "Exit code 1, and a message that says why"
PLAN = "{tool} plan {folder}/part.ngc --ini {ini}"


class FullReport(Full):
    __doc__ = Full.__doc__
    done = "`framepath report --html` on a full disk"
    command = "{tool} report {folder}/part.ngc --recording {folder}/recording.csv --ini {ini} --html out"

    def prepare(self, folder):
        rows = ["time,id,line,joint.0,joint.1,joint.2,axis.x,axis.y,axis.z"]
        rows += [f"{n * 1e-3:.6f},1,1,{place},{place / 2},0,{place},{place / 2},0" for n, place in
                 ((n, round(5e-6 * n * n + 1e-3 * (n % 7), 6)) for n in range(3000))]
        with open(os.path.join(folder, "recording.csv"), "w", encoding="utf-8") as file:
            file.write("\n".join(rows) + "\n")


ROWS = [row("FullFilter", "{tool} filter --dialect sinumerik {folder}/part.mpf > new", "`framepath filter` on a full disk",
            False, TO_A_SHELL),
        row("FullPlan", PLAN + " > new", "`framepath plan` on a full disk", False, TO_A_SHELL),
        row("FullPlanJson", PLAN + " --json > new", "`framepath plan --json` on a full disk", False, TO_A_SHELL),
        row("FullGenerate", "{tool} generate dense > new", "`framepath generate` on a full disk", False, TO_A_SHELL),
        row("FullCompare", "{tool} compare --generated zigzag --with {modules}/blendtp.so > new",
            "`framepath compare` on a full disk", False, TO_A_SHELL)]
ROWS += [row(f"FullPlan{kind}", PLAN + f" --{kind.lower()} out", f"`framepath plan --{kind.lower()}` on a full disk")
         for kind in ("Csv", "Html", "Svg")]
ROWS.append(FullReport)
