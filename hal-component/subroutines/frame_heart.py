"""The heartbeat of frame_guard, which framekins listens to.

It is a process of its own: while the linuxcnc module waits for LinuxCNC's task, up to 5 s, it keeps Python's lock, and a
thread would not beat. It beats as long as the guard's process runs and gets on.
"""

import mmap
import os
import select
import signal
import struct
import time

import hal

#: s between two beats
BEAT = 0.1

#: s that the guard may take for one look with all its commands to LinuxCNC
MOST = 10.0

#: states of a process (proc(5)) that does not run any more
STOPPED = "TtZXx"


class Heart:
    """The guard's side."""

    def __init__(self, name):
        """Starts the process. Its pin is NAME.heartbeat when this returns; RuntimeError if it is not."""
        self.signs = mmap.mmap(-1, 8)
        self.get_on()
        guard = os.getpid()
        ended, self.alive = os.pipe()
        begun, ready = os.pipe()
        if os.fork() == 0:
            os.close(self.alive)
            os.close(begun)
            try:
                self._beat(name, guard, ended, ready)
            finally:
                os._exit(0)
        os.close(ended)
        os.close(ready)
        if os.read(begun, 1) != b"1":
            raise RuntimeError("the heartbeat has not started: is another frame_guard loaded?")
        os.close(begun)

    def get_on(self):
        """The guard has not got stuck."""
        struct.pack_into("d", self.signs, 0, time.monotonic())

    def _beat(self, name, guard, ended, ready):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, lambda *_: os._exit(0))
        component = hal.component(f"{name}-heart", name)
        component.newpin("heartbeat", hal.HAL_U32, hal.HAL_OUT)
        component["heartbeat"] = 1
        component.ready()
        os.write(ready, b"1")
        os.close(ready)
        # the other end of this pipe closes with the guard, however it ends
        while not select.select([ended], [], [], BEAT)[0]:
            if _runs(guard) and time.monotonic() - struct.unpack_from("d", self.signs)[0] < MOST:
                component["heartbeat"] = component["heartbeat"] % 1000000 + 1
        component.exit()


def _runs(process):
    try:
        with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0] not in STOPPED
    except OSError:
        return False
