/* One model in one file: a header, then the learner's bytes (learner_save).
 *
 * A file is written aside, synced and renamed, so that a file under its own name is always whole.
 * docs/models.md has the format. */
#ifndef REACH_LEARNER_STORE_MODEL_FILE_H
#define REACH_LEARNER_STORE_MODEL_FILE_H

#include "learner/learner.h"
#include "learner/store/files.h"

#include <stddef.h>
#include <stdint.h>

#define MODEL_PATH_MOST 512
#define MODEL_REASON_MOST 800 /* of a line that says what is wrong, with its path */

struct model_bytes {
    unsigned char *bytes;
    size_t capacity;
    size_t size;
    uint64_t samples; /* handed to this model in its life */
    uint64_t hash;    /* of the bytes: model_hash */
};

/* FNV-1a of a saved learner: equal models have equal hashes. */
uint64_t model_hash(const void *bytes, size_t size);

/* Samples that were handed to this model in its life, those that it dropped among them. */
uint64_t model_samples(const struct learner *learner);

/* The learner's bytes, their number and hash. `model` must be large enough. */
void model_capture(struct model_bytes *model, const struct learner *learner);

/* Writes PATH.new and syncs it. Returns 0, or -1 with errno. After -1 the file is removed where a
 * write or the sync failed; where opening or closing it failed, or removing it, a PATH.new may be
 * left. It means nothing, and the next call writes over it. */
int model_file_write_aside(const struct files *files, const char *path,
                           const struct model_bytes *model);

/* Gives PATH.new its own name and syncs the directory. Returns 0, or -1 with errno. */
int model_file_place(const struct files *files, const char *directory, const char *path);

/* Removes PATH.new. */
void model_file_drop_aside(const struct files *files, const char *path);

enum model_file_result {
    MODEL_FILE_READ,
    MODEL_FILE_ABSENT,     /* there is no such file */
    MODEL_FILE_UNREADABLE, /* the system's reason; the file may be good */
    MODEL_FILE_FOREIGN,    /* of another version, or larger than this configuration can hold */
    MODEL_FILE_DAMAGED,
};

/* Reads into `model` and checks everything. Otherwise `reason` is one line with path and offset. */
enum model_file_result model_file_read(const struct files *files, const char *path,
                                       struct model_bytes *model, char *reason, size_t reason_size);

/* The same checks without keeping what is read, and whether a learner that takes `like` would take
 * it; FOREIGN otherwise. */
enum model_file_result model_file_check(const struct files *files, const char *path,
                                        const struct model_bytes *like, char *reason,
                                        size_t reason_size);

#endif
