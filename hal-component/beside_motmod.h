/* Loading and unloading beside motmod, which takes the functions of its kinematics and of its planner while it is loaded, and calls them
 * for as long as it runs: their code stays in memory when their module is unloaded, their pins do not.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_BESIDE_MOTMOD_H
#define FRAMEPATH_BESIDE_MOTMOD_H

#include <unistd.h>
#include "rtapi.h"
#include "loaded_beside.h"

/* How long to wait for a servo period at most, microseconds, and for how long at a time. */
#define PERIOD_COMES 100000
#define LOOK_AGAIN 1000

/* Servo periods that have run, and whether the module was unloaded: then nothing may touch its pins, whose places HAL gives to
 * others. Written in one thread and read in another, and atomic for them. */
static unsigned periods_run;
static int unloaded;

static void period_runs(void)
{
    __atomic_fetch_add(&periods_run, 1, __ATOMIC_RELAXED);
}

static int is_unloaded(void)
{
    return __atomic_load_n(&unloaded, __ATOMIC_ACQUIRE);
}

/* 0, or -1 with the reason said, where motmod is there already: a module that comes behind it is never called, or is the one that
 * was unloaded, whose functions would begin anew, and the joints jump. */
static int check_before_motmod(const char *module, const void *here)
{
    if (!is_loaded("motmod", here)) {
        periods_run = 0;
        unloaded = 0;
        return 0;
    }
    rtapi_print_msg(RTAPI_MSG_ERR, "%s: motmod is loaded already: loadrt %s has to come before loadrt motmod in the HAL files; while LinuxCNC "
                    "runs it cannot be loaded again: end LinuxCNC and start it anew\n", module, module);
    return -1;
}

/* To be called first when the module is unloaded, with what is said if motmod goes on calling it. At the end of LinuxCNC the
 * threads have been stopped before, and nothing is said. */
static void leave_motmod(const char *module, const char *words)
{
    unsigned before = __atomic_load_n(&periods_run, __ATOMIC_RELAXED);
    __atomic_store_n(&unloaded, 1, __ATOMIC_RELEASE);
    for (int waited = 0; before && waited < PERIOD_COMES; waited += LOOK_AGAIN) {
        if (__atomic_load_n(&periods_run, __ATOMIC_RELAXED) != before) {
            rtapi_print_msg(RTAPI_MSG_ERR, "%s: it was unloaded while LinuxCNC runs: %s\n", module, words);
            return;
        }
        usleep(LOOK_AGAIN);
    }
}

#endif
