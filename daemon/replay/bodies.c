/* Bodies that were found in the recorded run: a replay never searches. */
#include "daemon/replay/replay_private.h"

#include <string.h>

void replay_take_body(struct replay *replay, const void *data, size_t size)
{
    struct received_body *body = &replay->bodies[replay->n_bodies % REPLAY_BODIES];

    if (body_answer_read(data, size, body) && body->answer.kind == BODY_ANSWER_REPORT &&
        body->answer.report.outcome == FINDER_FOUND)
        replay->n_bodies++;
}

/* The newest of that number; with `checksum` when there is one. */
static const struct body_answer *find_body(const struct replay *replay, int64_t seq,
                                           uint32_t checksum)
{
    const struct body_answer *numbered = NULL;

    for (int64_t i = replay->n_bodies - 1; i >= 0 && i >= replay->n_bodies - REPLAY_BODIES; i--) {
        const struct body_answer *answer = &replay->bodies[i % REPLAY_BODIES].answer;
        if (answer->seq == seq && answer->checksum == checksum)
            return answer;
        if (answer->seq == seq && !numbered)
            numbered = answer;
    }
    return numbered;
}

static int give(struct replay *replay, const struct body *body, char *error, size_t error_size)
{
    const struct learner_config learner = config_learner(replay->used);
    char reason[200];

    if (recorded_store_give(&replay->store, &learner, tick_learner(replay->tick), body, reason,
                            sizeof reason))
        return replay_fail(replay, error, error_size, "%s", reason);
    return 0;
}

int replay_follow_body(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;
    static const struct body none;
    const struct body_answer *found;

    if (trace->body == 0)
        return 0;
    if (trace->body == MODEL_BODY_TAKEN)
        return give(replay, &none, error, error_size);
    found = find_body(replay, trace->body, (uint32_t)trace->body_checksum);
    if (!found)
        return replay_miss(replay, REPLAY_BODY, trace->body, 1, "its learner was given", error,
                           error_size);
    if (found->checksum != (uint32_t)trace->body_checksum && !replay->settings.lossy)
        return replay_fail(replay, error, error_size,
                           "the REACH_BODY %lld that its learner was given has another checksum "
                           "than the recorded one: %08x, not %08x; the log was altered",
                           (long long)trace->body, (unsigned)trace->body_checksum,
                           (unsigned)found->checksum);
    return give(replay, &found->body, error, error_size);
}
