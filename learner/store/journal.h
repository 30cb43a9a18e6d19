/* The journal of what was learned since a snapshot: a header that names the snapshot, then records
 * of one size, each with a checksum. A sample is one record, a body that was given many.
 *
 * A sample counts as stored when the journal has been synced behind it AND a mark that says so has
 * been written and synced as well: the mark tells damage from a torn end. A bad record that a mark
 * covers was safe once, so the file is damaged; a bad record past the last mark is what a crash
 * cuts in two, and the journal ends before it. docs/models.md has the format. */
#ifndef REACH_LEARNER_STORE_JOURNAL_H
#define REACH_LEARNER_STORE_JOURNAL_H

#include "learner/body/chain/body.h"
#include "learner/learner.h"
#include "learner/store/files.h"

#include <stdbool.h>
#include <stdint.h>

/* One learned sample. */
struct journal_sample {
    uint64_t number; /* of the sample in the model's life, from 1 */
    double z[LEARNER_MAX_INPUTS];
    double x[LEARNER_MAX_OUTPUTS];
};

/* A body that the model was given after sample `number` (learner_give_body); zeros: its body was
 * taken away. */
struct journal_body {
    uint64_t number;
    double numbers[BODY_NUMBERS]; /* body_to_numbers */
};

/* A journal that is being written. */
struct journal {
    const struct files *files;
    int file;          /* -1 = none */
    int head;          /* learner/store/head.h; open as long as the file is */
    uint32_t seed;     /* of the records' checksums: a record of another journal never fits */
    uint64_t first;    /* number that the snapshot stands at */
    uint64_t appended; /* number of the newest sample written */
    uint64_t stored;   /* number of the newest sample that is safe */
    uint64_t bodies;   /* written since the snapshot */
    uint64_t bodies_stored;
};

/* A new file for what follows the snapshot of `first` samples and hash `model`; synced. Refuses to
 * write over an existing one. Returns 0, or -1 with errno. */
int journal_create(struct journal *journal, const struct files *files, const char *path,
                   uint64_t first, uint64_t model);

/* Appends the sample after the newest. Returns 0, or -1 with errno; the journal is then of no
 * further use but for what is stored. */
int journal_append(struct journal *journal, const struct journal_sample *sample);

/* Appends a body, given after the newest sample. Returns as above. */
int journal_append_body(struct journal *journal, const struct journal_body *body);

/* Makes all that was appended safe, and only then raises `stored`. Returns as append does. After a
 * sync has failed the system may have thrown the data away, so that trying again proves nothing. */
int journal_commit(struct journal *journal);

void journal_close(struct journal *journal);

/* Whether it holds no sample, not even a part of one. */
bool journal_is_empty(const struct files *files, const char *path);

struct journal_reading {
    uint64_t model;  /* in: hash of the model that it must continue */
    uint64_t number; /* in: number that the model stands at; out: after the last sample */
    uint64_t stored; /* out: the last sample that a mark says is safe */
    long long torn;  /* out: offset where a torn end was cut off; -1 = it ends whole */
};

/* What is called for each sample and each body, in order. `body` returns NULL, or what is wrong
 * with it. */
struct journal_visitor {
    void (*sample)(void *user, const struct journal_sample *sample);
    const char *(*body)(void *user, const struct journal_body *body);
    void *user;
};

/* Calls `visitor` for all of it. Returns 0, or -1 with one line in `reason` that names
 * path, offset and what is wrong: what was visited is then of no use. */
int journal_read(const struct files *files, const char *path, struct journal_reading *reading,
                 const struct journal_visitor *visitor, char *reason, size_t reason_size);

#endif
