/* Signs of trouble: each is told where it is, and nowhere else. */
#include "learner/health/health.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <string.h>

enum { D_IN = 3, D_OUT = 2 };

static struct health health;
static struct learner_statistics statistics;

static struct learner_config polynomial(void)
{
    struct learner_config config = learner_config_default(D_IN, D_OUT);

    config.features = LEARNER_POLYNOMIAL;
    for (int i = 0; i < D_IN; i++) {
        config.reference[i] = i;
        config.scale[i] = 1.5;
    }
    return config;
}

static void begin(void)
{
    const struct learner_config config = polynomial();

    bed_seed();
    health_init(&health, &config, 0);
    statistics = (struct learner_statistics){.experts = 1, .capacity = 16};
}

static double noise(void)
{
    return bed_uniform(-1, 1);
}

/* A healthy sample: inputs about the references, outputs that a sensor measured. */
static void make_sample(double *z, double *x)
{
    for (int i = 0; i < D_IN; i++)
        z[i] = i + noise();
    for (int i = 0; i < D_OUT; i++)
        x[i] = sin(z[0] + i * z[1]) + 1e-3 * noise();
}

static bool learn(const double *z, const double *x)
{
    bool sound = health_look(&health, z, x);

    if (sound) {
        health_count(&health, LEARNER_UPDATED);
        statistics.samples++;
    }
    return sound;
}

static void learn_healthy(int n)
{
    double z[D_IN], x[D_OUT];

    for (int i = 0; i < n; i++) {
        make_sample(z, x);
        ck_assert(learn(z, x));
    }
}

static void count(int n, enum learner_update_result result)
{
    double z[D_IN], x[D_OUT];

    for (int i = 0; i < n; i++) {
        make_sample(z, x);
        ck_assert(health_look(&health, z, x));
        health_count(&health, result);
    }
}

static unsigned judge(void)
{
    return health_judge(&health, &statistics);
}

static void ck_assert_told(enum health_trouble trouble, const char *wanted)
{
    char text[256];

    ck_assert_uint_eq(judge(), 1U << trouble);
    health_tell(&health, &statistics, trouble, text, sizeof text);
    ck_assert_str_eq(text, wanted);
}

START_TEST(healthy_samples_are_no_trouble)
{
    begin();
    ck_assert_uint_eq(judge(), 0);
    learn_healthy(1000);
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

START_TEST(dropped_samples_are_told_above_five_percent)
{
    begin();
    learn_healthy(950);
    count(50, LEARNER_FULL);
    ck_assert_uint_eq(judge(), 0);
    count(3, LEARNER_FULL);
    ck_assert_told(HEALTH_FULL,
                   "53 of 1003 samples (5.3 %) were dropped: all 16 experts are in use "
                   "(p0, psi0, capacity)");
    begin();
    learn_healthy(900);
    count(100, LEARNER_OUTLIER);
    ck_assert_told(HEALTH_OUTLIERS, "100 of 1000 samples (10 %) were dropped as outliers: psi0 too "
                                    "small, or wrong rows?");
    begin();
    count(9, LEARNER_OUTLIER); /* the first of a stream say nothing */
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

START_TEST(an_input_far_from_its_reference_is_told_with_value_and_scale)
{
    static const char *const names[] = {"waist", "shoulder", "elbow"};
    double z[D_IN], x[D_OUT];

    begin();
    health.names = names;
    learn_healthy(100);
    make_sample(z, x);
    z[2] = 2 + 4.0 * 1.5; /* at the border */
    ck_assert(learn(z, x));
    ck_assert_uint_eq(judge(), 0);
    make_sample(z, x);
    z[2] = -58;             /* 40 scales below 2 */
    z[1] = 16;              /* 10 above 1 */
    ck_assert(learn(z, x)); /* told, and learned nevertheless */
    ck_assert_told(HEALTH_FAR,
                   "input 3 (elbow) is -58 in sample 102, 40 scales from its reference 2 (scale "
                   "1.5); so is input 2: another unit, another column?");
    ck_assert(health_scales(&health, 2, -58) == 40);
}
END_TEST

START_TEST(experts_that_are_linear_in_the_inputs_have_no_scale)
{
    struct learner_config config = polynomial();
    double z[D_IN] = {0}, x[D_OUT] = {0};

    begin();
    config.features = LEARNER_LINEAR;
    health_init(&health, &config, 0);
    for (int i = 0; i < 100; i++) {
        make_sample(z, x);
        z[0] *= 1000;
        ck_assert(learn(z, x));
    }
    statistics.experts = 90; /* a branch is many of them */
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

START_TEST(a_constant_input_is_told)
{
    double z[D_IN], x[D_OUT];

    begin();
    for (int i = 0; i < 60; i++) {
        make_sample(z, x);
        z[1] = 0.25 + 1e-4 * noise(); /* an encoder's jitter is no motion */
        ck_assert(learn(z, x));
        ck_assert_uint_eq(judge() & 1U << HEALTH_FULL, 0);
        if (i < 48)
            ck_assert_uint_eq(judge(), 0);
    }
    ck_assert_uint_eq(judge(), 1U << HEALTH_CONSTANT);
    make_sample(z, x);
    ck_assert(learn(z, x));
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

/* A walk at 50 Hz past a tracker that repeats its last answer for 20 samples. */
START_TEST(outputs_that_stand_still_are_not_sound)
{
    double z[D_IN], x[D_OUT], held[D_OUT] = {0};
    int refused = 0;

    begin();
    for (int i = 0; i < 400; i++) {
        z[0] = sin(0.02 * i);
        z[1] = 1 + cos(0.013 * i);
        z[2] = 2 + sin(0.017 * i);
        for (int k = 0; k < D_OUT; k++)
            x[k] = z[k] + 1e-3 * noise();
        if (i == 200)
            memcpy(held, x, sizeof held);
        if (i > 200 && i <= 220)
            memcpy(x, held, sizeof x);
        bool sound = learn(z, x);
        ck_assert(sound || (i > 200 && i <= 220));
        refused += !sound;
    }
    /* A sample may pass while inputs have moved by less than 1 % of their range. */
    ck_assert_int_ge(refused, 19);
    ck_assert_uint_eq(health.frozen, (uint64_t)refused);
    ck_assert_uint_eq(judge(), 1U << HEALTH_FROZEN);
}
END_TEST

START_TEST(a_robot_that_stands_still_is_sound)
{
    double z[D_IN], x[D_OUT];

    begin();
    learn_healthy(100);
    make_sample(z, x);
    for (int i = 0; i < 200; i++) {
        z[0] += 1e-5 * noise();
        ck_assert(learn(z, x));
    }
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

START_TEST(outputs_that_repeat_by_their_nature_are_sound)
{
    double z[D_IN], x[D_OUT];
    int refused = 0;

    begin();
    for (int i = 0; i < 1000; i++) {
        make_sample(z, x);
        x[0] = z[0] > 0 ? 1 : 0; /* a function with a step */
        x[1] = 0;
        refused += !learn(z, x);
    }
    ck_assert_int_le(refused, 30);
}
END_TEST

START_TEST(more_experts_than_branches_are_told)
{
    begin();
    learn_healthy(120);
    statistics.experts = 4; /* 30 samples each */
    ck_assert_uint_eq(judge(), 0);
    statistics.experts = 5;
    ck_assert_told(HEALTH_EXPERTS, "5 experts from 120 samples: more than there are branches; a "
                                   "smaller p0 or a larger psi0 makes fewer");
    learn_healthy(2000);
    ck_assert_uint_eq(judge(), 0);
    for (int i = 0; i < 100; i++)
        health_count_solutions(&health, 1 + i % 2);
    ck_assert_told(HEALTH_EXPERTS, "5 experts, but 1.5 solutions: more than there are branches; a "
                                   "smaller p0 or a larger psi0 makes fewer");
    for (int i = 0; i < 900; i++)
        health_count_solutions(&health, 5);
    ck_assert_uint_eq(judge(), 0);
}
END_TEST

START_TEST(a_window_forgets)
{
    const struct learner_config config = polynomial();
    double z[D_IN], x[D_OUT];

    begin();
    health_init(&health, &config, 1000);
    count(500, LEARNER_FULL);
    make_sample(z, x);
    z[0] = 100;
    ck_assert(learn(z, x));
    ck_assert_uint_eq(judge(), 1U << HEALTH_FULL | 1U << HEALTH_FAR);
    learn_healthy(3000);
    ck_assert_uint_eq(judge(), 0);
    ck_assert_uint_le(health.samples, 1000);
    ck_assert_uint_eq(health.seen, 3501);
}
END_TEST

START_TEST(numbers_that_are_none_are_left_to_the_learner)
{
    double z[D_IN] = {0, NAN, 0}, x[D_OUT] = {0};

    begin();
    ck_assert(health_look(&health, z, x));
    z[1] = 1;
    x[0] = INFINITY;
    ck_assert(health_look(&health, z, x));
    ck_assert_uint_eq(health.seen, 0);
}
END_TEST

START_TEST(a_line_is_cut_where_it_must_be)
{
    char text[20];
    double z[D_IN] = {1e300, 1e300, 1e300}, x[D_OUT] = {0};

    begin();
    ck_assert(learn(z, x));
    memset(text, 'x', sizeof text);
    health_tell(&health, &statistics, HEALTH_FAR, text, 10);
    ck_assert_str_eq(text, "input 1 i");
    ck_assert_int_eq(text[10], 'x');
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {healthy_samples_are_no_trouble,
                                  dropped_samples_are_told_above_five_percent,
                                  an_input_far_from_its_reference_is_told_with_value_and_scale,
                                  experts_that_are_linear_in_the_inputs_have_no_scale,
                                  a_constant_input_is_told,
                                  outputs_that_stand_still_are_not_sound,
                                  a_robot_that_stands_still_is_sound,
                                  outputs_that_repeat_by_their_nature_are_sound,
                                  more_experts_than_branches_are_told,
                                  a_window_forgets,
                                  numbers_that_are_none_are_left_to_the_learner,
                                  a_line_is_cut_where_it_must_be};

    return SUITE_RUN("health", tests);
}
