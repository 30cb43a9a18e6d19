/* The model is never lost: the process or the power ends at every operation on the disk, the disk
 * fails or fills up at every operation, every byte is damaged. What the next start finds must be,
 * to the byte, what an uninterrupted learner is at that sample, and have every sample that was
 * reported as stored; or the start must refuse and change nothing. */
#include "common/log.h"
#include "fake_disk.h"
#include "fixture.h"
#include "model_file.h"
#include "store_bench.h"
#include "tests/unit/suite.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define SAMPLES_MOST 100

static struct model_store_settings settings;
static struct random_state seed;
static uint64_t truth[SAMPLES_MOST + 1]; /* hash at each number of samples */
static char error[MODEL_REASON_MOST];

static void setup(void)
{
    log_open("test", LOG_LEVEL_ERROR - 1);
    settings = store_bench_settings(FAKE_DISK_DIRECTORY, &fake_disk_files);
    seed = fixture_random("model_crash");
    for (uint64_t n = 0; n <= SAMPLES_MOST; n++)
        truth[n] = store_bench_hash_at(&settings, n);
}

/* The process ends without a word, or the power does. */
static void crash(struct store_bench *bench, enum fake_disk_crash how)
{
    fake_disk.dies_at = 0; /* so that nothing is written by what follows */
    store_bench_close(bench);
    fake_disk_crash(how);
}

/* Learns, and keeps house after every other sample. Returns the samples reported as stored. */
static int64_t work(struct store_bench *bench, int samples)
{
    for (int i = 0; i < samples; i++) {
        store_bench_learn(bench, 1);
        if (i % 2)
            store_bench_serve(bench);
    }
    return model_store_report(bench->store).stored;
}

/* Two lives of a daemon. Returns the samples that were reported as stored. */
static int64_t two_lives(void)
{
    struct store_bench bench = store_bench_create(&settings);
    int64_t stored = work(&bench, 23);

    store_bench_close(&bench);
    bench = store_bench_try(&settings, error, sizeof error);
    if (!bench.store)
        return stored; /* the disk died before */
    int64_t more = work(&bench, 14);
    store_bench_close(&bench);
    return more > stored ? more : stored;
}

/* The next start finds a model that is right; it goes on well. */
static void recover(int64_t stored, const char *what, long operation)
{
    struct store_bench bench = store_bench_try(&settings, error, sizeof error);
    uint64_t found;

    ck_assert_msg(bench.store != NULL, "%s at operation %ld: %s", what, operation, error);
    found = model_samples(bench.learner);
    ck_assert_msg((int64_t)found >= stored, "%s at operation %ld: %llu samples, %lld were stored",
                  what, operation, (unsigned long long)found, (long long)stored);
    ck_assert_msg(found <= SAMPLES_MOST && store_bench_hash(&bench) == truth[found],
                  "%s at operation %ld: another model", what, operation);
    ck_assert_int_eq(work(&bench, 16), (int64_t)found + 16);
    store_bench_close(&bench);
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(store_bench_hash(&bench), truth[found + 16]);
    store_bench_close(&bench);
}

/* `crash` at every operation in turn, each time with the whole history before it. */
static void crash_everywhere(enum fake_disk_crash crash, const char *what)
{
    long operations;

    fake_disk_reset(seed);
    ck_assert_int_gt(two_lives(), 30);
    operations = fake_disk.operations;
    ck_assert_int_gt(operations, 100);
    for (long at = 0; at <= operations; at++) {
        int64_t stored;
        fake_disk_reset(seed);
        seed.state++;
        fake_disk.short_writes = at % 2;
        fake_disk.dies_at = at;
        stored = two_lives();
        fake_disk_crash(crash);
        recover(stored, what, at);
    }
}

START_TEST(killed_at_every_operation)
{
    setup();
    crash_everywhere(FAKE_DISK_KILLED, "killed");
}
END_TEST

START_TEST(power_off_at_every_operation)
{
    setup();
    crash_everywhere(FAKE_DISK_POWER_OFF, "power off");
}
END_TEST

START_TEST(power_off_that_tears_what_was_not_synced)
{
    setup();
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

    setup();
    fake_disk_reset(seed);
    two_lives();
    operations = fake_disk.operations;
    for (int kind = 0; kind < 2; kind++)
        for (long at = 0; at < operations; at++) {
            int64_t stored;
            fake_disk_reset(seed);
            fake_disk.fails_at = at;
            fake_disk.dies_at = at + 1 + (long)(random_bits(&seed) % 16);
            fake_disk.error = errors[kind];
            stored = two_lives();
            fake_disk_crash(FAKE_DISK_POWER_OFF);
            recover(stored, strerror(errors[kind]), at);
        }
}
END_TEST

/* What is reported while the disk refuses, and after. */
static void refuse_and_recover(void (*refuse)(bool refuse))
{
    struct store_bench bench;
    int64_t stored;

    fake_disk_reset(seed);
    bench = store_bench_create(&settings);
    stored = work(&bench, 24);
    ck_assert_int_eq(stored, 24);
    refuse(true);
    ck_assert_int_eq(work(&bench, 30), stored);
    ck_assert(!model_store_report(bench.store).storing);
    ck_assert_uint_eq(model_samples(bench.learner), 54);
    refuse(false);
    ck_assert_int_eq(work(&bench, 2), 56);
    ck_assert(model_store_report(bench.store).storing);
    crash(&bench, FAKE_DISK_POWER_OFF);
    recover(56, "after a disk that refused", 0);
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
    setup();
    refuse_and_recover(fill_up);
}
END_TEST

START_TEST(a_read_only_disk)
{
    struct store_bench bench;

    setup();
    refuse_and_recover(make_read_only);
    fake_disk.read_only = true; /* from the start on */
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(store_bench_hash(&bench), truth[72]);
    ck_assert_int_eq(work(&bench, 20), 0);
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

    setup();
    settings.sync_us = INT64_MAX; /* no marks */
    fake_disk_reset(seed);
    bench = store_bench_create(&settings);
    store_bench_serve(&bench);
    work(&bench, 8);
    crash(&bench, FAKE_DISK_KILLED);
    for (int i = 0; (name = fake_disk_name(i)) && !strstr(name, ".journal"); i++)
        ;
    ck_assert_ptr_nonnull(name);
    fake_disk_bytes(name, &size);
    ck_assert_uint_eq(size, 32 + 8 * 208);
    for (; size > 32; size--) {
        fake_disk_truncate(name, size);
        bench = store_bench_create(&settings);
        ck_assert_uint_eq(model_samples(bench.learner), (size - 32) / 208);
        ck_assert_uint_eq(store_bench_hash(&bench), truth[(size - 32) / 208]);
        crash(&bench, FAKE_DISK_KILLED);
    }
}
END_TEST

/* A start on damaged files: everything that was stored, or a refusal that changes nothing. */
static bool start_or_refuse(int64_t stored, const char *name, const char *what)
{
    uint64_t before = fake_disk_hash();
    struct store_bench bench = store_bench_try(&settings, error, sizeof error);

    ck_assert_msg(fake_disk_hash() == before, "%s: %s: a start has written", name, what);
    if (!bench.store) {
        ck_assert_msg(strstr(error, "/current-") && strstr(error, ": "), "no file in: %s", error);
        return false;
    }
    ck_assert_msg((int64_t)model_samples(bench.learner) >= stored, "%s: %s: samples are missing",
                  name, what);
    ck_assert_msg(store_bench_hash(&bench) == truth[model_samples(bench.learner)],
                  "%s: %s: another model", name, what);
    crash(&bench, FAKE_DISK_KILLED);
    return true;
}

static int flip_every_byte(int64_t stored, const char *name)
{
    size_t size = 0;
    unsigned char *bytes = fake_disk_bytes(name, &size);
    int refused = 0;

    for (size_t at = 0; at < size; at++) {
        unsigned char bit = (unsigned char)(1 << random_bits(&seed) % 8);
        bytes[at] ^= bit;
        refused += !start_or_refuse(stored, name, "a flipped bit");
        bytes[at] ^= bit;
    }
    return refused;
}

static const char *newest_snapshot(void)
{
    const char *newest = "";
    const char *name;

    for (int i = 0; (name = fake_disk_name(i)); i++)
        if (strstr(name, "/current-") && strstr(name, ".imle") && strcmp(name, newest) > 0)
            newest = name;
    return newest;
}

START_TEST(a_bit_flipped_anywhere)
{
    int64_t stored;
    const char *name;

    setup();
    for (settings.keep = 1; settings.keep <= 2; settings.keep++) {
        fake_disk_reset(seed);
        stored = two_lives();
        int snapshots = 0;
        int refused_snapshots = 0;
        for (int i = 0; (name = fake_disk_name(i)); i++) {
            int refused = flip_every_byte(stored, name);
            snapshots += strstr(name, ".imle") != NULL;
            refused_snapshots += strstr(name, ".imle") && refused > 0;
        }
        ck_assert_int_eq(snapshots, settings.keep);
        /* With an older generation a damaged snapshot is rebuilt. */
        ck_assert_int_eq(refused_snapshots, settings.keep == 1);
    }
}
END_TEST

/* What was learned before a load does not lead to what was loaded. */
START_TEST(a_damaged_snapshot_after_a_load_is_refused)
{
    struct store_bench bench;

    setup();
    fake_disk_reset(seed);
    bench = store_bench_create(&settings);
    work(&bench, 10);
    ck_assert(model_store_begin_save(bench.store, 1));
    work(&bench, 12);
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    ck_assert(model_store_begin_load(bench.store, 1));
    store_bench_serve(&bench);
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    ck_assert_int_eq(work(&bench, 6), 16);
    store_bench_close(&bench);
    size_t size = 0;
    const char *name = newest_snapshot();
    fake_disk_bytes(name, &size)[size / 2] ^= 1;
    ck_assert(!start_or_refuse(16, name, "damaged after a load"));
    ck_assert_ptr_nonnull(strstr(error, name));
}
END_TEST

/* The damaged snapshot that was rebuilt stays as evidence, whatever is written afterwards. */
START_TEST(evidence_is_kept)
{
    const char *name = NULL;
    unsigned char damaged[4096];
    unsigned char *bytes;
    size_t size = 0;
    int64_t stored;

    setup();
    fake_disk_reset(seed);
    stored = two_lives();
    bytes = fake_disk_bytes(newest_snapshot(), &size);
    ck_assert_uint_le(size, sizeof damaged);
    bytes[size / 2] ^= 4;
    memcpy(damaged, bytes, size);
    recover(stored, "damaged", 0);
    name = NULL;
    for (int i = 0; (name = fake_disk_name(i)) && !strstr(name, ".damaged-1"); i++)
        ;
    ck_assert_ptr_nonnull(name);
    ck_assert_int_eq(memcmp(fake_disk_bytes(name, &size), damaged, size), 0);
}
END_TEST

/* A file that is gone is noticed where samples would go with it. */
START_TEST(a_missing_file)
{
    int64_t stored;
    const char *name;
    int files = 0;
    int refused = 0;

    setup();
    fake_disk_reset(seed);
    two_lives();
    while (fake_disk_name(files))
        files++;
    ck_assert_int_eq(files, 4); /* two snapshots, two journals */
    for (int i = 0; i < files; i++) {
        fake_disk_reset(seed);
        stored = two_lives();
        name = fake_disk_name(i);
        fake_disk_files.remove(name);
        refused += !start_or_refuse(stored, name, "removed");
    }
    ck_assert_int_eq(refused, 1); /* the newest journal; the newest snapshot is rebuilt */
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
                                  a_torn_last_record_is_cut_off,
                                  a_bit_flipped_anywhere,
                                  a_damaged_snapshot_after_a_load_is_refused,
                                  evidence_is_kept,
                                  a_missing_file};

    return SUITE_RUN("model_crash", tests);
}
