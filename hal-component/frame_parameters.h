/* The parameters of loadrt framekins, and the kinematics that they choose.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_FRAME_PARAMETERS_H
#define FRAMEPATH_FRAME_PARAMETERS_H

#include "rtapi.h"
#include "rtapi_app.h"
#include "framepath.h"
#include "inner_kinematics.h"

static char *coordinates = "";
RTAPI_MP_STRING(coordinates, "Axis letters, one for each joint: coordinates=XYZ");

static char *machine = "";
RTAPI_MP_STRING(machine, "identity (also without it), xyzac or xyzbc");

static char *tool_length = "";
RTAPI_MP_STRING(tool_length, "frame (also without it): the tool's length turns with a frame; machine: it stays along the machine's axes");

static char *inner = "";
RTAPI_MP_STRING(inner, "In place of coordinates and machine: the kinematics module that is loaded behind this one");

static char *tool_types = "";
RTAPI_MP_STRING(tool_types, "Types of the inner kinematics that turn the tool's length themselves: tool_types=0,2");

static char *tool_axes = "";
RTAPI_MP_STRING(tool_axes, "Axes that turn the tool behind kinematics that cannot be asked, the first carries the second: tool_axes=C,B");

/* The module behind the frames that was chosen, "" for a machine of ours. LinuxCNC writes the parameters of a loadrt into a module that
 * is in memory still before it asks whether it can be loaded. */
static const char *behind = "";

/* Chooses the kinematics of another module, which lies beside the one that `here` is in; 0, or what is wrong has been said. */
static int configure_inner(const void *here)
{
    struct module_file own = own_file(here), file = file_beside(inner, here);
    const char *beside = *coordinates ? "coordinates" : *machine ? "machine" : *tool_length ? "tool_length" : NULL;
    int error;
    if (beside) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: inner=%s and %s= exclude each other, since the joints are those of %s: %s\n",
                        inner, beside, inner, *coordinates || *machine
                            ? "give coordinates= to that module, and to framekins inner= alone"
                            : "write TOOL_LENGTH under [FRAMEPATH] in the INI, or tool_types= for types with a tool-offset pin");
        return -22; /* EINVAL */
    }
    if (file.path[0] && !strcmp(file.path, own.path)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: inner=%s: that is framekins itself; write the kinematics behind it, those that "
                        "[KINS]KINEMATICS had before, as in: loadrt framekins inner=xyzac-trt-kins\n", inner);
        return -22; /* EINVAL */
    }
    if (check_inner_file(inner, here))
        return -22; /* EINVAL */
    error = framepath_kinematics_configure_inner(tool_types, tool_axes);
    if (error == FRAMEPATH_UNKNOWN_TOOL_AXES)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: tool_axes=%s: %s\n", tool_axes, framepath_kinematics_configure_text(error));
    else if (error)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: tool_types=%s: %s\n", tool_types, framepath_kinematics_configure_text(error));
    return error ? -22 : 0; /* EINVAL */
}

/* Chooses a machine of ours; the same. */
static int configure_machine(void)
{
    const char *for_inner = *tool_types ? "tool_types" : *tool_axes ? "tool_axes" : NULL;
    int letter = 0;
    int error = framepath_kinematics_configure(coordinates, machine, tool_length, &letter);
    const char *words = framepath_kinematics_configure_text(error);
    if (for_inner) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: %s= is for kinematics behind inner=, and there is no inner=: leave it out; a "
                        "tilting table is machine=xyzac or machine=xyzbc\n", for_inner);
        return -22; /* EINVAL */
    }
    if (!error)
        return 0;
    if (error == FRAMEPATH_UNKNOWN_MACHINE)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: machine=%s: %s\n", machine, words);
    else if (error == FRAMEPATH_UNKNOWN_TOOL_LENGTH)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: tool_length=%s: %s\n", tool_length, words);
    else if (!letter)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: coordinates=%s: %s; write one letter of XYZABCUVW for each joint, as in: "
                        "loadrt framekins coordinates=XYZ\n", coordinates, words);
    else
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: coordinates=%s: %s (letter %d); write one letter of XYZABCUVW for each joint, "
                        "as in: loadrt framekins coordinates=XYZ\n",
                        coordinates, words, letter);
    return -22; /* EINVAL */
}

#endif
