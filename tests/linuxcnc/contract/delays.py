"""How long the computer leaves a process waiting that wants to run: a witness for what a busy computer spoils."""

import os
import time

#: Seconds between two looks.
LOOKS = 0.01
#: What is longer than this may spoil a row: an operator who looks too late, a command that comes too late.
DISTURBED = 0.01


class Witness:
    """A process of its own, since calls into LinuxCNC stop every thread of Python."""

    def __init__(self, path):
        self.path = path
        parent = os.getpid()
        if os.fork() == 0:
            with open(path, "w", encoding="utf-8", buffering=1) as file:
                last = time.monotonic()
                while os.getppid() == parent:
                    time.sleep(LOOKS)
                    now = time.monotonic()
                    if now - last - LOOKS > DISTURBED / 2:
                        file.write(f"{last} {now}\n")
                    last = now
            os._exit(0)

    def longest(self, since):
        """The longest time, seconds, that it waited in vain since then; 0 where it was less than half of DISTURBED."""
        # it writes when it is let run again
        time.sleep(2 * LOOKS)
        if not os.path.exists(self.path):
            return 0.0
        with open(self.path, encoding="utf-8") as file:
            waits = [tuple(float(word) for word in line.split()) for line in file if line.endswith("\n")]
        return max((end - start - LOOKS for start, end in waits if end > since), default=0.0)
