/* Births by evidence: as many experts as branches, whatever the order of the samples, and what is
 * known stays. The branches are one bent surface, each a step above the last. */
#include <math.h>
#include <stdlib.h>

#include "branches.h"
#include "tests/unit/suite.h"

START_TEST(independent_samples_from_the_start_are_one_branch)
{
    struct learner_config config = branches_cubic(16);

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 300, 0.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 1);
    ck_assert_double_lt(branches_error_of(learner, 0.0), 0.2 * branches_tolerance);
    config.births = LEARNER_BIRTHS_PUBLISHED; /* here the published rule makes several */
    config.n_outliers = 0;
    learner = bed_create(&config);
    branches_teach(learner, 300, 0.0, NULL);
    ck_assert_int_gt(branches_experts(learner), 3);
    bed_clean();
}
END_TEST

START_TEST(a_tolerance_told_too_small_makes_no_more)
{
    struct learner_config config = branches_cubic(16);

    bed_seed();
    for (int i = 0; i < BRANCHES_OUTPUTS; i++)
        config.psi0[i] /= 400.0;
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 400, 0.0, NULL);
    ck_assert_int_le(branches_experts(learner), 2);
    ck_assert_double_lt(branches_error_of(learner, 0.0), 0.2 * branches_tolerance);
    bed_clean();
}
END_TEST

START_TEST(bursts_make_no_expert_and_a_branch_does)
{
    struct learner_config config = branches_cubic(16);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 400, 0.0, NULL);
    for (int burst = 0; burst < 20; burst++) {
        branches_teach(learner, BRANCHES_OUTLIERS, 1.0, counts);
        branches_teach(learner, 30, 0.0, NULL);
    }
    ck_assert_int_eq(branches_experts(learner), 1);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], 20 * BRANCHES_OUTLIERS);
    double before = branches_error_of(learner, 0.0);
    branches_teach(learner, 60, 1.0, counts);
    ck_assert_int_eq(counts[LEARNER_BORN], 1);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], 21 * BRANCHES_OUTLIERS);
    ck_assert_int_eq(branches_experts(learner), 2);
    ck_assert_double_lt(branches_error_of(learner, 1.0), branches_tolerance);
    ck_assert_double_lt(branches_error_of(learner, 0.0), 1.05 * before);
    bed_clean();
}
END_TEST

START_TEST(nothing_that_a_candidate_learned_is_lost)
{
    struct learner_config config = branches_cubic(16);
    double z[BRANCHES_OUTLIERS + 1][BRANCHES_INPUTS], x[BRANCHES_OUTPUTS];
    struct learner_prediction prediction;

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 200, 0.0, NULL);
    for (int k = 0; k <= BRANCHES_OUTLIERS; k++) {
        branches_draw(z[k]);
        branches_value_at(z[k], 1.0, x);
        ck_assert_int_eq(learner_update(learner, z[k], x),
                         k < BRANCHES_OUTLIERS ? LEARNER_OUTLIER : LEARNER_BORN);
    }
    for (int k = 0; k <= BRANCHES_OUTLIERS; k++) {
        double least = INFINITY;
        branches_value_at(z[k], 1.0, x);
        ck_assert_int_eq(learner_predict(learner, z[k], &prediction), 2);
        for (int s = 0; s < 2; s++)
            least = fmin(least, fabs(prediction.solution[s].value[0] - x[0]));
        ck_assert_double_lt(least, 0.1 * branches_tolerance);
    }
    bed_clean();
}
END_TEST

START_TEST(branches_by_chance_become_experts)
{
    struct learner_config config = branches_cubic(16);

    bed_seed();
    config.n_outliers = 20; /* so many in a row never come */
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 300, 0.0, NULL);
    for (int k = 0; k < 1000; k++)
        branches_teach(learner, 1, bed_uniform(0.0, 1.0) < 0.5, NULL);
    ck_assert_int_eq(branches_experts(learner), 2);
    ck_assert_double_lt(branches_error_of(learner, 1.0), 0.3 * branches_tolerance);
    bed_clean();
}
END_TEST

START_TEST(what_a_short_burst_made_goes_and_leaves_its_place)
{
    struct learner_config config = branches_cubic(16);
    struct learner_prediction prediction;
    const double z[BRANCHES_INPUTS] = {0.1, 0.2, 0.3};

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 400, 0.0, NULL);
    branches_teach(learner, 2 * BRANCHES_OUTLIERS, 1.0, NULL);
    branches_teach(learner, 400, 2.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 3);
    branches_teach(learner, 1000, 2.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 2);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), 2);
    ck_assert_int_eq(prediction.solution[0].principal + prediction.solution[1].principal, 0 + 2);
    branches_teach(learner, 60, 3.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 3);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), 3);
    for (int s = 0; s < 3; s++)
        ck_assert_int_lt(prediction.solution[s].principal, 3);
    bed_clean();
}
END_TEST

START_TEST(a_full_model_makes_room_and_keeps_what_is_known)
{
    struct learner_config config = branches_cubic(4);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 600, 0.0, NULL);
    branches_teach(learner, 600, 1.0, NULL);
    branches_teach(learner, 30, 2.0, NULL);
    branches_teach(learner, 300, 1.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 3); /* one place is a candidate's */
    double before[2] = {branches_error_of(learner, 0.0), branches_error_of(learner, 1.0)};
    branches_teach(learner, 200, 3.0, counts);
    ck_assert_int_eq(counts[LEARNER_BORN], 1);
    ck_assert_int_eq(branches_experts(learner), 3);
    ck_assert_double_lt(branches_error_of(learner, 3.0), 0.5 * branches_tolerance);
    ck_assert_double_lt(branches_error_of(learner, 0.0), 1.05 * before[0]);
    ck_assert_double_lt(branches_error_of(learner, 1.0), 1.05 * before[1]);
    ck_assert_double_gt(branches_error_of(learner, 2.0), 0.5 * branches_step);
    bed_clean();
}
END_TEST

START_TEST(a_burst_pushes_no_known_branch_out)
{
    struct learner_config config = branches_cubic(4);
    int counts[5] = {0};

    bed_seed();
    struct learner *learner = bed_create(&config);
    for (int branch = 0; branch < 3; branch++)
        branches_teach(learner, 600, branch, NULL);
    branches_teach(learner, 2 * BRANCHES_OUTLIERS, 3.0, counts);
    ck_assert_int_eq(counts[LEARNER_FULL], BRANCHES_OUTLIERS);
    ck_assert_int_eq(counts[LEARNER_OUTLIER], BRANCHES_OUTLIERS);
    for (int branch = 0; branch < 3; branch++)
        ck_assert_double_lt(branches_error_of(learner, branch), 0.2 * branches_tolerance);
    bed_clean();
}
END_TEST

START_TEST(the_stated_variance_is_that_of_new_samples)
{
    struct learner_config config = branches_cubic(16);
    double sum = 0.0;

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 1500, 0.0, NULL);
    for (int k = 0; k < 500; k++) {
        struct learner_prediction prediction;
        double z[BRANCHES_INPUTS], x[BRANCHES_OUTPUTS];
        branches_draw(z);
        branches_value_at(z, 0.0, x);
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
    struct learner_config config = branches_cubic(8);
    char err[128];
    size_t size = 0;

    bed_seed();
    struct learner *one = bed_create(&config);
    struct learner *other = bed_create(&config);
    branches_teach(one, 200, 0.0, NULL);
    branches_teach(one, BRANCHES_OUTLIERS - 2, 1.0, NULL);
    unsigned char *state = bed_saved(one, &size);
    ck_assert_int_eq(learner_load(other, state, size, err, sizeof err), 0);
    for (int k = 0; k < 100; k++) {
        double z[BRANCHES_INPUTS], x[BRANCHES_OUTPUTS];
        branches_draw(z);
        branches_value_at(z, 1.0, x);
        ck_assert_int_eq(learner_update(one, z, x), learner_update(other, z, x));
    }
    ck_assert_int_eq(branches_experts(other), 2);
    bed_expect_same_state(one, other);
    free(state);
    bed_clean();
}
END_TEST

START_TEST(experts_are_born_by_evidence_but_for_linear_ones)
{
    const enum learner_features kinds[] = {LEARNER_LINEAR, LEARNER_POLYNOMIAL};

    ck_assert_int_eq(learner_config_default(BRANCHES_INPUTS, BRANCHES_OUTPUTS).births,
                     LEARNER_BIRTHS_AUTO);
    for (int k = 0; k < 2; k++) {
        struct learner_config config = branches_cubic(16);
        config.features = kinds[k];
        config.n_outliers = 0;
        struct learner *told = bed_create(&config);
        bed_seed();
        branches_teach(told, 500, 0.0, NULL);
        config.births = LEARNER_BIRTHS_PUBLISHED;
        struct learner *published = bed_create(&config);
        bed_seed();
        branches_teach(published, 500, 0.0, NULL);
        ck_assert_int_lt(branches_experts(told), branches_experts(published));
        config.births = LEARNER_BIRTHS_AUTO;
        struct learner *by_default = bed_create(&config);
        bed_seed();
        branches_teach(by_default, 500, 0.0, NULL);
        bed_expect_same_state(by_default, kinds[k] == LEARNER_LINEAR ? published : told);
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
        experts_are_born_by_evidence_but_for_linear_ones,
    };

    return SUITE_RUN("births by evidence", tests);
}
