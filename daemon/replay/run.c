/* The beginning of a run: the configuration and the model that it had. */
#include "daemon/replay/replay_private.h"

#include "daemon/config/load.h"
#include "daemon/config/reloadable.h"

#include <stdio.h>
#include <string.h>

/* What a configuration out of a log may want. */
static const size_t most_bytes = (size_t)1 << 30;

static const reach_config_t *text_of(const struct replay *replay, int32_t checksum)
{
    for (int64_t i = replay->n_texts - 1; i >= 0 && i >= replay->n_texts - REPLAY_CONFIGS; i--) {
        const reach_config_t *text = &replay->texts[i % REPLAY_CONFIGS];
        if (text->checksum == checksum)
            return text;
    }
    return NULL;
}

/* The recorded configuration that the trace names. */
static int load_recorded(struct replay *replay, struct config *config, char *error,
                         size_t error_size)
{
    const reach_config_t *message = text_of(replay, replay->trace.config);
    char text[CONFIG_TEXT_SIZE];
    char reason[REPLAY_REASON / 2];

    if (!message && replay->foreign[1].any)
        return replay_another_version(replay, REPLAY_CONFIG, error, error_size);
    if (!message)
        return replay_fail(replay, error, error_size,
                           "its configuration, of checksum %08x, was not recorded before it; start "
                           "lcm-logger before reachd, or give the configuration with --config",
                           (unsigned)replay->trace.config);
    memcpy(text, message->text, sizeof text);
    if (config_text_checksum(text) != (uint32_t)message->checksum)
        return replay_fail(replay, error, error_size,
                           "its REACH_CONFIG has another text than its checksum says; the log was "
                           "altered");
    if (config_from_text(config, text, reason, sizeof reason))
        return replay_fail(replay, error, error_size,
                           "its configuration is not one of this version: %s", reason);
    /* As it was recorded: an option that has come since has its default, and changes nothing. */
    config->checksum = (uint32_t)message->checksum;
    snprintf(replay->report.revision, sizeof replay->report.revision, "%s",
             (const char *)message->revision);
    return 0;
}

/* Into the buffer that the tick does not work with. A replay keeps no model on disk. */
static struct config *load_config(struct replay *replay, char *error, size_t error_size)
{
    struct config *config = &replay->config[replay->used == &replay->config[0]];

    if (replay->settings.config)
        *config = *replay->settings.config;
    else if (load_recorded(replay, config, error, error_size))
        return NULL;
    config->model_directory[0] = '\0';
    return config;
}

int replay_follow_config(struct replay *replay, char *error, size_t error_size)
{
    struct config *config;
    char reason[REPLAY_REASON / 2];
    int changes;

    if (replay->settings.config || (int32_t)replay->used->checksum == replay->trace.config)
        return 0;
    config = load_config(replay, error, error_size);
    if (!config)
        return -1;
    if (!config_reloadable(replay->used, config, &changes, reason, sizeof reason))
        return replay_fail(replay, error, error_size, "%s", reason);
    replay->used = replay->inputs.config = config;
    return 0;
}

int replay_follow_store(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;
    const struct learner_config learner = config_learner(replay->used);
    const struct model_moment moment = {
        .result = (enum model_result)trace->store_result,
        .ready = trace->store_ready != 0,
        .model = (uint64_t)trace->model,
        .body = trace->body,
        .body_checksum = (uint32_t)trace->body_checksum,
    };
    char reason[MODEL_REASON_MOST];

    if (recorded_store_follow(&replay->store, &learner, &moment, reason, sizeof reason))
        return replay_fail(replay, error, error_size, "%s", reason);
    return 0;
}

static int create_tick(struct replay *replay, char *error, size_t error_size)
{
    const struct tick_settings settings = {.config = replay->used,
                                           .model = recorded_store_port(&replay->store)};
    size_t bytes = tick_memory(replay->used);
    char reason[REPLAY_REASON / 2] = "out of memory";

    if (bytes > most_bytes)
        return replay_fail(replay, error, error_size,
                           "its configuration wants %zu MB; a replay may have %zu", bytes >> 20,
                           most_bytes >> 20);
    replay->arena = arena_create(bytes);
    if (replay->arena)
        replay->tick = tick_create(&settings, replay->arena, reason, sizeof reason);
    if (!replay->tick)
        return replay_fail(replay, error, error_size, "%s", reason);
    return 0;
}

/* The model that the run began with. */
static int open_model(struct replay *replay, char *error, size_t error_size)
{
    const struct learner_config learner = config_learner(replay->used);
    char reason[MODEL_REASON_MOST];

    if (recorded_store_open(&replay->store, &learner, (uint64_t)replay->trace.model,
                            tick_learner(replay->tick), reason, sizeof reason))
        return replay_fail(replay, error, error_size, "%s", reason);
    return 0;
}

static void end_run(struct replay *replay)
{
    recorded_store_close(&replay->store);
    arena_destroy(replay->arena);
    replay->arena = NULL;
    replay->tick = NULL;
}

int replay_begin_run(struct replay *replay, char *error, size_t error_size)
{
    end_run(replay);
    replay->used = load_config(replay, error, error_size);
    if (replay->used && create_tick(replay, error, error_size) == 0 &&
        open_model(replay, error, error_size) == 0)
        return 0;
    end_run(replay);
    return -1;
}
