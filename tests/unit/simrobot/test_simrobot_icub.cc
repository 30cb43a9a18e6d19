/* The iCub-like arm: its URDF against published positions, its tools, its measured end-effector. */
#include <cmath>

#include "fixture.h"
#include "tests/unit/suite.h"

using fixture::degree;

namespace
{

constexpr char name[] = "simrobot-icub.yaml";

struct Icub {
    explicit Icub(std::initializer_list<const char *> overrides = {})
        : config(fixture::config(overrides, name)), rig(fixture::rig(config)),
          simulation(config, rig, fixture::test_seed())
    {
    }

    /* Pose of the hand by kinematics, for joints in radians. */
    Eigen::Isometry3d hand(const std::vector<double> &angles) const
    {
        return sim::rig_link(rig.hand, sim::rig_forward(rig, angles));
    }

    sim::Config config;
    sim::Rig rig;
    sim::Simulation simulation;
};

} // namespace

/* Two independent computations agreed on these; metres in the root frame, which looks backwards and
 * is 0.6 m above the ground. */
START_TEST(test_the_hand_is_where_the_public_kinematics_has_it)
{
    const double golden[3][10] = {
        {0, 0, 0, 20, 0, 0, 0, -0.08006, 0.09412, -0.16986},
        {-40, 40, 40, 50, 0, 0, 10, -0.32017, 0.15820, -0.00399},
        {-30, 30, 20, 60, 10, 5, 10, -0.28468, 0.18749, 0.01927},
    };
    Icub icub;

    for (const double *row : golden) {
        std::vector<double> angles(row, row + 7);
        for (double &angle : angles)
            angle *= degree;
        Eigen::Vector3d ground = icub.hand(angles).translation();
        ck_assert_double_eq_tol(-ground.x(), row[7], 1e-5);
        ck_assert_double_eq_tol(-ground.y(), row[8], 1e-5);
        ck_assert_double_eq_tol(ground.z() - 0.6, row[9], 1e-5);
    }
}
END_TEST

START_TEST(test_limits_are_those_of_the_paper)
{
    const double limits[7][2] = {{-80, 0},  {0, 80},   {0, 80},  {20, 80},
                                 {-30, 30}, {-30, 30}, {-10, 30}};
    Icub icub;

    ck_assert_int_eq(icub.rig.n_arm, 7);
    for (size_t i = 0; i < 7; i++) {
        const sim::Segment &segment =
            icub.rig.description.segments[static_cast<size_t>(icub.rig.joints[i])];
        ck_assert_double_eq_tol(segment.lower / degree, limits[i][0], 1e-4);
        ck_assert_double_eq_tol(segment.upper / degree, limits[i][1], 1e-4);
    }
}
END_TEST

/* Held rigidly, at any posture, while the arm moves. */
START_TEST(test_tools_are_as_long_as_they_should_be)
{
    const double lean = std::sqrt(0.5);
    const Eigen::Vector3d tips[3] = {
        {0, 0, 0}, {0.28 * lean, -0.28 * lean, 0}, {0.48 * lean, -0.48 * lean, 0.30}};
    Icub icub;

    for (int tool = 0; tool < 3; tool++) {
        ck_assert(icub.simulation.set_tool(tool));
        icub.simulation.command({0.4, -0.3, 0.5, 0.4, 0.3, -0.2, 0.1});
        fixture::steps(icub.simulation, 100);
        sim::Truth truth = icub.simulation.truth();
        Eigen::Vector3d expected = icub.hand(truth.position) * tips[tool];
        ck_assert_double_lt((truth.ball - expected).norm(), 1e-3);
        icub.simulation.reset();
    }
}
END_TEST

START_TEST(test_the_effector_is_measured_with_the_error_that_was_asked_for)
{
    Icub icub({"effector.noise=0.002"});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
    const int n = 2000;

    for (int i = 0; i < n; i++) {
        Eigen::Vector3d error = icub.simulation.measure_effector() - icub.simulation.truth().ball;
        sum += error;
        squares += error.cwiseAbs2();
    }
    for (int axis = 0; axis < 3; axis++) {
        ck_assert_double_eq_tol(sum[axis] / n, 0, 0.0003);
        ck_assert_double_eq_tol(std::sqrt(squares[axis] / n), 0.002, 0.0002);
    }
}
END_TEST

/* Wide physics steps: the motors still give the speed they are asked for, and time is exact. */
START_TEST(test_wide_steps_keep_speed_and_time)
{
    Icub icub;

    ck_assert_int_eq(icub.simulation.steps_in_period() * icub.simulation.step_us(), 20000);
    std::vector<double> before = icub.simulation.truth().position;
    icub.simulation.command({0.2, 0.2, -0.2, 0.2, 0.2, -0.2, 0.2});
    fixture::steps(icub.simulation, 10 * icub.simulation.steps_in_period());
    ck_assert_int_eq(icub.simulation.elapsed(), 200000);
    std::vector<double> after = icub.simulation.truth().position;
    for (size_t i = 0; i < before.size(); i++)
        ck_assert_double_eq_tol(std::fabs(after[i] - before[i]), 0.2 * 0.2, 0.006);
}
END_TEST

int main()
{
    const TTest *tests[] = {test_the_hand_is_where_the_public_kinematics_has_it,
                            test_limits_are_those_of_the_paper,
                            test_tools_are_as_long_as_they_should_be,
                            test_the_effector_is_measured_with_the_error_that_was_asked_for,
                            test_wide_steps_keep_speed_and_time};
    return SUITE_RUN("icub", tests);
}
