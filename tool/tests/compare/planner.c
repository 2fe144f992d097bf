/* A planner that knows straight lines only and goes along them at their speed from the first cycle to the last, without
 * any acceleration: what compare measures of it can be worked out by hand. Compiled with -DFAULT_.. it does one thing wrong.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"
#include "motion.h"
#include "tp.h"
#include "kinematics.h"

struct leg { EmcPose end; double velocity; int id, type; };
#define LEGS 100
static struct leg legs[LEGS];
static int first, count, next_id, exec_id, paused, aborted;
static double cycle_time;
static long cycles, stood;
static EmcPose here, from;
static double gone;
static emcmot_status_t *status;
static emcmot_config_t *config;
static struct { hal_float_t *jerk, *joint[3]; } *pins;
static void *volatile memory;
static volatile int *volatile nowhere;

int rtapi_app_main(void)
{
    int id = hal_init("made-up");
    if (id < 0)
        return id;
    pins = hal_malloc(sizeof *pins);
#ifdef FAULT_TAKES_JERK
    if (hal_pin_float_newf(HAL_IN, &pins->jerk, id, "made-up.axis.%c.max-jerk", 'x'))
        return -1;
#endif
#ifdef FAULT_ASKS
    if (hal_pin_float_newf(HAL_IN, &pins->joint[0], id, "made-up.joint.0.max-velocity")
        || hal_pin_float_newf(HAL_IN, &pins->joint[1], id, "made-up.joint.0.max-acceleration")
        || hal_pin_float_newf(HAL_IN, &pins->joint[2], id, "made-up.joint.0.max-jerk"))
        return -1;
#endif
#ifdef FAULT_NO_START
    rtapi_print_msg(RTAPI_MSG_ERR, "made-up: no heart\n");
    return -1;
#endif
    return hal_ready(id);
}

void rtapi_app_exit(void) {}

void tpMotFunctions(void (*a)(int, char), void (*b)(int, double), void (*c)(int, int), int (*d)(int), double (*e)(int),
                    double (*f)(int))
{
    (void)a; (void)b; (void)c; (void)d; (void)e; (void)f;
}

void tpMotData(emcmot_status_t *s, emcmot_config_t *c) { status = s; config = c; }
int tpCreate(TP_STRUCT * const tp, int size, int id) { (void)tp; (void)size; (void)id; return 0; }
int tpClear(TP_STRUCT * const tp) { (void)tp; count = 0; return 0; }
int tpSetCycleTime(TP_STRUCT *tp, double seconds) { (void)tp; cycle_time = seconds; return 0; }
int tpSetVmax(TP_STRUCT *tp, double v, double most) { (void)tp; (void)v; (void)most; return 0; }
int tpSetVlimit(TP_STRUCT *tp, double limit) { (void)tp; (void)limit; return 0; }
int tpSetAmax(TP_STRUCT *tp, double a) { (void)tp; (void)a; return 0; }
int tpSetId(TP_STRUCT *tp, int id) { (void)tp; next_id = id; return 0; }
int tpGetExecId(TP_STRUCT *tp) { (void)tp; return exec_id; }
struct state_tag_t tpGetExecTag(TP_STRUCT * const tp) { struct state_tag_t tag; (void)tp; memset(&tag, 0, sizeof tag); return tag; }
int tpSetTermCond(TP_STRUCT *tp, int condition, double tolerance) { (void)tp; (void)condition; (void)tolerance; return 0; }
int tpSetPos(TP_STRUCT *tp, EmcPose const * const pos) { (void)tp; here = from = *pos; return 0; }
int tpPause(TP_STRUCT *tp) { (void)tp; paused = 1; return 0; }
int tpResume(TP_STRUCT *tp) { (void)tp; paused = 0; return 0; }
int tpAbort(TP_STRUCT *tp) { (void)tp; aborted = 1; return 0; }
int tpSetSpindleSync(TP_STRUCT * const tp, int spindle, double sync, int mode) { (void)tp; (void)spindle; (void)sync; (void)mode; return 0; }
int tpGetMotionType(TP_STRUCT * const tp) { (void)tp; return count ? legs[first].type : 0; }
int tpIsDone(TP_STRUCT * const tp) { (void)tp; return !count; }
int tpQueueDepth(TP_STRUCT * const tp) { (void)tp; return count; }
int tpActiveDepth(TP_STRUCT * const tp) { (void)tp; return count > 0; }
int tcqFull(TC_QUEUE_STRUCT const * const queue) { (void)queue; return count >= LEGS - 1; }

#ifdef FAULT_ASKS
/* Refuses the move with what blendtp would find: the first joints there, how they move along Y, the way back, limits. */
static int say_joints(const EmcPose *end)
{
    KINEMATICS_FORWARD_FLAGS forward = 0;
    KINEMATICS_INVERSE_FLAGS inverse = 0;
    double joints[EMCMOT_MAX_JOINTS] = {0}, along[27] = {0, 1}, moved[27] = {0};
    double at[9] = {end->tran.x, end->tran.y, end->tran.z, end->a, end->b, end->c};
    EmcPose back;
    int (*jet)(const double *, const double *, double *) = dlsym(RTLD_DEFAULT, "framekinsJet");
    int (*axis)(int) = dlsym(RTLD_DEFAULT, "framekinsAxisOfJoint");
    int (*tilt)(void) = dlsym(RTLD_DEFAULT, "framekinsToolTiltAxis");
    kinematicsInverse(end, joints, &inverse, &forward);
    kinematicsForward(joints, &back, &forward, &inverse);
    jet(at, along, moved);
    rtapi_print_msg(RTAPI_MSG_ERR, "at %.3f %.3f, along %.3f %.3f, back %.3f, axis %d, tilt %d, type %d, joints %d, limits %g %g %g\n",
                    joints[0], joints[1], moved[0], moved[1], back.tran.x, axis(4), tilt(), config->kinType, config->numJoints,
                    *pins->joint[0], *pins->joint[1], *pins->joint[2]);
    return -9;
}
#endif

int tpAddLine(TP_STRUCT * const tp, EmcPose end, int type, double velocity, double most, double acceleration,
              unsigned char enables, char at_speed, int indexer, struct state_tag_t tag)
{
    (void)tp; (void)most; (void)acceleration; (void)enables; (void)at_speed; (void)indexer; (void)tag;
#ifdef FAULT_REFUSES
    if (next_id == 3) {
        rtapi_print_msg(RTAPI_MSG_ERR, "made-up: no third move\n");
        return -7;
    }
#endif
#ifdef FAULT_ASKS
    return say_joints(&end);
#endif
#ifdef FAULT_SKIPS
    if (next_id == 2)
        return 0;
#endif
    legs[(first + count) % LEGS] = (struct leg){end, velocity, next_id, type};
    count++;
    return 0;
}

int tpAddCircle(TP_STRUCT * const tp, EmcPose end, PmCartesian centre, PmCartesian normal, int turn, int type,
                double velocity, double most, double acceleration, unsigned char enables, char at_speed, struct state_tag_t tag)
{
    (void)centre; (void)normal; (void)turn;
    return tpAddLine(tp, end, type, velocity, most, acceleration, enables, at_speed, -1, tag);
}

int tpAddRigidTap(TP_STRUCT * const tp, EmcPose end, double velocity, double most, double acceleration,
                  unsigned char enables, double scale, struct state_tag_t tag)
{
    (void)tp; (void)end; (void)velocity; (void)most; (void)acceleration; (void)enables; (void)scale; (void)tag;
    return -1;
}

int tpSetAout(TP_STRUCT * const tp, unsigned char index, double start, double end) { (void)tp; (void)index; (void)start; (void)end; return 0; }
int tpSetDout(TP_STRUCT * const tp, int index, unsigned char start, unsigned char end) { (void)tp; (void)index; (void)start; (void)end; return 0; }
int tpSetRunDir(TP_STRUCT * const tp, tc_direction_t direction) { (void)tp; (void)direction; return 0; }

static double along(double start, double end, double share) { return start + share * (end - start); }

int tpRunCycle(TP_STRUCT * const tp, long period)
{
    (void)tp; (void)period;
    cycles++;
    if (aborted) {
        count = 0;
        aborted = 0;
    }
    if (!count || paused)
        return 0;
#ifdef FAULT_CRASHES
    if (cycles == 50)
        *nowhere = 1;
#endif
#ifdef FAULT_HANGS
    while (cycles == 50)
        ;
#endif
#ifdef FAULT_EXITS
    if (cycles == 50)
        _exit(0);
#endif
#ifdef FAULT_ALLOCATES
    if (cycles % 10 == 0) {
        memory = malloc(10);
        free(memory);
    }
#endif
#ifdef FAULT_GIVES_UP
    if (cycles == 50) {
        rtapi_print_msg(RTAPI_MSG_ERR, "made-up: an internal fault\n");
        count = 0;
        from = here;
        gone = 0;
        return 0;
    }
#endif
#ifdef FAULT_STANDS
    if (cycles >= 50 && stood < 20) {
        stood++;
        return 0;
    }
#endif
#ifdef FAULT_STICKS
    if (cycles >= 50)
        return 0;
#endif
    struct leg *leg = &legs[first];
    double x = leg->end.tran.x - from.tran.x, y = leg->end.tran.y - from.tran.y, z = leg->end.tran.z - from.tran.z;
    double length = sqrt(x * x + y * y + z * z);
    gone += leg->velocity * status->net_feed_scale * cycle_time;
    exec_id = leg->id;
    if (gone >= length - 1e-9) {
        here = from = leg->end;
        gone = 0;
        first = (first + 1) % LEGS;
        count--;
    } else {
        here.tran.x = along(from.tran.x, leg->end.tran.x, gone / length);
        here.tran.y = along(from.tran.y, leg->end.tran.y, gone / length);
        here.tran.z = along(from.tran.z, leg->end.tran.z, gone / length);
    }
    return 0;
}

int tpGetPos(TP_STRUCT const * const tp, EmcPose * const pos)
{
    (void)tp;
    *pos = here;
#ifdef FAULT_JUMPS
    if (cycles == 50)
        pos->tran.y += 0.3;
#endif
#ifdef FAULT_WANDERS
    /* another place at each time */
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    pos->tran.y += 1e-15 * now.tv_nsec;
#endif
#ifdef FAULT_NOT_A_NUMBER
    if (cycles == 50)
        pos->tran.y = NAN;
#endif
    return 0;
}
