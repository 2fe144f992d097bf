"""The settings of the frames: section [FRAMEPATH] of LinuxCNC's INI file, and what else there they depend on.

Everything is checked when LinuxCNC starts, so that a misspelt key is an error then and not a surprise at the machine.
"""

import re

SECTION = "FRAMEPATH"

#: [TRAJ]LINEAR_UNITS as LinuxCNC understands it: machine units in a millimetre
LINEAR_UNITS = {"mm": 1.0, "metric": 1.0, "in": 1 / 25.4, "inch": 1 / 25.4, "imperial": 1 / 25.4}

#: a frame command takes nine analog outputs in a row
OUTPUTS = 9

#: LinuxCNC has at most this many analog outputs (num_aio of motmod)
MOST_OUTPUTS = 64


class SettingsError(Exception):
    """A setting that cannot be used. The text names file, line, section, key, and what may be written."""


class IniFile:
    """An INI file as LinuxCNC reads it: of several equal keys the first counts, names are case-sensitive."""

    def __init__(self, path):
        self.path = path
        #: (section, key, value, line number), in the order of the file
        self.entries = []
        section, joined, begun = None, "", 0
        with open(path, encoding="utf-8", errors="replace") as file:
            for number, ended in enumerate(file, 1):
                line = ended.rstrip("\r\n")
                begun = begun if joined else number
                if line.endswith("\\"):
                    joined += line[:-1]
                    continue
                text, joined = (joined + line).strip(), ""
                if not text or text[0] in "#;":
                    continue
                heading = re.match(r"\[([^\]]*)\]", text)
                if heading:
                    section = heading.group(1).strip()
                elif "=" in text:
                    key, value = text.split("=", 1)
                    self.entries.append((section, key.strip(), value.strip(), begun))

    def find(self, section, key):
        """(value, line number), or (None, 0)."""
        for where, name, value, line in self.entries:
            if where == section and name == key:
                return value, line
        return None, 0

    def section(self, name):
        return [(key, value, line) for where, key, value, line in self.entries if where == name]


def _switch(text):
    return {"0": False, "1": True}.get(text)


def _choice(*words):
    return lambda text: text.lower() if text.lower() in words else None


def _tolerance(text):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0.001 <= value <= 10 else None


def _place(text):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) <= 100000 else None


def _output(width):
    """The first of so many outputs."""
    return lambda text: int(text) if text.isdigit() and int(text) + width <= MOST_OUTPUTS else None


#: key: (default, reader that returns None for what it cannot read, what may be written)
KEYS = {
    "CLEAR_AT_START": (True, _switch, "0 or 1"),
    "CLEAR_AT_END": (True, _switch, "0 or 1"),
    "CLEAR_ON_ABORT": (True, _switch, "0 or 1"),
    "TOOL_LENGTH": ("frame", _choice("frame", "machine"), "frame or machine"),
    "ROTS_CONVENTION": ("seed", _choice("seed", "k2"), "seed or k2"),
    # read by framepath filter
    "TOLERANCE": (0.01, _tolerance, "a tolerance from 0.001 to 10 mm"),
    "RETRACT_Z": (None, _place, "a place of the machine in mm"),
    "ANALOG_OUTPUT": (0, _output(OUTPUTS), f"a whole number from 0 to {MOST_OUTPUTS - OUTPUTS}"),
    "TYPE_OUTPUT": (3, _output(1), f"a whole number from 0 to {MOST_OUTPUTS - 1}"),
}


class Settings:
    """What the INI file says, checked. Attributes: the keys of [FRAMEPATH] in lower case, and

    units_per_mm: machine units in a millimetre; axes: which of X = 1, Y = 2 and Z = 4 there are, as a sum;
    tool_change_moves: whether M6 goes to a place of the machine; task_cycle: period of LinuxCNC's task, s.
    """

    #: one of the keys, which are set by their names; a type checker learns of it here
    clear_on_abort: bool

    def __init__(self, path):
        """Reads a file. Raises SettingsError, or OSError if it cannot be read."""
        ini = IniFile(path)
        for key, (default, _, _) in KEYS.items():
            setattr(self, key.lower(), default)
        seen = set()
        for key, value, line in ini.section(SECTION):
            place = f"{path}:{line}: [{SECTION}]{key}"
            if key not in KEYS:
                raise SettingsError(f"{place}: there is no such key; the keys are {', '.join(KEYS)}")
            if key in seen:
                raise SettingsError(f"{place}: this key stands there twice; keep one of the two")
            seen.add(key)
            _, read, possible = KEYS[key]
            setting = read(value)
            if setting is None:
                raise SettingsError(f"{place} = {value}: write {possible}, and comments on a line of their own")
            setattr(self, key.lower(), setting)
        for where, _, _, line in ini.entries:
            if where and where != SECTION and where.upper() == SECTION:
                raise SettingsError(f"{path}:{line}: section [{where}]: write [{SECTION}], in capitals")
        self.units_per_mm = _linear_units(ini)
        self.axes = _linear_axes(ini)
        self.tool_change_moves = _tool_change_moves(ini)
        self.task_cycle = _task_cycle(ini)
        self._ini = ini
        _require(ini, "OWORD_NARGS", "1", "without it the subroutines cannot tell a missing value from 0")
        if self.clear_on_abort:
            _require(ini, "ON_ABORT_COMMAND", None, f"[{SECTION}]CLEAR_ON_ABORT = 1 depends on it; write "
                     "o<frame_abort> call, or call o<frame_abort> in a subroutine of your own")

    def joint_problem(self, extra):
        """What is wrong with the letters of framekins, None if nothing is. They stand for the joints, one each: without this
        an axis would move nothing, in silence.

        extra: how many joints of motion are beside those of the kinematics (num_extrajoints of motmod), the last ones.
        """
        letters, line = _joint_letters(self._ini)
        joints, _ = self._ini.find("KINS", "JOINTS")
        if not letters or not (joints or "").isdigit():
            return None
        place = f"{self._ini.path}:{line}: [KINS]KINEMATICS: coordinates={letters}"
        if len(letters) != int(joints) - extra:
            remedy = "write a letter for each joint"
            if extra:
                remedy = f"{extra} of these beside the kinematics (num_extrajoints of motmod), {remedy} of theirs"
            return f"{place} names {len(letters)} joints, [KINS]JOINTS = {joints}: {remedy}"
        axes, _ = self._ini.find("TRAJ", "COORDINATES")
        missing = set("".join((axes or "").upper().split())) - set(letters)
        if missing:
            return (f"{place}: [TRAJ]COORDINATES has an axis {sorted(missing)[0]} that moves no joint: "
                    "write a letter for each axis")
        return None


def _linear_units(ini):
    text, line = ini.find("TRAJ", "LINEAR_UNITS")
    if text is None:
        raise SettingsError(f"{ini.path}: [TRAJ]LINEAR_UNITS is missing: write mm or inch")
    if text.lower() in LINEAR_UNITS:
        return LINEAR_UNITS[text.lower()]
    try:
        units = float(text)
    except ValueError:
        units = 0.0
    if not 0 < units < float("inf"):
        raise SettingsError(f"{ini.path}:{line}: [TRAJ]LINEAR_UNITS = {text}: write mm or inch")
    return units


def _linear_axes(ini):
    """The sum of X = 1, Y = 2 and Z = 4 of the machine."""
    letters, _ = ini.find("TRAJ", "COORDINATES")
    return sum(1 << n for n, letter in enumerate("XYZ") if letters is None or letter in letters.upper())


def _tool_change_moves(ini):
    """Whether LinuxCNC moves axes at M6."""
    position, _ = ini.find("EMCIO", "TOOL_CHANGE_POSITION")
    others = (ini.find("EMCIO", key)[0] for key in ("TOOL_CHANGE_AT_G30", "TOOL_CHANGE_QUILL_UP"))
    return bool(position) or any(text not in (None, "", "0") for text in others)


def _joint_letters(ini):
    """The letters of framekins, one for each joint, and their line; empty if they are not there."""
    kinematics, line = ini.find("KINS", "KINEMATICS")
    letters = re.search(r"^framekins\b.*\bcoordinates=(\w+)", kinematics or "")
    return (letters.group(1).upper() if letters else ""), line


def _task_cycle(ini):
    text, _ = ini.find("TASK", "CYCLE_TIME")
    try:
        return min(1.0, max(0.001, float(text)))
    except (TypeError, ValueError):
        return 0.1  # LinuxCNC's own default


def _require(ini, key, wanted, why):
    text, line = ini.find("RS274NGC", key)
    if text is None or (wanted is not None and text != wanted):
        place = f"{ini.path}:{line}" if line else ini.path
        value = wanted or "o<frame_abort> call"
        raise SettingsError(f"{place}: [RS274NGC]{key} = {value} is needed: {why}")
