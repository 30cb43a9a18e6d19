/* A joint between its stops, at them, and past half a turn. */
#include <cmath>
#include <cstdio>

#include "fixture.h"
#include "tests/unit/suite.h"

namespace
{

constexpr double limit_speed = 2;     /* rad/s, of every joint made here */
constexpr double stop_yields = 0.026; /* rad: 1 degree for the motor, half for the weight */

struct Range {
    double lower, upper; /* rad */
};

/* An arm of one joint across gravity: 1 kg, 0.3 m from the axis. A range without end is a
 * continuous joint. */
std::string one_joint(const Range &range, double effort)
{
    char text[1500];
    bool ends = std::isfinite(range.lower);

    snprintf(text, sizeof text,
             "<robot name='one'><link name='base'/><joint name='turn' type='%s'><parent "
             "link='base'/><child link='arm'/><origin xyz='0 0 0.5' rpy='0 1.1 0'/><axis xyz='0 1 "
             "0'/><limit lower='%.17g' upper='%.17g' effort='%g' velocity='%g'/></joint><link "
             "name='arm'><inertial><origin xyz='0.3 0 0'/><mass value='1'/><inertia ixx='0.002' "
             "ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link></robot>",
             ends ? "revolute" : "continuous", ends ? range.lower : 0, ends ? range.upper : 0,
             effort, limit_speed);
    return text;
}

class Bench
{
public:
    Bench(const Range &range, double effort, double start, const char *step = "physics.step=1")
        : range_(range), file_(one_joint(range, effort)),
          config_(file_.config({"robot.arm_joints=turn", "robot.hand_link=arm", "robot.start=[0]",
                                "robot.collisions=false", step},
                               "simrobot-icub.yaml"))
    {
        config_.start.value[0] = start;
        rig_ = fixture::rig(config_);
        simulation_ = std::make_unique<sim::Simulation>(config_, rig_, 1);
        last_ = start;
        ck_assert_double_eq_tol(position(), start, 1e-9);
    }

    double position() const
    {
        return simulation_->truth().position[0];
    }

    /* Runs at this speed for so many seconds; nothing jumps, nothing is thrown, nothing passes its
     * stops, and the angle is the one that kinematics has. */
    void run(double speed, double seconds)
    {
        double step = 1e-6 * static_cast<double>(simulation_->step_us());
        simulation_->command({speed});
        for (int i = 0; i < seconds / step; i++) {
            simulation_->step();
            sim::Truth truth = simulation_->truth();
            double moved = truth.position[0] - last_;
            ck_assert_double_lt(std::fabs(truth.velocity[0]), 1.2 * limit_speed);
            ck_assert_double_lt(std::fabs(moved), 1.2 * limit_speed * step);
            ck_assert_double_gt(truth.position[0], range_.lower - stop_yields);
            ck_assert_double_lt(truth.position[0], range_.upper + stop_yields);
            last_ = truth.position[0];
        }
        Eigen::Vector3d hand =
            sim::rig_link(rig_.hand, sim::rig_forward(rig_, {last_})) * Eigen::Vector3d::Zero();
        ck_assert_double_lt((hand - simulation_->truth().ball).norm(), 1e-5);
    }

private:
    Range range_;
    fixture::UrdfFile file_;
    sim::Config config_;
    sim::Rig rig_;
    std::unique_ptr<sim::Simulation> simulation_;
    double last_;
};

const double turn = 2 * M_PI;

} // namespace

/* From the middle to both stops and back, ranges up to four half turns each way; 0.82 .. 5.46 and
 * 6.28 are those of arms that are sold. */
START_TEST(test_every_range_is_swept_without_a_jump)
{
    const Range ranges[] = {{-0.5, 0.5},   {0.82, 5.46}, {-6.28, 6.28}, {-2 * turn, 2 * turn},
                            {-3.14, 3.14}, {3.1, 3.2},   {-9.5, -6.2},  {10, 12.5}};

    for (const Range &range : ranges)
        for (const char *step : {"physics.step=1", "physics.step=5"}) {
            double middle = (range.lower + range.upper) / 2, width = range.upper - range.lower;
            Bench bench(range, 50, middle, step);
            bench.run(limit_speed, width / 2 / limit_speed + 0.5);
            ck_assert_double_eq_tol(bench.position(), range.upper, stop_yields);
            bench.run(-limit_speed, width / limit_speed + 0.5);
            ck_assert_double_eq_tol(bench.position(), range.lower, stop_yields);
            bench.run(0, 0.3); /* the driver's ramp */
            bench.run(limit_speed, width / 2 / limit_speed + 0.1);
            ck_assert_double_gt(bench.position(), range.lower + width / 4);
        }
}
END_TEST

START_TEST(test_a_continuous_joint_counts_its_turns)
{
    Bench bench({-INFINITY, INFINITY}, 50, 0);

    bench.run(limit_speed, 10);
    ck_assert_double_gt(bench.position(), 19.5);
    bench.run(-limit_speed, 20);
    ck_assert_double_eq_tol(bench.position(), -20, 0.6);
}
END_TEST

/* Slow and fast, with torques from what the arm needs up to what some files claim. */
START_TEST(test_a_motor_leaves_its_stop_at_its_own_speed)
{
    for (double effort : {8.0, 50.0, 50000.0})
        for (double speed : {0.1, 0.5, 2.0}) {
            Bench bench({-0.5, 0.5}, effort, 0.4);
            bench.run(2, 1);
            ck_assert_double_eq_tol(bench.position(), 0.5, stop_yields);
            bench.run(0, 0.3); /* the driver's ramp */
            bench.run(-speed, 0.4 / speed + 0.1);
            ck_assert_double_lt(bench.position(), 0.25);
            ck_assert_double_gt(bench.position(), -0.25);
            bench.run(-2, 1);
            ck_assert_double_eq_tol(bench.position(), -0.5, stop_yields);
            bench.run(0, 0.5);
            ck_assert_double_eq_tol(bench.position(), -0.5, stop_yields);
            bench.run(speed, 0.4 / speed + 0.1);
            ck_assert_double_gt(bench.position(), -0.25);
        }
}
END_TEST

/* Random commands, half of the time against a stop. */
START_TEST(test_no_joint_of_a_shipped_robot_is_thrown)
{
    uint64_t seed = fixture::test_seed();

    for (const char *name :
         {"simrobot-kobian.yaml", "simrobot-icub.yaml", "simrobot-sixaxis.yaml"}) {
        sim::Config config = fixture::config({"robot.collisions=false"}, name);
        sim::Rig rig = fixture::rig(config);
        sim::Simulation simulation(config, rig, seed);
        sim::Random random(seed, 9);
        std::vector<double> velocities(rig.joints.size());
        for (int period = 0; period < 600; period++) {
            if (period % 50 == 0)
                for (double &velocity : velocities)
                    velocity = random.uniform(-4, 4);
            simulation.command(velocities);
            for (int i = 0; i < simulation.steps_in_period(); i++) {
                simulation.step();
                std::vector<double> now = simulation.truth().velocity;
                for (size_t k = 0; k < now.size(); k++)
                    ck_assert_double_lt(
                        std::fabs(now[k]),
                        1.2 *
                            rig.description.segments[static_cast<size_t>(rig.joints[k])].velocity);
            }
        }
    }
}
END_TEST

int main()
{
    const TTest *tests[] = {
        test_every_range_is_swept_without_a_jump, test_a_continuous_joint_counts_its_turns,
        test_a_motor_leaves_its_stop_at_its_own_speed, test_no_joint_of_a_shipped_robot_is_thrown};
    return SUITE_RUN("simrobot joints", tests);
}
