/* The robot in ODE: where its links are, what its motors can do, what its stops stop. */
#include <cmath>

#include "fixture.h"
#include "tests/unit/suite.h"

using fixture::degree;

namespace
{

const std::vector<double> middle = {-65, -17.5, 0, -65, 0, 0};

std::vector<double> random_pose(const sim::Rig &rig, sim::Random *random)
{
    std::vector<double> angles;
    for (int joint : rig.joints) {
        const sim::Segment &segment = rig.description.segments[static_cast<size_t>(joint)];
        angles.push_back(random->uniform(segment.lower, segment.upper));
    }
    return angles;
}

} // namespace

/* Forward kinematics of the URDF against the bodies that ODE holds together. */
START_TEST(test_bodies_are_where_kinematics_says)
{
    sim::Config config = fixture::config();
    sim::Rig rig = fixture::rig(config);
    sim::Random random(fixture::test_seed(), 0);

    for (int trial = 0; trial < 20; trial++) {
        sim::World world;
        sim::Robot robot(world, rig, config);
        std::vector<double> angles = random_pose(rig, &random);
        robot.reset(angles);
        for (int i = 0; i < 50; i++) {
            robot.drive_motors();
            world.step();
        }
        std::vector<double> reached = robot.positions();
        std::vector<Eigen::Isometry3d> bodies = robot.segment_poses();
        std::vector<Eigen::Isometry3d> expected = sim::rig_forward(rig, reached);
        for (size_t i = 0; i < angles.size(); i++)
            ck_assert_double_eq_tol(reached[i], angles[i], 1e-4);
        for (size_t i = 0; i < bodies.size(); i++) {
            ck_assert_double_lt((bodies[i].translation() - expected[i].translation()).norm(), 1e-5);
            ck_assert_double_lt((bodies[i].linear() - expected[i].linear()).norm(), 1e-5);
        }
    }
}
END_TEST

START_TEST(test_motors_hold_against_gravity)
{
    auto stage = fixture::stage({}, middle, 1);
    std::vector<double> before = stage->simulation->truth().position;

    fixture::steps(*stage->simulation, 5000);
    std::vector<double> after = stage->simulation->truth().position;
    for (size_t i = 0; i < before.size(); i++)
        ck_assert_double_eq_tol(after[i], before[i], 1e-4);
}
END_TEST

START_TEST(test_motors_reach_the_commanded_speed_as_fast_as_allowed)
{
    auto stage = fixture::stage({"motor.arm_acceleration=600"}, middle);
    const double acceleration = 600 * degree, speed = 0.3;

    stage->simulation->command({0, 0, 0, speed, 0, 0});
    fixture::steps(*stage->simulation, 10);
    ck_assert_double_eq_tol(stage->simulation->truth().velocity[3], 0.010 * acceleration, 0.005);
    fixture::steps(*stage->simulation, 100);
    ck_assert_double_eq_tol(stage->simulation->truth().velocity[3], speed, 1e-3);
}
END_TEST

START_TEST(test_speed_limit_of_the_urdf_holds)
{
    auto stage = fixture::stage({}, {-40, -17.5, 0, -80, 0, 0});
    const sim::Rig &rig = stage->rig;
    double limit = rig.description.segments[static_cast<size_t>(rig.joints[3])].velocity;
    double fastest = 0;

    stage->simulation->command({0, 0, 0, 50, 0, 0});
    for (int i = 0; i < 400; i++) {
        stage->simulation->step();
        fastest = std::max(fastest, stage->simulation->truth().velocity[3]);
    }
    ck_assert_double_gt(fastest, 0.99 * limit);
    ck_assert_double_lt(fastest, 1.01 * limit);
}
END_TEST

/* A motor whose torque is far below what holds the arm lets it sink. */
START_TEST(test_torque_limit_of_the_urdf_holds)
{
    sim::Config config = fixture::config();
    sim::Rig rig = fixture::rig(config);
    for (int joint : rig.joints)
        rig.description.segments[static_cast<size_t>(joint)].effort = 0.01;
    sim::World world;
    sim::Robot robot(world, rig, config);

    robot.reset({-60 * degree, -17.5 * degree, 0, -65 * degree, 0, 0});
    for (int i = 0; i < 300; i++) {
        robot.drive_motors();
        world.step();
    }
    ck_assert_double_gt(robot.positions()[0], -50 * degree);
}
END_TEST

START_TEST(test_stops_stop_at_the_limits)
{
    for (int direction : {-1, 1}) {
        auto stage = fixture::stage({}, middle);
        double speed = direction * 1.0;
        stage->simulation->command({speed, speed, speed, speed, speed, speed});
        fixture::steps(*stage->simulation, 3000);
        std::vector<double> reached = stage->simulation->truth().position;
        for (size_t i = 0; i < reached.size(); i++) {
            const sim::Segment &segment =
                stage->rig.description.segments[static_cast<size_t>(stage->rig.joints[i])];
            double limit = direction > 0 ? segment.upper : segment.lower;
            ck_assert_double_eq_tol(reached[i], limit, 1.5 * degree);
        }
    }
}
END_TEST

START_TEST(test_without_stops_an_overrun_is_seen)
{
    auto stage = fixture::stage({"robot.hard_stops=false"}, middle);

    stage->simulation->command({0, 0.5, 0, 0, 0, 0});
    fixture::steps(*stage->simulation, 1500);
    ck_assert_double_gt(stage->simulation->truth().position[1], 5 * degree);
}
END_TEST

START_TEST(test_encoders_err_as_configured)
{
    const int n = 4000;

    for (const char *kind : {"encoder.distribution=gaussian", "encoder.distribution=uniform"}) {
        auto stage = fixture::stage({kind, "encoder.noise=0.02"}, middle);
        double sum = 0, squares = 0, true_value = stage->simulation->truth().position[0];
        for (int i = 0; i < n; i++) {
            double e = stage->simulation->read_encoders().position[0] - true_value;
            sum += e;
            squares += e * e;
        }
        bool gaussian = std::string(kind).find("gaussian") != std::string::npos;
        double expected = 0.02 * degree * (gaussian ? 1 : std::sqrt(1.0 / 3));
        ck_assert_double_lt(std::fabs(sum / n), 5 * expected / std::sqrt(n));
        ck_assert_double_eq_tol(std::sqrt(squares / n), expected, 0.06 * expected);
    }
}
END_TEST

/* The same seed and the same calls give the same bits; another seed other readings. */
START_TEST(test_runs_repeat_to_the_bit)
{
    std::vector<double> readings[3];

    for (int run = 0; run < 3; run++) {
        auto stage = fixture::stage({}, middle, 0, run < 2 ? 7 : 8);
        for (int period = 0; period < 100; period++) {
            double v = 0.4 * std::sin(0.1 * period);
            stage->simulation->command({v, -v, v, v, v, -v});
            if (period == 40)
                stage->simulation->set_tool(1);
            fixture::steps(*stage->simulation, 20);
            sim::Reading reading = stage->simulation->read_encoders();
            Eigen::Vector3d ball = stage->simulation->truth().ball;
            readings[run].insert(readings[run].end(), reading.position.begin(),
                                 reading.position.end());
            readings[run].insert(readings[run].end(), ball.data(), ball.data() + 3);
        }
    }
    ck_assert(readings[0] == readings[1]);
    ck_assert(readings[0] != readings[2]);
}
END_TEST

START_TEST(test_reset_returns_to_the_start)
{
    auto stage = fixture::stage({}, middle, 1);

    fixture::steps(*stage->simulation, 2000);
    Eigen::Vector3d settled = stage->simulation->truth().ball;
    stage->simulation->command({0.5, 0.2, 0.2, 0.5, 0.5, 0.5});
    fixture::steps(*stage->simulation, 500);
    stage->simulation->reset();
    fixture::steps(*stage->simulation, 2000);
    ck_assert_double_lt((stage->simulation->truth().ball - settled).norm(), 1e-4);
    ck_assert_int_eq(stage->simulation->tool(), 1);
}
END_TEST

int main()
{
    const TTest *tests[] = {test_bodies_are_where_kinematics_says,
                            test_motors_hold_against_gravity,
                            test_motors_reach_the_commanded_speed_as_fast_as_allowed,
                            test_speed_limit_of_the_urdf_holds,
                            test_torque_limit_of_the_urdf_holds,
                            test_stops_stop_at_the_limits,
                            test_without_stops_an_overrun_is_seen,
                            test_encoders_err_as_configured,
                            test_runs_repeat_to_the_bit,
                            test_reset_returns_to_the_start};
    return SUITE_RUN("simrobot robot", tests);
}
