/* Every byte of what is kept is damaged, files are gone: the next start has everything that was
 * stored, or it refuses and changes nothing. */
#include "store_lives.h"
#include "tests/unit/suite.h"

#include <string.h>

/* A start on damaged files: everything that was stored, or a refusal that changes nothing. */
static bool start_or_refuse(int64_t stored, const char *name, const char *what)
{
    uint64_t before = fake_disk_hash();
    struct store_bench bench = store_bench_try(&lives.settings, lives.error, sizeof lives.error);

    ck_assert_msg(fake_disk_hash() == before, "%s: %s: a start has written", name, what);
    if (!bench.store) {
        ck_assert_msg(strstr(lives.error, "/current-") && strstr(lives.error, ": "),
                      "no file in: %s", lives.error);
        return false;
    }
    ck_assert_msg((int64_t)model_samples(bench.learner) >= stored, "%s: %s: samples are missing",
                  name, what);
    ck_assert_msg(store_bench_hash(&bench) == lives.truth[model_samples(bench.learner)],
                  "%s: %s: another model", name, what);
    lives_crash(&bench, FAKE_DISK_KILLED);
    return true;
}

static int flip_every_byte(int64_t stored, const char *name)
{
    size_t size = 0;
    unsigned char *bytes = fake_disk_bytes(name, &size);
    int refused = 0;

    for (size_t at = 0; at < size; at++) {
        unsigned char bit = (unsigned char)(1 << random_bits(&lives.seed) % 8);
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

    lives_setup("model_damage");
    for (lives.settings.keep = 1; lives.settings.keep <= 2; lives.settings.keep++) {
        fake_disk_reset(lives.seed);
        stored = lives_two();
        int snapshots = 0;
        int refused_snapshots = 0;
        for (int i = 0; (name = fake_disk_name(i)); i++) {
            int refused = flip_every_byte(stored, name);
            snapshots += strstr(name, ".imle") != NULL;
            refused_snapshots += strstr(name, ".imle") && refused > 0;
        }
        ck_assert_int_eq(snapshots, lives.settings.keep);
        /* With an older generation a damaged snapshot is rebuilt. */
        ck_assert_int_eq(refused_snapshots, lives.settings.keep == 1);
    }
}
END_TEST

/* What was learned before a load does not lead to what was loaded. */
START_TEST(a_damaged_snapshot_after_a_load_is_refused)
{
    struct store_bench bench;

    lives_setup("model_damage");
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    lives_work(&bench, 10);
    ck_assert(model_store_begin_save(bench.store, 1));
    lives_work(&bench, 12);
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    ck_assert(model_store_begin_load(bench.store, 1));
    store_bench_serve(&bench);
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    ck_assert_int_eq(lives_work(&bench, 6), 16);
    store_bench_close(&bench);
    size_t size = 0;
    const char *name = newest_snapshot();
    fake_disk_bytes(name, &size)[size / 2] ^= 1;
    ck_assert(!start_or_refuse(16, name, "damaged after a load"));
    ck_assert_ptr_nonnull(strstr(lives.error, name));
}
END_TEST

/* The damaged snapshot that was rebuilt stays as evidence, whatever is written afterwards. */
START_TEST(evidence_is_kept)
{
    const char *name = NULL;
    unsigned char damaged[8192];
    unsigned char *bytes;
    size_t size = 0;
    int64_t stored;

    lives_setup("model_damage");
    fake_disk_reset(lives.seed);
    stored = lives_two();
    bytes = fake_disk_bytes(newest_snapshot(), &size);
    ck_assert_uint_le(size, sizeof damaged);
    bytes[size / 2] ^= 4;
    memcpy(damaged, bytes, size);
    lives_recover(stored, "damaged", 0);
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

    lives_setup("model_damage");
    fake_disk_reset(lives.seed);
    lives_two();
    while (fake_disk_name(files))
        files++;
    ck_assert_int_eq(files, 6); /* two snapshots, two journals, a head of each */
    for (int i = 0; i < files; i++) {
        fake_disk_reset(lives.seed);
        stored = lives_two();
        name = fake_disk_name(i);
        fake_disk_files.remove(name);
        refused += !start_or_refuse(stored, name, "removed");
    }
    ck_assert_int_eq(refused, 1); /* the newest journal; the newest snapshot is rebuilt */
}
END_TEST

/* Cut between two records, a journal is whole by its own checksums. */
START_TEST(a_journal_that_was_cut_short_is_refused)
{
    const size_t record = 208;
    const size_t header = 32;
    const char *name = NULL;
    size_t size = 0;
    int64_t stored;

    lives_setup("model_damage");
    lives.settings.keep = 1;
    fake_disk_reset(lives.seed);
    stored = lives_two();
    for (int i = 0; (name = fake_disk_name(i)); i++)
        if (strcmp(name + strlen(name) - strlen(".journal"), ".journal") == 0)
            break;
    ck_assert_ptr_nonnull(name);
    fake_disk_bytes(name, &size);
    ck_assert_uint_gt(size, header + 2 * record);
    fake_disk_truncate(name, size - record); /* the mark alone: no sample is gone */
    ck_assert(start_or_refuse(stored, name, "the last mark cut off"));
    for (size_t left = header; left < size - record; left += record) {
        fake_disk_truncate(name, left);
        ck_assert(!start_or_refuse(stored, name, "cut off"));
        ck_assert_ptr_nonnull(strstr(lives.error, "cut short"));
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_bit_flipped_anywhere,
                                  a_damaged_snapshot_after_a_load_is_refused, evidence_is_kept,
                                  a_missing_file, a_journal_that_was_cut_short_is_refused};

    return SUITE_RUN("model_damage", tests);
}
