/* asked_kins: kinematics for tests, trivial, that count how often they are asked for their type: matrixkins makes itself
 * ready in that call, and is not any more after a second one.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"
#include "kinematics.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("Kinematics that count questions");
MODULE_LICENSE("GPL");

static int component;
static hal_u32_t **asked;

KINEMATICS_TYPE kinematicsType(void)
{
    **asked += 1;
    return KINEMATICS_BOTH;
}

int kinematicsForward(const double *joint, struct EmcPose *world, const KINEMATICS_FORWARD_FLAGS *forward,
                      KINEMATICS_INVERSE_FLAGS *inverse)
{
    (void)forward;
    (void)inverse;
    world->tran.x = joint[0];
    world->tran.y = joint[1];
    world->tran.z = joint[2];
    return 0;
}

int kinematicsInverse(const struct EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *inverse,
                      KINEMATICS_FORWARD_FLAGS *forward)
{
    (void)inverse;
    (void)forward;
    joint[0] = world->tran.x;
    joint[1] = world->tran.y;
    joint[2] = world->tran.z;
    return 0;
}

int kinematicsSwitchable(void) { return 0; }

int kinematicsSwitch(int type)
{
    (void)type;
    return 0;
}

int rtapi_app_main(void)
{
    component = hal_init("asked_kins");
    if (component < 0)
        return component;
    asked = hal_malloc(sizeof *asked);
    if (!asked || hal_pin_u32_new("asked_kins.asked", HAL_OUT, asked, component)) {
        hal_exit(component);
        return -1;
    }
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_exit(component);
}

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);
