/* The model on disk: kept as it is learned, and saved and loaded by number.
 *
 * The loop thread never touches a file. It puts each sample that it learns into a wait-free
 * mailbox; the housekeeping thread takes it from there, writes it to the journal and teaches it to
 * a second learner, the shadow. The same samples in the same order give the same bytes, so that the
 * shadow is the loop's learner at a sample a little earlier, and everything that is written comes
 * from it. A load is read into the shadow and the two learners change places. What is on disk:
 * docs/models.md.
 *
 * So it is with a body (docs/body.md): the loop sees that a search is due, housekeeping asks for it
 * with what the shadow has kept, and gives the shadow what was found, while the loop learns
 * nothing; then the two change places. */
#ifndef REACH_LEARNER_STORE_STORE_H
#define REACH_LEARNER_STORE_STORE_H

#include "common/base/arena.h"
#include "learner/learner.h"
#include "learner/store/files.h"
#include "learner/store/finder_port.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct model_store_settings {
    const char *directory; /* kept, not copied; empty: nothing is stored, saved or loaded */
    bool automatic;        /* keep what is learned, and go on from it at start */
    int snapshot_samples;  /* samples of a journal after which a snapshot is made, */
    double snapshot_rate;  /* at most so many bytes a second in the mean; 0 = no bound */
    int saved_most;        /* models saved by number; the oldest go first; 0 = no bound */
    int64_t sync_us;       /* longest time that a learned sample waits for the disk */
    int keep;              /* generations on disk */
    struct learner_config learner;
    const struct files *files;        /* NULL: the system's */
    const struct finder_port *finder; /* kept, not copied; NULL: nobody looks for a body */
    const struct body *start; /* kept, not copied: searches begin with it; NULL: with none */
};

struct model_store;

/* Bytes that model_store_create takes from the loop's arena. */
size_t model_store_memory(void);

/* The shadow and the space for its bytes are the store's own, and need not be locked in memory.
 * Returns NULL with one line in `error`. */
struct model_store *model_store_create(const struct model_store_settings *settings,
                                       struct arena *arena, char *error, size_t error_size);

/* Before the loop starts: takes the directory for this process alone and brings `learner`, which
 * knows nothing yet, to the state on disk. Returns 0, or -1 with one line in `error`: another
 * process has the directory, or what is there is damaged or of another configuration; nothing has
 * been changed. */
int model_store_open(struct model_store *store, struct learner *learner, char *error,
                     size_t error_size);

/* When the process has locked all its memory: lets the shadow's go. */
void model_store_unlock_memory(struct model_store *store);

/* Loop thread: a sample that is about to be learned. Returns false when housekeeping has fallen
 * behind so far that there is no room, or gives a body to the other learner: the sample must then
 * not be learned yet, so that what is learned and what is stored never differ. */
bool model_store_note(struct model_store *store, const double *z, const double *x);

/* Loop thread: the learner has learned what was noted. Begins a search for a body when one is due.
 */
void model_store_learned(struct model_store *store, const struct learner *learner);

/* Whether model_store_serve has anything to do: a model to keep, or a body to look for. */
bool model_store_is_served(const struct model_store *store);

/* Loop thread: whether model_store_note would take a sample now. */
bool model_store_takes(const struct model_store *store);

/* Loop thread: whether there is no room for a sample. */
bool model_store_full(const struct model_store *store);

/* Loop thread: whether housekeeping is at work on a save, a load or a body. */
bool model_store_works(const struct model_store *store);

/* Loop thread: start saving or loading. Returns false when the store was busy at the newest poll,
 * or has no directory. */
bool model_store_begin_save(struct model_store *store, int number);
bool model_store_begin_load(struct model_store *store, int number);

/* Loop thread: take the body away from the learner, which has one. The next result is of that. */
void model_store_begin_forgetting(struct model_store *store);

/* Loop thread: have the finder's port told of the body in use. */
void model_store_tell_body(struct model_store *store);

/* Loop thread, every tick: what became of it. A model that was read, and the learner that was given
 * a body, takes the learner's place here, between two ticks. */
enum model_store_result { MODEL_STORE_NOTHING, MODEL_STORE_DONE, MODEL_STORE_FAILED };
enum model_store_result model_store_poll(struct model_store *store, struct learner **learner);

/* What the newest poll has seen, for the trace: nothing else that the disk does decides anything.
 */
enum { MODEL_STORE_BODY_TAKEN = -1 };
struct model_store_moment {
    enum model_store_result result;
    bool ready; /* a save or load could begin then */
    uint64_t
        model;    /* hash of what the learner was given whole, at start or by a load; 0 = nothing */
    int64_t body; /* seq of the search whose body the learner was given then; 0 = none,
                     MODEL_STORE_BODY_TAKEN = its body was taken away */
    uint32_t body_checksum; /* of that body */
};
struct model_store_moment model_store_moment(const struct model_store *store);

/* Loop thread, for the status. */
struct model_store_report {
    int64_t stored; /* samples of the model's life that are safe on disk; 0 = none of this model */
    bool storing;   /* what is learned goes to disk */
    int64_t waits;  /* times that learning waited for room */
    /* What the newest search has come to, and how many there were. */
    enum model_store_search {
        MODEL_STORE_NO_SEARCH,
        MODEL_STORE_SEARCHING,
        MODEL_STORE_FOUND,
        MODEL_STORE_NOT_YET,
        MODEL_STORE_NO_CHAIN,
        MODEL_STORE_NO_FINDER,
    } search;
    int64_t searches;
    double not_rigid[BODY_OUTPUTS]; /* at the newest search's end: learner_not_rigid() */
};
struct model_store_report model_store_report(const struct model_store *store);

/* Housekeeping thread, often: does the reading and writing that is due at monotonic time `now`,
 * us; logs what failed and why. */
void model_store_serve(struct model_store *store, int64_t now);

/* When the loop has ended: stores what is left, gives up the directory and the store's own memory.
 * NULL is allowed. */
void model_store_close(struct model_store *store);

/* What `reachd --check-model` prints: reads the model on disk as a start would. Returns 0 with a
 * line in `text`, or -1 with a line that names file, offset and reason. */
int model_store_check(const struct model_store_settings *settings, char *text, size_t text_size);

#endif
