/* What an INI file says of the machine, as the caller hands it over: a text file with a setting on each line.
 *
 *   UNIT mm                      length of the machine's unit
 *   START nine numbers           where the machine stands, mm and degrees
 *   AXES letters                 the axes that there are; without it all nine
 *   STARTUP code                 runs before the program ([RS274NGC]RS274NGC_STARTUP_CODE)
 *   SKIP                         blocks that begin with a slash are left out
 *   TABLE                        the tools that follow are all there are
 *   TOOL number pocket offset(9) diameter front back orientation     machine units
 *   SWITCH output type           the analog output that switches the kinematics, and the type for which moves are supported,
 *                                -1: the one of the first move
 *   HELD number                  the tool that the spindle holds at the start
 *   USER number                  a code from M100 to M199 that is a program of the machine
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include "calls.hh"
#include "state.hh"

Machine machine;

static bool read_tool(std::istream &words)
{
    CANON_TOOL_TABLE tool = {};
    EmcPose &o = tool.offset;
    words >> tool.toolno >> tool.pocketno >> o.tran.x >> o.tran.y >> o.tran.z >> o.a >> o.b >> o.c >> o.u >> o.v >> o.w
          >> tool.diameter >> tool.frontangle >> tool.backangle >> tool.orientation;
    machine.tools.push_back(tool);
    return !words.fail();
}

static bool read_setting(const std::string &line)
{
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name == "UNIT") {
        words >> machine.unit;
        now.unit = machine.unit;
        now.units = fabs(machine.unit - 25.4) < 1e-3 ? CANON_UNITS_INCHES : CANON_UNITS_MM;
    } else if (name == "START") {
        for (double &coordinate : now.here.at)
            words >> coordinate;
    } else if (name == "AXES") {
        std::string letters;
        words >> letters;
        machine.axes = 0;
        for (char letter : letters)
            machine.axes |= 1 << std::string("XYZABCUVW").find(letter);
    } else if (name == "STARTUP") {
        std::getline(words >> std::ws, machine.startup);
    } else if (name == "SKIP") {
        now.block_delete = true;
    } else if (name == "TABLE") {
        machine.has_table = true;
        /* Behind the index 0 is what the spindle holds. */
        machine.tools.assign(1, CANON_TOOL_TABLE{});
        machine.tools[0].toolno = -1;
    } else if (name == "TOOL") {
        return read_tool(words);
    } else if (name == "SWITCH") {
        words >> machine.switch_output >> machine.kinematics_type;
        now.kinematics_type = std::max(machine.kinematics_type, 0);
    } else if (name == "HELD") {
        words >> now.tool_number;
    } else if (name == "USER") {
        int code = 0;
        words >> code;
        return know_user_code(code);
    } else {
        return false;
    }
    return !words.fail();
}

bool read_settings(const char *file)
{
    std::ifstream input(file);
    std::string line;
    while (std::getline(input, line))
        if (!read_setting(line))
            return false;
    return input.eof();
}
