"""Limits of joints in LinuxCNC itself: a tilting table of LinuxCNC's and one of ours, and what cannot be kept."""

import itertools
import json
import math
import os
import subprocess
import tempfile
import unittest

import pytest

import harness
from inner_machine import SELECT, SWITCH, Machine
from ten_programs import ATTEMPTS
from test_inner_machines import DOUBLE, OWN, SCARA, TABLE, TILTING

pytestmark = pytest.mark.thorough

#: what joints may do here: half of what the axes may
VELOCITY, ACCELERATION, JERK = 100, 1000, 20000

#: the table turns with the tip on the workpiece: its joints have far to go
TURNS = """\
G21 G17 G90 G94 G64 P0.05 F12000
G1 X30 Y20 Z5 A-60 C120
G1 X60 Y-40 Z0 A20 C-60
G1 X-40 Y-40 Z5 A10 C-80
G1 X0 Y0 Z0 A0 C0
"""

#: where a SCARA reaches, its elbow bent and nearly straight
SWEEPS = "\n".join(["G21 G17 G90 G94 G64 P0.05 F6000", "G1 X300 Y400", "G1 X0 Y540", "G1 X-250 Y300 Z330", "G1 X-100 Y350 Z320",
                    "G2 X250 Y350 I175 J0", "G1 X417 Y64 Z340", "M2"]) + "\n"

#: a robot turns its wrist while it moves
WRIST = "\n".join(["G21 G17 G91 G94 G64 P0.05 F20000", "G1 X-120 Y-60 C100", "X40 Y-100", "X20 Y200 C-200", "X-50 Y-30 C50",
                   "M2"]) + "\n"

#: next to the pole C goes to and fro
POLE = "\n".join(["G21 G17 G90 G94 G61 F1200", "G1 X0 A1 C0", "G64 P0.05", *(f"G1 X{k} C{6 * (k % 2)}" for k in range(1, 41)),
                  "M2"]) + "\n"

#: how far the tool axis may lean, degrees
TOLERANCE = 0.05

#: lines of the second program begin here
SECOND = 100


def set_limits(joints, velocity=VELOCITY, acceleration=ACCELERATION, jerk=JERK):
    """Steps that set the limits of so many joints."""
    values = {"max-velocity": velocity, "max-acceleration": acceleration, "max-jerk": jerk}
    return [["setp", f"blendtp.joint.{joint}.{name}", value] for joint in range(joints) for name, value in values.items()]


def peaks(positions):
    """Greatest velocity and acceleration, and the greatest mean of the jerk over four periods: what is recorded has
    six decimals."""
    rate = 1000.0
    velocity = max(abs(b - a) for a, b in itertools.pairwise(positions)) * rate
    triples = zip(positions, positions[1:], positions[2:], strict=False)
    acceleration = max(abs(a - 2 * b + c) for a, b, c in triples) * rate**2
    wide = zip(positions, positions[4:], positions[8:], positions[12:], strict=False)
    jerk = max(abs(d - 3 * c + 3 * b - a) for a, b, c, d in wide) * (rate / 4) ** 3
    return velocity / VELOCITY, acceleration / ACCELERATION, jerk / JERK


class Table(unittest.TestCase):
    def run_twice(self, machine, first):
        """The program as the axes let it run, and then as the joints do: for each the peaks over the limits of joints."""
        programs = {"free.ngc": first + TURNS + "M2\n", "limited.ngc": "\n" * SECOND + first + TURNS + "M2\n"}
        steps = [["run", "PROGRAMS/free.ngc"], *set_limits(5), ["run", "PROGRAMS/limited.ngc"]]
        result = machine.run(steps, programs)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        begins = next(n for n, line in enumerate(result.column("line")) if line > SECOND)
        found = [[peaks(positions) for positions in (result.commanded(joint)[:begins], result.commanded(joint)[begins:])]
                 for joint in range(5)]
        free, limited = ([max(of[kind] for of in by_joint) for kind in range(3)]
                         for by_joint in zip(*found, strict=True))
        return free, limited

    def check(self, free, limited):
        print(f"over the limits of joints, velocity, acceleration, jerk: {free} without, {limited} with")
        self.assertGreater(free[0], 1.2)
        self.assertGreater(free[1], 1.2)
        self.assertLessEqual(limited[0], 1.002)
        self.assertLessEqual(limited[1], 1.01)
        self.assertLessEqual(limited[2], 1.03)
        # not by being slow
        self.assertGreater(limited[0], 0.95)
        self.assertGreater(limited[1], 0.9)

    def test_the_table_of_linuxcnc(self):
        self.check(*self.run_twice(TILTING, ""))

    def test_the_table_of_ours_behind_a_frame(self):
        self.check(*self.run_twice(OWN, "o<rot_rpl> call [30]\n"))


def asked(command, machine, program, *options, warning=None):
    """What `framepath plan --ini` or `compare --ini` says: its text, and all of its figures. Nothing but this is warned of."""
    with tempfile.TemporaryDirectory() as folder:
        # its INI file names the subroutines from there
        os.symlink(os.path.join(harness.SAMPLES, "subroutines"), os.path.join(folder, "subroutines"))
        place = os.path.join(folder, "configs", "robot")
        os.makedirs(place)
        files = {"robot.ini": machine.ini(None), "robot.hal": machine.hal_text(None), "part.ngc": program}
        files |= {f"to_type_{number}.ngc": SWITCH.format(number=number, output=SELECT) for number in range(2)}
        for name, content in files.items():
            with open(os.path.join(place, name), "w", encoding="utf-8") as file:
                file.write(content)
        command = [harness.TOOL, command, os.path.join(place, "part.ngc"), "--ini", os.path.join(place, "robot.ini"), *options]
        text, figures = (subprocess.run(line, capture_output=True, text=True, check=False)
                         for line in (command, [*command, "--json"]))
        if text.stderr and (warning is None or warning not in text.stderr):
            raise RuntimeError(text.stderr)
        return text.stdout, json.loads(figures.stdout)


def planned(machine, program, *options, warning=None):
    """What `framepath plan --ini` says: its text, and figures."""
    text, figures = asked("plan", machine, program, *options, warning=warning)
    return text, figures["programs"][0]


def limited(machine, joints=5):
    """The machine with limits of joints in its HAL file."""
    lines = "".join(" ".join(map(str, step)) + "\n" for step in set_limits(joints))
    return Machine(machine.kinematics, machine.home, machine.letters, machine.hal + lines, machine.switches)


class Planned(unittest.TestCase):
    """`framepath plan --ini` of a machine whose HAL file sets limits of joints."""

    def check_time(self, machine, program, inner=None):
        """The plan lasts as long as in LinuxCNC."""
        text, figures = planned(machine, program)
        # of two ways to blend it takes the slower one where a move comes a period later: ten periods
        tolerance = max(3, 0.003 * figures["cycles"])
        for _ in range(ATTEMPTS):
            result = machine.run([["run", "PROGRAMS/part.ngc"]], {"part.ngc": program}, inner=inner)
            self.assertIsNone(result.failure, result.log)
            self.assertEqual(result.errors, [], result.log)
            cycles = len(machine.way(result))
            print(f"LinuxCNC {cycles} periods, planned {figures['cycles']}; {figures['limits_of_joints']}")
            # a run takes longer than planned where a busy computer hands over its moves late
            if cycles <= figures["cycles"] + tolerance:
                break
        self.assertLessEqual(abs(figures["cycles"] - cycles), tolerance)
        causes = [share["name"] for share in figures["limited_by"]]
        self.assertTrue(any("of joint" in cause for cause in causes), causes)
        return text, figures

    def test_the_time_is_that_of_linuxcnc(self):
        text, figures = self.check_time(limited(OWN), TURNS + "M2\n")
        self.assertIn("with the tool centre point", text)
        # without them another time
        free = planned(OWN, TURNS + "M2\n")[1]
        self.assertIsNone(free["limits_of_joints"])
        self.assertLess(free["time"], 0.95 * figures["time"])

    def test_the_time_behind_a_module_of_linuxcnc(self):
        """The command loads it, with its parameters and what HAL sets its pins to: nearly the same as behind our own table,
        whose jets take less time, which is planned with."""
        text, figures = self.check_time(limited(TILTING), TURNS + "M2\n")
        self.assertIn("behind xyzac-trt-kins", text)
        own = planned(limited(OWN), TURNS + "M2\n")[1]
        self.assertLessEqual(abs(own["cycles"] - figures["cycles"]), 0.005 * own["cycles"])

    def test_the_length_of_the_tool_goes_to_the_kinematics(self):
        """As HAL hands it over: joints are those of a machine with it, in the time of LinuxCNC."""
        program = "G43.1 Z150\n" + TURNS + "M2\n"
        figures = self.check_time(limited(TILTING), program)[1]
        own = planned(limited(OWN), program)[1]
        self.assertLessEqual(abs(own["cycles"] - figures["cycles"]), 0.005 * own["cycles"])
        with self.assertRaisesRegex(RuntimeError, "the length of the tool changes while A, B or C are turned"):
            planned(limited(TILTING), "G1 A20 F3000\nG43.1 Z30\nG1 X5\nM2\n")
        # without that net the kinematics know of no tool
        unlinked = Machine(TILTING.kinematics, TILTING.home, TILTING.letters, TILTING.hal.replace("net tool-z", "# net tool-z"))
        other = planned(limited(unlinked), program)[1]
        self.assertGreater(abs(other["cycles"] - figures["cycles"]), 0.2 * figures["cycles"])

    def test_the_time_of_a_robot_that_does_not_begin_at_zero(self):
        figures = self.check_time(limited(SCARA, 6), SWEEPS)[1]
        joints = {joint["name"]: joint for joint in figures["joints"]}
        self.assertAlmostEqual(joints["joint.1"]["from"], -90, delta=40)
        for joint in joints.values():
            velocity, acceleration, jerk = (peak["share"] for peak in joint["peaks"])
            self.assertLessEqual(velocity, 1.001)
            self.assertLessEqual(acceleration, 1.001)
            self.assertLessEqual(jerk, 1.05)

    def test_a_module_made_by_halcompile(self):
        """Its pins come when it is asked for its type, and HAL sets them behind that."""
        without = Machine(DOUBLE.kinematics, DOUBLE.home, DOUBLE.letters)
        ends = []
        for machine in (DOUBLE, without):
            text, figures = planned(limited(machine), "G64 P0.05 F6000\nG1 X30 Y20 Z5 A20 B-30\nM2\n",
                                    "--kinematics-type", "1")
            self.assertIn("behind xyzab_tdr_kins", text)
            ends.append([joint["to"] if abs(joint["to"]) > abs(joint["from"]) else joint["from"] for joint in figures["joints"]])
        self.assertGreater(max(abs(one - other) for one, other in zip(*ends, strict=True)), 1)

    def test_a_type_of_the_kinematics(self):
        switched = Machine(TABLE.kinematics, TABLE.home, TABLE.letters, TABLE.hal, switches=True)
        program = "M428\n" + TURNS + "M429\nM2\n"
        figures = planned(limited(switched), program, "--kinematics-type", "1")[1]
        own = planned(limited(OWN), TURNS + "M2\n")[1]
        self.assertLessEqual(abs(own["cycles"] - figures["cycles"]), 0.005 * own["cycles"])
        refused: list[tuple[list[str], str]] = [
            ([], "part.ngc:3: a move with kinematics of type 1 in a plan with type 0 .write --kinematics-type 1"),
            (["--kinematics-type", "9"], "--kinematics-type 9: it has no type 9")]
        for options, words in refused:
            with self.assertRaisesRegex(RuntimeError, words):
                planned(limited(switched), program, *options)
        several = program.replace("M429", "M429\nG1 X0 F1000")
        with self.assertRaisesRegex(RuntimeError, "a move with kinematics of type 0 behind moves with type 1 .plan the part .* with --kinematics-type"):
            planned(limited(switched), several, "--kinematics-type", "1")
        with self.assertRaisesRegex(RuntimeError, "--kinematics-type: the HAL files of .* set no limits of joints"):
            planned(OWN, program, "--kinematics-type", "1")

    def test_what_blendtp_refuses_is_refused(self):
        straight = Machine("scarakins", (45, 0, 150, 0, 0, 0), "XYZABC", SCARA.hal)
        refused = [(limited(straight, 6), "scarakins, with which blendtp refuses every move: .*singular"),
                   (limited(Machine("genserkins", (10, -40, -20, 20, 50, 30), "XYZABC"), 6), "genserkins.*2 us at most")]
        for machine, words in refused:
            with self.assertRaisesRegex(RuntimeError, words):
                planned(machine, "G1 X1 F100\nM2\n")
        with self.assertRaisesRegex(RuntimeError, "part.ngc:1: .*scarakins has no joints for where it ends"):
            planned(limited(SCARA, 6), "G1 X5000 F1000\nM2\n")

    def test_kinematics_that_are_not_known_are_named(self):
        named = Machine("nokins coordinates=XYZAC", TILTING.home, TILTING.letters, TILTING.hal)
        text, figures = planned(limited(named), TURNS + "M2\n", warning="since nokins cannot be asked here")
        self.assertIn("NOT planned", text)
        self.assertIn("behind nokins (", figures["limits_of_joints"])


class Compared(unittest.TestCase):
    """`framepath compare --ini` of the same: the module finds the kinematics, the jets and the limits as in LinuxCNC."""

    def check(self, machine):
        """The time is that of the plan but for .3 %: how far blendtp plans depends on how long a jet takes."""
        report = asked("compare", machine, TURNS + "M2\n", "--jerk", "20A", "--holds", "5")[1]
        stock, ours = ({name: run["motion"]["joints"][name]["ratio"] for name in ("velocity", "acceleration", "jerk")}
                       for run in report["programs"][0]["runs"])
        print(f"over the limits of joints: {stock} with LinuxCNC's planner, {ours} with blendtp")
        self.assertGreater(stock["velocity"], 1.2)
        self.assertGreater(stock["acceleration"], 1.2)
        self.assertLessEqual(ours["velocity"], 1.001)
        self.assertLessEqual(ours["acceleration"], 1.001)
        self.assertLessEqual(ours["jerk"], 1.05)
        self.assertGreater(ours["velocity"], 0.95)
        run = report["programs"][0]["runs"][1]
        cycles = round(1000 * run["motion"]["time"])
        # with the same limits of the axes, which decide how a corner is rounded
        planned_cycles = planned(machine, TURNS + "M2\n", "--jerk", "20A")[1]["cycles"]
        self.assertLessEqual(abs(cycles - planned_cycles), max(3, 0.003 * cycles))
        self.assertGreater(run["holds"]["count"], 0)
        self.assertLess(run["holds"]["mean_ratio"], 1.2)

    def test_modules_are_judged_by_their_joints(self):
        self.check(limited(OWN))

    def test_behind_a_module_of_linuxcnc(self):
        self.check(limited(TILTING))

    def test_a_machine_that_does_not_begin_at_zero(self):
        """A robot begins with its joints at home, and its joints are judged as well."""
        text, report = asked("compare", limited(SCARA, 6), WRIST, "--jerk", "20A")
        self.assertIn("limits of joints as its HAL files set them behind scarakins", text)
        stock, ours = (run["motion"]["joints"] for run in report["programs"][0]["runs"])
        print(f"over the limits of joints: {stock} with LinuxCNC's planner, {ours} with blendtp")
        self.assertGreater(stock["velocity"]["ratio"], 1.2)
        for quantity, most in (("velocity", 1.001), ("acceleration", 1.001), ("jerk", 1.05)):
            self.assertLessEqual(ours[quantity]["ratio"], most)
        self.assertGreater(ours["velocity"]["ratio"], 0.95)
        # a busy computer plans less far ahead
        cycles = round(1000 * report["programs"][0]["runs"][1]["motion"]["time"])
        planned_cycles = planned(limited(SCARA, 6), WRIST)[1]["cycles"]
        self.assertLessEqual(abs(cycles - planned_cycles), 0.1 * cycles)


class ToolAxis(unittest.TestCase):
    """Next to the pole C may leave the program by more than the tool axis, where framekins says what tilts the tool."""

    def run_with(self, machine, inner=None):
        """X, A and C in each period of motion."""
        steps = [["setp", "blendtp.rotary-tolerance", TOLERANCE], ["run", "PROGRAMS/pole.ngc"]]
        result = machine.run(steps, {"pole.ngc": POLE}, inner=inner)
        self.assertIsNone(result.failure, result.log)
        self.assertEqual(result.errors, [], result.log)
        rows = result.columns("axis.x", "axis.a", "axis.c")
        return [row for row, before in zip(rows[1:], rows, strict=False) if row != before]

    def leans(self, row):
        """Degrees between the tool axis and that of the program at this X."""
        x, a, c = row
        programmed = 6 * (x % 2 if x % 2 <= 1 else 2 - x % 2)
        half = math.sin(math.radians(c - programmed) / 2) ** 2
        chord = 4 * math.sin(math.radians(a - 1) / 2) ** 2 + 4 * math.sin(math.radians(a)) * math.sin(math.radians(1)) * half
        return math.degrees(math.sqrt(chord))

    def test_next_to_the_pole_it_is_faster(self):
        told = self.run_with(OWN)
        without = self.run_with(Machine(OWN.kinematics, OWN.home, OWN.letters,
                                        OWN.hal.replace("setp framekins.tool-centre-point 1", "")))
        leans = max(self.leans(row) for row in told if row[0] > 0)
        print(f"{len(told)} periods, {len(without)} where nothing tilts the tool; it leans by {leans} degrees")
        self.assertLess(len(told), 0.93 * len(without))
        self.assertLessEqual(leans, 1.005 * TOLERANCE)
        figures = planned(OWN, POLE, "--rotary-tolerance", str(TOLERANCE))[1]
        self.assertLessEqual(abs(figures["cycles"] - len(told)), max(3, 0.003 * len(told)))
        self.assertEqual(figures["findings"], [])

    def test_behind_another_module_as_well(self):
        """framekins asks it how it turns the tool; alone, nobody does."""
        told = self.run_with(TILTING, inner="inner=xyzac-trt-kins tool_types=0")
        without = self.run_with(TILTING)
        leans = max(self.leans(row) for row in told if row[0] > 0)
        print(f"{len(told)} periods, {len(without)} without framekins; the tool axis leans by {leans} degrees")
        self.assertLess(len(told), 0.93 * len(without))
        self.assertLessEqual(leans, 1.005 * TOLERANCE)


class Refusals(unittest.TestCase):
    def refused(self, machine, limits, *words):
        result = machine.run([*limits, ["mdi", "G1 X0.1 F100"]], record=False)
        said = [line for line in result.log.splitlines() if "blendtp" in line and words[0] in line]
        self.assertTrue(said, result.log)
        for word in words:
            self.assertIn(word, said[0])
        self.assertTrue(result.errors, result.log)

    def test_a_joint_without_a_limit_of_its_own(self):
        self.refused(TILTING, set_limits(4), "blendtp.joint.4.max-velocity is 0", "must be positive for each joint",
                     "[JOINT_4]MAX_VELOCITY")

    def test_limits_that_make_no_sense(self):
        """Each is refused for itself, by its pin; the machine stays where it is, and moves when all of them are right."""
        wrong = [("velocity", -1), ("velocity", "nan"), ("acceleration", 0), ("acceleration", "nan"), ("acceleration", "inf"),
                 ("jerk", 1), ("jerk", -5), ("jerk", "nan")]
        right = {"velocity": VELOCITY, "acceleration": ACCELERATION, "jerk": JERK}
        steps = set_limits(5)
        for quantity, value in wrong:
            pin = f"blendtp.joint.2.max-{quantity}"
            steps += [["setp", pin, value], ["mdi", "G1 X5 F6000"], ["setp", pin, right[quantity]]]
        steps += [["getp", "before", "joint.0.pos-cmd"], ["mdi", "G1 X5 F6000"], ["getp", "behind", "joint.0.pos-cmd"]]
        result = TILTING.run(steps, record=False)
        # the log has what is said twice: from motion, and from the operator's screen
        said = {line[line.index("blendtp.joint."):] for line in result.log.splitlines() if "blendtp.joint." in line}
        for quantity, value in wrong:
            begin = f"blendtp.joint.2.max-{quantity} is {value}: "
            found = [line for line in said if line.startswith(begin)]
            self.assertEqual(len(found), 1, (begin, said))
            self.assertIn(f"[JOINT_2]MAX_{quantity.upper()}", found[0])
        self.assertEqual(len(said), len(wrong), said)
        self.assertAlmostEqual(float(result.answers["before"]), 0, delta=1e-9)
        self.assertAlmostEqual(float(result.answers["behind"]), 5, delta=1e-6)

    def test_kinematics_that_take_too_long(self):
        robot = Machine("genserkins", (10, -40, -20, 20, 50, 30), "XYZABC")
        self.refused(robot, set_limits(6), "genserkins takes", "us at most", "set all blendtp.joint.* to 0")


if __name__ == "__main__":
    unittest.main()
