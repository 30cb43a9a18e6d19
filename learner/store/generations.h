/* The model that lives on by itself, in one directory: generations, each a snapshot
 * (current-N.imle) and the journal of what was learned after it (current-N.journal, and beside it
 * current-N.journal.head).
 *
 * A new generation begins at every start and whenever the journal has grown long enough. Its
 * snapshot gets its name last, when everything else of it is safe; older ones go only after that.
 * So the newest snapshot and its journal are the model, whatever was cut short. Nothing is ever
 * written over: a number is used once. Housekeeping only. */
#ifndef REACH_LEARNER_STORE_GENERATIONS_H
#define REACH_LEARNER_STORE_GENERATIONS_H

#include "learner/store/files.h"
#include "learner/store/journal.h"
#include "learner/store/model_file.h"

#include <stdbool.h>
#include <stdint.h>

struct generations {
    const struct files *files;
    const char *directory; /* kept, not copied */
    int keep;              /* generations on disk, >= 1 */
    int64_t newest;        /* greatest number used, by whatever file */
    bool damage;           /* a snapshot is to be set aside */
};

/* What became of the model that was on disk. */
struct recovery {
    bool any;               /* false: there was none */
    int64_t generation;     /* the one that was read first */
    uint64_t from_journals; /* samples */
    uint64_t stored;        /* the newest sample that was told to be safe */
};

/* Brings a learner that knows nothing to the state on disk: the newest snapshot and its journal.
 * Where that snapshot is damaged, an older one and the journals from there on give the same state,
 * which is believed only if its hash is the one that each next journal names. Says in the log what
 * was cut off or rebuilt; only reads. `model` is for work. Returns 0, or -1 with one line in
 * `reason` that names file, offset and what is wrong. */
int generations_recover(struct generations *generations, struct learner *learner,
                        struct model_bytes *model, struct recovery *recovery, char *reason,
                        size_t reason_size);

/* Makes a snapshot of `model` and opens its journal. Then removes generations beyond `keep`, and
 * sets damaged snapshots aside. Returns 0, or -1 with errno: the journal of the generation before
 * must then not go on either, since the new one may already be on disk. */
int generations_begin(struct generations *generations, const struct model_bytes *model,
                      struct journal *journal);

#endif
