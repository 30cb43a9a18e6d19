/* The sweep: with the shipped geometry every babbled posture can be fixated, with hand and tool,
 * and the targets of the experiments can be reached. Bodies are ODE's, at rest, droop included. */
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fixture.h"
#include "simrobot/world/visibility.h"
#include "tests/unit/suite.h"

using fixture::degree;

namespace
{

const double babbled[4][2] = {{-70, -60}, {-30, -5}, {-15, 15}, {-90, -40}};
const double allowed[4][2] = {{-70, -5}, {-30, -5}, {-15, 15}, {-90, -5}};
const std::vector<double> middle = {-65, -17.5, 0, -65};

/* A tube that comes to rest soon hangs as the shipped one does. */
const char quick_to_rest[] = "tool1.damping=0.06";
const int steps_to_rest = 500;

/* The robot at rest in this posture (deg); head straight ahead. */
std::unique_ptr<fixture::Stage> at_rest(const std::vector<double> &arm, int tool)
{
    std::vector<double> joints = arm;
    joints.insert(joints.end(), {0, 0});
    auto stage = fixture::stage({quick_to_rest}, joints, tool);
    fixture::steps(*stage->simulation, tool ? steps_to_rest : 2);
    return stage;
}

struct Range {
    double low = 1e9, high = -1e9;

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

struct Sweep {
    Range yaw, pitch, disparity, distance;
    int postures = 0, hidden = 0;
};

/* Share of the ball that the right eye sees once the head has turned to it. */
double visible_at_fixation(const fixture::Stage &stage, const sim::Truth &truth)
{
    std::vector<double> joints = truth.position;
    joints[4] = truth.fixation.yaw;
    joints[5] = truth.fixation.pitch;
    Eigen::Isometry3d eye = sim::rig_link(stage.rig.right_eye, sim::rig_forward(stage.rig, joints));
    return sim::visibility_of_ball(stage.simulation->snapshot(1).shapes, eye.translation(),
                                   truth.ball, stage.config.ball_radius);
}

void check_posture(const std::vector<double> &arm, int tool, Sweep *sweep)
{
    const double margin = 1 * degree;
    auto stage = at_rest(arm, tool);
    const sim::Rig &rig = stage->rig;
    sim::Truth truth = stage->simulation->truth();
    const sim::Segment &yaw = rig.description.segments[static_cast<size_t>(rig.joints[4])];
    const sim::Segment &pitch = rig.description.segments[static_cast<size_t>(rig.joints[5])];
    std::vector<Eigen::Isometry3d> straight = sim::rig_forward(rig, truth.position);
    double distance = (truth.ball - sim::rig_link(rig.right_eye, straight).translation()).norm();
    double radius = stage->config.ball_radius / distance * rig.focal_length;

    ck_assert(truth.fixation.converged);
    ck_assert_double_ge(truth.fixation.yaw, yaw.lower + margin);
    ck_assert_double_le(truth.fixation.yaw, yaw.upper - margin);
    ck_assert_double_ge(truth.fixation.pitch, pitch.lower + margin);
    ck_assert_double_le(truth.fixation.pitch, pitch.upper - margin);
    /* The whole ball in the left image too. */
    ck_assert_double_lt(std::fabs(truth.fixation.disparity) + radius, rig.width / 2.0);
    sweep->yaw.add(truth.fixation.yaw / degree);
    sweep->pitch.add(truth.fixation.pitch / degree);
    sweep->disparity.add(truth.fixation.disparity);
    sweep->distance.add(distance);
    sweep->postures++;
    sweep->hidden += visible_at_fixation(*stage, truth) < 0.9;
}

Sweep sweep_all(int tool)
{
    const int counts[4] = {3, 3, 3, 4};
    Sweep sweep;

    for (int i = 0; i < counts[0] * counts[1] * counts[2] * counts[3]; i++) {
        std::vector<double> arm;
        int rest = i;
        for (int joint = 0; joint < 4; joint++) {
            double share = static_cast<double>(rest % counts[joint]) / (counts[joint] - 1);
            arm.push_back(babbled[joint][0] + share * (babbled[joint][1] - babbled[joint][0]));
            rest /= counts[joint];
        }
        check_posture(arm, tool, &sweep);
    }
    return sweep;
}

/* A target of the experiments: where the ball shall be in the images when the head is there. */
struct Target {
    double yaw, pitch;              /* rad */
    Eigen::Vector3d pixel_position; /* u_right, v_right, disparity; px */
};

/* The arm's problem: image position as a function of its joints, with a tip that is fixed to the
 * hand; the tip is then put where the tube really hangs, and the problem solved again. */
struct Arm {
    const sim::Rig &rig;
    Target target;
    Eigen::Vector3d tip; /* in the hand's frame, m */

    Eigen::Vector3d see(const Eigen::Vector4d &q) const
    {
        std::vector<double> joints = {q[0], q[1], q[2], q[3], target.yaw, target.pitch};
        std::vector<Eigen::Isometry3d> poses = sim::rig_forward(rig, joints);
        sim::Projection p = sim::rig_project(rig, sim::rig_link(rig.left_eye, poses),
                                             sim::rig_link(rig.right_eye, poses),
                                             sim::rig_link(rig.hand, poses) * tip);
        return {p.u_right, p.v_right, p.u_left - p.u_right};
    }

    Eigen::Matrix<double, 3, 4> jacobian(const Eigen::Vector4d &q) const
    {
        const double step = 1e-5;
        Eigen::Matrix<double, 3, 4> result;
        for (int i = 0; i < 4; i++)
            result.col(i) = (see(q + step * Eigen::Vector4d::Unit(i)) - see(q)) / step;
        return result;
    }

    /* Damped steps within the joint limits less `margin`, the rest of the freedom towards the
     * middle of the babbled range. */
    Eigen::Vector4d solve(Eigen::Vector4d q, double margin) const
    {
        for (int i = 0; i < 60; i++) {
            Eigen::Matrix<double, 3, 4> j = jacobian(q);
            Eigen::Vector4d weight(0.03, 0.19, 0.27, 0.76);
            Eigen::Matrix<double, 4, 3> inverse =
                weight.asDiagonal() * j.transpose() *
                (j * weight.asDiagonal() * j.transpose() + 1e-2 * Eigen::Matrix3d::Identity())
                    .inverse();
            Eigen::Vector4d home(middle[0] * degree, middle[1] * degree, middle[2] * degree,
                                 middle[3] * degree);
            q += inverse * (target.pixel_position - see(q)) +
                 0.3 * (Eigen::Matrix4d::Identity() - inverse * j) * (home - q);
            for (int k = 0; k < 4; k++)
                q[k] = std::clamp(q[k], allowed[k][0] * degree + margin,
                                  allowed[k][1] * degree - margin);
        }
        return q;
    }
};

/* Tip of the tool in the hand's frame, at rest in this posture. */
Eigen::Vector3d tip_at_rest(const Eigen::Vector4d &q, int tool)
{
    auto stage = at_rest({q[0] / degree, q[1] / degree, q[2] / degree, q[3] / degree}, tool);
    sim::Truth truth = stage->simulation->truth();
    return sim::rig_link(stage->rig.hand, sim::rig_forward(stage->rig, truth.position)).inverse() *
           truth.ball;
}

/* Reaches for the target; `error` is the image error that is left, px. */
Eigen::Vector4d reach(const sim::Rig &rig, const Target &target, int tool, double *error,
                      double *smallest_singular_value)
{
    const double margin = 2 * degree;
    Eigen::Vector4d q(middle[0] * degree, middle[1] * degree, middle[2] * degree,
                      middle[3] * degree);
    Arm arm = {rig, target, tip_at_rest(q, tool)};

    for (int i = 0; i < (tool ? 5 : 1); i++) {
        q = arm.solve(q, margin);
        arm.tip = tip_at_rest(q, tool);
    }
    *error = (arm.see(q) - target.pixel_position).norm();
    Eigen::Matrix<double, 3, 4> j = arm.jacobian(q);
    *smallest_singular_value = std::sqrt(std::max(
        0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(j * j.transpose()).eigenvalues()[0]));
    return q;
}

/* All targets of an experiment: STAR moves the ball before a fixed head, coordination moves the
 * head and keeps the ball at its centre. */
void check_targets(int tool, bool move_head)
{
    auto stage = at_rest(middle, tool);
    sim::Fixation centre = stage->simulation->truth().fixation;
    double worst_error = 0, worst_condition = 1e9;

    for (int u : {-50, 0, 50})
        for (int v : {-50, 0, 50}) {
            Target target = {centre.yaw, centre.pitch, Eigen::Vector3d(u, v, 0)};
            if (move_head) {
                target.yaw -= std::atan(u / stage->rig.focal_length);
                target.pitch += std::atan(v / stage->rig.focal_length);
                target.pixel_position.setZero();
            }
            double error, condition;
            reach(stage->rig, target, tool, &error, &condition);
            worst_error = std::max(worst_error, error);
            worst_condition = std::min(worst_condition, condition);
        }
    printf("%s, %s: worst image error %.2f px, smallest singular value %.0f px/rad\n",
           tool ? "tool" : "hand", move_head ? "coordination" : "STAR", worst_error,
           worst_condition);
    fflush(stdout);
    /* The tube's tip moves on when the posture changes by the last step: half a pixel. */
    ck_assert_double_lt(worst_error, 0.5);
    ck_assert_double_gt(worst_condition, 40);
}

} // namespace

START_TEST(test_every_babbled_posture_can_be_fixated)
{
    const char *names[] = {"hand", "tool"};
    Sweep sweep = sweep_all(_i);

    printf("%s: yaw %.1f .. %.1f deg, pitch %.1f .. %.1f deg, disparity %.0f .. %.0f px, "
           "distance %.2f .. %.2f m, ball hidden in %d of %d\n",
           names[_i], sweep.yaw.low, sweep.yaw.high, sweep.pitch.low, sweep.pitch.high,
           sweep.disparity.low, sweep.disparity.high, sweep.distance.low, sweep.distance.high,
           sweep.hidden, sweep.postures);
    fflush(stdout);
    /* Depth that matters: zero disparity lies inside. */
    ck_assert_double_lt(sweep.disparity.low, -20);
    ck_assert_double_gt(sweep.disparity.high, 20);
    ck_assert_int_le(sweep.hidden, sweep.postures / 10);
}
END_TEST

START_TEST(test_star_targets_can_be_reached)
{
    check_targets(_i, false);
}
END_TEST

START_TEST(test_coordination_targets_can_be_reached)
{
    check_targets(_i, true);
}
END_TEST

/* The right eye's fixation: yaw is positive to the left, pitch positive down. */
START_TEST(test_signs_of_the_head)
{
    auto stage = at_rest(middle, 0);
    const sim::Rig &rig = stage->rig;
    sim::Truth truth = stage->simulation->truth();
    std::vector<double> joints = truth.position;

    joints[4] = truth.fixation.yaw + 0.02;
    joints[5] = truth.fixation.pitch;
    std::vector<Eigen::Isometry3d> poses = sim::rig_forward(rig, joints);
    sim::Projection left_of_it = sim::rig_project(rig, sim::rig_link(rig.left_eye, poses),
                                                  sim::rig_link(rig.right_eye, poses), truth.ball);
    /* Looking too far left, the ball is at the right: u > 0. */
    ck_assert_double_gt(left_of_it.u_right, 10);
    joints[4] = truth.fixation.yaw;
    joints[5] = truth.fixation.pitch - 0.02;
    poses = sim::rig_forward(rig, joints);
    sim::Projection above_it = sim::rig_project(rig, sim::rig_link(rig.left_eye, poses),
                                                sim::rig_link(rig.right_eye, poses), truth.ball);
    /* Looking too high, the ball is low: v > 0. */
    ck_assert_double_gt(above_it.v_right, 10);
}
END_TEST

/* Nearer than where the eyes' axes meet, the left eye sees it further right than the right eye. */
START_TEST(test_sign_of_disparity)
{
    sim::Rig rig = fixture::rig(fixture::config());
    std::vector<Eigen::Isometry3d> poses = sim::rig_forward(rig, {0, 0, 0, 0, 0, 0});
    Eigen::Isometry3d left = sim::rig_link(rig.left_eye, poses),
                      right = sim::rig_link(rig.right_eye, poses);

    for (double distance : {0.35, 0.7}) {
        Eigen::Vector3d point = right * Eigen::Vector3d(distance, 0, 0);
        sim::Projection p = sim::rig_project(rig, left, right, point);
        ck_assert_double_eq_tol(p.u_right, 0, 1e-6);
        if (distance < 0.5)
            ck_assert_double_gt(p.u_left - p.u_right, 50);
        else
            ck_assert_double_lt(p.u_left - p.u_right, -30);
    }
}
END_TEST

int main()
{
    Suite *suite = suite_create("simrobot geometry");
    TCase *sweep = tcase_create("sweep");
    tcase_set_timeout(sweep, 100);
    tcase_add_loop_test(sweep, test_every_babbled_posture_can_be_fixated, 0, 2);
    tcase_add_loop_test(sweep, test_star_targets_can_be_reached, 0, 2);
    tcase_add_loop_test(sweep, test_coordination_targets_can_be_reached, 0, 2);
    tcase_add_test(sweep, test_signs_of_the_head);
    tcase_add_test(sweep, test_sign_of_disparity);
    suite_add_tcase(suite, sweep);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
