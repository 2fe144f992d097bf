/* What framekins tells the operator once.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_FRAME_MESSAGES_H
#define FRAMEPATH_FRAME_MESSAGES_H

#include "rtapi.h"

#include "framepath.h"
#include "servo_thread.h"

/* Tells the operator of a guard that is missed, and of each stage once. */
static void tell_alarm(int alarm)
{
    static int told;
    if (alarm > told)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: %s\n", framepath_kinematics_alarm_text(alarm));
    told = alarm;
}

/* Whether what calls is not in the servo thread: refused with these words, once. */
static int is_refused_here(int *told, const char *words)
{
    if (!on_another_thread())
        return 0;
    if (!*told)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: %s in the HAL file\n", words);
    return *told = 1;
}

/* Whether this is not the thread in which motion asks for positions. Then nothing is taken and nothing shown. */
static int is_misplaced(void)
{
    static int told;
    return is_refused_here(&told, "it is in another thread than motion-controller, no frame is taken: write addf framekins "
                                  "servo-thread behind addf motion-controller servo-thread");
}

/* Whether motion-command-handler, which asks whether the end of a move has joints, is not in that thread. Then no place has any,
 * and motion takes no move: the library is in use by the controller. */
static int is_asked_in_another_thread(void)
{
    static int told;
    return is_refused_here(&told, "motion-command-handler is in another thread than motion-controller, no move is taken: write "
                                  "addf motion-command-handler servo-thread and then addf motion-controller servo-thread");
}

#endif
