#include "daemon/replay/replay.h"

#include "common/base/big_endian.h"
#include "common/base/checksum.h"
#include "daemon/bus/incoming.h"
#include "daemon/control/senses/refusals.h"
#include "daemon/control/trace.h"
#include "daemon/replay/replay_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct replay *replay_create(const struct replay_settings *settings)
{
    struct replay *replay = calloc(1, sizeof *replay);

    if (!replay)
        return NULL;
    replay->settings = *settings;
    replay->store.paths = settings->models;
    replay->store.n_paths = settings->n_models;
    return replay;
}

void replay_destroy(struct replay *replay)
{
    if (!replay)
        return;
    arena_destroy(replay->arena);
    recorded_store_close(&replay->store);
    free(replay);
}

/* The message that the tick was given. One that is there with other bytes was altered. Returns 1
 * with it, 0 when it is missing and that is allowed, else -1. */
static int find_given(struct replay *replay, enum replay_channel channel, int64_t seq,
                      int32_t checksum, const struct recorded **found, char *error,
                      size_t error_size)
{
    const struct recording *recording = &replay->recording[channel];

    *found = recording_find(recording, seq, (uint32_t)checksum);
    if (*found)
        return 1;
    *found = recording_numbered(recording, seq);
    if (*found && !replay->settings.lossy)
        return replay_fail(replay, error, error_size,
                           "the %s %lld that it was given has another checksum than the one at "
                           "byte %lld: %08x, not %08x; the log was altered",
                           replay_channels[channel], (long long)seq, (long long)(*found)->position,
                           (unsigned)checksum, (*found)->checksum);
    return replay_miss(replay, channel, seq, 1, "it was given", error, error_size);
}

/* It decoded once, for the tick was given it. */
static int undecodable(struct replay *replay, const struct recorded *found, char *error,
                       size_t error_size)
{
    return replay_fail(replay, error, error_size,
                       "it was given the message at byte %lld, which this reachd cannot read",
                       (long long)found->position);
}

static int give_state(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;
    struct tick_inputs *inputs = &replay->inputs;
    const struct recorded *found;
    int result;

    if (!trace->has_state)
        return 0;
    result = find_given(replay, REPLAY_STATE, trace->given_state, trace->state_checksum, &found,
                        error, error_size);
    if (result <= 0)
        return result;
    if (!incoming_state(found->bytes, found->size, &inputs->state))
        return undecodable(replay, found, error, error_size);
    inputs->has_state = true;
    inputs->state_checksum = found->checksum;
    return 0;
}

static int give_observations(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;
    struct tick_inputs *inputs = &replay->inputs;
    enum space_kind space = replay->used->space.kind;
    enum replay_channel channel = space == SPACE_CARTESIAN ? REPLAY_EFFECTOR : REPLAY_MARKER;

    for (int i = 0; i < trace->n_observations; i++) {
        const struct recorded *found;
        int result = find_given(replay, channel, trace->observation[i],
                                trace->observation_checksum[i], &found, error, error_size);
        if (result < 0)
            return -1;
        if (result == 0)
            continue;
        if (!incoming_observation(space, found->bytes, found->size,
                                  &inputs->observation[inputs->n_observations++]))
            return undecodable(replay, found, error, error_size);
    }
    return 0;
}

static int give_requests(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;
    struct tick_inputs *inputs = &replay->inputs;

    for (int i = 0; i < trace->n_requests; i++) {
        const struct recorded *found;
        int result = find_given(replay, REPLAY_REQUEST, trace->request[i],
                                trace->request_checksum[i], &found, error, error_size);
        if (result < 0)
            return -1;
        if (result == 0)
            continue;
        inputs->request_checksum[inputs->n_requests] = found->checksum;
        if (!incoming_request(found->bytes, found->size, &inputs->request[inputs->n_requests++]))
            return undecodable(replay, found, error, error_size);
    }
    return 0;
}

/* Which run the trace belongs to, and how many ticks before it are missing. */
static int follow_ticks(struct replay *replay, char *error, size_t error_size)
{
    int64_t seq = replay->trace.seq;

    if (replay_begins_run(replay)) {
        if (replay_begin_run(replay, error, error_size))
            return -1;
        replay->seq = 0;
        replay->report.runs++;
    }
    replay->inputs.unseen = seq - replay->seq - 1;
    if (replay->inputs.unseen > 0 && replay->foreign[0].any && !replay->settings.lossy)
        return replay_another_version(replay, REPLAY_TRACE, error, error_size);
    replay->foreign[0].any = false;
    if (replay->inputs.unseen > 0 && !(replay->trace.fresh && replay->seq == 0) &&
        replay_miss(replay, REPLAY_TRACE, replay->seq + 1, replay->inputs.unseen, "before it,",
                    error, error_size))
        return -1;
    replay->seq = seq;
    return 0;
}

static int gather_inputs(struct replay *replay, char *error, size_t error_size)
{
    trace_to_inputs(&replay->trace, &replay->inputs);
    return follow_ticks(replay, error, error_size) ||
                   replay_follow_config(replay, error, error_size) ||
                   replay_follow_store(replay, error, error_size) ||
                   replay_follow_body(replay, error, error_size) ||
                   give_state(replay, error, error_size) ||
                   give_observations(replay, error, error_size) ||
                   give_requests(replay, error, error_size)
               ? -1
               : 0;
}

/* The same calls as the loop's, in the same order. */
static void run_tick(struct replay *replay)
{
    const reach_trace_t *trace = &replay->trace;
    struct tick_outputs *outputs = &replay->outputs;

    tick_decide(replay->tick, &replay->inputs, trace->utime, outputs);
    for (int i = 0; i < trace->learned; i++)
        if (!tick_learn(replay->tick))
            break;
    tick_report(replay->tick, trace->utime, outputs);
    memcpy(outputs->trace.refused, trace->refused, sizeof trace->refused);
    refusals_into_status(trace->refused, &outputs->status);
    replay->report.ticks++;
    replay->report.seconds += replay->used->period;
    if (replay->settings.sink)
        replay->settings.sink(replay->settings.user, outputs);
}

static bool is_sound(const reach_trace_t *trace)
{
    return trace->seq > 0 && trace->n_observations >= 0 &&
           trace->n_observations <= TICK_MAX_OBSERVATIONS && trace->n_requests >= 0 &&
           trace->n_requests <= TICK_MAX_REQUESTS;
}

static bool is_foreign(const void *data, size_t size, int64_t fingerprint)
{
    return size < 8 || (int64_t)big_endian(data, 8) != fingerprint;
}

static int decode_trace(struct replay *replay, const void *data, size_t size, char *error,
                        size_t error_size)
{
    reach_trace_t *trace = &replay->trace;
    size_t covered = outgoing_trace_covered();

    if (size == covered + 4 && reach_trace_t_decode(data, 0, (int)size, trace) == (int)size &&
        (uint32_t)trace->checksum == checksum_crc32(data, covered) && is_sound(trace))
        return 0;
    snprintf(error, error_size,
             "byte %lld: the checksum of this REACH_TRACE is wrong; the log was altered",
             (long long)replay->position);
    return -1;
}

static int take_trace(struct replay *replay, const void *data, size_t size, char *error,
                      size_t error_size)
{
    if (is_foreign(data, size, __reach_trace_t_get_hash())) {
        replay_note_foreign(replay, REPLAY_TRACE, replay->position);
        return 0;
    }
    if (decode_trace(replay, data, size, error, error_size))
        return -1;
    if (replay_is_repeated(replay))
        return 0;
    if (gather_inputs(replay, error, error_size))
        return -1;
    run_tick(replay);
    return replay->settings.verify ? replay_verify(replay, error, error_size) : 0;
}

/* Whoever needs one that is none of ours misses it. */
static void take_config(struct replay *replay, const void *data, size_t size, int64_t position)
{
    reach_config_t *message = &replay->texts[replay->n_texts % REPLAY_CONFIGS];
    const reach_config_t *newest =
        &replay->texts[(replay->n_texts + REPLAY_CONFIGS - 1) % REPLAY_CONFIGS];

    if (is_foreign(data, size, __reach_config_t_get_hash())) {
        replay_note_foreign(replay, REPLAY_CONFIG, position);
        return;
    }
    if (reach_config_t_decode(data, 0, (int)size, message) != (int)size)
        return;
    message->text[sizeof message->text - 1] = '\0';
    message->revision[sizeof message->revision - 1] = '\0';
    if (message->checksum != newest->checksum ||
        memcmp(message->text, newest->text, sizeof newest->text) != 0)
        replay->n_texts++; /* they repeat themselves */
}

int replay_take(struct replay *replay, const char *channel, const void *data, size_t size,
                int64_t position, char *error, size_t error_size)
{
    int index = 0;

    while (index < REPLAY_CHANNELS && strcmp(channel, replay_channels[index]) != 0)
        index++;
    if (index < REPLAY_TRACE)
        recording_add(&replay->recording[index], data, size, position);
    if (index == REPLAY_CONFIG)
        take_config(replay, data, size, position);
    if (index == REPLAY_BODY)
        replay_take_body(replay, data, size);
    if (index != REPLAY_TRACE)
        return 0;
    replay->position = position;
    return take_trace(replay, data, size, error, error_size);
}
