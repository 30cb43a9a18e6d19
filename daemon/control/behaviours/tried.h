/* Postures that babbling has tried, and whether the marker could be fixated there: how the robot
 * finds by itself which part of its joints' range is of use (paper section 7.1 has it given).
 *
 * A posture is judged by the nearest that was tried. Only the newest are remembered, for a tool
 * changes what can be seen. Plain data; used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_TRIED_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_TRIED_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"

#include <stdbool.h>

#define TRIED_LENGTH 128

struct tried {
    int count; /* entries in use */
    int next;  /* index that the next one gets */
    bool good[TRIED_LENGTH];
    double posture[TRIED_LENGTH][MAX_JOINTS]; /* rad */
};

/* Remembers that the arm at `posture` (rad) was of use, or not. */
void tried_note(struct tried *tried, const double *posture, bool good);

/* Whether the nearest posture that was tried was of use; true before any was. Distances are in
 * shares of the babbled range of each joint. */
bool tried_promises(const struct tried *tried, const struct config *config, const double *posture);

#endif
