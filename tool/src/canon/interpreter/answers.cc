/* What the interpreter asks the machine (GET_EXTERNAL_.. of canon.hh). Without a tool table every tool number exists, without
 * length and radius.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <cstdio>
#include "calls.hh"
#include "state.hh"

static char parameters[4096];

void parameter_file(const char *name)
{
    snprintf(parameters, sizeof parameters, "%s", name);
}

void SET_PARAMETER_FILE_NAME(const char *name)
{
    parameter_file(name);
}

void GET_EXTERNAL_PARAMETER_FILE_NAME(char *name, int size)
{
    if (name && size > 0)
        snprintf(name, size, "%s", parameters);
}

#define POSITION_OF(letter, axis) \
    double GET_EXTERNAL_POSITION_##letter() { return program_position(axis); } \
    double GET_EXTERNAL_PROBE_POSITION_##letter() { return program_position(axis); }
POSITION_OF(X, 0)
POSITION_OF(Y, 1)
POSITION_OF(Z, 2)
POSITION_OF(A, 3)
POSITION_OF(B, 4)
POSITION_OF(C, 5)
POSITION_OF(U, 6)
POSITION_OF(V, 7)
POSITION_OF(W, 8)

double GET_EXTERNAL_TOOL_LENGTH_XOFFSET() { return now.tool_in_program_units.tran.x; }
double GET_EXTERNAL_TOOL_LENGTH_YOFFSET() { return now.tool_in_program_units.tran.y; }
double GET_EXTERNAL_TOOL_LENGTH_ZOFFSET() { return now.tool_in_program_units.tran.z; }
double GET_EXTERNAL_TOOL_LENGTH_AOFFSET() { return now.tool_in_program_units.a; }
double GET_EXTERNAL_TOOL_LENGTH_BOFFSET() { return now.tool_in_program_units.b; }
double GET_EXTERNAL_TOOL_LENGTH_COFFSET() { return now.tool_in_program_units.c; }
double GET_EXTERNAL_TOOL_LENGTH_UOFFSET() { return now.tool_in_program_units.u; }
double GET_EXTERNAL_TOOL_LENGTH_VOFFSET() { return now.tool_in_program_units.v; }
double GET_EXTERNAL_TOOL_LENGTH_WOFFSET() { return now.tool_in_program_units.w; }

/* The probe touches at the end of its move. */
double GET_EXTERNAL_PROBE_VALUE() { return 0; }
int GET_EXTERNAL_PROBE_TRIPPED_VALUE() { return 1; }

double GET_EXTERNAL_FEED_RATE() { return now.rate; }
double GET_EXTERNAL_TRAVERSE_RATE() { return 0; }
CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() { return now.units; }
double GET_EXTERNAL_LENGTH_UNITS() { return 1 / machine.unit; }
double GET_EXTERNAL_ANGLE_UNITS() { return 1; }
CANON_PLANE GET_EXTERNAL_PLANE() { return now.plane; }
CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() { return now.mode; }
double GET_EXTERNAL_MOTION_CONTROL_TOLERANCE() { return now.tolerance; }
double GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE() { return now.naive_cam; }
int GET_EXTERNAL_FLOOD() { return now.flood; }
int GET_EXTERNAL_MIST() { return now.mist; }
int GET_EXTERNAL_QUEUE_EMPTY() { return 1; }
int GET_EXTERNAL_AXIS_MASK() { return machine.axes; }
double GET_EXTERNAL_SPEED(int spindle) { return known(spindle) ? now.speed[spindle] : 0; }
CANON_DIRECTION GET_EXTERNAL_SPINDLE(int spindle)
{
    int direction = known(spindle) ? now.turning[spindle] : 0;
    return direction > 0 ? CANON_CLOCKWISE : direction < 0 ? CANON_COUNTERCLOCKWISE : CANON_STOPPED;
}
int GET_EXTERNAL_FEED_OVERRIDE_ENABLE() { return now.feed_override; }
int GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(int) { return 1; }
int GET_EXTERNAL_ADAPTIVE_FEED_ENABLE() { return 0; }
int GET_EXTERNAL_FEED_HOLD_ENABLE() { return 1; }
int GET_EXTERNAL_TC_FAULT() { return 0; }
int GET_EXTERNAL_TC_REASON() { return 0; }
int GET_EXTERNAL_OFFSET_APPLIED() { return 0; }
EmcPose GET_EXTERNAL_OFFSETS() { return EmcPose{}; }

/* The index of a tool is its place in the table, without a table its number; index 0 is what the spindle holds. */
static int index_of(int number)
{
    if (!machine.has_table || number <= 0)
        return number;
    for (size_t index = 1; index < machine.tools.size(); index++)
        if (machine.tools[index].toolno == number)
            return index;
    return -1;
}

int GET_EXTERNAL_TOOL_SLOT() { return index_of(now.tool_number); }
int GET_EXTERNAL_SELECTED_TOOL_SLOT() { return index_of(now.selected_tool); }

USER_DEFINED_FUNCTION_TYPE USER_DEFINED_FUNCTION[USER_DEFINED_FUNCTION_NUM];
int USER_DEFINED_FUNCTION_ADD(USER_DEFINED_FUNCTION_TYPE, int) { return -1; }

/* What it does, and for how long, nobody knows here. */
static void user_code(int number, double, double)
{
    fprintf(output, "USER %d\n", 100 + number);
}

bool know_user_code(int code)
{
    if (code < 100 || code >= 100 + USER_DEFINED_FUNCTION_NUM)
        return false;
    USER_DEFINED_FUNCTION[code - 100] = user_code;
    return true;
}

/* The tool table stands in front of LinuxCNC's own (libtooldata), whose header is not installed. */
enum toolidx_t { IDX_OK = 0 };

static CANON_TOOL_TABLE tool_without_length(int number)
{
    CANON_TOOL_TABLE tool = {};
    tool.toolno = tool.pocketno = number;
    return tool;
}

static CANON_TOOL_TABLE tool_at(int index)
{
    if (!machine.has_table)
        return tool_without_length(index ? index : now.tool_number);
    if (index == 0)
        index = index_of(now.tool_number);
    bool there = index > 0 && (size_t)index < machine.tools.size();
    return there ? machine.tools[index] : tool_without_length(index ? -1 : 0);
}

CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int pocket) { return tool_at(pocket); }
TOOL_DATA CANON_TOOL_TABLE tooldata_entry_init() { return tool_without_length(-1); }
TOOL_DATA int tooldata_find_index_for_tool(int number) { return index_of(number); }
TOOL_DATA toolidx_t tooldata_get(CANON_TOOL_TABLE *tool, int index)
{
    *tool = tool_at(index);
    return IDX_OK;
}
