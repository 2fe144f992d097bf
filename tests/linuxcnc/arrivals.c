/* arrivals: a module for tests that shows in which servo period a move reached the planner.
 *
 * It looks into the memory that task and motion share, behind the motion controller: the pins can be recorded with
 * everything else. Nothing is changed.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <stddef.h>
#include "rtapi.h"
#include "rtapi_app.h"
#include "rtapi_mutex.h"
#include "hal.h"
#include "motion.h"
#include "emcmotcfg.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("When moves reach the planner");
MODULE_LICENSE("GPL");

/* The start of motmod's shared memory, which no installed header declares. Task and motion keep apart by a count of changes
 * at both ends of the command in LinuxCNC 2.9.0, by a lock in front of it since 2.9.1: then the command begins with what is
 * commanded. */
#define LOCKED (offsetof(emcmot_command_t, command) == 0)

struct shared {
    rtapi_mutex_t lock[LOCKED];
    emcmot_command_t command;
    emcmot_status_t status;
};

static struct {
    /* Moves that have reached the planner. */
    hal_s32_t *moves;
    /* The scale of all feeds in this period, millionths. */
    hal_s32_t *scale;
    /* Moves in the planner's queue. */
    hal_s32_t *depth;
} *pins;

static int component;
static int segment;
static struct shared *shared;
static int seen;

static void look(void *unused, long period)
{
    (void)unused;
    (void)period;
    const emcmot_status_t *status = &shared->status;
    if (status->commandNumEcho != seen) {
        seen = status->commandNumEcho;
        switch (status->commandEcho) {
        case EMCMOT_SET_LINE:
        case EMCMOT_SET_CIRCLE:
        case EMCMOT_PROBE:
        case EMCMOT_RIGID_TAP:
            if (status->commandStatus == EMCMOT_COMMAND_OK)
                ++*pins->moves;
            break;
        default:
            break;
        }
    }
    *pins->scale = (int)(status->net_feed_scale * 1e6 + 0.5);
    *pins->depth = status->depth;
}

int rtapi_app_main(void)
{
    component = hal_init("arrivals");
    if (component < 0)
        return component;
    segment = rtapi_shmem_new(DEFAULT_SHMEM_KEY, component, sizeof *shared);
    if (segment < 0 || rtapi_shmem_getptr(segment, (void **)&shared)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "arrivals: motmod has to be loaded before\n");
        hal_exit(component);
        return -1;
    }
    pins = hal_malloc(sizeof *pins);
    if (!pins || hal_pin_s32_newf(HAL_OUT, &pins->moves, component, "arrivals.moves")
        || hal_pin_s32_newf(HAL_OUT, &pins->scale, component, "arrivals.scale")
        || hal_pin_s32_newf(HAL_OUT, &pins->depth, component, "arrivals.depth")
        || hal_export_funct("arrivals", look, 0, 1, 0, component)) {
        hal_exit(component);
        return -1;
    }
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    rtapi_shmem_delete(segment, component);
    hal_exit(component);
}
