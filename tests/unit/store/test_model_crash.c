/* The model is never lost: the process or the power ends at every operation on the disk, the disk
 * fails or fills up at every operation. */
#include "store_lives.h"
#include "tests/unit/suite.h"

#include <errno.h>
#include <string.h>

/* `crash` at every operation in turn, each time with the whole history before it. */
static void crash_everywhere(enum fake_disk_crash crash, const char *what)
{
    long operations;

    fake_disk_reset(lives.seed);
    ck_assert_int_gt(lives_two(), 30);
    operations = fake_disk.operations;
    ck_assert_int_gt(operations, 100);
    for (long at = 0; at <= operations; at++) {
        int64_t stored;
        fake_disk_reset(lives.seed);
        lives.seed.state++;
        fake_disk.short_writes = at % 2;
        fake_disk.dies_at = at;
        stored = lives_two();
        fake_disk_crash(crash);
        lives_recover(stored, what, at);
    }
}

START_TEST(killed_at_every_operation)
{
    lives_setup("model_crash");
    crash_everywhere(FAKE_DISK_KILLED, "killed");
}
END_TEST

START_TEST(power_off_at_every_operation)
{
    lives_setup("model_crash");
    crash_everywhere(FAKE_DISK_POWER_OFF, "power off");
}
END_TEST

START_TEST(power_off_that_tears_what_was_not_synced)
{
    lives_setup("model_crash");
    for (int i = 0; i < 5; i++)
        crash_everywhere(FAKE_DISK_TORN, "torn");
}
END_TEST

/* One operation fails; afterwards the disk is well, until the power goes soon after or in the end.
 */
START_TEST(a_failure_at_every_operation)
{
    const int errors[] = {ENOSPC, EIO};
    long operations;

    lives_setup("model_crash");
    fake_disk_reset(lives.seed);
    lives_two();
    operations = fake_disk.operations;
    for (int kind = 0; kind < 2; kind++)
        for (long at = 0; at < operations; at++) {
            int64_t stored;
            fake_disk_reset(lives.seed);
            fake_disk.fails_at = at;
            fake_disk.dies_at = at + 1 + (long)(random_bits(&lives.seed) % 16);
            fake_disk.error = errors[kind];
            stored = lives_two();
            fake_disk_crash(FAKE_DISK_POWER_OFF);
            lives_recover(stored, strerror(errors[kind]), at);
        }
}
END_TEST

/* What is reported while the disk refuses, and after. */
static void refuse_and_recover(void (*refuse)(bool refuse))
{
    struct store_bench bench;
    int64_t stored;

    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    stored = lives_work(&bench, 24);
    ck_assert_int_eq(stored, 24);
    refuse(true);
    ck_assert_int_eq(lives_work(&bench, 30), stored);
    ck_assert(!model_store_report(bench.store).storing);
    ck_assert_uint_eq(model_samples(bench.learner), 54);
    refuse(false);
    ck_assert_int_eq(lives_work(&bench, 2), 56);
    ck_assert(model_store_report(bench.store).storing);
    lives_crash(&bench, FAKE_DISK_POWER_OFF);
    lives_recover(56, "after a disk that refused", 0);
}

static void fill_up(bool full)
{
    fake_disk.capacity = full ? 0 : SIZE_MAX;
}

static void make_read_only(bool read_only)
{
    fake_disk.read_only = read_only;
}

START_TEST(a_full_disk)
{
    lives_setup("model_crash");
    refuse_and_recover(fill_up);
}
END_TEST

START_TEST(a_read_only_disk)
{
    struct store_bench bench;

    lives_setup("model_crash");
    refuse_and_recover(make_read_only);
    fake_disk.read_only = true; /* from the start on */
    bench = store_bench_create(&lives.settings);
    ck_assert_uint_eq(store_bench_hash(&bench), lives.truth[72]);
    ck_assert_int_eq(lives_work(&bench, 20), 72); /* what was there before */
    ck_assert(!model_store_report(bench.store).storing);
    ck_assert_uint_eq(model_samples(bench.learner), 92);
    store_bench_close(&bench);
}
END_TEST

/* Samples that were written but not yet synced are cut anywhere: the whole ones are there. */
START_TEST(a_torn_last_record_is_cut_off)
{
    const char *name;
    struct store_bench bench;
    size_t size = 0;

    lives_setup("model_crash");
    lives.settings.sync_us = INT64_MAX; /* no marks */
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    store_bench_serve(&bench);
    lives_work(&bench, 8);
    lives_crash(&bench, FAKE_DISK_KILLED);
    for (int i = 0; (name = fake_disk_name(i)) && !strstr(name, ".journal"); i++)
        ;
    ck_assert_ptr_nonnull(name);
    fake_disk_bytes(name, &size);
    ck_assert_uint_eq(size, 32 + 8 * 208);
    for (; size > 32; size--) {
        fake_disk_truncate(name, size);
        bench = store_bench_create(&lives.settings);
        ck_assert_uint_eq(model_samples(bench.learner), (size - 32) / 208);
        ck_assert_uint_eq(store_bench_hash(&bench), lives.truth[(size - 32) / 208]);
        lives_crash(&bench, FAKE_DISK_KILLED);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {killed_at_every_operation,
                                  power_off_at_every_operation,
                                  power_off_that_tears_what_was_not_synced,
                                  a_failure_at_every_operation,
                                  a_full_disk,
                                  a_read_only_disk,
                                  a_torn_last_record_is_cut_off};

    return SUITE_RUN("model_crash", tests);
}
