/* The limits of joints, for machines whose joints are not the axes: pins, and what is said of them. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

static struct {
    hal_float_t *velocity[FRAMEPATH_LIMITED_JOINTS];
    hal_float_t *acceleration[FRAMEPATH_LIMITED_JOINTS];
    hal_float_t *jerk[FRAMEPATH_LIMITED_JOINTS];
} *joint_pins;

static int make_joint_pins(void)
{
    int error = 0;
    joint_pins = hal_malloc(sizeof *joint_pins);
    if (!joint_pins)
        return 1;
    for (unsigned i = 0; i < FRAMEPATH_LIMITED_JOINTS && !error; i++)
        error = hal_pin_float_newf(HAL_IN, &joint_pins->velocity[i], component, "blendtp.joint.%u.max-velocity", i)
                || hal_pin_float_newf(HAL_IN, &joint_pins->acceleration[i], component, "blendtp.joint.%u.max-acceleration", i)
                || hal_pin_float_newf(HAL_IN, &joint_pins->jerk[i], component, "blendtp.joint.%u.max-jerk", i);
    return error;
}

/* framekins says how the joints of a machine of ours move; other kinematics are asked for places beside each other. */
static void find_joint_jet(void)
{
    int (*jet)(const double *, const double *, double *);
    *(void **)&jet = dlsym(RTLD_DEFAULT, "framekinsJet");
    framepath_planner_joint_jet(jet);
    *(void **)&axis_of_joint = dlsym(RTLD_DEFAULT, "framekinsAxisOfJoint");
}

/* Says why the limits of joints cannot be kept, and what to do. */
static void say_joint_refusal(int code, struct framepath_joint_limits const *limits)
{
    static const char *const need = "since a limit of joints is set, it must be positive for each joint: set it with setp from";
    static const char *const finite = "since a limit of joints is set, it must be positive for each joint, and not infinite: set it "
                                      "with setp from";
    static const char *const otherwise = "set all blendtp.joint.* to 0, and the axes keep their limits instead";
    int joint = limits->joint;
    switch (code) {
    case FRAMEPATH_JOINT_VELOCITY:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.joint.%d.max-velocity is %g: %s [JOINT_%d]MAX_VELOCITY\n", joint, limits->value, need,
                        joint);
        break;
    case FRAMEPATH_JOINT_ACCELERATION:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.joint.%d.max-acceleration is %g: %s [JOINT_%d]MAX_ACCELERATION\n", joint,
                        limits->value, finite, joint);
        break;
    case FRAMEPATH_JOINT_JERK:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.joint.%d.max-jerk is %g: it must be 0 (not limited) or, in machine units per second "
                        "cubed, at least %g, a fifth of the acceleration; set it with setp or [JOINT_%d]MAX_JERK\n", joint,
                        limits->jerk[joint], limits->value, joint);
        break;
    case FRAMEPATH_JOINTS_TOO_MANY:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: joints 0 to %d can have limits, but there are %d: %s\n", FRAMEPATH_LIMITED_JOINTS - 1,
                        joint, otherwise);
        break;
    case FRAMEPATH_JOINTS_SLOW:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s takes %.1f us for the joints of a place, %g us at most: limits of joints cannot be "
                        "kept with it; %s\n", kinematics, limits->value, FRAMEPATH_MOST_MICROSECONDS, otherwise);
        break;
    case FRAMEPATH_JOINTS_ROUGH:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: what %s says of joint %d is off by %.1g, so that its limits cannot be kept; %s\n",
                        kinematics, joint, limits->value, otherwise);
        break;
    case FRAMEPATH_JOINTS_SINGULAR:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the machine stands at a singular place of %s, which it cannot leave within the limits "
                        "of its joints: jog a joint away from there, or set all blendtp.joint.* to 0\n", kinematics);
        break;
    default:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: %s does not say where the joints are, so that their limits cannot be kept; %s\n",
                        kinematics, otherwise);
    }
}

/* Hands the limits of joints over. Called before a move is added: what makes no sense, or cannot be kept, refuses the move. */
static int take_joint_limits(void)
{
    static unsigned told;
    static int told_trivial;
    struct framepath_joint_limits limits;
    for (unsigned i = 0; i < FRAMEPATH_LIMITED_JOINTS; i++) {
        limits.velocity[i] = *joint_pins->velocity[i];
        limits.acceleration[i] = *joint_pins->acceleration[i];
        limits.jerk[i] = *joint_pins->jerk[i];
    }
    int code = framepath_planner_set_joint_limits(planner, &limits);
    if (code == FRAMEPATH_JOINTS_TRIVIAL) {
        if (!told_trivial)
            rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.joint.*: the joints of %s are the axes, so that only the limits of axes hold: set "
                            "those pins to 0. This is said once\n", kinematics);
        told_trivial = 1;
        return 0;
    }
    if (code != FRAMEPATH_JOINTS_TAKEN) {
        say_joint_refusal(code, &limits);
        return -1;
    }
    for (unsigned i = 0; i < FRAMEPATH_LIMITED_JOINTS; i++)
        if (limits.unlimited & ~told & 1u << i)
            rtapi_print("blendtp.joint.%u.max-jerk is %g: that is more than the acceleration can change in a servo period, so that "
                        "the jerk of this joint is not limited; 0 says the same\n", i, limits.jerk[i]);
    told = limits.unlimited;
    return 0;
}
