/* The store's work in the housekeeping thread: samples into the journal and the shadow, snapshots,
 * saving and loading by number. */
#include "learner/store/saved.h"
#include "learner/store/store_private.h"

#include "common/program/log.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const int64_t retry_us = 1000000; /* after a failure */

static void publish(struct model_store *store)
{
    atomic_store_explicit(&store->stored,
                          model_store_pack(store->shadow_epoch, store->journal.stored),
                          memory_order_release);
}

/* The disk refuses: said once, tried again later. Only a new snapshot can follow what is missing.
 */
static void give_up_journal(struct model_store *store, int64_t now, const char *what)
{
    char trouble[MODEL_REASON_MOST];

    snprintf(trouble, sizeof trouble, "%s: %s: %s", store->settings.directory, what,
             files_reason());
    journal_close(&store->journal);
    atomic_store_explicit(&store->storing, false, memory_order_relaxed);
    store->retry_at = now + retry_us;
    if (strcmp(trouble, store->trouble) != 0)
        log_error("%s; what is learned from here on is not stored", trouble);
    memcpy(store->trouble, trouble, sizeof trouble);
}

static void begin_generation(struct model_store *store, int64_t now)
{
    struct journal next;

    model_capture(&store->model, store->shadow);
    if (generations_begin(&store->generations, &store->model, &next)) {
        give_up_journal(store, now, "cannot make a snapshot");
        return;
    }
    journal_close(&store->journal);
    store->journal = next;
    store->snapshot_at = now;
    store->snapshot_bytes = store->model.size;
    store->waiting_since = 0;
    publish(store);
    atomic_store_explicit(&store->storing, true, memory_order_relaxed);
    if (store->trouble[0])
        log_info("%s: stored again, up to sample %llu", store->settings.directory,
                 (unsigned long long)store->shadow_number);
    store->trouble[0] = '\0';
}

static void commit_journal(struct model_store *store, int64_t now)
{
    if (journal_commit(&store->journal)) {
        give_up_journal(store, now, "cannot write the journal");
        return;
    }
    store->waiting_since = 0;
    publish(store);
}

static bool journal_is_long(const struct model_store *store)
{
    return store->journal.appended - store->journal.first >=
           (uint64_t)store->settings.snapshot_samples;
}

/* Snapshots may write so many bytes a second in the mean: the larger the newest one was, the longer
 * the next waits. Until then the journal holds what is learned. */
static bool budget_allows(const struct model_store *store, int64_t now)
{
    double seconds = (double)(now - store->snapshot_at) * 1e-6;

    return store->settings.snapshot_rate <= 0 ||
           seconds * store->settings.snapshot_rate >= (double)store->snapshot_bytes;
}

static bool snapshot_is_due(const struct model_store *store, int64_t now)
{
    if (store->journal.file < 0)
        return now >= store->retry_at;
    return journal_is_long(store) && budget_allows(store, now);
}

static void store_what_is_due(struct model_store *store, int64_t now)
{
    bool snapshot = snapshot_is_due(store, now);
    bool late = store->waiting_since && now - store->waiting_since >= store->settings.sync_us;

    if (store->journal.file >= 0 && (snapshot || late))
        commit_journal(store, now);
    if (snapshot)
        begin_generation(store, now);
}

/* Exactly the model that was asked for: called when the shadow stands at its sample. */
static void save_model(struct model_store *store)
{
    char path[MODEL_PATH_MOST];

    saved_path(store->settings.directory, store->model_number, path);
    model_capture(&store->model, store->shadow);
    if (saved_write(store->files, store->settings.directory, store->model_number,
                    store->settings.saved_most, &store->model)) {
        log_error("%s: %s", path, files_reason());
        model_store_set_stage(store, FAILED);
        return;
    }
    log_info("%s: saved, %llu samples", path, (unsigned long long)store->model.samples);
    model_store_set_stage(store, DONE);
}

static void save_if_reached(struct model_store *store)
{
    if (model_store_stage(store) == SAVE_ASKED && store->shadow_number == store->save_at)
        save_model(store);
}

/* From now on both learners take turns at being the loop's. */
int model_store_lock_shadow(struct model_store *store)
{
    if (store->unlocked && arena_lock(store->arena, true))
        return -1;
    store->unlocked = false;
    return 0;
}

/* The model into the shadow, which the loop will steer by. Returns 0, or -1 with a line; the shadow
 * is then as it was. */
static int read_model(struct model_store *store, const char *path, char *reason, size_t reason_size)
{
    char why[200];

    if (model_file_read(store->files, path, &store->model, reason, reason_size) != MODEL_FILE_READ)
        return -1;
    if (model_store_lock_shadow(store)) {
        snprintf(reason, reason_size, "%s: cannot lock memory for it: %s; raise LimitMEMLOCK", path,
                 strerror(errno));
        return -1;
    }
    if (learner_load(store->shadow, store->model.bytes, store->model.size, why, sizeof why) == 0)
        return 0;
    snprintf(reason, reason_size, "%s: %s", path, why);
    return -1;
}

static void load_model(struct model_store *store, int64_t now)
{
    char path[MODEL_PATH_MOST];
    char reason[MODEL_REASON_MOST];

    saved_path(store->settings.directory, store->model_number, path);
    if (read_model(store, path, reason, sizeof reason)) {
        log_error("%s", reason);
        model_store_set_stage(store, FAILED);
        return;
    }
    log_info("%s: read, %llu samples", path, (unsigned long long)store->model.samples);
    if (store->journal.file >= 0)
        commit_journal(store, now); /* the last of the model that goes */
    journal_close(&store->journal);
    atomic_store_explicit(&store->storing, false, memory_order_relaxed);
    store->retry_at = 0;
    store->shadow_epoch++;
    model_store_drop_search(store);
    model_store_set_stage(store, READ);
}

/* The loop steers by what was read; its old learner becomes the shadow and must be made equal. */
static void follow_swap(struct model_store *store)
{
    char why[200];

    if (learner_load(store->shadow, store->model.bytes, store->model.size, why, sizeof why))
        log_error("the shadow refuses the model that it held before: %s", why); /* cannot be */
    store->shadow_number = store->model.samples;
    model_store_set_stage(store, FREE);
}

static void take_noted(struct model_store *store, const struct noted *noted, int64_t now)
{
    if (noted->epoch != store->shadow_epoch)
        return; /* learned by a model that has been replaced */
    learner_update(store->shadow, noted->sample.z, noted->sample.x);
    store->shadow_number = noted->sample.number;
    if (!store->waiting_since)
        store->waiting_since = now;
    if (store->journal.file >= 0 && journal_append(&store->journal, &noted->sample))
        give_up_journal(store, now, "cannot write the journal");
}

/* The shadow was given a body, or has none any more, and what is on disk must be the same. */
void model_store_keep_body(struct model_store *store, int64_t now)
{
    struct journal_body body = {.number = store->shadow_number};

    if (store->journal.file < 0)
        return; /* a snapshot will have it */
    if (learner_body(store->shadow))
        body_to_numbers(learner_body(store->shadow), body.numbers);
    if (journal_append_body(&store->journal, &body))
        give_up_journal(store, now, "cannot write the journal");
    else
        commit_journal(store, now);
}

static void do_what_is_reached(struct model_store *store, int64_t now)
{
    save_if_reached(store);
    model_store_search_if_reached(store, now);
}

static void drain(struct model_store *store, int64_t now)
{
    struct noted noted;

    while (mailbox_peek(store->noted, &noted)) {
        do_what_is_reached(store, now); /* looked at after the sample behind it was seen */
        mailbox_take(store->noted, &noted);
        take_noted(store, &noted, now);
    }
    do_what_is_reached(store, now);
}

/* The loop may take the shadow at any moment. */
static bool is_loops(const struct model_store *store)
{
    enum stage stage = model_store_stage(store);

    return stage == READ || stage == BODY_GIVEN;
}

void model_store_serve(struct model_store *store, int64_t now)
{
    if (!store->arena || is_loops(store))
        return;
    if (model_store_stage(store) == SWAPPED)
        follow_swap(store);
    drain(store, now);
    model_store_follow_search(store, now);
    if (model_store_stage(store) == BODY_AWAITED) {
        model_store_give_body(store, now);
        return;
    }
    if (model_store_stage(store) == LOAD_ASKED)
        load_model(store, now);
    else if (store->opened)
        store_what_is_due(store, now);
}

static void store_the_rest(struct model_store *store)
{
    if (model_store_stage(store) == SWAPPED)
        follow_swap(store);
    drain(store, 0);
    if (store->journal.file >= 0)
        commit_journal(store, 0);
    /* A long journal would be learned anew at the next start. */
    if (store->journal.file < 0 || journal_is_long(store))
        begin_generation(store, 0);
    if (store->journal.file >= 0)
        log_info("%s: stored up to sample %llu", store->settings.directory,
                 (unsigned long long)store->journal.stored);
    journal_close(&store->journal);
}

void model_store_close(struct model_store *store)
{
    if (!store)
        return;
    /* A model that was read, but never taken by the loop, is not the one that was learned. */
    if (store->opened && model_store_stage(store) != READ)
        store_the_rest(store);
    model_store_release(store);
}
