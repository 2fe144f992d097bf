#!/usr/bin/python3
"""Stands where the screen stands, and records with `framepath record` as the owner of the machine does."""

import os
import signal
import subprocess
import sys
import time

from driver import Failure, Operator, main

#: Seconds that a recording has for coming up, and for ending.
PATIENCE = 30
#: What is said when a recording has begun.
BEGUN = " joints and the axes "


def shown(what):
    """The lines of `halcmd show`, as words."""
    text = subprocess.run(["halcmd", "-s", "show", what], check=True, capture_output=True, text=True).stdout
    return [line.split() for line in text.splitlines() if line.strip()]


def wiring():
    """HAL without its values: components, links, functions of threads."""
    return {
        # halcmd itself is one
        "components": sorted(words[2] for words in shown("comp") if not words[2].startswith("halcmd")),
        "pins": sorted([words[4], *words[5:]] for words in shown("pin")),
        "signals": sorted([words[2], *words[3:]] for words in shown("sig")),
        "threads": threads(),
    }


def threads():
    """Each thread with its functions, which have lines of their own in LinuxCNC 2.10."""
    found: list[list[str]] = []
    for words in shown("thread"):
        if len(words) > 1:
            found.append([words[2], *words[5:]])
        else:
            found[-1] += words
    return found


def used_memory():
    """Bytes of HAL's memory that are taken, and all."""
    text = subprocess.run(["halcmd", "status", "mem"], check=True, capture_output=True, text=True).stdout
    line = next(line for line in text.splitlines() if "used/total" in line)
    return [int(word) for word in line.rpartition(" ")[2].split("/")]


def samplers():
    """Processes of halsampler."""
    return [int(words[3]) for words in shown("comp") if words[2].startswith("halsampler")]


class RecordingOperator(Operator):
    def __init__(self):
        super().__init__()
        self.recordings = {}

    def record(self, name, *options):
        """Starts a recording, and waits until it records or has ended."""
        with open(f"{name}.out", "w", encoding="utf-8") as output, open(f"{name}.err", "w", encoding="utf-8") as errors:
            process = subprocess.Popen(["./framepath", "record", *options], stdout=output, stderr=errors)
        self.recordings[name] = process
        limit = time.monotonic() + PATIENCE
        while process.poll() is None and BEGUN not in self.said(name, "err"):
            if time.monotonic() > limit:
                raise Failure(f"{name} does not begin to record: {self.said(name, 'err')}")
            time.sleep(0.05)

    @staticmethod
    def said(name, stream):
        with open(f"{name}.{stream}", encoding="utf-8") as file:
            return file.read()

    def end(self, name, signal_name=None):
        """Sends a recording a signal, if one is named, and keeps how it ended."""
        process = self.recordings[name]
        if signal_name:
            process.send_signal(getattr(signal, f"SIG{signal_name}"))
        begun = time.monotonic()
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired as error:
            process.kill()
            raise Failure(f"{name} does not end: {self.said(name, 'err')}") from error
        self.answers[name] = {"status": process.returncode, "out": self.said(name, "out"),
                              "err": self.said(name, "err"), "took": time.monotonic() - begun}

    def record_beyond(self, name, *options):
        """Starts a recording that goes on when LinuxCNC ends; it writes files NAME.out, .err and .status."""
        command = f"./framepath record \"$@\" > {name}.out 2> {name}.err; echo $? > {name}.status"
        subprocess.Popen(["sh", "-c", command, "record", *options], start_new_session=True)
        self.wait_for("the recording", lambda: os.path.exists(f"{name}.err") and BEGUN in self.said(name, "err"))

    def wait_unread(self):
        """Waits until no halsampler is left."""
        self.wait_for("the end of halsampler", lambda: not samplers(), PATIENCE)

    def end_reading(self):
        """Somebody ends halsampler."""
        for process in samplers():
            os.kill(process, signal.SIGTERM)

    def wiring(self, name):
        """Keeps how HAL is wired."""
        self.answers[name] = wiring()

    def memory(self, name):
        """Keeps how much of HAL's memory is taken."""
        self.answers[name] = used_memory()

    def stop_reading(self, seconds):
        """halsampler stands for so long."""
        for process in samplers():
            os.kill(process, signal.SIGSTOP)
            time.sleep(seconds)
            os.kill(process, signal.SIGCONT)


if __name__ == "__main__":
    sys.exit(main(RecordingOperator))
