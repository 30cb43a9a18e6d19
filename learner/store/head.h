/* Beside a journal: how far it was stored, one record behind the other. A journal that was cut
 * between two records is whole by its own checksums; only another file can tell that something is
 * gone. It is evidence and no more: never synced, so that after a loss of power it may be older
 * than the journal, and a start does without it. docs/models.md has the format. */
#ifndef REACH_LEARNER_STORE_HEAD_H
#define REACH_LEARNER_STORE_HEAD_H

#include "learner/store/files.h"

#include <stdbool.h>
#include <stdint.h>

struct head {
    uint64_t number; /* of the newest sample that is safe */
    uint64_t bodies; /* of this journal that are safe */
};

/* PATH.head, for the journal at PATH. Returns the file, or -1 with errno. */
int head_create(const struct files *files, const char *journal_path);

void head_remove(const struct files *files, const char *journal_path);

/* `seed` is the journal's, so that a record of another journal never fits. Returns 0, or -1. */
int head_append(const struct files *files, int file, uint32_t seed, struct head head);

/* The newest whole record; zeros where there is none. */
struct head head_read(const struct files *files, const char *journal_path, uint32_t seed);

#endif
