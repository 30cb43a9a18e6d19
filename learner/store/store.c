#include "learner/store/store.h"

#include "learner/store/store_private.h"

#include "common/program/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>

static const uint32_t noted_capacity = 1024; /* samples; a power of two */

size_t model_store_memory(void)
{
    return arena_footprint(sizeof(struct model_store)) +
           mailbox_memory(sizeof(struct noted), noted_capacity);
}

static bool has_directory(const struct model_store *store)
{
    return store->settings.directory[0];
}

static int create_shadow(struct model_store *store, char *error, size_t error_size)
{
    size_t bytes = learner_memory(&store->settings.learner);

    store->arena = arena_create(bytes + arena_footprint(bytes));
    if (!store->arena) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    store->shadow = learner_create(&store->settings.learner, store->arena, error, error_size);
    store->model.bytes = arena_alloc(store->arena, bytes);
    store->model.capacity = bytes;
    return store->shadow && store->model.bytes ? 0 : -1;
}

struct model_store *model_store_create(const struct model_store_settings *settings,
                                       struct arena *arena, char *error, size_t error_size)
{
    struct model_store *store = arena_alloc(arena, sizeof *store);

    if (store)
        store->noted = mailbox_create(arena, sizeof(struct noted), noted_capacity);
    if (!store || !store->noted) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    store->settings = *settings;
    store->ready = has_directory(store);
    store->files = settings->files ? settings->files : &files_system;
    store->directory_file = -1;
    store->journal.file = -1;
    store->generations = (struct generations){
        .files = store->files, .directory = settings->directory, .keep = settings->keep};
    store->notes = has_directory(store) || model_store_seeks(settings);
    store->search.schedule = body_schedule_begin();
    model_store_begin_with(store);
    if (store->notes && create_shadow(store, error, error_size)) {
        arena_destroy(store->arena);
        return NULL;
    }
    return store;
}

static int take_directory(struct model_store *store, bool shared, char *error, size_t error_size)
{
    const char *directory = store->settings.directory;
    int file = store->files->open(directory, O_RDONLY | O_DIRECTORY);

    if (file < 0) {
        snprintf(error, error_size, "model.directory: %s: %s", directory, strerror(errno));
        return -1;
    }
    if (store->files->lock(file, shared)) {
        snprintf(error, error_size, "model.directory: %s: %s", directory,
                 errno == EWOULDBLOCK ? "another program keeps its model there; end it first, or "
                                        "give this one a directory of its own"
                                      : strerror(errno));
        store->files->close(file);
        return -1;
    }
    store->directory_file = file;
    return 0;
}

/* The shadow as it is on disk; the learner's own errors name no file. */
static int recover(struct model_store *store, struct recovery *recovery, char *error,
                   size_t error_size)
{
    if (generations_recover(&store->generations, store->shadow, &store->model, recovery, error,
                            error_size))
        return -1;
    model_capture(&store->model, store->shadow);
    store->shadow_number = store->number = store->model.samples;
    store->moment.model = recovery->any ? store->model.hash : 0;
    atomic_store_explicit(&store->stored, model_store_pack(0, recovery->stored),
                          memory_order_release);
    return 0;
}

static void describe(const struct model_store *store, const struct recovery *recovery, char *text,
                     size_t text_size)
{
    if (!recovery->any)
        snprintf(text, text_size, "%s: no model yet", store->settings.directory);
    else
        snprintf(text, text_size,
                 "%s: a model of %llu samples, hash %016llx, %d experts; generation %lld and %llu "
                 "samples from its journal",
                 store->settings.directory, (unsigned long long)store->model.samples,
                 (unsigned long long)store->model.hash,
                 learner_get_statistics(store->shadow).experts, (long long)recovery->generation,
                 (unsigned long long)recovery->from_journals);
}

int model_store_open(struct model_store *store, struct learner *learner, char *error,
                     size_t error_size)
{
    struct recovery recovery = {0};
    char text[MODEL_REASON_MOST];

    if (!has_directory(store))
        return 0;
    if (take_directory(store, false, error, error_size))
        return -1;
    if (!store->settings.automatic)
        return 0;
    if (recover(store, &recovery, error, error_size) ||
        learner_load(learner, store->model.bytes, store->model.size, error, error_size))
        return -1;
    store->opened = true;
    model_store_search_anew(store, learner);
    describe(store, &recovery, text, sizeof text);
    log_info("%s", text);
    return 0;
}

int model_store_check(const struct model_store_settings *settings, char *text, size_t text_size)
{
    struct arena *arena = arena_create(model_store_memory());
    struct model_store *store = arena ? model_store_create(settings, arena, text, text_size) : NULL;
    struct recovery recovery = {0};
    int result = -1;

    if (store && !has_directory(store))
        snprintf(text, text_size, "model.directory is empty: there is nothing to check");
    else if (store && take_directory(store, true, text, text_size) == 0)
        result = recover(store, &recovery, text, text_size);
    if (result == 0)
        describe(store, &recovery, text, text_size);
    if (store)
        model_store_release(store);
    arena_destroy(arena);
    return result;
}

void model_store_release(struct model_store *store)
{
    if (store->directory_file >= 0)
        store->files->close(store->directory_file);
    store->directory_file = -1;
    arena_destroy(store->arena);
    store->arena = NULL;
}

void model_store_unlock_memory(struct model_store *store)
{
    if (store->arena && arena_lock(store->arena, false) == 0)
        store->unlocked = true;
}

bool model_store_full(const struct model_store *store)
{
    return store->notes && mailbox_full(store->noted);
}

bool model_store_is_served(const struct model_store *store)
{
    return store->notes;
}

bool model_store_takes(const struct model_store *store)
{
    enum stage stage = model_store_stage(store);

    return !store->notes ||
           (stage != BODY_AWAITED && stage != BODY_GIVEN && !mailbox_full(store->noted));
}

bool model_store_note(struct model_store *store, const double *z, const double *x)
{
    const struct learner_config *learner = &store->settings.learner;
    enum stage stage = model_store_stage(store);
    struct noted noted = {.epoch = store->epoch, .sample = {.number = store->number + 1}};

    if (!store->notes)
        return true;
    if (stage == BODY_AWAITED || stage == BODY_GIVEN)
        return false;
    memcpy(noted.sample.z, z, sizeof(double) * (size_t)learner->n_inputs);
    memcpy(noted.sample.x, x, sizeof(double) * (size_t)learner->n_outputs);
    if (!mailbox_put(store->noted, &noted))
        return false;
    store->number++;
    return true;
}

bool model_store_works(const struct model_store *store)
{
    enum stage stage = model_store_stage(store);
    int search = atomic_load_explicit(&store->search.stage, memory_order_acquire);

    return stage == SAVE_ASKED || stage == LOAD_ASKED || stage == SWAPPED ||
           stage == BODY_AWAITED || search == SEARCH_ASKED || search == SEARCH_SENT;
}

static bool begin_request(struct model_store *store, int number)
{
    if (!store->ready)
        return false;
    store->ready = false;
    store->model_number = number;
    return true;
}

bool model_store_begin_save(struct model_store *store, int number)
{
    if (!begin_request(store, number))
        return false;
    store->save_at = store->number;
    model_store_set_stage(store, SAVE_ASKED);
    return true;
}

bool model_store_begin_load(struct model_store *store, int number)
{
    if (!begin_request(store, number))
        return false;
    model_store_set_stage(store, LOAD_ASKED);
    return true;
}

/* The shadow takes the learner's place, and housekeeping makes the other one equal. */
static void swap_learners(struct model_store *store, struct learner **learner)
{
    struct learner *old = *learner;

    *learner = store->shadow;
    store->shadow = old;
    model_store_set_stage(store, SWAPPED);
}

static enum model_store_result take_result(struct model_store *store, struct learner **learner)
{
    switch (model_store_stage(store)) {
    case READ:
        store->epoch++;
        store->number = store->model.samples;
        store->moment.model = store->model.hash;
        model_store_search_anew(store, store->shadow);
        swap_learners(store, learner);
        return MODEL_STORE_DONE;
    case DONE:
        model_store_set_stage(store, FREE);
        return MODEL_STORE_DONE;
    case FAILED:
        model_store_set_stage(store, FREE);
        return MODEL_STORE_FAILED;
    default:
        return MODEL_STORE_NOTHING;
    }
}

enum model_store_result model_store_poll(struct model_store *store, struct learner **learner)
{
    bool awaited;

    store->moment.result = take_result(store, learner);
    if (model_store_poll_body(store, &awaited))
        swap_learners(store, learner);
    store->ready = has_directory(store) && !awaited && model_store_stage(store) == FREE;
    store->moment.ready = store->ready;
    return store->moment.result;
}

struct model_store_moment model_store_moment(const struct model_store *store)
{
    return store->moment;
}

static enum model_store_search search_of(const struct model_store *store)
{
    const struct search *search = &store->search;

    if (atomic_load_explicit(&search->stage, memory_order_acquire) != SEARCH_NONE)
        return MODEL_STORE_SEARCHING;
    return (enum model_store_search)atomic_load_explicit(&search->outcome, memory_order_relaxed);
}

struct model_store_report model_store_report(const struct model_store *store)
{
    uint64_t stored = atomic_load_explicit(&store->stored, memory_order_acquire);
    uint64_t of_this = stored - model_store_pack(store->epoch, 0);

    struct model_store_report report = {
        .stored = of_this <= store->number ? (int64_t)of_this : 0,
        .storing = atomic_load_explicit(&store->storing, memory_order_relaxed),
        .waits = (int64_t)mailbox_refused(store->noted),
        .search = search_of(store),
        .searches = store->search.seq,
    };
    for (int i = 0; i < BODY_OUTPUTS; i++)
        report.not_rigid[i] =
            atomic_load_explicit(&store->search.not_rigid[i], memory_order_relaxed);
    return report;
}
