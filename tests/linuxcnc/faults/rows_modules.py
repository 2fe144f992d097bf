"""The modules are loaded and unloaded again and again."""

import re
import subprocess

from fault import Fault, harness, os, recovered, require

SECTION = "Modules"
LOAD = ("loadrt blendtp\nloadrt homemod\nloadrt framekins coordinates=XYZ\n"
        "loadrt motmod servo_period_nsec=1000000 num_joints=3\n"
        "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\naddf framekins servo-thread\nstart\n")
UNLOAD = "stop\nunloadrt motmod\nunloadrt framekins\nunloadrt homemod\nunloadrt blendtp\n"


class Reloaded(Fault):
    """Each time both load and unload without a message, and nothing of HAL is used up; LinuxCNC starts afterwards"""

    section = SECTION
    done = "both modules loaded and unloaded 100 times in one HAL"

    def run(self):
        times = 5 if self.short else 100
        text = "".join(f"{LOAD}getp blendtp.version\n{UNLOAD}list comp\n" for _ in range(times))
        done = subprocess.run([os.path.join(harness.HERE, "isolated"), harness.MODULES, "halrun"], input=text, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600, check=False)
        versions = [line for line in done.stdout.splitlines() if re.fullmatch(r"(halcmd: )*\d+", line.strip())]
        require(done.returncode == 0 and len(versions) == times, f"{len(versions)} of {times} times: {done.stdout[-300:]}")
        complaints = [line for line in done.stdout.splitlines() if re.search(r"(?i)error|fail|not found", line)]
        require(not complaints, f"{complaints[:1]}")
        recovered()
        return f"{times} times"
