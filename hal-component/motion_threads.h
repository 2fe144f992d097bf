/* Whether motion's two functions are in one HAL thread, and in order: motion-command-handler, which hands over moves, before
 * motion-controller, which runs them. HAL does not tell a module where functions are added; the calls do.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_MOTION_THREADS_H
#define FRAMEPATH_MOTION_THREADS_H

#include <stdlib.h>
#include "rtapi.h"
#include "motion.h"
#include "servo_thread.h"

/* So many commands of task without a period of the controller mean that it does not run: there is one at most in a period.
 * Task sends three of the kind that arrives here when it starts. */
#define COMMANDS_WITHOUT_CONTROLLER 3
/* By how many moves the one order has to be ahead of the other to be believed, and how many of the wrong one a move of the
 * right one outweighs: in the right order a late period looks like the wrong one, the other way round hardly ever. */
#define ORDER_IS_SURE 16
#define RIGHT_OUTWEIGHS 4
/* How many times longer it is from a command to the controller than from the controller to the command in the wrong order. */
#define MUCH_LONGER 4
/* Of a period, what the controller may be early or late by to count as on time: one of so many parts. */
#define ON_TIME 8

static struct {
    int commands, number;       /* since the controller's last period; the number that task gave the last one */
    long long ended, commanded; /* ns; 0: nothing since */
    long long planned;          /* when the controller last began, ns */
    int order;                  /* how many moves came in the wrong order, less those in the right one */
    int said;                   /* the order, or that nothing runs */
} threads;

#define SAME_THREAD "write addf motion-command-handler servo-thread and then addf motion-controller servo-thread in the HAL file"

/* -1, with the reason said, for a command on another thread than the controller's: the planner is not made for two. */
static int check_thread(void)
{
    if (!on_another_thread())
        return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: motion-command-handler is in another thread than motion-controller, no move is "
                    "taken: " SAME_THREAD "\n");
    return -1;
}

/* Whether a command is not to be taken, since it is on another thread than the controller's: the first one is told at once. No
 * move has been taken that it could be about, so that an abort, too, has nothing to stop. */
static int is_misplaced_command(void)
{
    static int told;
    if (!on_another_thread())
        return 0;
    if (!told)
        told = check_thread();
    return 1;
}

/* A command that only the command handler gives, with task's number for it (what calls without numbers is no LinuxCNC); whether it is
 * not to be taken. */
static int command_comes(const emcmot_status_t *status)
{
    if (is_misplaced_command())
        return 1;
    if (threads.said || !status || status->commandNumEcho == threads.number)
        return 0;
    threads.number = status->commandNumEcho;
    if (++threads.commands < COMMANDS_WITHOUT_CONTROLLER)
        return 0;
    threads.said = 1;
    rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: motion-controller is in no thread that runs: " SAME_THREAD "\n");
    return 0;
}

/* The number of a move comes just before it. */
static int move_comes(const emcmot_status_t *status)
{
    if (command_comes(status))
        return 1;
    threads.commanded = threads.ended && status && status->commandNumEcho ? rtapi_get_time() : 0;
    return 0;
}

/* The controller begins to plan, every so many ns; looks at the order until that is sure. A thread that is late runs one period
 * right behind the other, and may wait for the processor between handler and controller: either order may then look like the
 * other, and it counts for nothing. */
static void controller_plans(long period)
{
    long long now, before, after, since;
    /* Here already, for commands that another thread gives during its first period. */
    this_is_the_servo_thread();
    if (threads.order <= -ORDER_IS_SURE || threads.said)
        return;
    now = rtapi_get_time();
    since = now - threads.planned;
    threads.planned = now;
    if (!threads.commanded)
        return;
    before = threads.commanded - threads.ended;
    after = now - threads.commanded;
    threads.commanded = 0;
    if (ON_TIME * llabs(since - period) > period)
        return;
    threads.order += after > MUCH_LONGER * before ? 1 : -RIGHT_OUTWEIGHS;
    if (threads.order < ORDER_IS_SURE)
        return;
    threads.said = 1;
    rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: motion-controller comes before motion-command-handler, so that every command "
                    "waits for a period: " SAME_THREAD "\n");
}

/* The end of the controller's period. Where it has not planned (traj_period_nsec of motmod) the order is not to be seen. */
static void controller_ends(void)
{
    this_is_the_servo_thread();
    threads.commands = 0;
    threads.commanded = 0;
    threads.ended = threads.order > -ORDER_IS_SURE && !threads.said ? rtapi_get_time() : 0;
}

#endif
