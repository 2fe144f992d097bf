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

/* offsets: of X Y Z A B C U V W, machine units or degrees; what is no number is none. */
static void take_external_offsets_off(struct EmcPose *place, hal_float_t *const *offsets)
{
/* No header says what motion does: this status came into LinuxCNC's later than that. */
#ifdef LINUXCNC_HAS_PATH_MOTION
    (void)place;
    (void)offsets;
#else
    double *const axes[9] = {&place->tran.x, &place->tran.y, &place->tran.z, &place->a, &place->b, &place->c,
                             &place->u, &place->v, &place->w};
    for (int i = 0; i < 9; i++)
        if (isfinite(*offsets[i]))
            *axes[i] -= *offsets[i];
#endif
}

#endif
