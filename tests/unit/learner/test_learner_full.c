/* A learner at its capacity, while samples of branches go on coming that it has no expert for: what
 * it knows stays as good as it was, nothing grows, and a call costs what it cost before. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "bed.h"
#include "tests/unit/suite.h"

enum { INPUTS = 4, OUTPUTS = 3, CALLS = 600, QUERIES = 300 };

static struct learner_config linear_config(void)
{
    struct learner_config config = learner_config_default(INPUTS, OUTPUTS);

    config.capacity = 48;
    for (int i = 0; i < INPUTS; i++)
        config.sigma0[i] = 10.0;
    for (int i = 0; i < OUTPUTS; i++)
        config.psi0[i] = 0.06 * 0.06;
    config.hyper_psi = config.prior_psi = INFINITY;
    return config;
}

static struct learner_config cubic_config(void)
{
    struct learner_config config = linear_config();

    config.features = LEARNER_POLYNOMIAL;
    config.births = LEARNER_BIRTHS_PUBLISHED; /* by evidence a full model makes room */
    config.capacity = 4;
    config.clustering = LEARNER_CLUSTER_LEADER;
    config.leader_level = 0.9999;
    config.p0 = 0.001;
    config.ridge = 5e-5;
    config.noise_share = 0.1;
    config.gamma_floor = 0.05;
    for (int i = 0; i < INPUTS; i++)
        config.scale[i] = 1.5;
    config.inherit = true;
    return config;
}

/* One of many branches, far from each other. */
static void value_on_branch(const double *z, int branch, double *x)
{
    for (int i = 0; i < OUTPUTS; i++)
        x[i] = sin(z[i] + 0.5 * z[i + 1]) + 2.0 * branch;
}

static void draw(double *z)
{
    for (int i = 0; i < INPUTS; i++)
        z[i] = bed_uniform(-0.7, 0.7);
}

static double thread_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;

    return (x > y) - (x < y);
}

/* What a tenth of the calls stay below: more than that is the machine's other work. */
static double tenth(double *times)
{
    qsort(times, CALLS, sizeof *times, by_size);
    return times[CALLS / 10];
}

/* Times of learning samples of `branch` (or, each time another, of those from -branch on),
 * and of the predictions between them. */
struct cost {
    double update, predict;
};

static struct cost live(struct learner *learner, int branch)
{
    static double update[CALLS], predict[CALLS];
    static struct learner_prediction prediction;

    for (int k = 0; k < CALLS; k++) {
        double z[INPUTS], x[OUTPUTS];
        draw(z);
        value_on_branch(z, branch >= 0 ? branch : k % 5 - branch, x);
        double start = thread_us();
        learner_update(learner, z, x);
        update[k] = thread_us() - start;
        start = thread_us();
        learner_predict(learner, z, &prediction);
        predict[k] = thread_us() - start;
    }
    return (struct cost){tenth(update), tenth(predict)};
}

/* RMSE of the solution that is closest to the branch, always at the same queries. */
static double error_of(struct learner *learner, int branch)
{
    static double queries[QUERIES][INPUTS];
    static bool drawn;
    double sum = 0.0;

    for (int k = 0; k < QUERIES && !drawn; k++)
        draw(queries[k]);
    drawn = true;
    for (int k = 0; k < QUERIES; k++) {
        double x[OUTPUTS];
        value_on_branch(queries[k], branch, x);
        sum += bed_square_off(learner, queries[k], x, OUTPUTS);
    }
    return sqrt(sum / QUERIES);
}

/* Of the branch that is known worst; the last one is known in part only. */
static double worst_error(struct learner *learner, int branches)
{
    double worst = 0.0;

    for (int branch = 0; branch < branches - 1; branch++)
        worst = fmax(worst, error_of(learner, branch));
    return worst;
}

/* Learns branches 0, 1, ... until no expert is left; returns how many branches there are. */
static int fill(struct learner *learner)
{
    int branches = 0;

    while (learner_get_statistics(learner).full == 0 && branches < 50)
        for (int k = 0, at = branches++; k < 1000; k++) {
            double z[INPUTS], x[OUTPUTS];
            draw(z);
            value_on_branch(z, at, x);
            learner_update(learner, z, x);
        }
    return branches;
}

static void stays_as_it_is(struct learner_config config)
{
    struct learner *learner = bed_create(&config);
    int branches = fill(learner);
    struct cost before = live(learner, 0);
    double error = worst_error(learner, branches);
    struct learner_statistics then = learner_get_statistics(learner);
    size_t size = learner_save_size(learner);

    ck_assert_int_eq(then.experts, config.capacity);
    ck_assert_int_gt(branches, 2);
    struct cost after = live(learner, -2 * branches);
    struct learner_statistics now = learner_get_statistics(learner);
    printf(
        "%d experts, %d branches: error %.4f -> %.4f; update %.1f -> %.1f us, predict %.1f -> %.1f "
        "us, %d samples dropped\n",
        then.experts, branches, error, worst_error(learner, branches), before.update, after.update,
        before.predict, after.predict, (int)(now.full - then.full));
    ck_assert_double_lt(error, 0.3); /* branches lie 3.5 apart */
    ck_assert_uint_gt(now.full - then.full, CALLS / 2);
    ck_assert_uint_eq(now.births, then.births);
    ck_assert_uint_eq(learner_save_size(learner), size);
    ck_assert_double_le(worst_error(learner, branches), 1.05 * error);
    /* A sample that fits nowhere is compared with everybody. */
    ck_assert_double_le(after.update, 2.0 * before.update + 10.0);
    ck_assert_double_le(after.predict, 1.5 * before.predict + 5.0);
    bed_clean();
}

START_TEST(linear_experts_at_capacity_stay_as_they_are)
{
    bed_seed();
    stays_as_it_is(linear_config());
}
END_TEST

START_TEST(richer_experts_at_capacity_stay_as_they_are)
{
    bed_seed();
    stays_as_it_is(cubic_config());
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {linear_experts_at_capacity_stay_as_they_are,
                                  richer_experts_at_capacity_stay_as_they_are};

    return SUITE_RUN("full learner", tests);
}
