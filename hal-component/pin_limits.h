/* What blendtp's pins say of limits and tolerances, handed to the planner before a move is added: what makes no sense
 * refuses the move. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

static char capital(char letter)
{
    return letter - 'a' + 'A';
}

/* Hands the jerk limits to the planner. Called before a move is added: a limit that makes no sense refuses the move. */
static int take_jerk_limits(void)
{
    /* Axes of which it was said that they have more than can be used. */
    static unsigned told;
    double jerk[AXES], least;
    unsigned unlimited;
    for (int i = 0; i < AXES; i++)
        jerk[i] = *pins->max_jerk[i];
    int axis = framepath_planner_set_jerk(planner, jerk, &least, &unlimited);
    if (axis >= 0 && axis < AXES && least == 0.0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.axis.%c.max-jerk is %g, and the machine has no axis %c, or one without "
                        "[AXIS_%c]MAX_ACCELERATION: set the pin to 0\n", letters[axis], jerk[axis], capital(letters[axis]),
                        capital(letters[axis]));
        return -1;
    }
    if (axis >= 0 && axis < AXES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.axis.%c.max-jerk is %g: it must be 0 (not limited) or, in machine units per "
                        "second cubed, at least %g, a fifth of the acceleration; set it with setp or "
                        "[AXIS_%c]MAX_JERK\n", letters[axis], jerk[axis], least, capital(letters[axis]));
        return -1;
    }
    for (int i = 0; i < AXES; i++)
        if (unlimited & ~told & 1u << i)
            rtapi_print("blendtp.axis.%c.max-jerk is %g: that is more than the acceleration can change in a servo period, so "
                        "that the jerk of this axis is not limited; 0 says the same\n", letters[i], jerk[i]);
    told = unlimited;
    return 0;
}

/* Hands over how far paths may leave the program. As above: what makes no sense refuses the move. */
static int take_tolerances(void)
{
    switch (framepath_planner_set_blending(planner, *pins->millimetre, *pins->rotary_tolerance, *pins->default_tolerance)) {
    case FRAMEPATH_BAD_MILLIMETRE:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.millimetre is %g: it must be the length of a millimetre in machine units: "
                        "set it to 1, or to 0.0393700787 on a machine in inches\n", *pins->millimetre);
        return -1;
    case FRAMEPATH_BAD_ROTARY_TOLERANCE:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.rotary-tolerance is %g: it must be a number of degrees up to 1e6, 0 for as many "
                        "degrees as P has millimetres\n", *pins->rotary_tolerance);
        return -1;
    case FRAMEPATH_BAD_DEFAULT_TOLERANCE:
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp.default-tolerance is %g: it must be a number of machine units from 0 to "
                        "1e6\n", *pins->default_tolerance);
        return -1;
    default:
        return 0;
    }
}

/* Says once, at the first move, which limits of the INI no pin has. */
static void say_forgotten_jerk_limits(void)
{
    for (int i = 0; i < AXES; i++) {
        if (ini_jerk[i] > 0.0 && *pins->max_jerk[i] == 0.0 && signbit(*pins->max_jerk[i]))
            rtapi_print_msg(RTAPI_MSG_ERR, "nothing sets blendtp.axis.%c.max-jerk (so not limited), although the INI has "
                            "[AXIS_%c]MAX_JERK = %g: write setp blendtp.axis.%c.max-jerk [AXIS_%c]MAX_JERK in the HAL file\n",
                            letters[i], capital(letters[i]), ini_jerk[i], letters[i], capital(letters[i]));
        ini_jerk[i] = 0.0;
    }
}
