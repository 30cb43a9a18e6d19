/* The last robot states, for the joints at an instant between two of them.
 *
 * Cameras are late and out of step with the encoders; a training pair needs the joints at the
 * moment of exposure. Plain data, no pointers; used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_SENSES_JOINT_HISTORY_H
#define REACH_DAEMON_CONTROL_SENSES_JOINT_HISTORY_H

#include "daemon/config/sizes.h"

#include <stdbool.h>
#include <stdint.h>

#define HISTORY_LENGTH 64 /* 1.28 s at 50 Hz */

struct history {
    int n_joints;
    int count;  /* entries in use */
    int newest; /* index of the newest */
    int64_t utime[HISTORY_LENGTH];
    double q[HISTORY_LENGTH][MAX_JOINTS]; /* rad */
};

void history_init(struct history *history, int n_joints);

/* Adds joints (rad) read at utime (us), which must be after the newest one. */
void history_push(struct history *history, int64_t utime, const double *q);

/* Joints at utime, linear between the two states around it.
 *   returns false when utime lies outside what is held; q is then untouched. */
bool history_at(const struct history *history, int64_t utime, double *q);

#endif
