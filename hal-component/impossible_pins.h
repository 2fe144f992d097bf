/* Which pin of framekins has a value that nothing can be made of, for the operator: a refusal says what is wrong, not where.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_IMPOSSIBLE_PINS_H
#define FRAMEPATH_IMPOSSIBLE_PINS_H

#include <math.h>
#include "rtapi.h"
#include "framepath.h"

struct named_value {
    const char *name;
    double value;
    int is_length;
};

/* The elements of a map in the order of its rows. */
static const char *const row_names[12] = {"xx", "xy", "xz", "x", "yx", "yy", "yz", "y", "zx", "zy", "zz", "z"};

static int is_impossible(const struct named_value *pin)
{
    return !isfinite(pin->value) || (pin->is_length && fabs(pin->value) > FRAMEPATH_GREATEST_LENGTH);
}

static void tell_of(const char *group, const struct named_value *pin)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "framekins: framekins.%s%s is %g, which is no %s: look at what sets it in the HAL file\n",
                    group, pin->name, pin->value, pin->is_length ? "length of a machine" : "finite number");
}

/* Names the first such pin, if there is one. The limits of a table may be infinite, so they are not looked at. */
static void tell_impossible_pin(const struct framepath_frame_inputs *in)
{
    const struct named_value all[] = {
        {"command", in->command, 0},
        {"value.1", in->value[0], 0},
        {"value.2", in->value[1], 0},
        {"value.3", in->value[2], 0},
        {"work-offset.x", in->work_offset[0], 1},
        {"work-offset.y", in->work_offset[1], 1},
        {"work-offset.z", in->work_offset[2], 1},
        {"work-offset.rotation", in->work_rotation, 0},
        {"tool-offset.x", in->tool_offset[0], 1},
        {"tool-offset.y", in->tool_offset[1], 1},
        {"tool-offset.z", in->tool_offset[2], 1},
        {"x-rot-point", in->rotation_point[0], 1},
        {"y-rot-point", in->rotation_point[1], 1},
        {"z-rot-point", in->rotation_point[2], 1},
        {"x-offset", in->offset[0], 1},
        {"y-offset", in->offset[1], 1},
        {"z-offset", in->offset[2], 1},
        {"tool-offset", in->table_tool_offset, 1},
    };
    for (unsigned i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (is_impossible(&all[i])) {
            tell_of("", &all[i]);
            return;
        }
    }
    for (int i = 0; i < 12; i++) {
        struct named_value element = {row_names[i], in->map[i], i % 4 == 3};
        if (is_impossible(&element)) {
            tell_of("map.", &element);
            return;
        }
    }
}

#endif
