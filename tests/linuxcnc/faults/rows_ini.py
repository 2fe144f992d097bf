"""Keys of the INI file with values that make no sense, one by one, and a forgotten line of the HAL file."""

from typing import ClassVar

from fault import Fault, operated, recovered, require, said, trial_was_right, without_failure

SECTION = "INI"
NEXT = [["run", "PROGRAMS/trial.ngc", 60], ["note", "trial"]]
#: Seconds that LinuxCNC has for coming up, running the trial, and going down again.
PATIENCE = 100

X, TRAJ, KINS, EMCMOT, FRAMEPATH = "AXIS_X", "TRAJ", "KINS", "EMCMOT", "FRAMEPATH"

#: (section, key, values, words that one message has to have).
REFUSED = [
    (X, "MAX_VELOCITY", ("0", "-5"), ("X", "MAX_VELOCITY")),
    (X, "MAX_VELOCITY", ("fast",), ("AXIS_X", "MAX_VELOCITY")),
    (X, "MAX_VELOCITY", ("nan",), ("isnan", "AxisSetMaxVelocity")),
    (X, "MAX_ACCELERATION", ("0", "-5"), ("X", "MAX_ACCELERATION")),
    (X, "MAX_ACCELERATION", ("fast",), ("AXIS_X", "MAX_ACCELERATION")),
    (X, "MAX_ACCELERATION", ("nan",), ("isnan", "AxisSetMaxAcceleration")),
    (X, "MAX_JERK", ("-5", "1", "nan"), ("AXIS_X", "MAX_JERK")),
    (X, "MAX_JERK", ("much",), ("framepath-sim.hal", "much")),
    (X, "MAX_JERK", (None,), ("AXIS_X", "MAX_JERK")),
    (TRAJ, "MAX_LINEAR_VELOCITY", ("0", "-5"), ("MAX_LINEAR_VELOCITY",)),
    (TRAJ, "MAX_LINEAR_VELOCITY", ("text",), ("TRAJ", "MAX_LINEAR_VELOCITY")),
    (TRAJ, "TPMOD", ("blendtpp",), ("blendtpp", "No such file")),
    (TRAJ, "TPMOD", ("tpmod", None), ("blendtp.axis.x.max-jerk", "not found")),
    (KINS, "KINEMATICS", ("framekins",), ("framekins: coordinates=",)),
    (KINS, "KINEMATICS", ("framekins coordinates=XYQ",), ("coordinates=XYQ", "letter 3")),
    (KINS, "KINEMATICS", ("framekins coordinates=XY",), ("[KINS]KINEMATICS: coordinates=XY names",)),
    (KINS, "KINEMATICS", ("framekins coordinates=XYZA",), ("[KINS]KINEMATICS: coordinates=XYZA names",)),
    (KINS, "KINEMATICS", ("framekins coordinates=XYZ colour=red",), ("Unknown parameter", "colour")),
    (KINS, "KINEMATICS", ("framekins coordinates=XYZ machine=hexapod",), ("machine=hexapod", "machine=identity")),
    (KINS, "KINEMATICS", ("trivkins coordinates=XYZ",), ("framekins", "not found")),
    (KINS, "KINEMATICS", ("nokins",), ("nokins: dlopen",)),
    (KINS, "JOINTS", ("0", "20"), ("num_joints",)),
    (KINS, "JOINTS", ("text",), ("num_joints", "text")),
    (KINS, "JOINTS", (None,), ("[KINS]JOINTS",)),
    (KINS, "JOINTS", ("2",), ("[KINS]JOINTS = 2",)),
    (EMCMOT, "SERVO_PERIOD", ("0", "-1000000"), ("servo thread",)),
    (EMCMOT, "SERVO_PERIOD", ("text",), ("servo_period_nsec", "text")),
    (EMCMOT, "SERVO_PERIOD", (None,), ("[EMCMOT]SERVO_PERIOD",)),
    (EMCMOT, "SERVO_PERIOD", ("1000000000",), ("[EMCMOT]SERVO_PERIOD",)),
    (FRAMEPATH, "CLEAR_AT_START", ("maybe",), ("[FRAMEPATH]CLEAR_AT_START", "0 or 1")),
    (FRAMEPATH, "CLEAR_AT_END", ("7",), ("[FRAMEPATH]CLEAR_AT_END", "0 or 1")),
    (FRAMEPATH, "CLEAR_ON_ABORT", ("text",), ("[FRAMEPATH]CLEAR_ON_ABORT", "0 or 1")),
    (FRAMEPATH, "TOOL_LENGTH", ("long",), ("[FRAMEPATH]TOOL_LENGTH", "frame or machine")),
    (FRAMEPATH, "ROTS_CONVENTION", ("k9",), ("[FRAMEPATH]ROTS_CONVENTION", "seed or k2")),
    (FRAMEPATH, "ANALOG_OUTPUT", ("-3", "60", "x"), ("[FRAMEPATH]ANALOG_OUTPUT", "whole number")),
    (FRAMEPATH, "COLOUR", ("red",), ("[FRAMEPATH]COLOUR", "no such key")),
    ("RS274NGC", "OWORD_NARGS", (None,), ("OWORD_NARGS",)),
    ("RS274NGC", "ON_ABORT_COMMAND", (None,), ("ON_ABORT_COMMAND",)),
    ("RS274NGC", "SUBROUTINE_PATH", ("nowhere",), ("not found", "code_off")),
]

#: What LinuxCNC has a sensible value for, and what only makes a machine slow: the program runs as it should.
HARMLESS = [
    (X, "MAX_VELOCITY", ("inf",)),
    (X, "MAX_ACCELERATION", (None, "inf")),
    (X, "MAX_JERK", ("0", "1e9", "1e300", "inf")),
    (TRAJ, "MAX_LINEAR_VELOCITY", (None, "inf")),
    (TRAJ, "DEFAULT_LINEAR_VELOCITY", ("0", None)),
    ("TASK", "CYCLE_TIME", ("0", "text", None)),
    (FRAMEPATH, "ANALOG_OUTPUT", (None,)),
]


def shown(section, key, value):
    return f"`[{section}]{key}` missing" if value is None else f"`[{section}]{key} = {value}`"


class Refused(Fault):
    """LinuxCNC does not start, or no move is taken; a message names the key or the value; no joint moves"""

    section = SECTION
    ini: ClassVar[dict] = {}
    words: tuple = ()

    def run(self):
        try:
            result = operated(NEXT, ini=self.ini, timeout=PATIENCE, record=False)
        except RuntimeError as error:
            text = str(error)
            missing = [word for word in self.words if word not in text]
            require(not missing, f"does not start, and does not name {missing}")
            return "does not start: " + line_with(text.splitlines(), self.words)
        said(result, *self.words)
        at = result.answers.get("trial", {}).get("joints")
        require(at is None or not any(at), f"it says so, and the joints are at {at}")
        return line_with([text for _, text in result.messages] + result.log.splitlines(), self.words)


def line_with(texts, words):
    """The line that names most of it, without where the files of a test are."""
    best = max(texts, key=lambda text: sum(word in text for word in words))
    return "\"" + " ".join(word.rsplit("/", 1)[-1] if word.startswith("/") else word for word in best.split())[:160] + "\""


class Harmless(Fault):
    """The program runs to its end, without an error"""

    section = SECTION
    ini: ClassVar[dict] = {}

    def run(self):
        result = operated(NEXT, ini=self.ini, timeout=PATIENCE, record=False)
        without_failure(result)
        require(not result.errors, f"LinuxCNC says: {result.errors[:1]}")
        trial_was_right(result)
        return "runs"


def row(kind, section, key, value, words=()):
    """A class of its own for each value."""
    title = f"{kind.__name__}_{section}_{key}_{value}".replace(" ", "_").replace("=", "_")
    return type(title, (kind,), {"__doc__": kind.__doc__, "done": shown(section, key, value), "ini": {(section, key): value},
                                 "words": words})


class FewOutputs(Fault):
    """LinuxCNC does not start, and names the pin that is missing"""

    section = SECTION
    done = "`num_aio=4` in the HAL file, too few to carry a frame"

    def run(self):
        try:
            operated(NEXT, timeout=PATIENCE, record=False, edit_hal=lambda text: text.replace("num_aio=16", "num_aio=4"))
        except RuntimeError as error:
            require("motion.analog-out-04" in str(error), "does not start, and does not say why")
            recovered()
            return "does not start: " + line_with(str(error).splitlines(), ("motion.analog-out-04",))
        return require(False, "it starts all the same")


ROWS = [row(Refused, section, key, value, words) for section, key, values, words in REFUSED for value in values]
ROWS += [row(Harmless, section, key, value) for section, key, values in HARMLESS for value in values]
ROWS.append(FewOutputs)
