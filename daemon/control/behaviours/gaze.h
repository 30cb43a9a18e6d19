/* Where the head looks: at the marker while it is seen, elsewhere in search of it when it is not.
 */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_GAZE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_GAZE_H

#include "daemon/config/config.h"
#include "daemon/control/kinematics/head.h"
#include "daemon/control/senses/sight.h"

#include <stdint.h>

enum gaze_state {
    GAZE_ON_MARKER, /* the marker is seen and followed */
    GAZE_WAITING,   /* it is not seen; the head rests, it may come back */
    GAZE_SEARCHING, /* it is not seen; the head searches */
};

struct gaze {
    const struct config *config;
    struct head_search search;
    int64_t last_seen; /* us of senses.time; 0 = never */
};

void gaze_init(struct gaze *gaze, const struct config *config);

/* One period, at `now` of the stamps and `time` of the durations (us): head velocities (rad/s) for
 * the head at q (rad). With `may_search` false the head rests when the marker is out of view, for
 * instance while the arm still moves. */
enum gaze_state gaze_step(struct gaze *gaze, const struct sight *sight, int64_t now, int64_t time,
                          const double *q, bool may_search, double velocity[HEAD_JOINTS]);

#endif
