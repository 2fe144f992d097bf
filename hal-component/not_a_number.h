/* What holds the machine since it is not a number, for the operator: it stands, and nothing else shows why. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

/* What of the overrides is not a number, with the remedy; NULL if all are. Motion multiplies them with the adaptive feed. */
static const char *wrong_override(const emcmot_status_t *status)
{
    if (isnan(greatest_velocity))
        return "the slider for the greatest velocity is not a number: set it anew, or look at what sets it";
    if (!status || !isnan(status->net_feed_scale))
        return NULL;
    if (isnan(status->feed_scale))
        return "the feed override is not a number: set it anew, or look at what sets it";
    if (isnan(status->rapid_scale))
        return "the rapid override is not a number: set it anew, or look at what sets it";
    return "motion.adaptive-feed is not a number: look at what sets it, or write M52 P0";
}

/* Says it once for as long as it is so and there are moves. */
static void say_not_a_number(const TP_STRUCT *tp, const emcmot_status_t *status)
{
    static const char *told;
    const char *found = tp->depth > 0 ? wrong_override(status) : NULL;
    if (found && found != told)
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the machine is held, since %s\n", found);
    told = found;
}
