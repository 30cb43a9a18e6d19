/* Lockstep: which markers belong to a state. Plain data; used by the loop thread alone.
 *
 * A state names the exposure whose marker is due with it. Later markers wait, so that a run does
 * not depend on how fast vision is; a missing one is waited for, so that it does not depend on what
 * the bus lost: the simulator asks again for it. Markers may come again, or out of order. */
#ifndef REACH_DUE_MARKERS_H
#define REACH_DUE_MARKERS_H

#include "tick.h"

#include <reach_marker_t.h>
#include <stdbool.h>
#include <stdint.h>

struct due_markers {
    int64_t newest; /* exposure of the newest marker handed on, us */
    int n;          /* markers that wait */
    reach_marker_t waiting[TICK_MAX_MARKERS];
};

void due_markers_init(struct due_markers *markers);

/* Keeps a marker until it is due. Repeats are ignored; when there is no room the latest one goes,
 * which the simulator will ask for when it is due. */
void due_markers_add(struct due_markers *markers, const reach_marker_t *marker);

/* Whether the marker exposed at `due` (us, 0 = none) is here or was handed on already. */
bool due_markers_ready(const struct due_markers *markers, int64_t due);

/* Hands on the oldest marker up to `due`. Returns false when there is none. */
bool due_markers_take(struct due_markers *markers, int64_t due, reach_marker_t *marker);

#endif
