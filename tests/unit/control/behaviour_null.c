/* The least that a behaviour can be: it rests for as many ticks as it was asked to. */
#include "daemon/control/behaviours/behaviour.h"

#include <reach_status_t.h>

struct null_state {
    int ticks;
};

static bool null_accepts(const struct config *config, const reach_request_t *request)
{
    (void)config;
    return request->count >= 1;
}

static void null_start(struct behaviour *behaviour, const reach_request_t *request,
                       const struct senses *senses, struct wants *wants)
{
    (void)senses, (void)wants;
    behaviour->progress.total = request->count;
    behaviour->progress.phase = REACH_STATUS_T_TRACK;
}

static bool null_step(struct behaviour *behaviour, const struct senses *senses, struct wants *wants)
{
    struct null_state *state = behaviour_state(behaviour);

    (void)senses, (void)wants;
    if (state->ticks == behaviour->progress.total)
        return false;
    behaviour->progress.done = ++state->ticks;
    return true;
}

BEHAVIOUR_STATE_FITS(struct null_state);

extern const struct behaviour_ops behaviour_null; /* as a row of the table declares it */
const struct behaviour_ops behaviour_null = {
    .name = "null",
    .kind = 99,
    .code = 98,
    .state_size = sizeof(struct null_state),
    .accepts = null_accepts,
    .start = null_start,
    .step = null_step,
};
