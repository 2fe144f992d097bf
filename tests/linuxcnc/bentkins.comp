component bentkins "A head as a user builds it: C carries B, and their axes and the tool miss each other";
pin out s32 dummy=0 "halcompile wants one";
license "GPL";
;;

#include "rtapi_math.h"
#include "kinematics.h"

#define RADIAN (M_PI / 180)

/* Along the arm from the axis of C to that of B, and from there to the tip: aside and up. */
#define ARM 15
#define ASIDE 4
#define UP 120

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

KINEMATICS_TYPE kinematicsType() { return KINEMATICS_BOTH; }

/* From the tip to the place of the linear joints. */
static void reach(double b, double c, double *x, double *y, double *z)
{
    double leaning = ARM + ASIDE * cos(b) + UP * sin(b);
    *x = leaning * cos(c) - ARM - ASIDE;
    *y = leaning * sin(c);
    *z = UP * cos(b) - ASIDE * sin(b) - UP;
}

int kinematicsForward(const double *joints, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double x, y, z;
    (void)fflags;
    (void)iflags;
    reach(joints[3] * RADIAN, joints[4] * RADIAN, &x, &y, &z);
    world->tran.x = joints[0] - x;
    world->tran.y = joints[1] - y;
    world->tran.z = joints[2] - z;
    world->b = joints[3];
    world->c = joints[4];
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joints, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double x, y, z;
    (void)iflags;
    (void)fflags;
    reach(world->b * RADIAN, world->c * RADIAN, &x, &y, &z);
    joints[0] = world->tran.x + x;
    joints[1] = world->tran.y + y;
    joints[2] = world->tran.z + z;
    joints[3] = world->b;
    joints[4] = world->c;
    return 0;
}
