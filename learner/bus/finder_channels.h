/* Who asks reach-finder for bodies. Each has channels of its own, so that none takes what was found
 * for another, and a log of the robot holds its own bodies alone. */
#ifndef REACH_LEARNER_BUS_FINDER_CHANNELS_H
#define REACH_LEARNER_BUS_FINDER_CHANNELS_H

#ifdef __cplusplus
extern "C" {
#endif

enum finder_asker { FINDER_ASKED_BY_DAEMON, FINDER_ASKED_BY_LEARNER, FINDER_ASKERS };

struct finder_channels {
    const char *request; /* body_request_t */
    const char *answer;  /* body_t */
};
extern const struct finder_channels finder_channels[FINDER_ASKERS];

#ifdef __cplusplus
}
#endif
#endif
