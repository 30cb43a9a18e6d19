#include "daemon/control/behaviours/gaze.h"

void gaze_init(struct gaze *gaze, const struct config *config)
{
    gaze->config = config;
    gaze->last_seen = 0;
    /* The search needs no seed of its own: any sequence of places will do. */
    head_search_init(&gaze->search, 1);
}

enum gaze_state gaze_step(struct gaze *gaze, const struct sight *sight, int64_t now, int64_t time,
                          const double *q, bool may_search, double velocity[HEAD_JOINTS])
{
    velocity[0] = velocity[1] = 0;
    if (sight_seen(sight, now)) {
        gaze->last_seen = time;
        head_search_end(&gaze->search);
        head_fixate(gaze->config, sight->carried, velocity);
        return GAZE_ON_MARKER;
    }
    if (!may_search || (double)(time - gaze->last_seen) * 1e-6 < gaze->config->fixation_lost)
        return GAZE_WAITING;
    head_search_step(&gaze->search, gaze->config, time, q, velocity);
    return GAZE_SEARCHING;
}
