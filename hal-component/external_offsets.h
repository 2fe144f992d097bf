/* External offsets (axis.L.eoffset), where motion switches the kinematics: src/kinematics/switch_place.rs. Part of framekins.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_EXTERNAL_OFFSETS_H
#define FRAMEPATH_EXTERNAL_OFFSETS_H

#include <math.h>
#include "hal.h"
#include "rtapi.h"
#include "framepath.h"
#include "impossible_pins.h"

#define OFFSETS 9

/* Whether motion takes the offsets off itself (src/emc/motion/control.c, handle_kinematicsSwitch), and the pins are not looked at.
 * No header says so: this status came into LinuxCNC's later than that. */
#ifdef LINUXCNC_HAS_PATH_MOTION
#define MOTION_TAKES_OFFSETS_OFF 1
#else
#define MOTION_TAKES_OFFSETS_OFF 0
#endif

/* Where the pins are while nothing is linked to them: HAL leads those that are linked to the value of the signal. */
static const hal_float_t *unlinked_offsets[OFFSETS];

static int export_offset_pins(hal_float_t **offsets, int component)
{
    int error = 0;
    for (int i = 0; i < OFFSETS; i++) {
        error |= hal_pin_float_newf(HAL_IN, &offsets[i], component, "framekins.external-offset.%c", "xyzabcuvw"[i]);
        unlinked_offsets[i] = offsets[i];
    }
    return error;
}

/* Whether a pin cannot be the external offset of its axis: something has set it that is none, and the joints would jump by
 * it. */
static int is_unknown_offset(hal_float_t *const *offsets, int axis)
{
    double value = *offsets[axis];
    return !MOTION_TAKES_OFFSETS_OFF
           && (!isfinite(value) || fabs(value) > FRAMEPATH_GREATEST_LENGTH || (value != 0 && offsets[axis] == unlinked_offsets[axis]));
}

static int has_unknown_offset(hal_float_t *const *offsets)
{
    for (int i = 0; i < OFFSETS; i++)
        if (is_unknown_offset(offsets, i))
            return 1;
    return 0;
}

/* Names the first such pin, if there is one. */
static void tell_unknown_offset(hal_float_t *const *offsets)
{
    for (int i = 0; i < OFFSETS; i++) {
        char letter = "xyzabcuvw"[i];
        if (!is_unknown_offset(offsets, i))
            continue;
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: framekins.external-offset.%c is %g, no external offset of that axis: write "
                        "net external-offset-%c axis.%c.eoffset => framekins.external-offset.%c in the HAL file, and set it nowhere "
                        "else\n", letter, (double)*offsets[i], letter, letter, letter);
        return;
    }
}

/* What motion is to give its planner for the place of its joints. */
static void take_external_offsets_off(struct EmcPose *place, hal_float_t *const *offsets)
{
    double taken[OFFSETS];
    for (int i = 0; i < OFFSETS; i++)
        taken[i] = MOTION_TAKES_OFFSETS_OFF || is_unknown_offset(offsets, i) ? 0 : *offsets[i];
    framepath_kinematics_take_offsets_off(place, taken);
}

/* Whether joints would jump behind a switch, and why. */
static int is_another_place(const struct EmcPose *asked)
{
    struct framepath_place_jump jump;
    char letter, axis;
    if (!framepath_kinematics_jumps_behind_switch(asked, &jump))
        return 0;
    letter = "xyzabcuvw"[jump.axis];
    axis = "XYZABCUVW"[jump.axis];
    /* Screens show 255 letters of a message. */
    rtapi_print_msg(RTAPI_MSG_ERR, "framekins: joints would jump, so the machine is switched off: motion goes on from %c %g, not "
                    "%g. External offsets need net external-offset-%c axis.%c.eoffset => framekins.external-offset.%c\n", axis,
                    jump.goes_on, jump.place, letter, letter, letter);
    rtapi_print_msg(RTAPI_MSG_ERR, "framekins: where that net is there, %c is beyond [AXIS_%c]MIN_LIMIT or MAX_LIMIT in the "
                    "coordinates of the frame, which motion holds it within while it has an external offset\n", axis, axis);
    return 1;
}

#endif
