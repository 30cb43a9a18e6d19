/* What the finder believes: no wrong body from samples that lie along one way, and none for ever.
 */
#include "finder_bed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
/* After the C++ headers: Check takes the word `fail`. */
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

namespace
{

enum { JOINTS = 4 };

/* A robot that tries what moving does: for 15 samples each, every joint goes at a speed of its own,
 * up to some degrees a sample, and turns back at its stop. */
struct Walk {
    const body &truth;
    double q[CHAIN_MAX_JOINTS];
    double speed[CHAIN_MAX_JOINTS];
    int steps = 0;

    explicit Walk(const body &arm) : truth(arm)
    {
        random_joints(&truth, q);
    }

    void step(Samples &samples)
    {
        double x[3];
        for (int i = 0; i < JOINTS; i++) {
            if (steps % 15 == 0)
                speed[i] = bed_uniform(-0.06, 0.06);
            q[i] += speed[i];
            if (std::abs(q[i] - truth.chain.middle[i]) > truth.range[i])
                speed[i] = -speed[i];
        }
        steps++;
        if (arm_sample(&truth, finder_bed_tip, q, x))
            samples.add(q, x);
    }
};

/* One joint of one sample, the next of another: within what the samples went through. */
void mixed_joints(const Samples &samples, double *q)
{
    for (int i = 0; i < JOINTS; i++)
        q[i] = samples.z[JOINTS * size_t(bed_uniform(0, samples.n())) + size_t(i)];
}

double spread_of(const Samples &samples, int output)
{
    double sum = 0;
    double squares = 0;

    for (int k = 0; k < samples.n(); k++) {
        double x = samples.x[3 * size_t(k) + size_t(output)];
        sum += x;
        squares += x * x;
    }
    return std::sqrt(squares / samples.n() - std::pow(sum / samples.n(), 2));
}

/* How far a learner that stands on the body, and has learned the samples, is from the truth, rms,
 * over how far the samples lie from their mean. */
double error_within(const body &found, const Samples &samples, const body &truth)
{
    learner_config config = body_config(JOINTS, truth.sees, 16);
    learner *learner = bed_create(&config);
    char err[160];
    double sum = 0;
    int n = 0;

    ck_assert_msg(learner_give_body(learner, &found, err, sizeof err) == 0, "%s", err);
    for (int k = 0; k < samples.n(); k++)
        learner_update(learner, &samples.z[size_t(JOINTS) * size_t(k)], &samples.x[3 * size_t(k)]);
    while (n < 200) {
        double q[CHAIN_MAX_JOINTS];
        double place[3];
        learner_solution one{};
        mixed_joints(samples, q);
        if (!arm_output(&truth, finder_bed_tip, q, place))
            continue;
        n++;
        learner_predict_single(learner, q, &one);
        for (int i = 0; i < 3; i++)
            sum += std::pow((one.value[i] - place[i]) / spread_of(samples, i), 2) / 3;
    }
    bed_clean();
    return std::sqrt(sum / n);
}

/* What a robot with eyes explored first: joints (rad), yaw, pitch (rad) and disparity (px), in the
 * order of time. A wrong chain explains these as well as others do, and is sure to 0.1 % of its
 * length by its covariance alone. */
const double explored[24][JOINTS + 3] = {
    {-1.09464, -0.29752, -0.00131, -1.43265, -0.38363, 0.05680, -0.061},
    {-1.11595, -0.30842, 0.00085, -1.43644, -0.39132, 0.04099, 2.246},
    {-1.17937, -0.40328, -0.15020, -0.93906, -0.50554, 0.03602, -38.458},
    {-1.18402, -0.40258, -0.15025, -0.91587, -0.50539, 0.03834, -39.926},
    {-1.18765, -0.40180, -0.15115, -0.89343, -0.50451, 0.03944, -40.686},
    {-1.19063, -0.39642, -0.15173, -0.87463, -0.50041, 0.04231, -41.530},
    {-1.19378, -0.39231, -0.14780, -0.86243, -0.49577, 0.04399, -42.289},
    {-1.19858, -0.39260, -0.12382, -0.84819, -0.48846, 0.04445, -42.520},
    {-1.20036, -0.39430, -0.10335, -0.84480, -0.48312, 0.04428, -42.198},
    {-1.20201, -0.39556, -0.08270, -0.84354, -0.47799, 0.04391, -42.197},
    {-1.20358, -0.39698, -0.06600, -0.84590, -0.47378, 0.04355, -41.864},
    {-1.20480, -0.40388, -0.05132, -0.85158, -0.47443, 0.04095, -41.113},
    {-1.20569, -0.41129, -0.03557, -0.85811, -0.47452, 0.03849, -40.918},
    {-1.20700, -0.42012, -0.01793, -0.86580, -0.47570, 0.03559, -40.240},
    {-1.20763, -0.42987, 0.00398, -0.87370, -0.47585, 0.03320, -39.666},
    {-1.20800, -0.43982, 0.02674, -0.88112, -0.47546, 0.03156, -39.216},
    {-1.20875, -0.44953, 0.05065, -0.88836, -0.47511, 0.03032, -38.754},
    {-1.20952, -0.45741, 0.07332, -0.89512, -0.47374, 0.02998, -38.435},
    {-1.20992, -0.46489, 0.09579, -0.90202, -0.47186, 0.02907, -37.912},
    {-1.21029, -0.47157, 0.11624, -0.91017, -0.46971, 0.02844, -37.377},
    {-1.21051, -0.47748, 0.13411, -0.91888, -0.46738, 0.02841, -36.865},
    {-1.21092, -0.48185, 0.14907, -0.92654, -0.46503, 0.02720, -36.457},
    {-1.21140, -0.48644, 0.16201, -0.93416, -0.46413, 0.02750, -35.856},
    {-1.21166, -0.49188, 0.17122, -0.94713, -0.46372, 0.02539, -35.128},
};

START_TEST(another_chain_that_explains_as_well_is_doubt)
{
    body robot = made_up_arm(JOINTS, true); /* its noise alone */
    Samples samples{JOINTS, {}, {}};
    Answer answer;

    robot.noise[0] = robot.noise[1] = 0.000552;
    robot.noise[2] = 0.19;
    for (const double *row : explored) {
        samples.add(row, row + JOINTS);
        int n = samples.n();
        if (n != 15 && n != 19 && n != 24)
            continue;
        Answer before = std::move(answer);
        answer = search(robot, {samples.view()}, before.begin());
        ck_assert_int_eq(answer.outcome, FINDER_NOT_YET);
    }
    ck_assert_double_gt(answer.report.doubt, 0.1);
}
END_TEST

/* The robot's way: a search with each quarter more, which begins where the last one ended. */
START_TEST(no_wrong_body_is_believed_from_a_short_walk)
{
    bed_seed();
    for (int walk = 0; walk < 20; walk++) {
        body truth = made_up_arm(JOINTS, true);
        Samples samples{JOINTS, {}, {}};
        Walk way(truth);
        Answer answer;
        int next = 15;
        for (int k = 0; k < 32 && answer.outcome != FINDER_FOUND; k++) {
            way.step(samples);
            if (samples.n() < next)
                continue;
            next = int(std::ceil(1.25 * next));
            Answer before = std::move(answer);
            answer = search(truth, {samples.view()}, before.begin());
        }
        if (answer.outcome == FINDER_FOUND)
            ck_assert_double_lt(error_within(*answer.found, samples, truth), 0.2);
    }
}
END_TEST

/* Of this arm a chain explains the samples whose eyes see nothing in most other postures. */
START_TEST(what_sees_nothing_is_no_start_for_the_next_search)
{
    setenv("REACH_TEST_SEED", "2", 1);
    bed_seed();
    unsetenv("REACH_TEST_SEED");
    body truth = made_up_arm(JOINTS, true);
    Samples samples{JOINTS, {}, {}};
    add_random(samples, truth, 16);
    Answer answer = search(truth, samples);
    ck_assert_int_eq(answer.outcome, FINDER_NOT_YET);
    ck_assert(answer.report.doubt < 1e9 || !answer.report.any_body);
}
END_TEST

START_TEST(a_body_is_sure_where_the_robot_may_go)
{
    bed_seed();
    body truth = made_up_arm(JOINTS, false);
    body still = truth;
    Samples samples{JOINTS, {}, {}};
    still.range[0] = still.range[2] = 0.01;
    add_random(samples, still, 60);
    ck_assert_int_eq(search(truth, samples).outcome, FINDER_FOUND);
    Answer told = search(truth, {samples.view()}, nullptr, true);
    ck_assert_int_eq(told.outcome, FINDER_NOT_YET);
    add_random(samples, truth, 10);
    told = search(truth, {samples.view()}, told.begin(), true);
    ck_assert_int_eq(told.outcome, FINDER_FOUND);
    ck_assert_double_lt(error_of(*told.found, samples, truth), 0.002);
}
END_TEST

/* Another arm's body, as if it had been believed. */
body wrong_body()
{
    body wrong = made_up_arm(JOINTS, false);

    wrong.samples = 24;
    wrong.error = 1;
    wrong.doubt = 0.01;
    return wrong;
}

/* What a wrong body makes of one hand: of a walk and, from there on, of postures anywhere. It
 * thinks that the last tool bends. */
std::vector<learner_samples> taken_for_three(const Samples &samples)
{
    learner_samples last = samples.view(27, samples.n() - 27);

    last.rigid = false;
    return {samples.view(0, 23), samples.view(23, 4), last};
}

START_TEST(a_better_body_takes_the_place_of_a_wrong_one)
{
    bed_seed();
    body truth = made_up_arm(JOINTS, false);
    body wrong = wrong_body();
    Samples samples{JOINTS, {}, {}};
    Walk way(truth);
    for (int k = 0; k < 27; k++)
        way.step(samples);
    add_random(samples, truth, 40);
    Answer answer = search(truth, taken_for_three(samples), &wrong);
    ck_assert_int_eq(answer.outcome, FINDER_FOUND);
    ck_assert_int_eq(answer.report.samples, samples.n());
    ck_assert_double_lt(error_of(*answer.found, samples, truth), 0.002);
}
END_TEST

/* All samples lie along one line: chains explain them with one tool, and none is sure. */
START_TEST(a_wrong_body_goes_though_no_other_is_sure)
{
    bed_seed();
    body truth = made_up_arm(JOINTS, false);
    body wrong = wrong_body();
    Samples samples{JOINTS, {}, {}};
    for (int k = 0; k < 60; k++) {
        double q[CHAIN_MAX_JOINTS];
        double place[3];
        for (int i = 0; i < JOINTS; i++)
            q[i] = truth.chain.middle[i] + (k / 30.0 - 1) * (0.3 + 0.2 * i);
        arm_sample(&truth, finder_bed_tip, q, place);
        samples.add(q, place);
    }
    Answer answer = search(truth, taken_for_three(samples), &wrong);
    ck_assert_int_eq(answer.outcome, FINDER_REFUTED);
    ck_assert(answer.report.any_body);
    ck_assert_double_gt(answer.found->doubt, 0.02); /* the next search doubts it, too */
}
END_TEST

START_TEST(a_right_body_stays)
{
    const double stick[3] = {0.1, -0.2, 0.3};

    bed_seed();
    body truth = made_up_arm(JOINTS, false);
    Samples samples{JOINTS, {}, {}};
    add_random(samples, truth, 40);
    Answer known = search(truth, samples);
    ck_assert_int_eq(known.outcome, FINDER_FOUND);
    for (int n = 1; n <= 64; n *= 4) { /* of a stick */
        Samples more = samples;
        add_random(more, truth, n, stick);
        learner_samples hand = more.view(0, 40);
        learner_samples tool = more.view(40, n);
        tool.rigid = n < 64;
        Answer answer = search(truth, {hand, tool}, known.found.get());
        ck_assert_int_eq(answer.outcome, FINDER_FOUND);
        ck_assert_double_lt(error_of(*answer.found, samples, truth), 0.002);
    }
}
END_TEST

} // namespace

int main()
{
    const TTest *const tests[] = {
        another_chain_that_explains_as_well_is_doubt,
        no_wrong_body_is_believed_from_a_short_walk,
        what_sees_nothing_is_no_start_for_the_next_search,
        a_body_is_sure_where_the_robot_may_go,
        a_better_body_takes_the_place_of_a_wrong_one,
        a_wrong_body_goes_though_no_other_is_sure,
        a_right_body_stays,
    };
    return SUITE_RUN("what the finder believes", tests);
}
