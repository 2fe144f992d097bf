/* The sizes and offsets of the structures shared with motmod, as the C compiler sees them.
 * Only the tests read this table; in the modules the linker drops it. */
#include <stddef.h>
#include "linuxcnc.h"

struct framepath_layout {
    const char *name;
    size_t value;
};

#define SIZE(type) {"sizeof " #type, sizeof(type)}
#define OFFSET(type, field) {#type "." #field, offsetof(type, field)}

const struct framepath_layout framepath_layout[] = {
    SIZE(EmcPose),
    OFFSET(EmcPose, tran),
    OFFSET(EmcPose, a),
    OFFSET(EmcPose, u),
    OFFSET(EmcPose, w),
    SIZE(struct state_tag_t),
    OFFSET(struct state_tag_t, fields_float),
    OFFSET(struct state_tag_t, fields),
    OFFSET(struct state_tag_t, packed_flags),
    SIZE(TP_STRUCT),
    OFFSET(TP_STRUCT, queue),
    OFFSET(TP_STRUCT, spindle),
    OFFSET(TP_STRUCT, currentPos),
    OFFSET(TP_STRUCT, goalPos),
    OFFSET(TP_STRUCT, queueSize),
    OFFSET(TP_STRUCT, execId),
    OFFSET(TP_STRUCT, done),
    OFFSET(TP_STRUCT, depth),
    OFFSET(TP_STRUCT, activeDepth),
    OFFSET(TP_STRUCT, aborting),
    OFFSET(TP_STRUCT, pausing),
    OFFSET(TP_STRUCT, reverse_run),
    OFFSET(TP_STRUCT, motionType),
    SIZE(emcmot_status_t),
    OFFSET(emcmot_status_t, feed_scale),
    OFFSET(emcmot_status_t, rapid_scale),
    OFFSET(emcmot_status_t, net_feed_scale),
    OFFSET(emcmot_status_t, enables_queued),
    OFFSET(emcmot_status_t, spindleSync),
    OFFSET(emcmot_status_t, spindle_status),
    OFFSET(emcmot_status_t, distance_to_go),
    OFFSET(emcmot_status_t, dtg),
    OFFSET(emcmot_status_t, current_vel),
    OFFSET(emcmot_status_t, requested_vel),
    OFFSET(emcmot_status_t, tcqlen),
    OFFSET(emcmot_status_t, stepping),
    SIZE(emcmot_config_t),
    OFFSET(emcmot_config_t, numSpindles),
    OFFSET(emcmot_config_t, numDIO),
    OFFSET(emcmot_config_t, numAIO),
    OFFSET(emcmot_config_t, trajCycleTime),
};

const size_t framepath_layout_length = sizeof(framepath_layout) / sizeof(framepath_layout[0]);
