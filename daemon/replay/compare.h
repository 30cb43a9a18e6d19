/* A message that was recorded against the same one, computed anew. */
#ifndef REACH_DAEMON_REPLAY_COMPARE_H
#define REACH_DAEMON_REPLAY_COMPARE_H

#include "daemon/bus/outgoing.h"

#include <stdbool.h>
#include <stddef.h>

/* Gives `replayed` what the recorded message has measured: durations, counts of late ticks, what
 * the disk and the search for a body had come to. No replay can have that, and no command depends
 * on it. */
void replay_take_measured(const struct outgoing *recorded, struct outgoing *replayed);

/* Whether both are the same in every bit; if not, the first field that differs and its values in
 * `text`: "velocity[3]: recorded 0.25, replayed 0.5". Both are of one kind. */
bool replay_same(const struct outgoing *recorded, const struct outgoing *replayed, char *text,
                 size_t text_size);

#endif
