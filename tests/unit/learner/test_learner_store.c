/* Configurations that are refused, full capacity, and states saved and loaded. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_prediction a, b;
static char err[160];

static struct learner_config small(int capacity)
{
    struct learner_config config = learner_config_default(2, 1);

    config.capacity = capacity;
    config.psi0[0] = 0.01;
    config.sigma0[0] = config.sigma0[1] = 0.05;
    return config;
}

static void teach(struct learner *learner, int samples, double shift)
{
    for (int n = 0; n < samples; n++) {
        double z[2] = {bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0)};
        double x = sin(3.0 * z[0]) + z[1] + shift;
        learner_update(learner, z, &x);
    }
}

START_TEST(every_row_is_checked)
{
    struct learner_config good = small(8);
    struct learner_config bad = good;

    ck_assert_int_eq(learner_config_check(&good, err, sizeof err), 0);
    bad.psi0[0] = 0.0;
    ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "psi0"));
    bad = good;
    bad.alpha = NAN;
    ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "alpha"));
    bad = learner_config_default(17, 1);
    ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
    ck_assert_uint_eq(learner_memory(&bad), 0);
    bad = learner_config_default(16, 1);
    for (int i = 0; i < 16; i++)
        bad.sigma0[i] = 1.0;
    bad.psi0[0] = 1.0;
    bad.features = LEARNER_POLYNOMIAL;
    bad.degree = 5;
    ck_assert_int_eq(learner_config_check(&bad, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "degree"));
}
END_TEST

START_TEST(a_small_arena_is_told)
{
    struct learner_config config = small(8);
    struct arena *arena = arena_create(learner_memory(&config) - ARENA_ALIGNMENT);

    ck_assert_ptr_null(learner_create(&config, arena, err, sizeof err));
    ck_assert_ptr_nonnull(strstr(err, "bytes"));
    arena_destroy(arena);
}
END_TEST

START_TEST(a_full_learner_refuses_births_and_keeps_what_it_knows)
{
    struct learner_config config = small(6);
    const double z[2] = {0.1, 0.1};

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 2000, 0.0);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 6);
    learner_predict(learner, z, &a);
    teach(learner, 500, 100.0);
    struct learner_statistics statistics = learner_get_statistics(learner);
    ck_assert_int_eq(statistics.experts, 6);
    ck_assert_uint_gt(statistics.full, 400);
    learner_predict(learner, z, &b);
    ck_assert_int_eq(memcmp(&a.solution[0], &b.solution[0], sizeof a.solution[0]), 0);
    teach(learner, 500, 0.0);
    ck_assert_uint_gt(learner_get_statistics(learner).samples, statistics.samples);
    bed_clean();
}
END_TEST

/* Bytes bound the experts as their number does; at the bound nothing grows and nothing is lost. */
START_TEST(memory_bounds_the_experts)
{
    struct learner_config config = small(1024);
    const double z[2] = {0.1, 0.1};

    bed_seed();
    config.features = LEARNER_POLYNOMIAL;
    config.births = LEARNER_BIRTHS_PUBLISHED; /* by evidence a full model makes room */
    config.degree = 4;
    config.clustering = LEARNER_CLUSTER_LEADER;
    size_t whole = learner_memory(&config);
    config.most_bytes = (double)whole / 10.0;
    ck_assert_uint_le(learner_memory(&config), whole / 10);
    struct learner *learner = bed_create(&config);
    int capacity = learner_get_statistics(learner).capacity;
    ck_assert_int_gt(capacity, 8);
    ck_assert_int_lt(capacity, 103);
    for (int tool = 0; tool < 2 * capacity; tool++)
        teach(learner, 30, 5.0 * tool);
    ck_assert_int_eq(learner_get_statistics(learner).experts, capacity);
    ck_assert_uint_gt(learner_get_statistics(learner).full, 100);
    size_t size = learner_save_size(learner);
    learner_predict(learner, z, &a);
    teach(learner, 300, -50.0);
    ck_assert_uint_eq(learner_save_size(learner), size);
    learner_predict(learner, z, &b);
    ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
    config.most_bytes = 1.0;
    ck_assert_int_eq(learner_get_statistics(bed_create(&config)).capacity, 1);
    bed_clean();
}
END_TEST

static void teach_both(struct learner *one, struct learner *other, int samples)
{
    for (int n = 0; n < samples; n++) {
        double z[2] = {bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0)};
        double x = sin(3.0 * z[0]) + z[1] + n % 2;
        ck_assert_int_eq(learner_update(one, z, &x), learner_update(other, z, &x));
        ck_assert_int_eq(learner_predict(one, z, &a), learner_predict(other, z, &b));
        for (int k = 0; k < a.n_solutions; k++)
            ck_assert_int_eq(memcmp(&a.solution[k], &b.solution[k], sizeof a.solution[k]), 0);
    }
}

START_TEST(a_loaded_state_goes_on_to_the_same_bytes)
{
    struct learner_config config = small(64);
    size_t size = 0;

    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++) {
        config.features = (enum learner_features)features;
        config.capacity = 64;
        struct learner *one = bed_create(&config);
        teach(one, 700, 0.0);
        unsigned char *buffer = bed_saved(one, &size);
        config.capacity = 80;
        struct learner *other = bed_create(&config);
        teach(other, 50, 3.0);
        ck_assert_int_eq(learner_load(other, buffer, size, err, sizeof err), 0);
        bed_expect_same_state(one, other);
        teach_both(one, other, 300);
        bed_expect_same_state(one, other);
        free(buffer);
        bed_clean();
    }
}
END_TEST

START_TEST(a_damaged_state_is_refused_whole)
{
    struct learner_config config = small(64);
    size_t size = 0;

    bed_seed();
    struct learner *learner = bed_create(&config);
    struct learner *untouched = bed_create(&config);
    teach(learner, 100, 0.0);
    unsigned char *buffer = bed_saved(learner, &size);
    ck_assert_int_eq(learner_load(untouched, buffer, size, err, sizeof err), 0);
    for (size_t cut = 0; cut < size; cut += 7)
        ck_assert_int_eq(learner_load(learner, buffer, cut, err, sizeof err), -1);
    for (size_t n = 0; n < size; n++) {
        buffer[n] ^= (unsigned char)(1U << (n % 8));
        ck_assert_int_eq(learner_load(learner, buffer, size, err, sizeof err), -1);
        buffer[n] ^= (unsigned char)(1U << (n % 8));
    }
    bed_expect_same_state(learner, untouched);
    free(buffer);
    bed_clean();
}
END_TEST

static void expect_refusal(const unsigned char *buffer, size_t size,
                           const struct learner_config *config, const char *reason)
{
    struct learner *learner = bed_create(config);

    ck_assert_int_eq(learner_load(learner, buffer, size, err, sizeof err), -1);
    ck_assert_msg(strstr(err, reason) != NULL, "'%s' does not say '%s'", err, reason);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 0);
}

START_TEST(a_state_of_another_learner_is_refused)
{
    struct learner_config config = small(64);
    struct learner_config other = config;
    size_t size = 0;

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 400, 0.0);
    unsigned char *buffer = bed_saved(learner, &size);
    other.alpha = 0.99;
    expect_refusal(buffer, size, &other, "parameters");
    other = config;
    other.features = LEARNER_POLYNOMIAL;
    expect_refusal(buffer, size, &other, "parameters");
    other = config;
    other.capacity = 2;
    expect_refusal(buffer, size, &other, "capacity");
    other = learner_config_default(1, 1);
    other.psi0[0] = other.sigma0[0] = 1.0;
    expect_refusal(buffer, size, &other, "dimensions");
    other.kind = LEARNER_LWPR;
    expect_refusal(buffer, size, &other, "kind");
    free(buffer);
    bed_clean();
}
END_TEST

/* Fields of a saved state's header as models on disk have them. The kind's is its own, whatever its
 * place among those that there are. */
START_TEST(a_state_begins_with_the_same_bytes_in_every_build)
{
    static const struct {
        enum learner_kind kind;
        uint64_t number, parameters, checksum;
    } known[] = {{LEARNER_IMLE, 0, 0x041977cfbfdc40d5, 0xdf0ac411700f3770},
                 {LEARNER_LWPR, 2, 0x19ab099d5db06313, 0x03ef004e05348c0e}};

    for (int k = 0; k < 2; k++) {
        struct learner_config config = learner_config_default(2, 2);
        uint64_t header[14];
        size_t size = 0;
        config.kind = known[k].kind;
        config.psi0[0] = config.psi0[1] = 0.01;
        config.sigma0[0] = config.sigma0[1] = 0.05;
        unsigned char *buffer = bed_saved(bed_create(&config), &size);
        ck_assert_uint_ge(size, sizeof header);
        memcpy(header, buffer, sizeof header);
        ck_assert_uint_eq(header[2], known[k].number);
        ck_assert_uint_eq(header[5], known[k].parameters);
        ck_assert_uint_eq(header[13], known[k].checksum);
        free(buffer);
    }
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_row_is_checked,
        a_small_arena_is_told,
        a_full_learner_refuses_births_and_keeps_what_it_knows,
        memory_bounds_the_experts,
        a_loaded_state_goes_on_to_the_same_bytes,
        a_damaged_state_is_refused_whole,
        a_state_of_another_learner_is_refused,
        a_state_begins_with_the_same_bytes_in_every_build,
    };

    return SUITE_RUN("learner store", tests);
}
