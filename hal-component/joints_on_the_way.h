/* What a look along the way of the queued moves finds of the joints, in words. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_JOINTS_ON_THE_WAY_H
#define FRAMEPATH_JOINTS_ON_THE_WAY_H

#include "rtapi.h"
#include "framepath.h"

/* Whether an external offset is added behind the planner. */
static int has_external_offset(const emcmot_status_t *status)
{
    const EmcPose *offset = &status->eoffset_pose;
    return offset->tran.x || offset->tran.y || offset->tran.z || offset->a || offset->b || offset->c || offset->u || offset->v ||
           offset->w;
}

/* Says what a look along the way of the queued moves has found. Screens show 255 letters of a message. */
static void say_finding(void)
{
    static int told;
    int line, joint;
    double position, limit, p[9] = { 0 };
    framepath_planner_finding_place(planner, p);
    switch (framepath_planner_range_finding(planner, &line, &joint, &position, &limit)) {
    case FRAMEPATH_LEAVES_RANGE:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the move would take joint %d to %f on its way, beyond its soft limit %f "
                        "(line %d%s)\n", joint, position, limit, line,
                        motion.status && has_external_offset(motion.status) ? ", with the external offsets as they stand" : "");
        break;
    case FRAMEPATH_JOINT_JUMPS:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: joint %d, which has limits, would jump by %.4g at G53 X%.4f Y%.4f Z%.4f A%.4f B%.4f "
                        "C%.4f on the way of the move of line %d: keep clear of that place, or pass it with another arm\n", joint,
                        position, p[0], p[1], p[2], p[3], p[4], p[5], line);
        break;
    case FRAMEPATH_OUT_OF_REACH:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s has no joints that lead to G53 X%.4f Y%.4f Z%.4f A%.4f B%.4f C%.4f, which is on the "
                        "way of the move of line %d, and joints have limits: keep within reach\n", kinematics, p[0], p[1], p[2], p[3],
                        p[4], p[5], line);
        break;
    case FRAMEPATH_RANGE_UNKNOWN:
        if (!told)
            rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s finds no joints for a place on the way of the move of line %d: the soft "
                            "limits are checked at its end only. This is said once\n", kinematics, line);
        told = 1;
        break;
    default:
        break;
    }
}

#endif
