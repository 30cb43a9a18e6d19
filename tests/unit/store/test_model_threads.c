/* The store between two threads that know nothing of each other's pace: learning, saving and
 * loading in one, housekeeping in the other. Under the thread sanitizer this finds what they share.
 */
#include "common/program/log.h"
#include "learner/store/model_file.h"
#include "learner/store/store.h"
#include "store_bench.h"
#include "tests/unit/suite.h"

#include <stdlib.h>
#include <time.h>

static const int requests = 20; /* that are carried out */

/* One tick: a sample, and now and then a request. Returns whether a request was carried out. */
static bool tick(struct store_bench *bench, int i)
{
    const struct timespec moment = {.tv_nsec = 20000};

    if (i % 300 == 0)
        model_store_begin_save(bench->store, i / 300 % 3);
    if (i % 300 == 150)
        model_store_begin_load(bench->store, i / 300 % 3);
    if (!store_bench_learn_one(bench))
        nanosleep(&moment, NULL);
    return model_store_poll(bench->store, &bench->learner) == MODEL_STORE_DONE;
}

START_TEST(two_threads)
{
    char directory[] = "/tmp/reach-threads-XXXXXX";
    struct model_store_settings settings;
    struct store_bench bench;
    uint64_t samples;
    int done = 0;

    log_open("test", LOG_LEVEL_ERROR - 1);
    ck_assert_ptr_nonnull(mkdtemp(directory));
    settings = store_bench_settings(directory, NULL);
    settings.snapshot_samples = 100;
    settings.sync_us = 2000;
    bench = store_bench_create(&settings);
    store_bench_keep_house(&bench);
    for (int i = 0; done < requests; i++) {
        done += tick(&bench, i);
        ck_assert_int_le(model_store_report(bench.store).stored,
                         (int64_t)model_samples(bench.learner));
    }
    store_bench_end_house();
    samples = model_samples(bench.learner);
    ck_assert_uint_eq(store_bench_hash(&bench), store_bench_hash_at(&settings, samples));
    store_bench_close(&bench);
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(model_samples(bench.learner), samples);
    ck_assert_uint_eq(store_bench_hash(&bench), store_bench_hash_at(&settings, samples));
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {two_threads};

    return SUITE_RUN("model_threads", tests);
}
