/* framekins: a kinematics module of LinuxCNC with programmable frames in front of the machine's own kinematics, which are
 * the library's or those of another module.
 *
 * This file owns the HAL pins and forwards to the library (include/framepath.h).
 * The pins are explained in framekins.9.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

#include <math.h>

#include "framepath.h"
#include "beside_motmod.h"
#include "external_offsets.h"
#include "first_loaded.h"
#include "frame_messages.h"
#include "frame_parameters.h"
#include "impossible_pins.h"
#include "inner_kinematics.h"
#include "linuxcnc_version.h"
#include "servo_thread.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("Kinematics with programmable frames: translate, rotate, scale, mirror");
MODULE_LICENSE("GPL");

/* The dimensions of a machine with a tilting rotary table have the names of LinuxCNC's xyzac-trt-kins. */
static struct {
    hal_float_t *command, *value[3], *check;
    hal_float_t *work_offset[3], *work_rotation, *tool_offset[3];
    hal_float_t *map[12];
    hal_bit_t *mirror[6];
    hal_bit_t *in_position, *teleop, *tool_length_machine;
    hal_float_t *rotation_point[3], *offset[3], *table_tool_offset;
    hal_bit_t *conventional_directions, *tool_centre_point;
    hal_float_t *tilt_range[2], *rotary_range[2];
    hal_float_t *switchkins_type, *acknowledged;
    hal_bit_t *active, *tool_centre_point_active, *parameters_pending;
    hal_float_t *frame_tool_offset[3];
    hal_s32_t *slot, *operations, *refusal, *tilt_axis, *normal_refusal;
    hal_float_t *normal_tilt, *normal_rotary;
    hal_s32_t *normal_tilt_axis, *normal_rotary_axis;
    hal_s32_t *retract_kind;
    hal_float_t *retract_way[3], *retract_z;
    hal_bit_t *enabled, *release_on_abort, *release, *releasing, *hold, *guarded;
    hal_s32_t *releases, *releases_seen;
    hal_u32_t *heartbeat, *version;
    hal_float_t *frame[12], *position[9], *turned_tool[3];
    hal_float_t *external_offset[OFFSETS];
    hal_float_t *inner_type;
    hal_s32_t *inner_type_active, *inner_refusal, *tool_centre_type, *axes_type;
    /* What frame_guard looks at. It has these linked to pins of its own, which are read without HAL's lock: a process that is
       killed while it holds that would stop every other one. Users link the ones of the same names above. */
    struct {
        hal_bit_t *active, *parameters_pending, *tool_length_matters;
        hal_s32_t *operations;
        hal_float_t *command, *acknowledged, *work_offset[3], *work_rotation, *tool_offset[3];
    } guard;
} *pins;

static int component;
static int has_table;
/* The next place that motion asks for is the one that it gives its planner: it does so itself behind a switch that worked,
 * before anything else asks (handle_kinematicsSwitch). */
static int is_place_of_planner;
static const double no_limits[2] = {-HUGE_VAL, HUGE_VAL};

/* What the pins of a tilting table say; nothing and no limits on a machine without one, which has no such pins. */
static void read_table_pins(struct framepath_frame_inputs *in)
{
    for (int i = 0; i < 3; i++) {
        in->rotation_point[i] = has_table ? *pins->rotation_point[i] : 0.0;
        in->offset[i] = has_table ? *pins->offset[i] : 0.0;
    }
    for (int i = 0; i < 2; i++) {
        in->tilt_range[i] = has_table || *behind ? *pins->tilt_range[i] : no_limits[i];
        in->rotary_range[i] = has_table || *behind ? *pins->rotary_range[i] : no_limits[i];
    }
    in->table_tool_offset = has_table ? *pins->table_tool_offset : 0.0;
    in->conventional_directions = has_table && *pins->conventional_directions;
    in->tool_centre_point = has_table && *pins->tool_centre_point;
}

/* What the pins say now. */
static struct framepath_frame_inputs read_pins(void)
{
    struct framepath_frame_inputs in;
    read_table_pins(&in);
    in.command = *pins->command;
    for (int i = 0; i < 3; i++) {
        in.value[i] = *pins->value[i];
        in.work_offset[i] = *pins->work_offset[i];
        in.tool_offset[i] = *pins->tool_offset[i];
    }
    in.work_rotation = *pins->work_rotation;
    for (int i = 0; i < 12; i++)
        in.map[i] = *pins->map[i];
    for (int i = 0; i < 6; i++)
        in.mirror[i] = *pins->mirror[i];
    in.tool_length_machine = *pins->tool_length_machine;
    in.in_position = *pins->in_position;
    in.teleop = *pins->teleop;
    in.check = *pins->check;
    in.enabled = *pins->enabled;
    in.release_on_abort = *pins->release_on_abort;
    in.release = *pins->release;
    in.releases_seen = *pins->releases_seen;
    in.heartbeat = *pins->heartbeat;
    in.period = 0.0;
    in.clock = 0;
    in.inner_type = *behind ? *pins->inner_type : 0.0;
    in.unknown_offset = has_unknown_offset(pins->external_offset);
    return in;
}

static void write_pins(const struct framepath_frame_outputs *out)
{
    *pins->switchkins_type = out->switchkins_type;
    *pins->acknowledged = out->acknowledged;
    *pins->active = out->active;
    *pins->slot = out->slot;
    *pins->operations = out->operations;
    *pins->refusal = out->refusal;
    *pins->tool_centre_point_active = out->tool_centre_point;
    *pins->parameters_pending = out->parameters_pending;
    for (int i = 0; i < 3; i++)
        *pins->frame_tool_offset[i] = out->tool_offset[i];
    *pins->normal_refusal = out->normal_refusal;
    *pins->normal_tilt = out->normal_tilt;
    *pins->normal_rotary = out->normal_rotary;
    *pins->normal_tilt_axis = out->normal_tilt_axis;
    *pins->normal_rotary_axis = out->normal_rotary_axis;
    *pins->releasing = out->releasing;
    *pins->releases = out->releases;
    *pins->hold = out->hold;
    *pins->guarded = out->guarded;
    for (int i = 0; i < 12; i++)
        *pins->frame[i] = out->frame[i];
    for (int i = 0; i < 9; i++)
        *pins->position[i] = out->position[i];
    for (int i = 0; i < 3; i++)
        *pins->turned_tool[i] = out->turned_tool[i];
    *pins->retract_kind = out->retract_kind;
    for (int i = 0; i < 3; i++)
        *pins->retract_way[i] = out->retract_way[i];
    *pins->retract_z = out->retract_z;
}

/* What is behind the frame, and why not what the pin asks for; that is told once. */
static void write_inner_pins(const struct framepath_frame_outputs *out)
{
    if (!*behind)
        return;
    if (out->inner_refusal && out->inner_refusal != *pins->inner_refusal) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: framekins.inner-type = %g is not taken by %s, and the machine is held: %s\n",
                        *pins->inner_type, behind, framepath_kinematics_refusal_text(out->inner_refusal));
        tell_unknown_offset(pins->external_offset);
    }
    *pins->inner_refusal = out->inner_refusal;
    *pins->inner_type_active = out->inner_type;
    *pins->tool_centre_type = out->tool_centre_type;
    *pins->axes_type = out->axes_type;
}

static void write_guard_pins(const struct framepath_frame_inputs *in, const struct framepath_frame_outputs *out)
{
    *pins->guard.active = out->active;
    *pins->guard.parameters_pending = out->parameters_pending;
    *pins->guard.tool_length_matters = out->tool_length_matters;
    *pins->guard.operations = out->operations;
    *pins->guard.command = in->command;
    *pins->guard.acknowledged = out->acknowledged;
    for (int i = 0; i < 3; i++) {
        *pins->guard.work_offset[i] = out->work_offset[i];
        *pins->guard.tool_offset[i] = out->tool_offset[i];
    }
    *pins->guard.work_rotation = out->work_rotation;
}

/* In the servo thread, behind motion-controller: takes commands, asks motion for a switch, shows the state. */
static void update(void *argument, long period)
{
    (void)argument;
    struct framepath_frame_inputs in = read_pins();
    in.period = period * 1e-9;
    in.clock = rtapi_get_time();
    struct framepath_frame_outputs out;
    period_runs();
    framepath_kinematics_forget_switch();
    if (is_misplaced())
        return;
    framepath_kinematics_update(&in, &out);
    /* Of each command, also where the one before was refused for the same reason. */
    int is_refused = out.refusal && (out.refusal != *pins->refusal || out.acknowledged != *pins->acknowledged);
    if (is_refused) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: frame refused: %s\n", framepath_kinematics_refusal_text(out.refusal));
        tell_unknown_offset(pins->external_offset);
    }
    if (is_refused || (out.parameters_pending && !*pins->parameters_pending))
        tell_impossible_pin(&in);
    tell_alarm(out.alarm);
    write_pins(&out);
    write_inner_pins(&out);
    write_guard_pins(&in, &out);
}

int kinematicsForward(const double *joints, struct EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    int answer;
    this_is_the_servo_thread();
    answer = *behind ? framepath_kinematics_inner_forward(joints, world, fflags, iflags) : framepath_kinematics_forward(joints, world);
    if (is_place_of_planner) {
        is_place_of_planner = 0;
        take_external_offsets_off(world, pins->external_offset);
    }
    return answer;
}

int kinematicsInverse(const struct EmcPose *world, double *joints, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    if (is_asked_in_another_thread() || is_another_place(world))
        return -1;
    if (*behind)
        return framepath_kinematics_inner_inverse(world, joints, iflags, fflags);
    return framepath_kinematics_inverse(world, joints);
}

/* Exports the function of the module once the kinematics behind it are found: without them addf fails in the HAL file, and
 * LinuxCNC does not start. */
static int begin_inner(void)
{
    if (find_inner(behind, tool_types, &pins))
        return -1;
    hal_set_unready(component);
    if (hal_export_funct("framekins", update, 0, 1, 0, component))
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: HAL has no room for the function; raise HAL_SIZE or load fewer components\n");
    hal_ready(component);
    return 0;
}

/* motmod asks for it while it is loaded. Behind a frame that turns, axes are no joints any more. */
KINEMATICS_TYPE kinematicsType(void)
{
    if (!*behind)
        return KINEMATICS_BOTH;
    if (is_in_inner(behind, &pins, __builtin_return_address(0)))
        return own_type_of_inner(behind, &pins);
    if (!inner_found.module && (is_servo_thread_seen() || begin_inner()))
        return KINEMATICS_BOTH;
    return inner_found.type == KINEMATICS_IDENTITY ? KINEMATICS_BOTH : inner_found.type;
}

/* motmod asks this in each period before it looks at motion.switchkins-type. */
int kinematicsSwitchable(void)
{
    if (*behind && !is_unloaded() && *pins->inner_type != *pins->inner_type_active) {
        struct framepath_frame_inputs in = read_pins();
        *pins->switchkins_type = framepath_kinematics_take_inner_type(&in);
    }
    return 1;
}

/* 0 is success; anything else makes motion report an error and keep its pose. */
int kinematicsSwitch(int type)
{
    struct framepath_frame_inputs in;
    int answer;
    /* Modules switch themselves to type 0 while they are loaded. */
    if (*behind && !inner_found.module)
        return 0;
    if (is_unloaded())
        return -1;
    in = read_pins();
    answer = framepath_kinematics_switch(type, &in);
    is_place_of_planner = !answer;
    return answer;
}

#include "for_planner.h"

EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);

/* What passes between framekins, motion and frame_guard so that a frame does not outlive its program. */
static int export_guard_pins(void)
{
    int error = 0;
    error |= hal_pin_float_newf(HAL_IN, &pins->check, component, "framekins.check");
    error |= hal_pin_bit_newf(HAL_IN, &pins->enabled, component, "framekins.enabled");
    error |= hal_pin_bit_newf(HAL_IN, &pins->release_on_abort, component, "framekins.release-on-abort");
    error |= hal_pin_bit_newf(HAL_IN, &pins->release, component, "framekins.release");
    error |= hal_pin_s32_newf(HAL_IN, &pins->releases_seen, component, "framekins.releases-seen");
    error |= hal_pin_u32_newf(HAL_IN, &pins->heartbeat, component, "framekins.heartbeat");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->releasing, component, "framekins.releasing");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->releases, component, "framekins.releases");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->hold, component, "framekins.hold");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->guarded, component, "framekins.guarded");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->guard.active, component, "framekins.guard.active");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->guard.parameters_pending, component, "framekins.guard.parameters-pending");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->guard.tool_length_matters, component, "framekins.guard.tool-length-matters");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->guard.operations, component, "framekins.guard.operations");
    error |= hal_pin_float_newf(HAL_OUT, &pins->guard.command, component, "framekins.guard.command");
    error |= hal_pin_float_newf(HAL_OUT, &pins->guard.acknowledged, component, "framekins.guard.acknowledged");
    for (int i = 0; i < 3; i++) {
        error |= hal_pin_float_newf(HAL_OUT, &pins->guard.work_offset[i], component, "framekins.guard.work-offset.%c", "xyz"[i]);
        error |= hal_pin_float_newf(HAL_OUT, &pins->guard.tool_offset[i], component, "framekins.guard.frame-tool-offset.%c", "xyz"[i]);
    }
    error |= hal_pin_float_newf(HAL_OUT, &pins->guard.work_rotation, component, "framekins.guard.work-offset.rotation");
    if (error)
        return -1;
    /* The machine counts as on, and may be, until somebody says otherwise. */
    *pins->enabled = *pins->guarded = 1;
    return 0;
}

/* Where the machine is with its frame, for screens. */
static int export_position_pins(void)
{
    int error = 0;
    for (int i = 0; i < 12; i++)
        error |= hal_pin_float_newf(HAL_OUT, &pins->frame[i], component, "framekins.frame.%s", row_names[i]);
    for (int i = 0; i < 9; i++)
        error |= hal_pin_float_newf(HAL_OUT, &pins->position[i], component, "framekins.position.%c", "xyzabcuvw"[i]);
    error |= export_offset_pins(pins->external_offset, component);
    for (int i = 0; i < 3; i++)
        error |= hal_pin_float_newf(HAL_OUT, &pins->turned_tool[i], component, "framekins.turned-tool.%c", "xyz"[i]);
    error |= hal_pin_s32_newf(HAL_OUT, &pins->retract_kind, component, "framekins.retract-kind");
    for (int i = 0; i < 3; i++)
        error |= hal_pin_float_newf(HAL_OUT, &pins->retract_way[i], component, "framekins.retract-way.%c", "xyz"[i]);
    error |= hal_pin_float_newf(HAL_OUT, &pins->retract_z, component, "framekins.retract-z");
    return error;
}

static int export_frame_pins(void)
{
    int error = 0;
    error |= hal_pin_float_newf(HAL_IN, &pins->command, component, "framekins.command");
    for (int i = 0; i < 3; i++) {
        error |= hal_pin_float_newf(HAL_IN, &pins->value[i], component, "framekins.value.%d", i + 1);
        error |= hal_pin_float_newf(HAL_IN, &pins->work_offset[i], component, "framekins.work-offset.%c", "xyz"[i]);
        error |= hal_pin_float_newf(HAL_IN, &pins->tool_offset[i], component, "framekins.tool-offset.%c", "xyz"[i]);
    }
    error |= hal_pin_float_newf(HAL_IN, &pins->work_rotation, component, "framekins.work-offset.rotation");
    for (int i = 0; i < 12; i++)
        error |= hal_pin_float_newf(HAL_IN, &pins->map[i], component, "framekins.map.%s", row_names[i]);
    for (int i = 0; i < 6; i++)
        error |= hal_pin_bit_newf(HAL_IN, &pins->mirror[i], component, "framekins.mirror.%c", "abcuvw"[i]);
    error |= hal_pin_bit_newf(HAL_IN, &pins->in_position, component, "framekins.in-position");
    error |= hal_pin_bit_newf(HAL_IN, &pins->teleop, component, "framekins.teleop");
    error |= hal_pin_bit_newf(HAL_IN, &pins->tool_length_machine, component, "framekins.tool-length-machine");
    error |= hal_pin_float_newf(HAL_OUT, &pins->switchkins_type, component, "framekins.switchkins-type");
    error |= hal_pin_float_newf(HAL_OUT, &pins->acknowledged, component, "framekins.acknowledged");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->active, component, "framekins.active");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->slot, component, "framekins.slot");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->operations, component, "framekins.operations");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->refusal, component, "framekins.refusal");
    error |= hal_pin_bit_newf(HAL_OUT, &pins->tool_centre_point_active, component, "framekins.tool-centre-point-active");
    for (int i = 0; i < 3; i++)
        error |= hal_pin_float_newf(HAL_OUT, &pins->frame_tool_offset[i], component, "framekins.frame-tool-offset.%c", "xyz"[i]);
    error |= hal_pin_bit_newf(HAL_OUT, &pins->parameters_pending, component, "framekins.parameters-pending");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->tilt_axis, component, "framekins.tilt-axis");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->normal_refusal, component, "framekins.normal-refusal");
    error |= hal_pin_float_newf(HAL_OUT, &pins->normal_tilt, component, "framekins.normal-tilt");
    error |= hal_pin_float_newf(HAL_OUT, &pins->normal_rotary, component, "framekins.normal-rotary");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->normal_tilt_axis, component, "framekins.normal-tilt-axis");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->normal_rotary_axis, component, "framekins.normal-rotary-axis");
    error |= hal_pin_u32_newf(HAL_OUT, &pins->version, component, "framekins.version");
    error |= export_position_pins();
    error |= export_guard_pins();
    if (error)
        return -1;
    /* The map is the identity until somebody says otherwise. */
    *pins->map[0] = *pins->map[5] = *pins->map[10] = 1.0;
    *pins->version = FRAMEPATH_VERSION;
    *pins->tilt_axis = framepath_kinematics_tilt_axis();
    return 0;
}

/* What the axes that turn the tool can reach. */
static int export_range_pins(void)
{
    static const char *const range_names[2] = {"min", "max"};
    int error = 0;
    for (int i = 0; i < 2; i++) {
        error |= hal_pin_float_newf(HAL_IN, &pins->tilt_range[i], component, "framekins.tilt-%s", range_names[i]);
        error |= hal_pin_float_newf(HAL_IN, &pins->rotary_range[i], component, "framekins.rotary-%s", range_names[i]);
    }
    if (error)
        return -1;
    /* Without limits until somebody says otherwise. */
    for (int i = 0; i < 2; i++)
        *pins->tilt_range[i] = *pins->rotary_range[i] = no_limits[i];
    return 0;
}

/* For machines with a tilting rotary table. */
static int export_table_pins(void)
{
    int error = 0;
    for (int i = 0; i < 3; i++) {
        error |= hal_pin_float_newf(HAL_IN, &pins->rotation_point[i], component, "framekins.%c-rot-point", "xyz"[i]);
        error |= hal_pin_float_newf(HAL_IN, &pins->offset[i], component, "framekins.%c-offset", "xyz"[i]);
    }
    error |= hal_pin_float_newf(HAL_IN, &pins->table_tool_offset, component, "framekins.tool-offset");
    error |= hal_pin_bit_newf(HAL_IN, &pins->conventional_directions, component, "framekins.conventional-directions");
    error |= hal_pin_bit_newf(HAL_IN, &pins->tool_centre_point, component, "framekins.tool-centre-point");
    return error ? error : export_range_pins();
}

/* For kinematics of another module. */
static int export_inner_pins(void)
{
    int error = 0;
    error |= hal_pin_float_newf(HAL_IN, &pins->inner_type, component, "framekins.inner-type");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->inner_type_active, component, "framekins.inner-type-active");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->inner_refusal, component, "framekins.inner-refusal");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->tool_centre_type, component, "framekins.tool-centre-type");
    error |= hal_pin_s32_newf(HAL_OUT, &pins->axes_type, component, "framekins.axes-type");
    return error ? error : export_range_pins();
}

int rtapi_app_main(void)
{
    int error;
    const char *remedy = *inner ? "loadrt framekins inner=.. has to come first in the HAL files, before loadrt [KINS]KINEMATICS and "
                                  "before motmod"
                                : "write KINEMATICS = framekins coordinates=.. under [KINS] in the INI, and no loadrt of "
                                  "kinematics; or load framekins before it, with inner=";
    if (check_version("framekins") || check_first("framekins", "kinematicsForward", &pins, remedy)
        || check_before_motmod("framekins", &pins))
        return -22; /* EINVAL */
    error = *inner ? configure_inner(&pins) : configure_machine();
    if (error)
        return error;
    behind = inner;
    has_table = framepath_kinematics_tilt_axis() != 0;
    component = hal_init("framekins");
    if (component < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: hal_init failed (%d): is it loaded already? Load it once\n", component);
        return component;
    }
    pins = hal_malloc(sizeof *pins);
    if (!pins || export_frame_pins() || (has_table && export_table_pins()) || (*behind && export_inner_pins())
        || (!*behind && hal_export_funct("framekins", update, 0, 1, 0, component))) {
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: HAL has no room for the pins; raise HAL_SIZE or load fewer components\n");
        hal_exit(component);
        return -12; /* ENOMEM */
    }
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    leave_motmod("framekins", "a frame that is active stays, and nobody removes it any more; blendtp takes no further move. Stop the program, "
                 "end LinuxCNC and start it anew");
    hal_exit(component);
    /* motmod goes on calling the kinematics behind the frame. */
    if (!is_loaded("motmod", &pins))
        forget_inner();
}
