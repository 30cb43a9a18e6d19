/* The store's state, for the files that make it up: store/store.c (start, and what the loop thread
 * calls), keeping.c (what housekeeping does), bodies.c (bodies on their way, on both sides),
 * giving.c (a body into the shadow). */
#ifndef REACH_LEARNER_STORE_STORE_PRIVATE_H
#define REACH_LEARNER_STORE_STORE_PRIVATE_H

#include "common/base/mailbox.h"
#include "learner/body/search/schedule.h"
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
 * to it, then FREE. A body that was found: the loop says BODY_AWAITED, and learns nothing from then
 * on; housekeeping gives it to the shadow and says BODY_GIVEN (or FREE, where that failed); the
 * loop takes the shadow and says SWAPPED. A body that is taken away goes the same way (a failure
 * is FAILED). The shadow and the bytes are the loop's in READ and
 * BODY_GIVEN, else housekeeping's. In FREE it is the loop that begins. */
enum stage { FREE, SAVE_ASKED, LOAD_ASKED, READ, SWAPPED, DONE, FAILED, BODY_AWAITED, BODY_GIVEN };

/* A search for a body: the loop says ASKED in NONE; the rest is housekeeping's. */
enum search_stage { SEARCH_NONE, SEARCH_ASKED, SEARCH_SENT, SEARCH_FOUND };

struct search {
    _Atomic int stage;
    _Atomic int outcome; /* enum model_store_search, of the newest that has ended */

    /* The loop's, and housekeeping's from ASKED on. */
    struct body_schedule schedule; /* the loop's alone */
    int64_t seq;
    int64_t epoch;
    uint64_t at; /* sample with which it became due, or at which the body is to be given */
    bool forget; /* the loop's until BODY_AWAITED: what is to be given is none */
    _Atomic bool tell;
    _Atomic bool again; /* what was found came too late: the next search is due at once */
    _Atomic double not_rigid[BODY_OUTPUTS];
    uint64_t changes; /* of the body in use, that the log knows of */

    /* Housekeeping's. */
    int64_t sent_at;         /* monotonic us: first */
    int64_t asked_at;        /* newest */
    bool came;               /* somebody searches */
    bool absent;             /* said: nobody does */
    uint64_t changes_before; /* of the body in use, when the search was asked for */
    struct body_answer answer;
    bool any_candidate; /* what a search came to that was not sure enough: */
    struct body candidate;
};

struct model_store {
    struct model_store_settings settings;
    const struct files *files;
    struct mailbox *noted;

    /* The loop's. */
    int64_t epoch;
    uint64_t number; /* of the newest sample noted */
    bool notes;      /* samples are handed to a shadow at all */
    struct model_store_moment moment;
    bool ready; /* a save or load can begin */

    /* Between both. */
    _Atomic int stage;
    int model_number;        /* of the request */
    uint64_t save_at;        /* sample at which the model is to be saved */
    _Atomic uint64_t stored; /* epoch and number in one: model_store_pack */
    _Atomic bool storing;

    struct search search;

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
    int64_t snapshot_at;   /* monotonic us: when the newest snapshot was made, */
    size_t snapshot_bytes; /* and how large it was */
    char trouble[MODEL_REASON_MOST]; /* what the log was told; "" = all is well */
};

/* A number that belongs to one epoch, in one word, so that both are read at once. */
static inline uint64_t model_store_pack(int64_t epoch, uint64_t number)
{
    return (uint64_t)epoch << 48 | number;
}

/* bodies.c. Whether the store is to find a body for its learner. */
bool model_store_seeks(const struct model_store_settings *settings);
/* Loop thread: the learner was given whole; nothing of searches before counts. */
void model_store_search_anew(struct model_store *store, const struct learner *learner);
/* Loop thread, at a poll. Whether the shadow, which stands on a body, is to take the learner's
 * place; `*awaited`: nothing else can begin now. */
bool model_store_poll_body(struct model_store *store, bool *awaited);
/* Housekeeping: the sample at which a search became due is reached, or something else is. */
void model_store_search_if_reached(struct model_store *store, int64_t now);
void model_store_follow_search(struct model_store *store, int64_t now);
/* Housekeeping: tells of the body in use, when it was asked to. */
void model_store_tell_if_asked(struct model_store *store);
/* Housekeeping: gives the body once the shadow stands where the loop waits. */
void model_store_give_body(struct model_store *store, int64_t now);
/* The body to begin the next search with is the one of the settings, or none. */
void model_store_begin_with(struct model_store *store);
/* Housekeeping: the model was replaced. */
void model_store_drop_search(struct model_store *store);

/* giving.c: what the shadow has come to see of its body, for the report. */
void search_look_at_body(struct model_store *store);

/* keeping.c: for bodies.c and giving.c. */
void model_store_keep_body(struct model_store *store, int64_t now);
int model_store_lock_shadow(struct model_store *store);

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

static inline enum search_stage search_stage_of(const struct model_store *store)
{
    return (enum search_stage)atomic_load_explicit(&store->search.stage, memory_order_acquire);
}

static inline void search_set_stage(struct model_store *store, enum search_stage stage)
{
    atomic_store_explicit(&store->search.stage, (int)stage, memory_order_release);
}

static inline void search_end(struct model_store *store, enum model_store_search outcome)
{
    atomic_store_explicit(&store->search.outcome, (int)outcome, memory_order_relaxed);
    search_set_stage(store, SEARCH_NONE);
}

/* What is to be given is none: somebody wants that, or the body in use was refuted. */
static inline bool search_gives_none(const struct search *search)
{
    return search->forget || search->answer.report.outcome == FINDER_REFUTED;
}

#endif
