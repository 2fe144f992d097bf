/* blendtp: a trajectory planner module of LinuxCNC ([TRAJ]TPMOD = blendtp).
 *
 * This file owns the HAL pins and defines the functions of tp.h that motmod calls, so that the C compiler checks each
 * against LinuxCNC's header; every one forwards to the library (include/framepath.h).
 * The pins are explained in blendtp.9.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"
#include "kinematics.h"
#include "framepath.h"
#include "beside_motmod.h"
#include "first_loaded.h"
#include "ini_jerk.h"
#include "linuxcnc_version.h"
#include "loaded_beside.h"
#include "motion_threads.h"
#include "run_direction.h"
#include "shared_structures.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("Jerk-limited trajectory planner");
MODULE_LICENSE("GPL");

#define AXES 9
static const char letters[AXES + 1] = "xyzabcuvw";

static struct {
    hal_float_t *max_jerk[AXES];
    hal_float_t *millimetre;
    hal_float_t *rotary_tolerance;
    hal_float_t *default_tolerance;
    hal_bit_t *corners_inside;
    hal_u32_t *version;
} *pins;

static int component;
static struct framepath_planner *planner;
/* [AXIS_L]MAX_JERK of the INI, 0 where it has none, or where it has been looked at. */
static double ini_jerk[AXES];

/* What motmod handed over; the library gets it when it is known to fit. */
static struct {
    emcmot_status_t *status;
    emcmot_config_t *config;
} motion;

/* The name of the kinematics module. */
static char kinematics[64] = "the kinematics module";

/* What no move may exceed, and whether that was ever above 0: then it is the operator's slider that holds the machine. */
static double greatest_velocity = 1;
static int was_positive;

/* framekins says how the axes of the program lie to those of the machine; other kinematics do not have it. */
static int (*linear_map)(double map[9]);
static int (*tool_tilt_axis)(void);

#ifdef FRAMEPATH_FAULT_INJECTION
#include "fault_injection.h"
#endif

#include "linuxcnc_differences.h"
#include "operator_pins.h"
#include "pin_limits.h"
#include "joint_pins.h"
#include "joints_on_the_way.h"
#include "not_a_number.h"
#include "unloaded_modules.h"

/* With a greatest velocity of 0 in the INI a program would wait for ever without a word. */
static int has_velocity(void)
{
    if (greatest_velocity > 0 || was_positive)
        return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the greatest velocity of the machine is %g: [TRAJ]MAX_LINEAR_VELOCITY has to be "
                    "positive\n", greatest_velocity);
    return -1;
}

/* What the planner has to know before a move is added. */
static int prepare(void)
{
    double map[9];
    if (check_thread() || check_loaded())
        return -1;
    say_forgotten_jerk_limits();
    if (linear_map)
        framepath_planner_set_machine_map(planner, linear_map(map), map);
    if (tool_tilt_axis)
        framepath_planner_set_tool_tilt_axis(planner, tool_tilt_axis());
    framepath_planner_set_corners_inside(planner, *pins->corners_inside);
    return has_velocity() || take_jerk_limits() || take_joint_limits() || take_tolerances() ? -1 : 0;
}

/* Says why a move was refused; zero-length moves are no error. */
static int said(int result)
{
    if (result < 0)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s\n", framepath_planner_error_text(planner));
    return result;
}

/* Hands over the kinematics, whose joints are looked at on the way of each move. Their type is what motmod noted: kinematicsType
 * sets matrixkins up anew each time, and the second time without its parameters. */
static void find_kinematics(void)
{
    int (*inverse)(const EmcPose *, double *, const unsigned long *, unsigned long *);
    int (*forward)(const double *, EmcPose *, const unsigned long *, unsigned long *);
    const char *(*inner)(void);
    Dl_info file;
    *(void **)&inverse = dlsym(RTLD_DEFAULT, "kinematicsInverse");
    *(void **)&forward = dlsym(RTLD_DEFAULT, "kinematicsForward");
    *(void **)&inner = dlsym(RTLD_DEFAULT, "framekinsInner");
    if (inverse && dladdr(*(void **)&inverse, &file) && file.dli_fname) {
        const char *slash = strrchr(file.dli_fname, '/');
        const char *name = slash ? slash + 1 : file.dli_fname;
        snprintf(kinematics, sizeof kinematics, "%.*s", (int)strcspn(name, "."), name);
    }
    /* Behind a frame it is these that are asked. */
    if (inner && inner())
        snprintf(kinematics, sizeof kinematics, "%s", inner());
    /* It counts the turns of a joint from call to call, and would count those of the look along a move too. */
    if (!strcmp(kinematics, "rosekins"))
        inverse = NULL;
    if (!inverse)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s cannot be asked for joints on the way of a move: the soft limits are checked "
                        "at the ends of moves only\n", kinematics);
    framepath_planner_kinematics(inverse, forward, motion.config->kinType);
}

int tpCreate(TP_STRUCT * const tp, int queue_size, int id)
{
    (void)id;
    char found[128];
    if (check_structures(motion.status, motion.config, tp, found, sizeof found)) {
        say_built_for_another("blendtp", found);
        return -1;
    }
    framepath_planner_motion_data(motion.status, motion.config);
    planner = framepath_planner_create(tp, queue_size);
    if (!planner) {
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: motmod asks for a queue of %d moves, %d is the most\n", queue_size,
                        FRAMEPATH_QUEUE_CAPACITY);
        return -1;
    }
    if (is_loaded("tpmod", &pins))
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: tpmod is loaded, too, and has nothing to do: remove its loadrt\n");
    /* motmod is loaded after the kinematics, so they can be looked up now; here, not in the servo thread. */
    *(void **)&linear_map = dlsym(RTLD_DEFAULT, "framekinsLinearMap");
    *(void **)&tool_tilt_axis = dlsym(RTLD_DEFAULT, "framekinsToolTiltAxis");
    find_frames();
    find_kinematics();
    find_joint_jet();
    return 0;
}

void tpMotFunctions(void (*dio_write)(int, char), void (*aio_write)(int, double), void (*set_rotary_unlock)(int, int),
                    int (*get_rotary_unlock)(int), double (*axis_velocity_limit)(int),
                    double (*axis_acceleration_limit)(int))
{
    framepath_planner_motion_functions(dio_write, aio_write, set_rotary_unlock, get_rotary_unlock, axis_velocity_limit,
                                       axis_acceleration_limit);
}

void tpMotData(emcmot_status_t *status, emcmot_config_t *config)
{
    motion.status = status;
    motion.config = config;
}

int tpAddLine(TP_STRUCT * const tp, EmcPose end, int canon_motion_type, double vel, double ini_maxvel, MOVE_LIMITS,
              unsigned char enables, char atspeed, int indexer, struct state_tag_t tag)
{
    (void)acc;
    if (prepare())
        return -1;
    return said(framepath_planner_add_line(planner, tp, &end, canon_motion_type, vel, ini_maxvel, path_jerk, enables, atspeed,
                                           indexer, &tag));
}

int tpAddCircle(TP_STRUCT * const tp, EmcPose end, PmCartesian center, PmCartesian normal, int turn,
                int canon_motion_type, double vel, double ini_maxvel, MOVE_LIMITS, unsigned char enables, char atspeed,
                struct state_tag_t tag)
{
    (void)acc;
    if (prepare())
        return -1;
    return said(framepath_planner_add_circle(planner, tp, &end, &center, &normal, turn, canon_motion_type, vel, ini_maxvel, path_jerk,
                                             enables, atspeed, &tag));
}

int tpAddRigidTap(TP_STRUCT * const tp, EmcPose end, double vel, double ini_maxvel, MOVE_LIMITS, unsigned char enables,
                  double scale, struct state_tag_t tag)
{
    (void)vel;
    (void)acc;
    if (prepare())
        return -1;
    return said(framepath_planner_add_rigid_tap(planner, tp, &end, ini_maxvel, path_jerk, enables, scale, &tag));
}

int tpRunCycle(TP_STRUCT * const tp, long period)
{
    static const char *told;
    int result;
    const char *fault, *spindle;
    double asked, greatest;
    controller_plans(period);
    period_of_direction(tp);
#ifdef FRAMEPATH_FAULT_INJECTION
    if (!is_unloaded())
        inject_fault(tp);
#endif
    result = framepath_planner_run_cycle(planner, tp);
    report_path_motion(motion.status);
    say_finding();
    say_not_a_number(tp, motion.status);
    spindle = framepath_planner_spindle_error_text(planner, &asked, &greatest);
    if (spindle && asked > 0)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the motion was stopped, since %s (%.4g units a second, %.4g at most)\n",
                        spindle, asked, greatest);
    else if (spindle)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the motion was stopped, since %s\n", spindle);
    fault = framepath_planner_fault_text(planner);
    if (fault && fault != told)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the motion was stopped, since %s. This is a fault of blendtp: please "
                        "report it with the program\n", fault);
    told = fault;
    return result;
}

int tpSetCycleTime(TP_STRUCT *tp, double seconds)
{
    int result = framepath_planner_set_cycle_time(planner, tp, seconds);
    /* motmod begins with 0, before it knows better. */
    if (result != TP_ERR_OK && seconds != 0)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: nothing can be planned for servo periods of %g s: [EMCMOT]SERVO_PERIOD is a number "
                        "of nanoseconds from 10000 to 100000000\n", seconds);
    return result;
}

int tpSetVmax(TP_STRUCT *tp, double vmax, double ini_maxvel)
{
    /* Every move brings its own velocity. */
    (void)tp;
    (void)vmax;
    (void)ini_maxvel;
    return command_comes(motion.status) ? TP_ERR_FAIL : TP_ERR_OK;
}

int tpSetVlimit(TP_STRUCT *tp, double limit)
{
    (void)tp;
    if (command_comes(motion.status))
        return TP_ERR_FAIL;
    greatest_velocity = limit;
    was_positive |= limit > 0;
    return framepath_planner_set_velocity_limit(planner, limit);
}

int tpSetAmax(TP_STRUCT *tp, double amax)
{
    /* Acceleration is limited axis by axis. */
    (void)tp;
    (void)amax;
    return command_comes(motion.status) ? TP_ERR_FAIL : TP_ERR_OK;
}

int tpSetId(TP_STRUCT *tp, int id)
{
    (void)tp;
    if (move_comes(motion.status))
        return TP_ERR_FAIL;
    return framepath_planner_set_id(planner, id);
}

int tpSetTermCond(TP_STRUCT *tp, int condition, double tolerance)
{
    (void)tp;
    if (command_comes(motion.status))
        return TP_ERR_FAIL;
    return framepath_planner_set_termination(planner, condition, tolerance);
}

int tpSetPos(TP_STRUCT *tp, EmcPose const *position)
{
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_set_position(planner, tp, position);
}

int tpSetSpindleSync(TP_STRUCT * const tp, int spindle, double sync, int velocity_mode)
{
    (void)tp;
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_set_spindle_sync(planner, spindle, sync, velocity_mode);
}

int tpSetAout(TP_STRUCT * const tp, unsigned char index, double start, double end)
{
    (void)tp;
    (void)end;
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_set_analog_output(planner, index, start);
}

int tpSetDout(TP_STRUCT * const tp, int index, unsigned char start, unsigned char end)
{
    (void)tp;
    (void)end;
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_set_digital_output(planner, index, start);
}

int tpSetRunDir(TP_STRUCT * const tp, tc_direction_t direction)
{
    int result;
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    result = framepath_planner_set_run_direction(planner, tp, direction);
    direction_asked(tp, motion.status, direction, result);
    return result == TP_ERR_OK ? TP_ERR_OK : TP_ERR_FAIL;
}

int tpClear(TP_STRUCT *tp)
{
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_clear(planner, tp);
}

int tpPause(TP_STRUCT *tp)
{
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_pause(planner, tp);
}

int tpResume(TP_STRUCT *tp)
{
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_resume(planner, tp);
}

int tpAbort(TP_STRUCT *tp)
{
    if (is_misplaced_command())
        return TP_ERR_FAIL;
    return framepath_planner_abort(planner, tp);
}

int tpGetPos(TP_STRUCT const * const tp, EmcPose *position)
{
    (void)tp;
    return framepath_planner_position(planner, position);
}

int tpGetExecId(TP_STRUCT *tp)
{
    return tp->execId;
}

struct state_tag_t tpGetExecTag(TP_STRUCT * const tp)
{
    return tp->execTag;
}

int tpGetMotionType(TP_STRUCT * const tp)
{
    return tp->motionType;
}

int tpIsDone(TP_STRUCT * const tp)
{
    return tp->done;
}

int tpQueueDepth(TP_STRUCT * const tp)
{
    return tp->depth;
}

int tpActiveDepth(TP_STRUCT * const tp)
{
    return tp->activeDepth;
}

int tcqFull(TC_QUEUE_STRUCT const * const queue)
{
    int full = framepath_planner_queue_full(planner);
    (void)queue;
    controller_ends();
    period_runs();
    if (!is_unloaded())
        show_operator();
    return full;
}

EXPORT_SYMBOL(tpCreate);
EXPORT_SYMBOL(tpMotFunctions);
EXPORT_SYMBOL(tpMotData);
EXPORT_SYMBOL(tpAddLine);
EXPORT_SYMBOL(tpAddCircle);
EXPORT_SYMBOL(tpAddRigidTap);
EXPORT_SYMBOL(tpRunCycle);
EXPORT_SYMBOL(tpSetCycleTime);
EXPORT_SYMBOL(tpSetVmax);
EXPORT_SYMBOL(tpSetVlimit);
EXPORT_SYMBOL(tpSetAmax);
EXPORT_SYMBOL(tpSetId);
EXPORT_SYMBOL(tpSetTermCond);
EXPORT_SYMBOL(tpSetPos);
EXPORT_SYMBOL(tpSetSpindleSync);
EXPORT_SYMBOL(tpSetAout);
EXPORT_SYMBOL(tpSetDout);
EXPORT_SYMBOL(tpSetRunDir);
EXPORT_SYMBOL(tpClear);
EXPORT_SYMBOL(tpPause);
EXPORT_SYMBOL(tpResume);
EXPORT_SYMBOL(tpAbort);
EXPORT_SYMBOL(tpGetPos);
EXPORT_SYMBOL(tpGetExecId);
EXPORT_SYMBOL(tpGetExecTag);
EXPORT_SYMBOL(tpGetMotionType);
EXPORT_SYMBOL(tpIsDone);
EXPORT_SYMBOL(tpQueueDepth);
EXPORT_SYMBOL(tpActiveDepth);
EXPORT_SYMBOL(tcqFull);

int rtapi_app_main(void)
{
    int error = 0;
    if (check_version("blendtp") || check_first("blendtp", "tpCreate", &pins, "write TPMOD = blendtp under [TRAJ] in the INI, "
                                                "and no loadrt of a planner")
        || check_before_motmod("blendtp", &pins))
        return -22; /* EINVAL */
    component = hal_init("blendtp");
    if (component < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: hal_init failed (%d): is it loaded already? Load it once\n", component);
        return component;
    }
    pins = hal_malloc(sizeof *pins);
    if (!pins)
        error = 1;
    for (int i = 0; i < AXES && !error; i++)
        error |= hal_pin_float_newf(HAL_IN, &pins->max_jerk[i], component, "blendtp.axis.%c.max-jerk", letters[i]);
    if (!error)
        error |= make_joint_pins();
    if (!error)
        error |= hal_pin_float_newf(HAL_IN, &pins->millimetre, component, "blendtp.millimetre");
    if (!error)
        error |= hal_pin_float_newf(HAL_IN, &pins->rotary_tolerance, component, "blendtp.rotary-tolerance");
    if (!error)
        error |= hal_pin_float_newf(HAL_IN, &pins->default_tolerance, component, "blendtp.default-tolerance");
    if (!error)
        error |= hal_pin_bit_newf(HAL_IN, &pins->corners_inside, component, "blendtp.corners-inside");
    if (!error)
        error |= hal_pin_u32_newf(HAL_OUT, &pins->version, component, "blendtp.version") || make_operator_pins();
#ifdef FRAMEPATH_FAULT_INJECTION
    if (!error)
        error |= make_fault_pins();
#endif
    if (error) {
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: HAL has no room for the pins; raise HAL_SIZE or load fewer components\n");
        hal_exit(component);
        return -12; /* ENOMEM */
    }
    *pins->millimetre = 1.0;
    *pins->default_tolerance = FRAMEPATH_DEFAULT_TOLERANCE;
    *pins->version = FRAMEPATH_VERSION;
    read_ini_jerk(letters, AXES, ini_jerk);
    for (int i = 0; i < AXES; i++)
        *pins->max_jerk[i] = jerk_without_pin(ini_jerk[i]);
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    leave_motmod("blendtp", "the moves that are queued run, no further one is taken. End LinuxCNC and start it anew");
    hal_exit(component);
}
