/* The third way to drive the tick, beside lockstep and real time: by what was recorded, out of a
 * log or from lcm-logplayer on the bus. Runs in the thread that calls it, as fast as it can. */
#ifndef REACH_DAEMON_REPLAY_PLAYER_H
#define REACH_DAEMON_REPLAY_PLAYER_H

#include "daemon/replay/replay.h"

#include <lcm/lcm.h>

/* The whole log, of one file or of pieces in any order; "-" is standard input. Prints what it did.
 * `settings` without a sink. Returns 0, or -1 with one line in `error`. */
int player_play_log(const char *const *paths, int n_paths, const struct replay_settings *settings,
                    char *error, size_t error_size);

/* What comes on the bus until SIGINT or SIGTERM, which must be blocked; sends what the daemon would
 * have sent on the same channels with "REPLAY_" before their names. Prints what it did and what was
 * lost. Returns as above. */
int player_play_bus(lcm_t *lcm, const struct replay_settings *settings, char *error,
                    size_t error_size);

#endif
