/* Whether motmod lays out what it shares with its planner as this module does. Its structures lie one behind the other
 * in shared memory and have no version; a planner that was built for others reads and writes in wrong places.
 * What can be seen: how far they are apart, which is their sizes, and what motmod has just written into them.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_SHARED_STRUCTURES_H
#define FRAMEPATH_SHARED_STRUCTURES_H

#include <stddef.h>
#include <stdio.h>
#include "rtapi.h"
#include "motion.h"
#include "tp.h"

/* The end of motmod's shared memory, from the status on (LinuxCNC's motion_struct.h, which is not installed). */
struct shared_structures {
    struct emcmot_status_t status;
    struct emcmot_config_t config;
    struct emcmot_error_t error;
    struct emcmot_internal_t internal;
};

/* How far a structure is behind the status here, and where motmod has it. */
static int lies_elsewhere(const char *name, const emcmot_status_t *status, const void *place, size_t expected, char *found,
                          size_t size)
{
    ptrdiff_t distance = (const char *)place - (const char *)status;
    if (distance == (ptrdiff_t)expected)
        return 0;
    snprintf(found, size, " (%s is %td bytes behind motion's status, not %zu)", name, distance, expected);
    return 1;
}

/* Whether numbers are not what motmod writes into its new structures. The sizes fit by now, so all of this can be read. */
static int holds_something_else(const emcmot_status_t *status, const emcmot_config_t *config, char *found, size_t size)
{
    int scales = status->feed_scale == 1.0 && status->rapid_scale == 1.0 && status->net_feed_scale == 1.0;
    for (int i = 0; i < EMCMOT_MAX_SPINDLES; i++)
        scales = scales && status->spindle_status[i].scale == 1.0;
    int counts = config->numJoints >= 1 && config->numJoints <= EMCMOT_MAX_JOINTS && config->numSpindles >= 0
                 && config->numSpindles <= EMCMOT_MAX_SPINDLES && config->numDIO >= 0 && config->numDIO <= EMCMOT_MAX_DIO
                 && config->numAIO >= 0 && config->numAIO <= EMCMOT_MAX_AIO;
    const char *wrong = !scales ? "the overrides are not 1"
                        : !counts ? "the numbers of joints, spindles and outputs make no sense"
                        : status->head != status->tail ? "the counts of changes differ"
                        : status->config_num != config->config_num ? "the numbers of the configuration differ"
                        : NULL;
    if (wrong)
        snprintf(found, size, " (%s in motion's new status)", wrong);
    return wrong != NULL;
}

/* 0, or -1 with what does not fit in `found`. Nothing is written to the structures. */
static int check_structures(const emcmot_status_t *status, const emcmot_config_t *config, const TP_STRUCT *tp, char *found,
                            size_t size)
{
    const size_t status_at = offsetof(struct shared_structures, status);
    const size_t config_at = offsetof(struct shared_structures, config) - status_at;
    const size_t tp_at = offsetof(struct shared_structures, internal) + offsetof(struct emcmot_internal_t, coord_tp) - status_at;
    found[0] = 0;
    if (!status || !config || !tp)
        snprintf(found, size, " (motion hands over no status)");
    return !status || !config || !tp || lies_elsewhere("its configuration", status, config, config_at, found, size)
           || lies_elsewhere("its planner", status, tp, tp_at, found, size)
           || holds_something_else(status, config, found, size) ? -1 : 0;
}

#endif
