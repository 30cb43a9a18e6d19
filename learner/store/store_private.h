/* The store's state, for the files that make it up: store/store.c (start, and what the loop thread
 * calls), keeping.c (what housekeeping does). */
#ifndef REACH_LEARNER_STORE_STORE_PRIVATE_H
#define REACH_LEARNER_STORE_STORE_PRIVATE_H

#include "common/base/mailbox.h"
#include "learner/store/generations.h"
#include "learner/store/journal.h"
#include "learner/store/model_file.h"
#include "learner/store/store.h"

#include <stdatomic.h>

/* A sample on its way from the loop. */
struct noted {
    int64_t epoch; /* counts the models that were loaded while running */
    struct journal_sample sample;
};

/* A save: SAVE_ASKED, then DONE or FAILED, then FREE. A load: LOAD_ASKED, then FAILED or READ; the
 * loop takes the model that was read and says SWAPPED; housekeeping makes the other learner equal
 * to it, then FREE. The shadow and the bytes are the loop's in READ, else housekeeping's. */
enum stage { FREE, SAVE_ASKED, LOAD_ASKED, READ, SWAPPED, DONE, FAILED };

struct model_store {
    struct model_store_settings settings;
    const struct files *files;
    struct mailbox *noted;

    /* The loop's. */
    int64_t epoch;
    uint64_t number; /* of the newest sample noted */
    struct model_store_moment moment;
    bool ready; /* a save or load can begin */

    /* Between both. */
    _Atomic int stage;
    int model_number;        /* of the request */
    uint64_t save_at;        /* sample at which the model is to be saved */
    _Atomic uint64_t stored; /* epoch and number in one: model_store_pack */
    _Atomic bool storing;

    /* Housekeeping's. */
    struct arena *arena;
    struct learner *shadow;
    int64_t shadow_epoch;
    uint64_t shadow_number;
    struct model_bytes model; /* for work */
    bool unlocked;            /* the shadow's memory, while the rest of the process is locked */
    int directory_file;       /* holds the lock; -1 = none */
    bool opened;              /* the shadow is what is on disk, and may be written */
    struct generations generations;
    struct journal journal;
    int64_t waiting_since; /* the oldest sample that is not stored, monotonic us; 0 = none */
    int64_t retry_at;      /* monotonic us */
    char trouble[MODEL_REASON_MOST]; /* what the log was told; "" = all is well */
};

/* A number that belongs to one epoch, in one word, so that both are read at once. */
static inline uint64_t model_store_pack(int64_t epoch, uint64_t number)
{
    return (uint64_t)epoch << 48 | number;
}

/* Gives up the directory and the shadow. */
void model_store_release(struct model_store *store);

static inline enum stage model_store_stage(const struct model_store *store)
{
    return (enum stage)atomic_load_explicit(&store->stage, memory_order_acquire);
}

static inline void model_store_set_stage(struct model_store *store, enum stage stage)
{
    atomic_store_explicit(&store->stage, (int)stage, memory_order_release);
}

#endif
