component skewkins "Kinematics as a user writes them: X and Y are not square, type 1 exchanges them";
pin out s32 dummy=0 "halcompile wants one";
license "GPL";
;;

#include "rtapi_math.h"
#include "kinematics.h"

/* Of Y, how much X goes along. */
#define SKEW 0.125

static int exchanged;

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);

KINEMATICS_TYPE kinematicsType() { return KINEMATICS_BOTH; }
int kinematicsSwitchable() { return 1; }

int kinematicsSwitch(int type)
{
    if (type != 0 && type != 1)
        return -1;
    exchanged = type;
    return 0;
}

int kinematicsForward(const double *joints, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    (void)fflags;
    (void)iflags;
    world->tran.x = joints[exchanged] - SKEW * joints[!exchanged];
    world->tran.y = joints[!exchanged];
    world->tran.z = joints[2];
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joints, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    joints[exchanged] = world->tran.x + SKEW * world->tran.y;
    joints[!exchanged] = world->tran.y;
    joints[2] = world->tran.z;
    return 0;
}
