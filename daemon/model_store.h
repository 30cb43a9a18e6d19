/* Models on disk: model-<number>.imle in one directory.
 *
 * The loop thread never touches a file: it copies the learner's state into a buffer that was taken
 * at start (or takes it out of there), and the housekeeping thread reads and writes. A file holds
 * a header with version, size and checksum before the learner's bytes; it is written aside,
 * synced and renamed, so that a model on disk is always whole. */
#ifndef REACH_MODEL_STORE_H
#define REACH_MODEL_STORE_H

#include "arena.h"
#include "learner.h"

#include <stdbool.h>
#include <stddef.h>

struct model_store;

size_t model_store_memory(size_t learner_bytes);

/* `directory` is kept, not copied; empty means that saving and loading are refused.
 * `learner_bytes` is the largest state to hold (learner_save_size of a full learner). */
struct model_store *model_store_create(const char *directory, size_t learner_bytes,
                                       struct arena *arena);

/* Loop thread: start saving or loading. Returns false when the store is busy or has no
 * directory. */
bool model_store_begin_save(struct model_store *store, const struct learner *learner, int number);
bool model_store_begin_load(struct model_store *store, int number);

/* Loop thread, every tick: what became of it. A model that was read is put into the learner here,
 * between two ticks. */
enum model_store_result { MODEL_STORE_NOTHING, MODEL_STORE_DONE, MODEL_STORE_FAILED };
enum model_store_result model_store_poll(struct model_store *store, struct learner *learner);

/* Housekeeping thread: does the reading and writing that is due; logs what failed and why. */
void model_store_serve(struct model_store *store);

#endif
