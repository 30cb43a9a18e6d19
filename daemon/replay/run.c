/* The beginning of a run: the configuration and the model that it had. */
#include "daemon/replay/replay_private.h"

#include "daemon/config/load.h"
#include "daemon/config/reloadable.h"

#include <inttypes.h>
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

/* The learner that models are read into, and space for their bytes. */
static int create_spare(struct replay *replay, char *error, size_t error_size)
{
    struct learner_config learner = config_learner(replay->used);
    size_t bytes = learner_memory(&learner);
    char reason[REPLAY_REASON / 2] = "out of memory";

    if (replay->spare)
        return 0;
    replay->spare = arena_create(bytes + arena_footprint(bytes));
    replay->store.learner = NULL;
    if (replay->spare) {
        replay->store.learner = learner_create(&learner, replay->spare, reason, sizeof reason);
        replay->model =
            (struct model_bytes){.bytes = arena_alloc(replay->spare, bytes), .capacity = bytes};
    }
    if (replay->store.learner && replay->model.bytes)
        return 0;
    return replay_fail(replay, error, error_size, "%s", reason);
}

/* The file among those that were given whose hash is the one wanted. */
static int read_model(struct replay *replay, uint64_t hash, char *error, size_t error_size)
{
    char reason[MODEL_REASON_MOST];

    for (int i = 0; i < replay->settings.n_models; i++) {
        const char *path = replay->settings.models[i];
        if (model_file_read(&files_system, path, &replay->model, reason, sizeof reason) !=
            MODEL_FILE_READ)
            return replay_fail(replay, error, error_size, "%s", reason);
        if (replay->model.hash != hash)
            continue;
        if (learner_load(replay->store.learner, replay->model.bytes, replay->model.size, reason,
                         sizeof reason))
            return replay_fail(replay, error, error_size, "%s: %s", path, reason);
        return 0;
    }
    return replay_fail(replay, error, error_size,
                       "it has a model of hash %016" PRIx64 ", and no --model file has that", hash);
}

/* The model that the trace names, when it is another one than the tick has. */
static int follow_model(struct replay *replay, char *error, size_t error_size)
{
    uint64_t hash = (uint64_t)replay->trace.model;

    if (hash == replay->model_hash)
        return 0;
    if (create_spare(replay, error, error_size) || read_model(replay, hash, error, error_size))
        return -1;
    replay->model_hash = hash;
    replay->store.take = true;
    return 0;
}

int replay_follow_store(struct replay *replay, char *error, size_t error_size)
{
    const reach_trace_t *trace = &replay->trace;

    replay->store.moment = (struct model_store_moment){
        .result = (enum model_store_result)trace->store_result,
        .ready = trace->store_ready != 0,
        .model = (uint64_t)trace->model,
    };
    return follow_model(replay, error, error_size);
}

static int create_tick(struct replay *replay, char *error, size_t error_size)
{
    size_t bytes = tick_memory(replay->used);
    char reason[REPLAY_REASON / 2] = "out of memory";

    if (bytes > most_bytes)
        return replay_fail(replay, error, error_size,
                           "its configuration wants %zu MB; a replay may have %zu", bytes >> 20,
                           most_bytes >> 20);
    replay->arena = arena_create(bytes);
    if (replay->arena)
        replay->tick = tick_create(replay->used, replay->arena, reason, sizeof reason);
    if (!replay->tick)
        return replay_fail(replay, error, error_size, "%s", reason);
    return 0;
}

static void end_run(struct replay *replay)
{
    arena_destroy(replay->arena);
    arena_destroy(replay->spare);
    replay->arena = replay->spare = NULL;
    replay->tick = NULL;
    replay->model_hash = 0;
    memset(&replay->store, 0, sizeof replay->store);
}

int replay_begin_run(struct replay *replay, char *error, size_t error_size)
{
    end_run(replay);
    replay->used = load_config(replay, error, error_size);
    if (!replay->used || create_tick(replay, error, error_size) ||
        follow_model(replay, error, error_size)) {
        end_run(replay);
        return -1;
    }
    model_store_replay(tick_model_store(replay->tick), &replay->store);
    tick_take_recorded_model(replay->tick);
    return 0;
}
