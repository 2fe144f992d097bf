"""What all screens that follow frames have in common."""

import re

import hal


def turns_tool(state, ini) -> bool:
    """Whether the tool's length turns with a frame now: [FRAMEPATH]TOOL_LENGTH, tool_length= of framekins, and off while the
    kinematics behind the frame turn it themselves. ini: LinuxCNC's INI file, linuxcnc.ini."""
    if state.tool_centre_point or hal.get_value("framekins.tool-length-machine"):
        return False
    return not re.search(r"\btool_length=machine\b", ini.find("KINS", "KINEMATICS") or "")
