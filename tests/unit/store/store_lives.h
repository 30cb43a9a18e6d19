/* A store on the fake disk through lives of its daemon that end in any way. What a start finds must
 * be, to the byte, what an uninterrupted learner is at that sample, and have every sample that was
 * reported as stored. */
#ifndef TESTS_UNIT_STORE_STORE_LIVES_H
#define TESTS_UNIT_STORE_STORE_LIVES_H

#include "fake_disk.h"
#include "learner/store/model_file.h"
#include "store_bench.h"

#include <stdint.h>

#define LIVES_SAMPLES_MOST 100

/* There is one of them at a time. */
struct store_lives {
    struct model_store_settings settings;
    struct random_state seed;
    uint64_t truth[LIVES_SAMPLES_MOST + 1]; /* hash at each number of samples */
    char error[MODEL_REASON_MOST];          /* why the last start was refused */
};

extern struct store_lives lives;

/* `test` names the random numbers. */
void lives_setup(const char *test);

/* The process ends without a word, or the power does. */
void lives_crash(struct store_bench *bench, enum fake_disk_crash how);

/* Learns, and keeps house after every other sample. Returns the samples reported as stored. */
int64_t lives_work(struct store_bench *bench, int samples);

/* Two lives of a daemon. Returns the samples that were reported as stored. */
int64_t lives_two(void);

/* The next start finds a model that is right; it goes on well. `what` happened at `operation`. */
void lives_recover(int64_t stored, const char *what, long operation);

#endif
