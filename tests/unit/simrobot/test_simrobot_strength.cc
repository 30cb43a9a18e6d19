/* Gravity's torques, and the motors that cannot hold them. */
#include <cmath>
#include <cstring>

#include "fixture.h"
#include "simrobot/world/strength.h"
#include "tests/unit/suite.h"

using fixture::UrdfFile;

namespace
{

constexpr char shipped[][24] = {"simrobot-kobian.yaml", "simrobot-icub.yaml",
                                "simrobot-sixaxis.yaml"};

} // namespace

/* A force does the work by which the height of the masses changes: torques against differences of
 * the potential energy. */
START_TEST(test_torques_are_the_slope_of_the_potential_energy)
{
    sim::Random random(fixture::test_seed(), 4);
    const double step = 1e-6;

    for (const char *name : shipped) {
        sim::Config config = fixture::config({}, name);
        sim::Rig rig = fixture::rig(config);
        auto energy = [&](const std::vector<double> &angles) {
            std::vector<Eigen::Isometry3d> poses = sim::rig_forward(rig, angles);
            double sum = config.ball_mass * sim::rig_link(rig.hand, poses).translation().z();
            for (size_t i = 1; i < poses.size(); i++) {
                const sim::Segment &segment = rig.description.segments[i];
                sum += segment.mass * (poses[i] * segment.centre_of_mass).z();
            }
            return 9.81 * sum;
        };
        for (int trial = 0; trial < 20; trial++) {
            std::vector<double> angles;
            for (size_t i = 0; i < rig.joints.size(); i++)
                angles.push_back(random.uniform(-2, 2));
            std::vector<double> torques = sim::gravity_torques(rig, config.ball_mass, angles);
            for (size_t i = 0; i < angles.size(); i++) {
                std::vector<double> more = angles, less = angles;
                more[i] += step;
                less[i] -= step;
                ck_assert_double_eq_tol(torques[i], (energy(less) - energy(more)) / (2 * step),
                                        1e-5);
            }
        }
    }
}
END_TEST

/* 2 kg at 0.5 m: 9.81 N m when level, and that is as long as the arm points within 30 degrees of
 * level for a motor of 8.5 N m: a third of the turn. The other one slides upwards with 3 kg. */
START_TEST(test_a_weak_motor_is_named_with_its_need)
{
    UrdfFile file(
        "<robot name='weak'><link name='base'/>"
        "<joint name='lift' type='prismatic'><parent link='base'/><child link='car'/><axis xyz='0 "
        "0 "
        "1'/><limit lower='0' upper='1' effort='29' velocity='1'/></joint>"
        "<link name='car'><inertial><mass value='1'/><inertia ixx='0.01' ixy='0' ixz='0' "
        "iyy='0.01' "
        "iyz='0' izz='0.01'/></inertial></link>"
        "<joint name='turn' type='continuous'><parent link='car'/><child link='arm'/><axis xyz='0 "
        "1 "
        "0'/><limit effort='8.4957' velocity='1'/></joint>"
        "<link name='arm'><inertial><origin xyz='0.5 0 0'/><mass value='2'/><inertia ixx='0.01' "
        "ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link></robot>");
    sim::Rig rig = fixture::rig(file.config({"robot.arm_joints=lift turn", "robot.hand_link=arm",
                                             "robot.start=[]", "robot.collisions=false"},
                                            "simrobot-icub.yaml"));
    std::vector<std::string> notes = sim::strength_notes(rig, 0);

    ck_assert_uint_eq(notes.size(), 2);
    ck_assert_ptr_nonnull(strstr(notes[0].c_str(), "joint lift"));
    ck_assert_ptr_nonnull(strstr(notes[0].c_str(), "100.0 %"));
    ck_assert_ptr_nonnull(strstr(notes[0].c_str(), "29 N, up to 29.43"));
    ck_assert_ptr_nonnull(strstr(notes[1].c_str(), "joint turn"));
    ck_assert_ptr_nonnull(strstr(notes[1].c_str(), "N m, up to 9.81"));
    const char *share = strstr(notes[1].c_str(), "in ");
    ck_assert_double_eq_tol(strtod(share + 3, nullptr), 100.0 / 3, 4);
}
END_TEST

START_TEST(test_the_shipped_robots_hold_themselves)
{
    for (const char *name : shipped) {
        sim::Config config = fixture::config({}, name);
        ck_assert_uint_eq(sim::strength_notes(fixture::rig(config), config.ball_mass).size(), 0);
    }
}
END_TEST

int main()
{
    const TTest *tests[] = {test_torques_are_the_slope_of_the_potential_energy,
                            test_a_weak_motor_is_named_with_its_need,
                            test_the_shipped_robots_hold_themselves};
    return SUITE_RUN("simrobot strength", tests);
}
