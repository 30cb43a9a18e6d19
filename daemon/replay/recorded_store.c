#include "daemon/replay/recorded_store.h"

#include <inttypes.h>
#include <stdio.h>

/* The learner that models are read into, and space for their bytes. */
static int create_learner(struct recorded_store *store, const struct learner_config *config,
                          char *error, size_t error_size)
{
    size_t bytes = learner_memory(config);

    if (store->arena)
        return 0;
    snprintf(error, error_size, "out of memory");
    store->learner = NULL;
    store->arena = arena_create(bytes + arena_footprint(bytes));
    if (!store->arena)
        return -1;
    store->learner = learner_create(config, store->arena, error, error_size);
    store->model =
        (struct model_bytes){.bytes = arena_alloc(store->arena, bytes), .capacity = bytes};
    return store->learner && store->model.bytes ? 0 : -1;
}

/* The file among those that were given whose hash is the one wanted. */
static int read_model(struct recorded_store *store, uint64_t hash, struct learner *learner,
                      char *error, size_t error_size)
{
    char reason[MODEL_REASON_MOST];

    for (int i = 0; i < store->n_paths; i++) {
        const char *path = store->paths[i];
        if (model_file_read(&files_system, path, &store->model, error, error_size) !=
            MODEL_FILE_READ)
            return -1;
        if (store->model.hash != hash)
            continue;
        if (learner_load(learner, store->model.bytes, store->model.size, reason, sizeof reason)) {
            snprintf(error, error_size, "%s: %s", path, reason);
            return -1;
        }
        store->hash = hash;
        return 0;
    }
    snprintf(error, error_size,
             "it has a model of hash %016" PRIx64 ", and no --model file has that", hash);
    return -1;
}

int recorded_store_open(struct recorded_store *store, const struct learner_config *config,
                        uint64_t hash, struct learner *learner, char *error, size_t error_size)
{
    if (hash == 0)
        return 0;
    return create_learner(store, config, error, error_size) ||
                   read_model(store, hash, learner, error, error_size)
               ? -1
               : 0;
}

int recorded_store_follow(struct recorded_store *store, const struct learner_config *config,
                          const struct model_moment *moment, char *error, size_t error_size)
{
    store->moment = *moment;
    if (moment->model == store->hash)
        return 0;
    if (create_learner(store, config, error, error_size) ||
        read_model(store, moment->model, store->learner, error, error_size))
        return -1;
    store->take = true;
    return 0;
}

int recorded_store_give(struct recorded_store *store, const struct learner_config *config,
                        const struct learner *learner, const struct body *body, char *error,
                        size_t error_size)
{
    if (create_learner(store, config, error, error_size))
        return -1;
    model_capture(&store->model, learner);
    if (learner_load(store->learner, store->model.bytes, store->model.size, error, error_size) ||
        learner_give_body(store->learner, body, error, error_size))
        return -1;
    store->take = true;
    return 0;
}

void recorded_store_close(struct recorded_store *store)
{
    arena_destroy(store->arena);
    *store = (struct recorded_store){.paths = store->paths, .n_paths = store->n_paths};
}

static bool note(void *context, const double *z, const double *x)
{
    (void)context, (void)z, (void)x;
    return true;
}

static void take_no_notice(void *context, const struct learner *learner)
{
    (void)context, (void)learner;
}

/* How many samples a tick learned is in its trace: nothing waits here. */
static bool is_never(const void *context)
{
    (void)context;
    return false;
}

/* One a tick, as the store that was recorded. */
static bool begin_request(void *context, int number)
{
    struct recorded_store *store = context;
    bool ready = store->ready;

    (void)number;
    store->ready = false;
    return ready;
}

static void do_nothing(void *context)
{
    (void)context;
}

static enum model_result poll_recorded(void *context, struct learner **learner)
{
    struct recorded_store *store = context;
    struct learner *old = *learner;

    store->ready = store->moment.ready;
    if (store->take) {
        *learner = store->learner;
        store->learner = old;
        store->take = false;
    }
    return store->moment.result;
}

static struct model_moment moment(const void *context)
{
    const struct recorded_store *store = context;

    return store->moment;
}

/* What the disk had come to is measured: a replay cannot have it (compare.h). */
static struct model_report report_nothing(const void *context)
{
    (void)context;
    return (struct model_report){0};
}

static const struct model_port_ops ops = {
    .note = note,
    .learned = take_no_notice,
    .full = is_never,
    .works = is_never,
    .begin_save = begin_request,
    .begin_load = begin_request,
    .begin_forgetting = do_nothing,
    .tell_body = do_nothing,
    .poll = poll_recorded,
    .moment = moment,
    .report = report_nothing,
};

struct model_port recorded_store_port(struct recorded_store *store)
{
    return (struct model_port){&ops, store};
}
