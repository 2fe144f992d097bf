/* Where the program stands while it is interpreted.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#pragma once
#include <string>
#include <vector>
#include "versions.hh"

const int AXES = 9;

struct Pose {
    double at[AXES] = {};
};

struct Where {
    double unit = 1;
    CANON_UNITS units = CANON_UNITS_MM;
    CANON_PLANE plane = PLANE_XY;
    CANON_MOTION_MODE mode = CANON_CONTINUOUS;
    double tolerance = 0, naive_cam = 0;
    Pose work, shift, tool;         /* offsets: G5x, G92, tool; mm and degrees */
    EmcPose tool_in_program_units = {};
    double rotation = 0;            /* degrees about Z */
    Pose here;                      /* of the machine */
    double rate = 0;
    bool feed_override = true, block_delete = false, optional_stop = false;
    double speed[EMCMOT_MAX_SPINDLES] = {};
    double greatest[EMCMOT_MAX_SPINDLES] = {};  /* D of G96; 0: S is rpm */
    int turning[EMCMOT_MAX_SPINDLES] = {};
    int selected_tool = 0, tool_number = 0;
    int flood = 0, mist = 0;
    double kinematics_type = 0;
    int file = 0;                   /* that of the line that is carried out: 0 the program, else which READ tells of it */
};

extern Where now;

/* What does not change while a program runs; without settings a machine in millimetres that has every tool. */
struct Machine {
    double unit = 1;                /* mm */
    int axes = (1 << AXES) - 1;     /* those that there are, X the lowest bit */
    std::string startup;
    bool has_table = false;
    std::vector<CANON_TOOL_TABLE> tools;
    int switch_output = -1;         /* the analog output that switches the kinematics, -1: none that matters */
    int kinematics_type = 0;        /* the type with which programs move, -1: that of the first move */
};

extern Machine machine;

inline bool rotary(int axis)
{
    return axis >= 3 && axis <= 5;
}

inline bool known(int spindle)
{
    return spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES;
}

/* Where the program believes an axis is, in its units. */
double program_position(int axis);
