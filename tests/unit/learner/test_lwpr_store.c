/* Locally weighted projection regression behind the learner's interface: what is refused, full
 * capacity, and states saved and loaded. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_prediction a, b;
static char err[160];

static struct learner_config small(int capacity)
{
    struct learner_config config = learner_config_default(2, 2);

    config.kind = LEARNER_LWPR;
    config.capacity = capacity;
    return config;
}

/* Returns how many samples were learned. */
static int teach(struct learner *learner, int samples, double range)
{
    int learned = 0;

    for (int n = 0; n < samples; n++) {
        double z[2] = {bed_uniform(-range, range), bed_uniform(-range, range)};
        double x[2] = {sin(3.0 * z[0]) + z[1], z[0] * z[1]};
        enum learner_update_result result = learner_update(learner, z, x);
        learned += result == LEARNER_UPDATED || result == LEARNER_BORN;
    }
    return learned;
}

START_TEST(every_row_is_checked)
{
    struct learner_config good = small(8), bad = good;
    double *const rows[] = {&bad.lwpr.init_d,       &bad.lwpr.init_alpha,   &bad.lwpr.penalty,
                            &bad.lwpr.w_gen,        &bad.lwpr.w_prune,      &bad.lwpr.cutoff,
                            &bad.lwpr.init_lambda,  &bad.lwpr.final_lambda, &bad.lwpr.tau_lambda,
                            &bad.lwpr.init_s2,      &bad.lwpr.norm_out[1],  &bad.scale[1],
                            &bad.lwpr.add_threshold};
    const double wrong[] = {-1.0, NAN, INFINITY};

    ck_assert_msg(learner_config_check(&good, err, sizeof err) == 0, "%s", err);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int k = 0; k < 3; k++) {
            bad = good;
            *rows[i] = wrong[k];
            ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
        }
    bad = good;
    bad.lwpr.max_projections = 3;
    ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "max_projections"));
}
END_TEST

/* With 5 inputs a projection counts after 10 samples; 0.92 would remember 12.5, 0.94 16.7. */
START_TEST(what_would_be_forgotten_before_it_counts_is_refused)
{
    struct learner_config config = learner_config_default(5, 2);

    config.kind = LEARNER_LWPR;
    config.lwpr.final_lambda = 0.94;
    ck_assert_msg(learner_config_check(&config, err, sizeof err) == 0, "%s", err);
    config.lwpr.final_lambda = 0.92;
    ck_assert_int_eq(learner_config_check(&config, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "lwpr.final_lambda"));
}
END_TEST

/* A sample that one output would need a new field for is learned by none of them. */
START_TEST(a_full_learner_keeps_what_it_knows)
{
    struct learner_config config = small(5);
    const double known[2] = {0.0, 0.0}, far[2] = {9.0, 9.0}, x[2] = {100.0, 100.0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 1000, 0.2);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 2);
    ck_assert_int_eq(learner_update(learner, far, x), LEARNER_BORN);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 4);
    learner_predict(learner, known, &a);
    for (int n = 0; n < 100; n++)
        ck_assert_int_eq(learner_update(learner, (double[2]){-9.0, n / 10.0}, x), LEARNER_FULL);
    learner_predict(learner, known, &b);
    ck_assert_int_eq(memcmp(&a.solution[0], &b.solution[0], sizeof a.solution[0]), 0);
    ck_assert_uint_eq(learner_get_statistics(learner).full, 100);
    ck_assert_int_eq(teach(learner, 100, 0.2), 100);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 4);
    bed_clean();
}
END_TEST

START_TEST(a_loaded_state_goes_on_to_the_same_bytes)
{
    size_t size = 0;

    bed_seed();
    for (int full = 0; full < 2; full++) {
        struct learner_config config = small(256);
        config.lwpr.diagonal_only = !full;
        struct learner *one = bed_create(&config);
        teach(one, 3000, 1.0);
        unsigned char *buffer = bed_saved(one, &size);
        config.capacity = 300;
        struct learner *other = bed_create(&config);
        teach(other, 500, 2.0);
        ck_assert_int_eq(learner_load(other, buffer, size, err, sizeof err), 0);
        bed_expect_same_state(one, other);
        for (int n = 0; n < 3000; n++) {
            double z[2] = {bed_uniform(-1.5, 1.5), bed_uniform(-1.5, 1.5)};
            double x[2] = {sin(3.0 * z[0]) + z[1], z[0] * z[1]};
            ck_assert_int_eq(learner_update(one, z, x), learner_update(other, z, x));
            learner_predict(one, z, &a);
            learner_predict(other, z, &b);
            ck_assert_int_eq(memcmp(&a.solution[0], &b.solution[0], sizeof a.solution[0]), 0);
        }
        bed_expect_same_state(one, other);
        free(buffer);
        bed_clean();
    }
}
END_TEST

/* The envelope's checksum covers all bytes: a state that passes it but cannot be is made by giving
 * its numbers to a learner whose rows forbid them. */
START_TEST(what_cannot_be_a_state_is_refused_whole)
{
    struct learner_config config = small(64);
    size_t size = 0, at = 0, now = 0;

    bed_seed();
    struct learner *one = bed_create(&config), *other = bed_create(&config);
    teach(one, 500, 1.0);
    teach(other, 100, 0.5);
    unsigned char *before = bed_saved(other, &now), *buffer = bed_saved(one, &size);
    for (int n = 0; n < 200; n++) {
        at = (size_t)bed_uniform(0.0, (double)size);
        buffer[at] ^= 0x10;
        ck_assert_int_eq(learner_load(other, buffer, size, err, sizeof err), -1);
        buffer[at] ^= 0x10;
    }
    ck_assert_int_eq(learner_load(other, buffer, size - 8, err, sizeof err), -1);
    config.lwpr.penalty *= 2.0;
    struct learner *unlike = bed_create(&config);
    ck_assert_int_eq(learner_load(unlike, buffer, size, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "parameters"));
    unsigned char *after = bed_saved(other, &size);
    ck_assert_uint_eq(size, now);
    ck_assert_int_eq(memcmp(before, after, size), 0);
    free(before);
    free(buffer);
    free(after);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_row_is_checked,
        what_would_be_forgotten_before_it_counts_is_refused,
        a_full_learner_keeps_what_it_knows,
        a_loaded_state_goes_on_to_the_same_bytes,
        what_cannot_be_a_state_is_refused_whole,
    };

    return SUITE_RUN("lwpr store", tests);
}
