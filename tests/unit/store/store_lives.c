#include "store_lives.h"

#include "common/program/log.h"
#include "tests/unit/seed.h"

#include <check.h>

struct store_lives lives;

void lives_setup(const char *test)
{
    log_open("test", LOG_LEVEL_ERROR - 1);
    lives.settings = store_bench_settings(FAKE_DISK_DIRECTORY, &fake_disk_files);
    lives.seed = fixture_random(test);
    for (uint64_t n = 0; n <= LIVES_SAMPLES_MOST; n++)
        lives.truth[n] = store_bench_hash_at(&lives.settings, n);
}

void lives_crash(struct store_bench *bench, enum fake_disk_crash how)
{
    fake_disk.dies_at = 0; /* so that nothing is written by what follows */
    store_bench_close(bench);
    fake_disk_crash(how);
}

int64_t lives_work(struct store_bench *bench, int samples)
{
    for (int i = 0; i < samples; i++) {
        store_bench_learn(bench, 1);
        if (i % 2)
            store_bench_serve(bench);
    }
    return model_store_report(bench->store).stored;
}

int64_t lives_two(void)
{
    struct store_bench bench = store_bench_create(&lives.settings);
    int64_t stored = lives_work(&bench, 23);

    store_bench_close(&bench);
    bench = store_bench_try(&lives.settings, lives.error, sizeof lives.error);
    if (!bench.store)
        return stored; /* the disk died before */
    int64_t more = lives_work(&bench, 14);
    store_bench_close(&bench);
    return more > stored ? more : stored;
}

void lives_recover(int64_t stored, const char *what, long operation)
{
    struct store_bench bench = store_bench_try(&lives.settings, lives.error, sizeof lives.error);
    uint64_t found;

    ck_assert_msg(bench.store != NULL, "%s at operation %ld: %s", what, operation, lives.error);
    found = model_samples(bench.learner);
    ck_assert_msg((int64_t)found >= stored, "%s at operation %ld: %llu samples, %lld were stored",
                  what, operation, (unsigned long long)found, (long long)stored);
    ck_assert_msg(found <= LIVES_SAMPLES_MOST && store_bench_hash(&bench) == lives.truth[found],
                  "%s at operation %ld: another model", what, operation);
    ck_assert_int_eq(lives_work(&bench, 16), (int64_t)found + 16);
    store_bench_close(&bench);
    bench = store_bench_create(&lives.settings);
    ck_assert_uint_eq(store_bench_hash(&bench), lives.truth[found + 16]);
    store_bench_close(&bench);
}
