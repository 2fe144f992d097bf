/* External offsets (axis.L.eoffset), where motion switches the kinematics. Part of framekins.c.
 *
 * Behind a switch motion asks where its joints are, and gives its planner that place. In each period it adds the external
 * offsets to where the planner is: LinuxCNC 2.9 does not take them off that place, so that joints would jump by them.
 * Later ones do (src/emc/motion/control.c, handle_kinematicsSwitch).
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_EXTERNAL_OFFSETS_H
#define FRAMEPATH_EXTERNAL_OFFSETS_H

#include <math.h>
#include "emcpos.h"
#include "hal.h"
#include "rtapi.h"
#include "impossible_pins.h"

#define OFFSETS 9

/* How far rounding may lead beside a place that motion has taken an offset off and added it again, machine units or degrees. */
#define BESIDE_PLACE 1e-8

/* Where the pins are while nothing is linked to them: HAL leads those that are linked to the value of the signal. */
static const hal_float_t *unlinked_offsets[OFFSETS];

/* The place of the joints behind a switch, and where motion keeps its own: it asks with that, and the planner with another. */
static struct {
    const struct EmcPose *asked_with;
    struct EmcPose place;
} behind_switch;

struct offset_axes {
    double *axis[OFFSETS];
};

static struct offset_axes axes_of_place(struct EmcPose *place)
{
    return (struct offset_axes){{&place->tran.x, &place->tran.y, &place->tran.z, &place->a, &place->b, &place->c, &place->u,
                                 &place->v, &place->w}};
}

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
 * it. Where motion takes the offsets off itself the pins are not looked at. */
static int is_unknown_offset(hal_float_t *const *offsets, int axis)
{
#ifdef LINUXCNC_HAS_PATH_MOTION
    (void)offsets;
    (void)axis;
    return 0;
#else
    double value = *offsets[axis];
    return !isfinite(value) || fabs(value) > GREATEST_LENGTH || (value != 0 && offsets[axis] == unlinked_offsets[axis]);
#endif
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
    behind_switch.asked_with = place;
    behind_switch.place = *place;
/* No header says what motion does: this status came into LinuxCNC's later than that. */
#ifdef LINUXCNC_HAS_PATH_MOTION
    (void)offsets;
#else
    struct offset_axes axes = axes_of_place(place);
    for (int i = 0; i < OFFSETS; i++)
        if (!is_unknown_offset(offsets, i))
            *axes.axis[i] -= *offsets[i];
#endif
}

/* Whether motion goes on from another place than that of its joints, which would jump: an offset that framekins is not told
 * of, or a limit that motion holds the axis within as long as it has an offset. An answer that fails has motion switch the
 * machine off where it stands. Asked in the period of a switch only. */
static int is_another_place(const struct EmcPose *asked)
{
    if (asked != behind_switch.asked_with)
        return 0;
    struct EmcPose now = *asked;
    struct offset_axes is = axes_of_place(&now), was = axes_of_place(&behind_switch.place);
    behind_switch.asked_with = NULL;
    for (int i = 0; i < OFFSETS; i++) {
        char letter = "xyzabcuvw"[i], axis = "XYZABCUVW"[i];
        if (fabs(*is.axis[i] - *was.axis[i]) <= BESIDE_PLACE)
            continue;
        /* Screens show 255 letters of a message. */
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: joints would jump, so the machine is switched off: motion goes on from %c %g, not "
                        "%g. External offsets need net external-offset-%c axis.%c.eoffset => framekins.external-offset.%c\n", axis,
                        *is.axis[i], *was.axis[i], letter, letter, letter);
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: where that net is there, %c is beyond [AXIS_%c]MIN_LIMIT or MAX_LIMIT in the "
                        "coordinates of the frame, which motion holds it within while it has an external offset\n", axis, axis);
        return 1;
    }
    return 0;
}

/* The period is over: from the next one on motion moves. */
static void forget_place_behind_switch(void)
{
    behind_switch.asked_with = NULL;
}

#endif
