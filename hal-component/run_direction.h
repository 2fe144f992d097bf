/* What the operator is told of a run that does not turn back, or forward again. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_RUN_DIRECTION_H
#define FRAMEPATH_RUN_DIRECTION_H

#include "rtapi.h"
#include "framepath.h"

/* Servo periods for which the machine still counts as asked to run in reverse, and whether it was said that it does not. */
static int reverse_asked;
static int reverse_refusal_said;

/* In each servo period: nobody asks while it runs in reverse. */
static void period_of_direction(const TP_STRUCT *tp)
{
    if (reverse_asked && tp->reverse_run != TC_DIR_REVERSE)
        reverse_asked--;
    if (!reverse_asked)
        reverse_refusal_said = 0;
}

/* Why the run does not turn. Negative adaptive feed asks in every servo period, also while the machine comes to rest for that, or has
 * nothing to do; the operator asks once, and a resume that goes on as before would be a surprise. */
static void say_not_turned(const TP_STRUCT *tp, const emcmot_status_t *status, tc_direction_t direction, int result)
{
    static int told;
    int command = direction == TC_DIR_REVERSE ? EMCMOT_REVERSE : EMCMOT_FORWARD;
    int commanded = status && (int)status->commandEcho == command;
    int idle = tp->done || tp->aborting;
    /* Screens show 255 letters of a message. */
    if (result == FRAMEPATH_TURNED_AT_REST_ONLY && commanded && status->commandNumEcho != told) {
        told = status->commandNumEcho;
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: the run is not turned, since the machine moves: pause it, and %s once it stands. "
                        "A resume goes on %s\n", direction == TC_DIR_REVERSE ? "reverse it" : "run it forward",
                        direction == TC_DIR_REVERSE ? "forward" : "in reverse");
    } else if (result == FRAMEPATH_NOTHING_TO_REVERSE && !reverse_refusal_said && (commanded || !idle)) {
        reverse_refusal_said = 1;
        rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: there is no way back from here: a reverse run goes over the moves since "
                        "the machine last had nothing to do, but not over threads, taps, probing moves and locking "
                        "indexers. %s\n", commanded ? "A resume runs forward" :
                        "To go on set motion.adaptive-feed to 0 or above, or run forward");
    }
}

/* Motion has asked for a direction. */
static void direction_asked(const TP_STRUCT *tp, const emcmot_status_t *status, tc_direction_t direction, int result)
{
    say_not_turned(tp, status, direction, result);
    reverse_asked = direction == TC_DIR_REVERSE ? 2 : 0;
}

#endif
