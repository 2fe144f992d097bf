#!/usr/bin/python3
"""The operator of driver.py in front of a screen: AXIS on an X server without a monitor (Xvfb).

AXIS runs as users have it, with the USER_COMMAND_FILE of the sample. Where a test wants to see what AXIS knows, that is
screen_probe.py, which installs the same and answers questions.
"""

import base64
import contextlib
import json
import os
import subprocess
import sys
import time

import linuxcnc

import driver

#: the size of the monitor, points
SIZE = "1280x900x24"

PICTURE = "picture.png"

#: times that a program or the X server is started, until it runs
STARTS = 3

QUESTION, ANSWER = "question.json", "answer.json"


#: -ini and the file; the name of the screen that is driven may stand behind
INI = sys.argv[1:3]


class Screen(driver.Operator):
    """The steps of an operator, and those that want a screen."""

    def __init__(self):
        super().__init__()
        self.processes = []

    def monitor(self):
        """Starts an X server, on which everything is shown that starts from now on."""
        # several that start at once may take each other's keyboard away
        number = next(filter(None, (self.start_server() for _ in range(STARTS))), None)
        if not number:
            raise driver.Failure("Xvfb has not started")
        os.environ["DISPLAY"] = f":{number}"

    def start_server(self):
        """The number of its display; empty if it has not started."""
        display, write = os.pipe()
        # no -auth: nobody else is in these namespaces
        self.processes.append(subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", SIZE, "-nolisten", "tcp", "+extension", "GLX"],
            pass_fds=[write]))
        os.close(write)
        with os.fdopen(display) as file:
            return file.readline().strip()

    def show(self, *command):
        """Starts a screen: its command, to which LinuxCNC's arguments are added."""
        self.monitor()
        name, *arguments = command
        self.processes.append(subprocess.Popen([name, *INI, *arguments]))

    def show_machine(self, command, hal_file):
        """Starts the picture of a simulated machine, and links it."""
        self.monitor()
        self.processes.append(subprocess.Popen([command]))
        self.wait_pin("vismach.plotclear")
        self.halcmd("source", hal_file)

    def wait_pin(self, name, timeout=180):
        """Waits until a pin is there: a screen makes its own when it is up, on a busy computer after minutes."""
        def is_there():
            if self.processes[-1].poll() is not None:
                raise driver.Failure(f"the screen has ended with {self.processes[-1].returncode}")
            return subprocess.run(["halcmd", "getp", name], capture_output=True, check=False).returncode == 0

        self.wait_for(name, is_there, timeout)

    def on_for_good(self):
        """Switches the machine on until it stays so: gmoccapy presses its own buttons when it sees the emergency stop come and
        go, which switches the machine off again."""
        for _ in range(10):
            # screens look ten times a second, and are to see one after the other
            self.command.state(linuxcnc.STATE_ESTOP_RESET)
            self.sleep(0.5)
            self.on()
            self.sleep(2)
            self.poll()
            if self.status.task_state == linuxcnc.STATE_ON:
                return
        raise driver.Failure("the screen switches the machine off")

    def ask(self, name, question, *arguments):
        """Keeps what screen_probe.py answers; waits until it does."""
        with open(f"{QUESTION}.new", "w", encoding="utf-8") as file:
            json.dump([question, *arguments], file)
        os.replace(f"{QUESTION}.new", QUESTION)
        self.wait_for(f"an answer to {question}", lambda: os.path.exists(ANSWER))
        with open(ANSWER, encoding="utf-8") as file:
            answer = json.load(file)
        os.remove(ANSWER)
        if "error" in answer:
            raise driver.Failure(f"{question}: {answer['error']}")
        self.answers[name] = answer["answer"]

    def start_to_pause(self, program):
        """Starts a program that comes to an M0. Screens read a program that somebody else has opened, and qtdragon and AXIS may
        send a command then: one that comes before task has read ours takes its place, and the start is given again."""
        for _ in range(STARTS):
            self.start(program)
            with contextlib.suppress(driver.Failure):
                self.wait_for("the program to run", lambda: self.status.interp_state != linuxcnc.INTERP_IDLE, 10)
                return
        raise driver.Failure(f"{STARTS} starts had no effect")

    def wait_paused(self):
        """Waits until the program stands at its M0."""
        self.wait_for("M0", lambda: self.status.interp_state == linuxcnc.INTERP_PAUSED and self.status.inpos)
        self.sleep(0.3)

    def picture(self, name):
        """Keeps what the monitor shows, a PNG as text in base 64."""
        subprocess.run(["import", "-window", "root", PICTURE], check=True)
        with open(PICTURE, "rb") as file:
            self.answers[name] = base64.b64encode(file.read()).decode()

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def main(kind=Screen):
    screens = []

    def operator():
        screens.append(kind())
        return screens[0]

    try:
        return driver.main(operator)
    finally:
        screens[0].close()
        time.sleep(0.1)


if __name__ == "__main__":
    sys.exit(main())
