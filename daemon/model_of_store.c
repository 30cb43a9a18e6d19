#include "daemon/model_of_store.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static_assert((int)MODEL_NOTHING == (int)MODEL_STORE_NOTHING &&
                  (int)MODEL_DONE == (int)MODEL_STORE_DONE &&
                  (int)MODEL_FAILED == (int)MODEL_STORE_FAILED &&
                  (int)MODEL_BODY_TAKEN == (int)MODEL_STORE_BODY_TAKEN,
              "results are handed on as they are");

struct model_store_settings model_of_store_settings(const struct config *config,
                                                    const struct finder_port *finder,
                                                    const struct body *start)
{
    return (struct model_store_settings){
        .directory = config->model_directory,
        .automatic = config->model_automatic,
        .snapshot_samples = config->model_snapshot,
        .snapshot_rate = config->model_snapshot_budget * 1e6 / 86400,
        .saved_most = config->model_saved_most,
        .sync_us = (int64_t)(config->model_sync * 1e6),
        .keep = config->model_keep,
        .learner = config_learner(config),
        .finder = finder,
        .start = start,
    };
}

static bool store_note(void *context, const double *z, const double *x)
{
    return model_store_note(context, z, x);
}

static void store_learned(void *context, const struct learner *learner)
{
    model_store_learned(context, learner);
}

static bool store_full(const void *context)
{
    return model_store_full(context);
}

static bool store_works(const void *context)
{
    return model_store_works(context);
}

static bool store_begin_save(void *context, int number)
{
    return model_store_begin_save(context, number);
}

static bool store_begin_load(void *context, int number)
{
    return model_store_begin_load(context, number);
}

static void store_begin_forgetting(void *context)
{
    model_store_begin_forgetting(context);
}

static void store_tell_body(void *context)
{
    model_store_tell_body(context);
}

static enum model_result store_poll(void *context, struct learner **learner)
{
    return (enum model_result)model_store_poll(context, learner);
}

static struct model_moment store_moment(const void *context)
{
    const struct model_store_moment moment = model_store_moment(context);

    return (struct model_moment){.result = (enum model_result)moment.result,
                                 .ready = moment.ready,
                                 .model = moment.model,
                                 .body = moment.body,
                                 .body_checksum = moment.body_checksum};
}

static enum model_search search_of(enum model_store_search search)
{
    switch (search) {
    case MODEL_STORE_SEARCHING:
        return MODEL_SEARCHING;
    case MODEL_STORE_FOUND:
        return MODEL_FOUND;
    case MODEL_STORE_NO_CHAIN:
        return MODEL_NO_CHAIN;
    case MODEL_STORE_NO_FINDER:
        return MODEL_NO_FINDER;
    default:
        return MODEL_NO_SEARCH;
    }
}

static struct model_report store_report(const void *context)
{
    const struct model_store_report report = model_store_report(context);

    struct model_report told = {
        .stored = report.stored,
        .storing = report.storing,
        .waits = report.waits,
        .search = search_of(report.search),
        .searches = report.searches,
    };
    memcpy(told.not_rigid, report.not_rigid, sizeof told.not_rigid);
    return told;
}

static const struct model_port_ops ops = {
    .note = store_note,
    .learned = store_learned,
    .full = store_full,
    .works = store_works,
    .begin_save = store_begin_save,
    .begin_load = store_begin_load,
    .begin_forgetting = store_begin_forgetting,
    .tell_body = store_tell_body,
    .poll = store_poll,
    .moment = store_moment,
    .report = store_report,
};

struct model_port model_of_store(struct model_store *store)
{
    return (struct model_port){&ops, store};
}

int model_of_store_check(const struct config *config, char *error, size_t error_size)
{
    const char *path = config->model_directory;
    struct stat status;

    if (!path[0] || (stat(path, &status) == 0 && S_ISDIR(status.st_mode)))
        return 0;
    snprintf(error, error_size, "model.directory: %.300s is not a directory; make it first", path);
    return -1;
}
