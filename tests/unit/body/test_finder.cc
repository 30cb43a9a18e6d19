/* The finder on arms that are made up: it finds chains, and says when there is none or it cannot
 * know yet. */
#include "finder_bed.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstring>
/* After the C++ headers: Check takes the word `fail`. */
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

namespace
{

/* Each joint alone, from the middle of its range, where an odd number of them passes. */
void add_sweeps(Samples &samples, const body &truth, int each)
{
    for (int i = 0; i < truth.chain.n; i++)
        for (int k = 0; k < each; k++) {
            double q[CHAIN_MAX_JOINTS];
            double place[3];
            for (int j = 0; j < truth.chain.n; j++)
                q[j] = truth.chain.middle[j];
            q[i] += truth.range[i] * (2.0 * k / (each - 1) - 1);
            arm_sample(&truth, finder_bed_tip, q, place);
            samples.add(q, place);
        }
}

void expect_found(const Samples &samples, const body &truth, double within)
{
    Answer answer = search(truth, samples);
    ck_assert_int_eq(answer.outcome, FINDER_FOUND);
    double error = error_of(*answer.found, samples, truth);
    std::printf("error %.2f mm\n", 1e3 * error);
    ck_assert_double_lt(error, within);
}

START_TEST(four_joints_are_found_from_thirty_samples)
{
    bed_seed();
    body truth = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    add_random(samples, truth, 30);
    expect_found(samples, truth, 0.002);
}
END_TEST

START_TEST(seven_joints_are_found)
{
    bed_seed();
    body truth = made_up_arm(7, false);
    Samples samples{7, {}, {}};
    add_random(samples, truth, 100);
    expect_found(samples, truth, 0.003);
}
END_TEST

START_TEST(a_joint_that_slides_is_found_from_sweeps)
{
    bed_seed();
    body truth = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    truth.chain.slides[1] = true;
    truth.range[1] = 0.3;
    add_sweeps(samples, truth, 13);
    add_random(samples, truth, 20);
    Answer answer = search(truth, samples);
    ck_assert_int_eq(answer.outcome, FINDER_FOUND);
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(answer.found->chain.slides[i], i == 1);
    ck_assert_double_lt(error_of(*answer.found, samples, truth), 0.002);
}
END_TEST

/* Two segments that bend into arcs of a circle, each by two inputs. */
Eigen::Vector3d soft_tip(const double *q)
{
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();

    for (int s = 0; s < 2; s++) {
        const double length = 0.4;
        Eigen::Vector3d bend(q[2 * s], q[2 * s + 1], 0);
        double angle = std::max(bend.norm(), 1e-9);
        Eigen::Vector3d aside = bend / angle;
        Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(aside);
        Eigen::Isometry3d arc = Eigen::Isometry3d::Identity();
        arc.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
        arc.translation() =
            length / angle *
            ((1 - std::cos(angle)) * aside + std::sin(angle) * Eigen::Vector3d::UnitZ());
        pose = pose * arc;
    }
    return pose.translation();
}

START_TEST(a_soft_arm_is_no_chain)
{
    bed_seed();
    body arm = made_up_arm(4, false); /* its noise alone */
    Samples samples{4, {}, {}};
    for (int k = 0; k < 150; k++) {
        double q[4];
        for (double &one : q)
            one = bed_uniform(-1.5, 1.5);
        Eigen::Vector3d place = soft_tip(q);
        for (int i = 0; i < 3; i++)
            place[i] += ARM_NOISE * bed_normal();
        samples.add(q, place.data());
    }
    Answer answer = search(arm, samples);
    ck_assert_int_eq(answer.outcome, FINDER_NO_CHAIN);
    ck_assert_ptr_nonnull(std::strstr(answer.report.why, "off by"));
    ck_assert_int_eq(answer.found->chain.n, 0); /* it is left alone */
}
END_TEST

START_TEST(samples_along_a_line_do_not_tell)
{
    bed_seed();
    body truth = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    for (int k = 0; k < 60; k++) {
        double q[4];
        double place[3];
        for (int i = 0; i < 4; i++)
            q[i] = truth.chain.middle[i] + (k / 30.0 - 1) * (0.3 + 0.2 * i);
        arm_sample(&truth, finder_bed_tip, q, place);
        samples.add(q, place);
    }
    ck_assert_int_eq(search(truth, samples).outcome, FINDER_NOT_YET);

    Samples few{4, {}, {}};
    add_random(few, truth, 14);
    Answer answer = search(truth, few);
    ck_assert_int_eq(answer.outcome, FINDER_NOT_YET);
    ck_assert_ptr_nonnull(std::strstr(answer.report.why, "too few"));
}
END_TEST

/* From -1 to 1: where joint i is at step k of a way on which samples have neighbours. */
double along_the_way(int k, int i)
{
    return std::sin(0.05 * k * (1 + 0.37 * i) + i);
}

START_TEST(what_a_chain_leaves_of_a_soft_arm_is_no_noise)
{
    bed_seed();
    body arm = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    for (int k = 0; k < 400; k++) {
        double q[4];
        for (int i = 0; i < 4; i++)
            q[i] = 1.5 * along_the_way(k, i);
        Eigen::Vector3d place = soft_tip(q);
        samples.add(q, place.data());
    }
    ck_assert_int_eq(search(arm, samples).outcome, FINDER_NO_CHAIN);
}
END_TEST

/* Of this arm 20 times the noise told is seen. */
START_TEST(a_noise_that_nobody_told_is_seen)
{
    bed_seed();
    body truth = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    for (int k = 0; k < 400; k++) {
        double q[4];
        double place[3];
        for (int i = 0; i < 4; i++)
            q[i] = truth.chain.middle[i] + truth.range[i] * along_the_way(k, i);
        arm_sample(&truth, finder_bed_tip, q, place);
        for (double &one : place)
            one += 20 * ARM_NOISE * bed_normal();
        samples.add(q, place);
    }
    Answer answer = search(truth, samples);
    ck_assert_int_eq(answer.outcome, FINDER_FOUND);
    ck_assert_ptr_nonnull(std::strstr(answer.report.why, "times what was told"));
    ck_assert_double_eq_tol(answer.found->noise[0], 20 * ARM_NOISE, 2 * ARM_NOISE);
}
END_TEST

/* So few can be explained by any chain that gives way a little: it would be the wrong one. */
START_TEST(few_samples_of_a_tool_that_bends_tell_nothing_of_the_chain)
{
    bed_seed();
    body truth = made_up_arm(4, true);
    Samples hand{4, {}, {}};
    Samples tool{4, {}, {}};
    add_random(hand, truth, 30);
    for (int k = 0; k < 4; k++) {
        const double tip[3] = {0.1, 0.25 + 0.002 * k, 0.05};
        add_random(tool, truth, 1, tip);
    }
    learner_samples bends = tool.view();
    bends.rigid = false;
    ck_assert_int_eq(search(truth, {hand.view(), bends}).report.samples, hand.n());
}
END_TEST

START_TEST(the_same_samples_give_the_same_bytes)
{
    bed_seed();
    body truth = made_up_arm(4, false);
    Samples samples{4, {}, {}};
    std::vector<double> one(BODY_NUMBERS);
    std::vector<double> other(BODY_NUMBERS);
    add_random(samples, truth, 30);
    Answer first = search(truth, samples);
    Samples copy = samples; /* at another address */
    Answer second = search(truth, copy);
    body_to_numbers(first.found.get(), one.data());
    body_to_numbers(second.found.get(), other.data());
    ck_assert(one == other);
    ck_assert_int_eq(std::memcmp(first.report.why, second.report.why, sizeof first.report.why), 0);

    body back; /* and as numbers there and back */
    body_from_numbers(one.data(), &back);
    body_to_numbers(&back, other.data());
    ck_assert(one == other);
}
END_TEST

} /* namespace */

int main()
{
    const TTest *const tests[] = {
        four_joints_are_found_from_thirty_samples,
        seven_joints_are_found,
        a_joint_that_slides_is_found_from_sweeps,
        a_soft_arm_is_no_chain,
        samples_along_a_line_do_not_tell,
        what_a_chain_leaves_of_a_soft_arm_is_no_noise,
        a_noise_that_nobody_told_is_seen,
        few_samples_of_a_tool_that_bends_tell_nothing_of_the_chain,
        the_same_samples_give_the_same_bytes,
    };
    return SUITE_RUN("finder", tests);
}
