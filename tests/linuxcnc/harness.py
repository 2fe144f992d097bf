#!/usr/bin/python3
"""Runs a scenario in a real, headless LinuxCNC with our modules, and records every joint in every servo cycle.

The configuration is the sample that users get (hal-component/configs/framepath-sim), with our driver in place of the
screen and a recorder behind the motion controller. As a program: harness.py --help.
"""

import argparse
import csv
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SAMPLES = os.path.join(ROOT, "hal-component")
MODULES = os.environ.get("FRAMEPATH_MODULES", os.path.join(ROOT, "target", "modules"))
TOOL = os.environ.get("FRAMEPATH_TOOL", os.path.join(ROOT, "target", "release", "framepath"))
#: LinuxCNC's own modules: installed, or built to be run in place.
LINUXCNC_MODULES = (os.path.join(os.environ["LINUXCNC_IN_PLACE"], "rtlib") if os.environ.get("LINUXCNC_IN_PLACE")
                    else "/usr/lib/linuxcnc/modules")
#: LinuxCNC from 2.10 on hands [AXIS_L]MAX_JERK to the planner itself.
HANDS_OVER_JERK = os.environ.get("LINUXCNC_VERSION", "2.9").startswith("2.10")
#: The folders of LinuxCNC's headers, as build.rs and make have them.
HEADERS = os.environ.get("LINUXCNC_INCLUDE", "/usr/include/linuxcnc").split(":")
INCLUDES = [word for folder in HEADERS for word in ("-isystem", folder)]

#: Seconds that the task controller waits for the motion controller.
COMMAND_TIMEOUT = 30
# halsampler prints six decimals: positions are recorded in millionths.
RECORDED_SCALE = 1e6


class Result:
    """What came out of a scenario."""

    def __init__(self, outcome, rows, header, log, status=None):
        #: None, or which step failed and why
        self.failure = outcome["failure"]
        #: error texts that LinuxCNC showed the operator, in order
        self.errors = outcome["errors"]
        #: all messages [kind, text]
        self.messages = outcome["messages"]
        #: what the steps `note` and `getp` kept
        self.answers = outcome["answers"]
        #: one list of numbers for each servo cycle, and the names of the columns
        self.rows = rows
        self.header = header
        #: everything LinuxCNC printed
        self.log = log
        #: of the command `linuxcnc`; None if it was stopped
        self.status = status

    def forgive_end_of_steps(self):
        """LinuxCNC's interpreter says this at the end of a program that was stepped, with its own planner too; releases word
        the rest differently."""
        self.errors = [error for error in self.errors if not error.startswith("File ended with no percent sign")]

    def column(self, name):
        index = self.header.index(name)
        return [row[index] for row in self.rows]

    def commanded(self, joint):
        """A joint's positions as kinematics and planner command them.

        LinuxCNC smooths what they command by a cubic interpolator: with one servo period to a trajectory period the
        recorded joint is (p[-1] + 4 p + p[+1]) / 6, which on an arc is inside by acceleration * period^2 / 6. This
        undoes it, exactly up to the recorder's last digit, by solving for p with standstill at both ends.
        """
        recorded = self.column(f"joint.{joint}")
        ratio, value = [0.0], [recorded[0]]
        for position in recorded[1:-1]:
            divisor = 4 - ratio[-1]
            ratio.append(1 / divisor)
            value.append((6 * position - value[-1]) / divisor)
        result = [recorded[-1]]
        for r, v in zip(reversed(ratio), reversed(value), strict=True):
            result.append(v - r * result[-1])
        return result[::-1]

    def columns(self, *names):
        indices = [self.header.index(name) for name in names]
        return [tuple(row[i] for i in indices) for row in self.rows]


class Recorder:
    """A HAL file that samples joints, axes and the running line in every servo cycle."""

    def __init__(self, joints, axes, integers=None):
        self.signals = [f"joint.{n}.motor-pos-cmd" for n in range(joints)] + [f"axis.{a}.pos-cmd" for a in axes]
        self.integers = {"motion_type": "motion.motion-type", "line": "motion.program-line", "slot": "framekins.slot",
                         **(integers or {})}
        self.header = ["time", *self.integers] + [f"joint.{n}" for n in range(joints)] + [f"axis.{a}" for a in axes]

    def hal(self):
        count = len(self.signals)
        lines = [f"loadrt scale count={count}", f"loadrt sampler depth=16000 cfg={'f' * count}{'s' * len(self.integers)}"]
        for n, pin in enumerate(self.signals):
            lines += [
                f"setp scale.{n}.gain {RECORDED_SCALE:.0f}",
                f"net record-{n} scale.{n}.out => sampler.0.pin.{n}",
                # the joints' commands are on the loop-back signals of the sample; the axes are free
                f"net joint-{n} => scale.{n}.in" if pin.startswith("joint.") else f"net axis-{n} {pin} => scale.{n}.in",
            ]
        for n in range(count):
            lines.append(f"addf scale.{n} servo-thread")
        for n, (name, pin) in enumerate(self.integers.items()):
            lines.append(f"net record-{name} {pin} => sampler.0.pin.{count + n}")
        lines.append("addf sampler.0 servo-thread")
        return "\n".join(lines) + "\n"

    def read(self, path, ini_text):
        """The recording as rows of numbers."""
        return read_recording(path, ini_text, len(self.signals))


def modules_with(name, folder):
    """Fills a folder with our modules and one that is made for a test, from name.c beside this file."""
    for file in glob.glob(os.path.join(MODULES, "*.so")):
        os.symlink(file, os.path.join(folder, os.path.basename(file)))
    subprocess.run(["cc", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-DRTAPI", "-DUSPACE",
                    "-D__MODULE__", "-D_GNU_SOURCE", *INCLUDES,
                    "-o", os.path.join(folder, f"{name}.so"), os.path.join(HERE, f"{name}.c")], check=True)


def edit_ini(text, changes):
    """Sets keys of an INI text: changes maps (section, key) to a value, or to None to remove the key."""
    lines, section, done = [], None, set()
    for line in text.splitlines():
        found = re.match(r"\[(.+)\]", line)
        if found:
            section = found.group(1)
            lines.append(line)
            for (where, key), value in changes.items():
                if where == section and value is not None and (where, key) not in done:
                    lines.append(f"{key} = {value}")
                    done.add((where, key))
            continue
        key = re.match(r"(\w+)\s*=", line)
        if key and (section, key.group(1)) in changes:
            continue
        lines.append(line)
    missing = {where for (where, _), value in changes.items() if value is not None} - {w for w, _ in done}
    for where in sorted(missing):
        lines.append(f"[{where}]")
        lines += [f"{key} = {value}" for (w, key), value in changes.items() if w == where]
    return "\n".join(lines) + "\n"


def run(steps, programs=None, ini=None, hal="", sample="framepath-sim", joints=3, axes="xyz", timeout=300,
        record=True, modules=None, integers=None, configuration=None, files=(), display="driver.py", recorder=None,
        edit_hal=None, linger=0, first=(("on",), ("home",))):
    """Carries out a scenario.

    steps: list of [name, argument, ...], see driver.Operator; what is done first is `first`.
    programs: {file name: text}; steps name them by their file name with PROGRAMS in front: "PROGRAMS/part.ngc".
    ini: {(section, key): value or None} changes to the sample's INI. hal: text of a further HAL file.
    integers: {column: pin} further pins to record, of type s32.
    configuration: a folder with sample.ini and sample.hal in place of the sample that users get.
    files: what goes into the folder of the configuration; display: which of them stands where the screen stands.
    recorder: what records in place of a Recorder of these joints, axes and integers.
    edit_hal: what makes another text of that of the sample's HAL file.
    linger: for how many seconds what else the scenario has started goes on when LinuxCNC has ended.
    Raises RuntimeError with LinuxCNC's output if LinuxCNC did not come up at all.
    """
    folder = tempfile.mkdtemp(prefix="framepath-run.")
    try:
        config = os.path.join(folder, "configs", sample)
        shutil.copytree(configuration or os.path.join(SAMPLES, "configs", sample), config)
        for shared in ("subroutines", "preview", "panel"):
            shutil.copytree(os.path.join(SAMPLES, shared), os.path.join(folder, shared))
        for name in ("driver.py", *files):
            shutil.copy(os.path.join(HERE, name), config)
        program_folder = os.path.join(folder, "programs")
        os.mkdir(program_folder)
        for name, text in (programs or {}).items():
            with open(os.path.join(program_folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        if edit_hal:
            hal_path = os.path.join(config, f"{sample}.hal")
            with open(hal_path, encoding="utf-8") as file:
                edited = edit_hal(file.read())
            with open(hal_path, "w", encoding="utf-8") as file:
                file.write(edited)
        recorder = recorder or Recorder(joints, axes, integers)
        recording = os.path.join(folder, "recording.txt")
        ini_path = os.path.join(config, f"{sample}.ini")
        with open(ini_path, encoding="utf-8") as file:
            text = file.read()
        # without real-time rights the servo thread may stand still for a while, after which the task controller would
        # give up the program
        changes = {("DISPLAY", "DISPLAY"): f"./{display}", ("EMCMOT", "COMM_TIMEOUT"): COMMAND_TIMEOUT}
        changes.update(ini or {})
        text = edit_ini(text, changes)
        extra = hal
        if record:
            extra += recorder.hal()
            extra += f"loadusr halsampler -t {recording}\n"
        with open(os.path.join(config, "test.hal"), "w", encoding="utf-8") as file:
            file.write(extra)
        text = text.replace(f"HALFILE = {sample}.hal", f"HALFILE = {sample}.hal\nHALFILE = test.hal")
        with open(ini_path, "w", encoding="utf-8") as file:
            file.write(text)
        scenario = os.path.join(folder, "scenario.json")
        outcome = os.path.join(folder, "outcome.json")
        steps = [[str(a).replace("PROGRAMS", program_folder) if isinstance(a, str) else a for a in step]
                 for step in [*first, *steps]]
        with open(scenario, "w", encoding="utf-8") as file:
            json.dump(steps, file)
        environment = dict(os.environ, KEEP=folder, FRAMEPATH_SCENARIO=scenario, FRAMEPATH_RESULT=outcome)
        os.chmod(folder, 0o755)
        log_path = os.path.join(folder, "log.txt")
        status = None
        with open(log_path, "w", encoding="utf-8") as log_file:
            try:
                status = subprocess.run([os.path.join(HERE, "isolated"), modules or MODULES, "sh", "-c",
                                f'linuxcnc -r "$0"; status=$?; sleep {linger}; exit $status', ini_path],
                               env=environment, stdin=subprocess.DEVNULL, stdout=log_file,
                               stderr=subprocess.STDOUT, timeout=timeout, check=False).returncode
            except subprocess.TimeoutExpired:
                log_file.write(f"\nstopped after {timeout} s\n")
        with open(log_path, encoding="utf-8", errors="replace") as file:
            log = file.read()
        if not os.path.exists(outcome):
            raise RuntimeError(f"LinuxCNC did not run the scenario:\n{log}")
        with open(outcome, encoding="utf-8") as file:
            result = json.load(file)
        # where the process of the modules has ended by itself, LinuxCNC finds none to unload: in the words of 2.9 and of 2.10
        if ("unloadrt failed" in log or "motmod: not loaded" in log) and not result["failure"]:
            result["failure"] = "the modules had come to an end before LinuxCNC did"
        rows = recorder.read(recording, text) if record else []
        return Result(result, rows, recorder.header, log, status)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def read_recording(path, ini_text, positions):
    """Rows of numbers in the order of Recorder.header: time in s, the integers, the positions in machine units."""
    periods = re.findall(r"^SERVO_PERIOD\s*=\s*(\d+)", ini_text, re.MULTILINE)
    period = int(periods[0]) * 1e-9
    rows, first = [], None
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if "overrun" in words:
                raise RuntimeError("the recorder lost samples")
            number = int(words[0])
            first = number if first is None else first
            values, integers = words[1:1 + positions], words[1 + positions:]
            rows.append([(number - first) * period, *(int(word) for word in integers),
                         *(float(word) / RECORDED_SCALE for word in values)])
    return rows


def write_csv(result, path):
    """The recording as `framepath report` reads it: time, number of the motion, program line, joints, axes."""
    first = result.header.index("joint.0")
    line, motion_type = (result.header.index(name) for name in ("line", "motion_type"))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["time", "id", "line", *result.header[first:]])
        number, last = 0, None
        for row in result.rows:
            # LinuxCNC reports no number of its own for the motion: a new one starts with another line or kind
            if (row[line], row[motion_type]) != last:
                number, last = number + 1, (row[line], row[motion_type])
            writer.writerow([f"{row[0]:.6f}", number, row[line], *(f"{value:.12f}" for value in row[first:])])


def main():
    parser = argparse.ArgumentParser(description="Runs a G-code program in a headless LinuxCNC with both modules.")
    parser.add_argument("program")
    parser.add_argument("--recording", required=True, help="where to write the recording (CSV)")
    parser.add_argument("--timeout", type=float, default=300)
    arguments = parser.parse_args()
    with open(arguments.program, encoding="utf-8") as file:
        text = file.read()
    result = run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": text}, timeout=arguments.timeout)
    for message in result.errors:
        print(f"LinuxCNC: {message}", file=sys.stderr)
    if result.failure:
        print(result.failure, file=sys.stderr)
    if result.failure or result.errors:
        return 1
    write_csv(result, arguments.recording)
    return 0


if __name__ == "__main__":
    sys.exit(main())
