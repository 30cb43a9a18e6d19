/* Births by evidence: as many experts as branches, whatever the order of the samples, and what is
 * known stays. The branches are one bent surface, each a step above the last. */
#include <math.h>
#include <stdlib.h>

#include "bed.h"
#include "tests/unit/suite.h"

enum { INPUTS = 3, OUTPUTS = 2, N_OUTLIERS = 5, QUERIES = 200 };

static const double tolerance = 0.02; /* sqrt(psi0) */
static const double step = 0.5;       /* from branch to branch */

static struct learner_config cubic(int capacity)
{
    struct learner_config config = learner_config_default(INPUTS, OUTPUTS);

    config.features = LEARNER_POLYNOMIAL;
    config.capacity = capacity;
    config.clustering = LEARNER_CLUSTER_LEADER;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = 1e-5;
    config.noise_share = 1e-3;
    config.gamma_floor = 0.05;
    config.inherit = true;
    config.births = LEARNER_BIRTHS_EVIDENCE;
    config.n_outliers = N_OUTLIERS;
    for (int i = 0; i < OUTPUTS; i++)
        config.psi0[i] = tolerance * tolerance;
    for (int i = 0; i < INPUTS; i++) {
        config.sigma0[i] = 10.0;
        config.scale[i] = 1.5;
    }
    return config;
}

static void draw(double *z)
{
    for (int i = 0; i < INPUTS; i++)
        z[i] = bed_uniform(-0.7, 0.7);
}

static void value_at(const double *z, double branch, double *x)
{
    for (int i = 0; i < OUTPUTS; i++)
        x[i] = 0.4 * sin(z[i] + 0.5 * z[i + 1]) + step * branch;
}

/* Learns n samples of a branch at independent inputs; counts each result. */
static void teach(struct learner *learner, int n, double branch, int *counts)
{
    for (int k = 0; k < n; k++) {
        double z[INPUTS], x[OUTPUTS];
        draw(z);
        value_at(z, branch, x);
        for (int i = 0; i < OUTPUTS; i++)
            x[i] += 5e-4 * bed_normal();
        int result = learner_update(learner, z, x);
        if (counts)
            counts[result]++;
    }
}

static int experts(const struct learner *learner)
{
    return learner_get_statistics(learner).experts;
}

/* How far the nearest solution is from the branch, root mean square, always at the same inputs. */
static double error_of(struct learner *learner, double branch)
{
    static double queries[QUERIES][INPUTS];
    static bool drawn;
    double sum = 0.0;

    for (int k = 0; k < QUERIES && !drawn; k++)
        draw(queries[k]);
    drawn = true;
    for (int k = 0; k < QUERIES; k++) {
        double x[OUTPUTS];
        value_at(queries[k], branch, x);
        sum += bed_square_off(learner, queries[k], x, OUTPUTS);
    }
    return sqrt(sum / QUERIES);
}

START_TEST(independent_samples_from_the_start_are_one_branch)
{
    struct learner_config config = cubic(16);

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 300, 0.0, NULL);
    ck_assert_int_eq(experts(learner), 1);
    ck_assert_double_lt(error_of(learner, 0.0), 0.2 * tolerance);
    config.births = LEARNER_BIRTHS_PUBLISHED; /* here the published rule makes several */
    config.n_outliers = 0;
    learner = bed_create(&config);
    teach(learner, 300, 0.0, NULL);
    ck_assert_int_gt(experts(learner), 3);
    bed_clean();
}
END_TEST

START_TEST(a_tolerance_told_too_small_makes_no_more)
{
    struct learner_config config = cubic(16);

    bed_seed();
    for (int i = 0; i < OUTPUTS; i++)
        config.psi0[i] /= 400.0;
    struct learner *learner = bed_create(&config);
    teach(learner, 400, 0.0, NULL);
    ck_assert_int_le(experts(learner), 2);
    ck_assert_double_lt(error_of(learner, 0.0), 0.2 * tolerance);
    bed_clean();
}
END_TEST

START_TEST(bursts_make_no_expert_and_a_branch_does)
{
    struct learner_config config = cubic(16);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 400, 0.0, NULL);
    for (int burst = 0; burst < 20; burst++) {
        teach(learner, N_OUTLIERS, 1.0, counts);
        teach(learner, 30, 0.0, NULL);
    }
    ck_assert_int_eq(experts(learner), 1);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], 20 * N_OUTLIERS);
    double before = error_of(learner, 0.0);
    teach(learner, 60, 1.0, counts);
    ck_assert_int_eq(counts[LEARNER_BORN], 1);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], 21 * N_OUTLIERS);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_double_lt(error_of(learner, 1.0), tolerance);
    ck_assert_double_lt(error_of(learner, 0.0), 1.05 * before);
    bed_clean();
}
END_TEST

START_TEST(nothing_that_a_candidate_learned_is_lost)
{
    struct learner_config config = cubic(16);
    double z[N_OUTLIERS + 1][INPUTS], x[OUTPUTS];
    struct learner_prediction prediction;

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 200, 0.0, NULL);
    for (int k = 0; k <= N_OUTLIERS; k++) {
        draw(z[k]);
        value_at(z[k], 1.0, x);
        ck_assert_int_eq(learner_update(learner, z[k], x),
                         k < N_OUTLIERS ? LEARNER_OUTLIER : LEARNER_BORN);
    }
    for (int k = 0; k <= N_OUTLIERS; k++) {
        double least = INFINITY;
        value_at(z[k], 1.0, x);
        ck_assert_int_eq(learner_predict(learner, z[k], &prediction), 2);
        for (int s = 0; s < 2; s++)
            least = fmin(least, fabs(prediction.solution[s].value[0] - x[0]));
        ck_assert_double_lt(least, 0.1 * tolerance);
    }
    bed_clean();
}
END_TEST

START_TEST(branches_by_chance_become_experts)
{
    struct learner_config config = cubic(16);

    bed_seed();
    config.n_outliers = 20; /* so many in a row never come */
    struct learner *learner = bed_create(&config);
    teach(learner, 300, 0.0, NULL);
    for (int k = 0; k < 1000; k++)
        teach(learner, 1, bed_uniform(0.0, 1.0) < 0.5, NULL);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_double_lt(error_of(learner, 1.0), 0.3 * tolerance);
    bed_clean();
}
END_TEST

START_TEST(what_a_short_burst_made_goes_and_leaves_its_place)
{
    struct learner_config config = cubic(16);
    struct learner_prediction prediction;
    const double z[INPUTS] = {0.1, 0.2, 0.3};

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 400, 0.0, NULL);
    teach(learner, 2 * N_OUTLIERS, 1.0, NULL);
    teach(learner, 400, 2.0, NULL);
    ck_assert_int_eq(experts(learner), 3);
    teach(learner, 1000, 2.0, NULL);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), 2);
    ck_assert_int_eq(prediction.solution[0].principal + prediction.solution[1].principal, 0 + 2);
    teach(learner, 60, 3.0, NULL);
    ck_assert_int_eq(experts(learner), 3);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), 3);
    for (int s = 0; s < 3; s++)
        ck_assert_int_lt(prediction.solution[s].principal, 3);
    bed_clean();
}
END_TEST

START_TEST(a_full_model_makes_room_and_keeps_what_is_known)
{
    struct learner_config config = cubic(4);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 600, 0.0, NULL);
    teach(learner, 600, 1.0, NULL);
    teach(learner, 30, 2.0, NULL);
    teach(learner, 300, 1.0, NULL);
    ck_assert_int_eq(experts(learner), 3); /* one place is a candidate's */
    double before[2] = {error_of(learner, 0.0), error_of(learner, 1.0)};
    teach(learner, 200, 3.0, counts);
    ck_assert_int_eq(counts[LEARNER_BORN], 1);
    ck_assert_int_eq(experts(learner), 3);
    ck_assert_double_lt(error_of(learner, 3.0), 0.5 * tolerance);
    ck_assert_double_lt(error_of(learner, 0.0), 1.05 * before[0]);
    ck_assert_double_lt(error_of(learner, 1.0), 1.05 * before[1]);
    ck_assert_double_gt(error_of(learner, 2.0), 0.5 * step);
    bed_clean();
}
END_TEST

START_TEST(a_burst_pushes_no_known_branch_out)
{
    struct learner_config config = cubic(4);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    for (int branch = 0; branch < 3; branch++)
        teach(learner, 600, branch, NULL);
    teach(learner, 2 * N_OUTLIERS, 3.0, counts);
    ck_assert_int_eq(counts[LEARNER_FULL], N_OUTLIERS);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], N_OUTLIERS);
    for (int branch = 0; branch < 3; branch++)
        ck_assert_double_lt(error_of(learner, branch), 0.2 * tolerance);
    bed_clean();
}
END_TEST

START_TEST(the_stated_variance_is_that_of_new_samples)
{
    struct learner_config config = cubic(16);
    double sum = 0.0;

    bed_seed();
    struct learner *learner = bed_create(&config);
    teach(learner, 1500, 0.0, NULL);
    for (int k = 0; k < 500; k++) {
        struct learner_prediction prediction;
        double z[INPUTS], x[OUTPUTS];
        draw(z);
        value_at(z, 0.0, x);
        learner_predict(learner, z, &prediction);
        double off = x[0] + 5e-4 * bed_normal() - prediction.solution[0].value[0];
        sum += off * off / prediction.solution[0].variance[0];
    }
    ck_assert_double_gt(sum / 500.0, 0.4);
    ck_assert_double_lt(sum / 500.0, 2.5);
    bed_clean();
}
END_TEST

START_TEST(candidates_are_saved)
{
    struct learner_config config = cubic(8);
    char err[128];
    size_t size = 0;

    bed_seed();
    struct learner *one = bed_create(&config);
    struct learner *other = bed_create(&config);
    teach(one, 200, 0.0, NULL);
    teach(one, N_OUTLIERS - 2, 1.0, NULL);
    unsigned char *state = bed_saved(one, &size);
    ck_assert_int_eq(learner_load(other, state, size, err, sizeof err), 0);
    for (int k = 0; k < 100; k++) {
        double z[INPUTS], x[OUTPUTS];
        draw(z);
        value_at(z, 1.0, x);
        ck_assert_int_eq(learner_update(one, z, x), learner_update(other, z, x));
    }
    ck_assert_int_eq(experts(other), 2);
    bed_expect_same_state(one, other);
    free(state);
    bed_clean();
}
END_TEST

START_TEST(experts_are_born_as_published_unless_told)
{
    const enum learner_features kinds[] = {LEARNER_LINEAR, LEARNER_POLYNOMIAL};

    ck_assert_int_eq(learner_config_default(INPUTS, OUTPUTS).births, LEARNER_BIRTHS_PUBLISHED);
    for (int k = 0; k < 2; k++) {
        struct learner_config config = cubic(16);
        config.features = kinds[k];
        config.n_outliers = 0;
        struct learner *told = bed_create(&config);
        bed_seed();
        teach(told, 500, 0.0, NULL);
        config.births = LEARNER_BIRTHS_PUBLISHED;
        struct learner *published = bed_create(&config);
        bed_seed();
        teach(published, 500, 0.0, NULL);
        ck_assert_int_lt(experts(told), experts(published));
        bed_clean();
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        independent_samples_from_the_start_are_one_branch,
        a_tolerance_told_too_small_makes_no_more,
        bursts_make_no_expert_and_a_branch_does,
        nothing_that_a_candidate_learned_is_lost,
        branches_by_chance_become_experts,
        what_a_short_burst_made_goes_and_leaves_its_place,
        a_full_model_makes_room_and_keeps_what_is_known,
        a_burst_pushes_no_known_branch_out,
        the_stated_variance_is_that_of_new_samples,
        candidates_are_saved,
        experts_are_born_as_published_unless_told,
    };

    return SUITE_RUN("births by evidence", tests);
}
