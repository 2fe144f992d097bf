/* What an operator sees of blendtp: pins that say what limits the speed, how far it looks ahead, and how long it takes. Part
 * of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

/* How old what program_time.py says may be, seconds. */
#define PROGRAM_TIME_LASTS 1.0

/* Bits for lamps, by FRAMEPATH_LIMIT_..; the one of the limit that is in force is on. */
static const char *const limit_names[] = {
    "nothing", "rest", "hold", "spindle", "feed", "override", "path-velocity", "velocity", "acceleration", "jerk", "between"};

#define LIMITS (sizeof limit_names / sizeof *limit_names)

static struct {
    hal_s32_t *kind;
    hal_s32_t *axis;
    hal_s32_t *joint;
    hal_bit_t *kinds[LIMITS];
    hal_bit_t *axes[AXES];
    hal_u32_t *moves_queued;
    hal_u32_t *moves_ahead;
    hal_u32_t *number;
    hal_s32_t *line;
    hal_bit_t *stands;
    hal_float_t *to_go;
    hal_float_t *seconds_queued;
    hal_float_t *seconds_ahead;
    /* Seconds of servo periods since the module was loaded. */
    hal_float_t *clock;
    /* On this clock: when the program ends, and when that was said. */
    hal_float_t *ends_at;
    hal_float_t *said_at;
    hal_bit_t *whole_program;
    hal_float_t *time_left;
    hal_u32_t *minutes;
    hal_u32_t *seconds;
} *operator_pins;

static int make_limit_pins(void)
{
    int error = hal_pin_s32_newf(HAL_OUT, &operator_pins->kind, component, "blendtp.limit.kind")
                || hal_pin_s32_newf(HAL_OUT, &operator_pins->axis, component, "blendtp.limit.axis")
                || hal_pin_s32_newf(HAL_OUT, &operator_pins->joint, component, "blendtp.limit.joint");
    for (unsigned i = 0; i < LIMITS && !error; i++)
        error = hal_pin_bit_newf(HAL_OUT, &operator_pins->kinds[i], component, "blendtp.limit.%s", limit_names[i]);
    for (int i = 0; i < AXES && !error; i++)
        error = hal_pin_bit_newf(HAL_OUT, &operator_pins->axes[i], component, "blendtp.limit.axis.%c", letters[i]);
    return error;
}

static int make_move_pins(void)
{
    return hal_pin_u32_newf(HAL_OUT, &operator_pins->number, component, "blendtp.move.number")
           || hal_pin_s32_newf(HAL_OUT, &operator_pins->line, component, "blendtp.move.line")
           || hal_pin_bit_newf(HAL_OUT, &operator_pins->stands, component, "blendtp.move.stands")
           || hal_pin_float_newf(HAL_OUT, &operator_pins->to_go, component, "blendtp.move.to-go");
}

static int make_time_pins(void)
{
    return hal_pin_u32_newf(HAL_OUT, &operator_pins->moves_queued, component, "blendtp.queued.moves")
           || hal_pin_float_newf(HAL_OUT, &operator_pins->seconds_queued, component, "blendtp.queued.seconds")
           || hal_pin_u32_newf(HAL_OUT, &operator_pins->moves_ahead, component, "blendtp.ahead.moves")
           || hal_pin_float_newf(HAL_OUT, &operator_pins->seconds_ahead, component, "blendtp.ahead.seconds")
           || hal_pin_float_newf(HAL_OUT, &operator_pins->clock, component, "blendtp.clock")
           || hal_pin_float_newf(HAL_IN, &operator_pins->ends_at, component, "blendtp.program.ends-at")
           || hal_pin_float_newf(HAL_IN, &operator_pins->said_at, component, "blendtp.program.said-at")
           || hal_pin_bit_newf(HAL_OUT, &operator_pins->whole_program, component, "blendtp.time-left.whole-program")
           || hal_pin_float_newf(HAL_OUT, &operator_pins->time_left, component, "blendtp.time-left")
           || hal_pin_u32_newf(HAL_OUT, &operator_pins->minutes, component, "blendtp.time-left.minutes")
           || hal_pin_u32_newf(HAL_OUT, &operator_pins->seconds, component, "blendtp.time-left.seconds");
}

static int make_operator_pins(void)
{
    operator_pins = hal_malloc(sizeof *operator_pins);
    if (!operator_pins || make_limit_pins() || make_move_pins() || make_time_pins())
        return 1;
    *operator_pins->axis = -1;
    *operator_pins->joint = -1;
    *operator_pins->kinds[FRAMEPATH_LIMIT_NOTHING] = 1;
    return 0;
}

/* framekins says which axis of a machine of ours a joint moves; NULL without it. */
static int (*axis_of_joint)(int joint);

static void show_limit(struct framepath_survey const *survey)
{
    int axis = survey->joint >= 0 && axis_of_joint ? axis_of_joint(survey->joint) : survey->axis;
    *operator_pins->kind = survey->limit;
    *operator_pins->axis = axis;
    *operator_pins->joint = survey->joint;
    for (int i = 0; i < (int)LIMITS; i++)
        *operator_pins->kinds[i] = i == survey->limit;
    for (int i = 0; i < AXES; i++)
        *operator_pins->axes[i] = i == axis;
}

/* How long it takes: of the whole program where program_time.py knows, else of what is queued. */
static void show_time_left(double queued)
{
    double now = *operator_pins->clock, age = now - *operator_pins->said_at, left = *operator_pins->ends_at - now;
    /* A comparison with what is not a number is false. */
    int whole = *operator_pins->ends_at > 0 && age >= 0 && age <= PROGRAM_TIME_LASTS && left < 1e9;
    unsigned seconds;
    if (!whole)
        left = queued;
    left = left > 0 && left < 1e9 ? left : 0;
    seconds = left;
    *operator_pins->whole_program = whole;
    *operator_pins->time_left = left;
    *operator_pins->minutes = seconds / 60;
    *operator_pins->seconds = seconds % 60;
}

/* At the end of a servo period, also of one in which motmod does not ask for a position since it jogs. */
static void show_operator(void)
{
    static unsigned long long periods;
    struct framepath_survey survey;
    *operator_pins->clock = ++periods * motion.config->servoCycleTime;
    if (framepath_planner_survey(planner, &survey))
        return;
    show_limit(&survey);
    *operator_pins->moves_queued = survey.moves_queued;
    *operator_pins->moves_ahead = survey.moves_ahead;
    *operator_pins->number = survey.moves_done;
    *operator_pins->line = survey.line;
    *operator_pins->stands = survey.stands;
    *operator_pins->to_go = survey.to_go;
    *operator_pins->seconds_queued = survey.seconds_queued;
    *operator_pins->seconds_ahead = survey.seconds_ahead;
    show_time_left(survey.seconds_queued);
}
