/* drive_planner SEED PERIODS [fault]
 * Calls every function of blendtp as motmod does, and as it never would: in random order, with plausible and hostile values,
 * in a process without LinuxCNC. The tools that watch memory say what is wrong; what motmod relies on is looked at here.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "rtapi.h"
#include "hal.h"
#include "motion.h"
#include "motion_types.h"
#include "tp.h"
#include "host.h"
#include "random.h"

/* One behind the other, as in motmod's shared memory; the block ends where they end. */
struct shared {
    struct emcmot_status_t status;
    struct emcmot_config_t config;
    struct emcmot_error_t error;
    struct emcmot_internal_t internal;
};

/* The limits of a move behind its velocities: its acceleration, since 2.10 the jerk along its path, which may be none. */
#ifdef LINUXCNC_HAS_MOVE_JERK
#define PLAIN_LIMITS(acceleration) acceleration, 0
#define LIMITS(acceleration) acceleration, pick(4) ? 0 : number(1000, 1e6)
#else
#define PLAIN_LIMITS(acceleration) acceleration
#define LIMITS(acceleration) acceleration
#endif

static struct shared *shared;
static TP_STRUCT *tp;
static int unlocked;
/* Moves that were taken, periods in which the machine moved, and those in which the status said how. */
static long taken, moved;
#ifdef LINUXCNC_HAS_PATH_MOTION
static long accelerated;
#endif

/* Motion tells of an output that it has not where it is given to the next move; at the start of one there are no such. */
static int is_given;
static void write_digital(int index, char value) { (void)value; REQUIRE(is_given != (index >= 0 && index < EMCMOT_MAX_DIO)); }
static void write_analog(int index, double value) { (void)value; REQUIRE(is_given != (index >= 0 && index < EMCMOT_MAX_AIO)); }
static void set_unlock(int joint, int unlock) { (void)joint; unlocked = unlock; }
static int get_unlocked(int joint) { (void)joint; return unlocked; }
static double velocity_limit(int axis) { return axis < 3 ? number(10, 500) : 90; }
static double acceleration_limit(int axis) { return axis < 3 ? number(100, 5000) : 900; }

static EmcPose pose(void)
{
    EmcPose at = {{number(-50, 50), number(-50, 50), number(-50, 50)}, 0, 0, 0, 0, 0, 0};
    if (!pick(4)) {
        at.a = number(-90, 90);
        at.b = number(-90, 90);
        at.c = number(-400, 400);
        at.u = number(-5, 5);
        at.v = number(-5, 5);
        at.w = number(-5, 5);
    }
    return at;
}

static struct state_tag_t tag(void)
{
    struct state_tag_t tag;
    memset(&tag, pick(256), sizeof tag);
    tag.fields[GM_FIELD_G_MODE_0] = pick(20) ? -1 : 530;
    return tag;
}

static PmCartesian vector(double size)
{
    PmCartesian vector = {number(-size, size), number(-size, size), number(-size, size)};
    return vector;
}

static void add_move(void)
{
    double feed = number(.1, 300);
    int kind = pick(12), result;
    shared->status.commandNumEcho += pick(9) > 0;
    shared->status.commandEcho = EMCMOT_SET_LINE;
    tpSetId(tp, whole(1000));
    if (kind < 8)
        result = tpAddLine(tp, pose(), whole(6), feed, number(10, 400), LIMITS(number(1, 5000)), random_bits(), !pick(9), whole(16), tag());
    else if (kind < 11)
        result = tpAddCircle(tp, pose(), vector(50), vector(1), whole(4), whole(6), feed, number(10, 400), LIMITS(number(1, 5000)),
                    random_bits(), !pick(9), tag());
    else
        result = tpAddRigidTap(tp, pose(), feed, number(10, 400), LIMITS(number(1, 5000)), random_bits(), number(1, 2), tag());
    taken += result == TP_ERR_OK;
}

static void set_something(void)
{
    EmcPose at;
    switch (pick(13)) {
    case 0: tpSetTermCond(tp, whole(3), number(0, .5)); break;
    case 1: tpSetVmax(tp, number(0, 300), number(0, 300)); break;
    case 2: tpSetVlimit(tp, number(0, 300)); break;
    case 3: tpSetAmax(tp, number(0, 3000)); break;
    case 4: is_given = 1; tpSetAout(tp, whole(64), number(-10, 10), number(-10, 10)); is_given = 0; break;
    case 5: is_given = 1; tpSetDout(tp, whole(64), pick(2), pick(2)); is_given = 0; break;
    case 6: tpSetSpindleSync(tp, whole(8), pick(3) ? 0 : number(-2, 2), pick(2)); break;
    case 7: tpSetRunDir(tp, pick(3) ? TC_DIR_FORWARD : pick(3)); break;
    case 8: shared->status.net_feed_scale = shared->status.feed_scale = number(0, 2); break;
    case 9: shared->status.stepping = !pick(9); break;
    case 10: shared->config.numSpindles = whole(9); break;
    case 11: at = pose(); if (!pick(30)) tpSetPos(tp, &at); break;
    default: if (!pick(30)) tpSetCycleTime(tp, number(.0001, .01));
    }
}

/* As task commands it, for an operator or because motion has an error. */
static void abort_motion(void)
{
    shared->status.commandEcho = EMCMOT_ABORT;
    tpAbort(tp);
    shared->status.motionFlag &= ~EMCMOT_MOTION_ERROR_BIT;
}

static void operate(void)
{
    if (shared->status.motionFlag & EMCMOT_MOTION_ERROR_BIT)
        abort_motion();
    switch (pick(200)) {
    case 0: tpPause(tp); break;
    case 1: if (pick(2)) tpAbort(tp); else abort_motion(); break;
    case 2: tpClear(tp); break;
    case 3: case 4: case 5: tpResume(tp); break;
    case 6: framepath_host_set("axis.x.max-jerk", number(1e3, 1e6)); break;
    case 7: framepath_host_set("axis.x.max-jerk", 20000); framepath_host_set("default-tolerance", .02); break;
    case 8: framepath_host_set("rotary-tolerance", number(0, 1)); break;
    case 9: framepath_host_set("millimetre", number(.03, 1)); break;
    case 10: framepath_host_set("default-tolerance", number(0, .1)); break;
    case 12: framepath_host_set("corners-inside", pick(2)); break;
    case 11: framepath_host_set("millimetre", 1); framepath_host_set("rotary-tolerance", 0); break;
    default: break;
    }
}

static void turn_spindles(void)
{
    for (int i = 0; i < EMCMOT_MAX_SPINDLES; i++) {
        spindle_status_t *spindle = &shared->status.spindle_status[i];
        spindle->spindleSpeedIn = number(0, 20);
        spindle->spindleRevs += number(0, .02);
        spindle->at_speed = pick(9) > 0;
        spindle->speed = number(-1200, 1200);
        spindle->direction = pick(3) - 1;
        if (spindle->spindle_index_enable && !pick(9))
            spindle->spindle_index_enable = 0;
    }
}

/* What LinuxCNC 2.10 reads of the way along the path: numbers, and a direction or none. */
static void look_at_path_motion(void)
{
#ifdef LINUXCNC_HAS_PATH_MOTION
    const emcmot_status_t *status = &shared->status;
    const PmCartesian way = status->current_dir;
    double length = sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
    REQUIRE(isfinite(status->current_acc) && isfinite(status->current_jerk));
    REQUIRE(length == 0 || fabs(length - 1) < 1e-9);
    accelerated += status->current_acc != 0 && status->current_jerk != 0 && length != 0;
#endif
}

/* What motmod does in a servo period, and what has to be so for it to go on. */
static void run_period(void)
{
    EmcPose at;
    turn_spindles();
    tpRunCycle(tp, 1000000);
    REQUIRE(tpGetPos(tp, &at) == 0);
    REQUIRE(isfinite(at.tran.x) && isfinite(at.tran.y) && isfinite(at.tran.z) && isfinite(at.a) && isfinite(at.w));
    REQUIRE(tpQueueDepth(tp) >= 0 && tpQueueDepth(tp) <= DEFAULT_TC_QUEUE_SIZE);
    REQUIRE(tpActiveDepth(tp) >= 0 && tpActiveDepth(tp) <= tpQueueDepth(tp));
    moved += shared->status.current_vel > 0;
    look_at_path_motion();
    tpGetExecId(tp);
    tpGetExecTag(tp);
    tpGetMotionType(tp);
    tpIsDone(tp);
    tcqFull(&tp->queue);
}

/* As motmod leaves them when it hands them over. */
static struct shared *new_structures(size_t room)
{
    struct shared *structures = calloc(1, room);
    emcmot_status_t *status = &structures->status;
    status->feed_scale = status->rapid_scale = status->net_feed_scale = 1.0;
    status->enables_new = status->enables_queued = FS_ENABLED | SS_ENABLED | FH_ENABLED;
    for (int i = 0; i < EMCMOT_MAX_SPINDLES; i++)
        status->spindle_status[i].scale = 1.0;
    structures->config.numJoints = 3;
    structures->config.kinType = KINEMATICS_IDENTITY;
    structures->config.numSpindles = 1;
    structures->config.numDIO = structures->config.numAIO = 4;
    for (int i = 0; i < EMCMOT_MAX_JOINTS; i++) {
        status->joint_status[i].max_pos_limit = 100;
        status->joint_status[i].min_pos_limit = -100;
    }
    return structures;
}

/* A motmod that lays out its structures otherwise, as 2.10 does: refused, and nothing written to them. */
static void refuse_other_layouts(void)
{
    const size_t further = 392;
    const size_t room = sizeof *shared + further;
    struct shared *there = new_structures(room), *before = malloc(room);
    TP_STRUCT *planner = &there->internal.coord_tp;
    emcmot_config_t *config = (emcmot_config_t *)((char *)&there->config + further);
    memcpy(before, there, room);
    tpMotData(NULL, NULL);
    REQUIRE(tpCreate(planner, DEFAULT_TC_QUEUE_SIZE, 1) == -1);
    REQUIRE(strstr(framepath_host_first_error(), "built for LinuxCNC"));
    tpMotData(&there->status, config);
    REQUIRE(tpCreate((TP_STRUCT *)((char *)planner + further), DEFAULT_TC_QUEUE_SIZE, 1) == -1);
    tpMotData(&there->status, &there->config);
    REQUIRE(tpCreate((TP_STRUCT *)((char *)planner + further), DEFAULT_TC_QUEUE_SIZE, 1) == -1);
    REQUIRE(framepath_host_errors() == 3);
    REQUIRE(!memcmp(before, there, room));
    REQUIRE(tpCreate(planner, INT_MAX, 1) == -1);
    free(before);
    free(there);
}

/* A pin with a value that makes no sense refuses a move by its name, before any of it takes effect. */
static void refuse_by_name(const char *pin, double value, double sensible)
{
    char words[64];
    EmcPose end = {{1, 1, 1}, 0, 0, 0, 0, 0, 0};
    snprintf(words, sizeof words, "blendtp.%s is ", pin);
    framepath_host_forget_errors();
    REQUIRE(framepath_host_set(pin, value) == 1);
    REQUIRE(tpAddLine(tp, end, EMC_MOTION_TYPE_FEED, 10, 10, PLAIN_LIMITS(100), 0, 0, -1, tag()) == -1);
    REQUIRE(!strncmp(framepath_host_first_error(), words, strlen(words)));
    REQUIRE(strchr(framepath_host_first_error() + strlen(words), ':'));
    REQUIRE(framepath_host_errors() == 1);
    framepath_host_set(pin, sensible);
}

/* The first move says what the INI has and no pin, once; where there is no INI, nothing. LinuxCNC 2.10 knows the INI's key:
 * there the pins begin with it. */
static void first_move(void)
{
    EmcPose end = {{0, 0, 1}, 0, 0, 0, 0, 0, 0};
#ifdef LINUXCNC_HAS_MOVE_JERK
    unsigned long expected = 0;
#else
    unsigned long expected = getenv("INI_FILE_NAME") != NULL;
#endif
    framepath_host_forget_errors();
    for (int i = 0; i < 2; i++) {
        REQUIRE(tpAddLine(tp, end, EMC_MOTION_TYPE_FEED, 10, 10, PLAIN_LIMITS(100), 0, 0, -1, tag()) >= 0);
        REQUIRE(framepath_host_errors() == expected);
    }
    REQUIRE(!expected || strstr(framepath_host_first_error(), "nothing sets blendtp.axis.y.max-jerk"));
    REQUIRE(tpClear(tp) == 0);
}

static void refuse_impossible_pins(void)
{
    static const double impossible[] = {NAN, -INFINITY, -1, -1e-300};
    for (unsigned i = 0; i < sizeof impossible / sizeof impossible[0]; i++) {
        refuse_by_name("axis.x.max-jerk", impossible[i], 0);
        refuse_by_name("axis.w.max-jerk", impossible[i], 0);
        refuse_by_name("millimetre", impossible[i], 1);
        refuse_by_name("rotary-tolerance", impossible[i], 0);
        refuse_by_name("default-tolerance", impossible[i], .02);
    }
    refuse_by_name("millimetre", 0, 1);
    refuse_by_name("millimetre", INFINITY, 1);
    refuse_by_name("rotary-tolerance", INFINITY, 0);
    refuse_by_name("default-tolerance", INFINITY, .02);
}

/* Where the joints are the axes their limits are not looked at, which is said once. */
static void tell_of_trivial_joints(void)
{
    EmcPose end = {{0, 0, 1}, 0, 0, 0, 0, 0, 0};
    framepath_host_forget_errors();
    framepath_host_set("joint.0.max-velocity", 5);
    for (int i = 0; i < 2; i++)
        REQUIRE(tpAddLine(tp, end, EMC_MOTION_TYPE_FEED, 10, 10, PLAIN_LIMITS(100), 0, 0, -1, tag()) >= 0);
    REQUIRE(framepath_host_errors() == 1);
    REQUIRE(strstr(framepath_host_first_error(), "are the axes"));
    framepath_host_set("joint.0.max-velocity", 0);
    REQUIRE(tpClear(tp) == 0);
}

int main(int argc, char **argv)
{
    if (argc < 3)
        return 2;
    random_state += strtoull(argv[1], NULL, 10) * 0x9E3779B97F4A7C15ULL;
    commit_fault(argc, argv);
    REQUIRE(rtapi_app_main() == 0);
    tpMotFunctions(write_digital, write_analog, set_unlock, get_unlocked, velocity_limit, acceleration_limit);
    refuse_other_layouts();
    shared = new_structures(sizeof *shared);
    tp = &shared->internal.coord_tp;
    tpMotData(&shared->status, &shared->config);
    REQUIRE(tpCreate(tp, DEFAULT_TC_QUEUE_SIZE, 1) == 0);
    REQUIRE(tpSetCycleTime(tp, .001) == 0);
    first_move();
    refuse_impossible_pins();
    tell_of_trivial_joints();
    long period = 0;
    for (; period < strtol(argv[2], NULL, 10); period++) {
        while (!pick(3))
            add_move();
        while (!pick(4))
            set_something();
        operate();
        run_period();
    }
    REQUIRE(period < 1000 || (taken > period / 10 && moved > period / 10));
#ifdef LINUXCNC_HAS_PATH_MOTION
    REQUIRE(period < 1000 || accelerated > period / 100);
#endif
    printf("%ld moves taken, motion in %ld periods, %lu messages\n", taken, moved, framepath_host_errors());
    rtapi_app_exit();
    free(shared);
    return 0;
}
