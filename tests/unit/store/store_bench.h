/* A store with a small learner on either side of it, for tests of what is kept on disk. Sample n
 * is the same in every bench, so that equal numbers must give equal models. */
#ifndef TESTS_UNIT_STORE_STORE_BENCH_H
#define TESTS_UNIT_STORE_STORE_BENCH_H

#include "learner/store/store.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct store_bench {
    struct arena *arena;
    struct learner *learner; /* the loop's */
    struct model_store *store;
    int64_t now; /* monotonic us */
};

/* Snapshots every 10 samples, synced at every call of serve. `files` NULL: the system's. */
struct model_store_settings store_bench_settings(const char *directory, const struct files *files);

/* Without a store, and with a line in `error`, when it cannot start. */
struct store_bench store_bench_try(const struct model_store_settings *settings, char *error,
                                   size_t error_size);

/* Ends the test when it cannot start. */
struct store_bench store_bench_create(const struct model_store_settings *settings);

/* The next sample. Returns false when the store has no room. */
bool store_bench_learn_one(struct store_bench *bench);
void store_bench_learn(struct store_bench *bench, int samples);

/* Housekeeping, a second later. */
void store_bench_serve(struct store_bench *bench);

/* Housekeeping as fast as it goes, in a thread of its own until it is ended. One at a time. */
void store_bench_keep_house(struct store_bench *bench);
void store_bench_end_house(void);

/* Of the loop's learner. */
uint64_t store_bench_hash(const struct store_bench *bench);

void store_bench_close(struct store_bench *bench);

/* The hash of a learner that has learned so many samples without ever being interrupted. */
uint64_t store_bench_hash_at(const struct model_store_settings *settings, uint64_t samples);

/* Removes a directory of the real file system with all files in it. */
void store_bench_remove(const char *directory);

#endif
