"""The modules are loaded and unloaded again and again."""

import re
import subprocess

from fault import Fault, harness, os, recovered, require

SECTION = "Modules"
#: Stays, so that LinuxCNC's process for modules does. Without motmod: HAL keeps its thread, and it cannot be loaded again.
STAYS = "loadrt homemod\n"
LOAD = "loadrt blendtp\nloadrt framekins coordinates=XYZ\n"
UNLOAD = "unloadrt framekins\nunloadrt blendtp\n"


class Reloaded(Fault):
    """Each time both load and unload without a message, and nothing of HAL is used up; LinuxCNC starts afterwards"""

    section = SECTION
    done = "both modules loaded and unloaded 100 times in one HAL"

    def run(self):
        times = 5 if self.short else 100
        text = STAYS + "".join(f"{LOAD}getp blendtp.version\n{UNLOAD}list comp\n" for _ in range(times))
        done = subprocess.run([os.path.join(harness.HERE, "isolated"), harness.MODULES, "halrun"], input=text, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600, check=False)
        versions = [line for line in done.stdout.splitlines() if re.fullmatch(r"(halcmd: )*\d+", line.strip())]
        require(done.returncode == 0 and len(versions) == times, f"{len(versions)} of {times} times: {done.stdout[-300:]}")
        complaints = [line for line in done.stdout.splitlines() if re.search(r"(?i)error|fail|not found", line)]
        require(not complaints, f"{complaints[:1]}")
        recovered()
        return f"{times} times"
