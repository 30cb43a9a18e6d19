/* Links and tool that stop each other: an arm against its own trunk, a tool that is taken through
 * the body, a user's robot against its bench. */
#include <algorithm>
#include <cmath>
#include <cstring>

#include "fixture.h"
#include "tests/unit/suite.h"

namespace
{

constexpr char icub[] = "simrobot-icub.yaml";
constexpr char sixaxis[] = "simrobot-sixaxis.yaml";

struct World {
    explicit World(const sim::Config &wanted)
        : config(wanted), rig(fixture::rig(config)), simulation(config, rig, 1)
    {
    }
    explicit World(std::initializer_list<const char *> overrides = {})
        : World(fixture::config(overrides, icub))
    {
    }

    sim::Config config;
    sim::Rig rig;
    sim::Simulation simulation;
};

const std::vector<double> at_rest = {-40, 40, 40, 50, 0, 0, 10};
/* Forearm across the chest, further than there is room. */
const std::vector<double> into_trunk = {0, 0, 80, 80, 0, 0, 10};

/* The six-axis arm, whose URDF has no <collision>, with two: its bench and its hand. */
std::string bench_and_hand(const char *of_bench)
{
    std::string text = fixture::shipped_urdf(sixaxis);

    text = fixture::replaced(text, "<link name=\"bench\">",
                             "<link name=\"bench\"><collision><geometry>" + std::string(of_bench) +
                                 "</geometry></collision>");
    return fixture::replaced(text, "<link name=\"roller\">",
                             "<link name=\"roller\"><collision><origin xyz=\"0 0 0.07\"/><geometry>"
                             "<cylinder radius=\"0.03\" length=\"0.2\"/></geometry></collision>");
}

std::string complaint(const sim::Config &config)
{
    sim::Rig rig;
    std::string error;
    return sim::rig_load(config, &rig, &error) ? "" : error;
}

} // namespace

START_TEST(test_an_arm_stops_at_the_trunk)
{
    World solid, ghost({"robot.collisions=false"});

    ck_assert_double_lt(fixture::go_to(ghost.simulation, into_trunk), 0.5);
    ck_assert_int_eq(ghost.simulation.truth().touching, 0);
    ck_assert_int_eq(ghost.simulation.touching_steps(), 0);
    ck_assert_double_gt(fixture::go_to(solid.simulation, into_trunk), 5);
    sim::Truth truth = solid.simulation.truth();
    ck_assert_int_gt(truth.touching, 0);
    ck_assert_double_lt(truth.deepest, 0.001);
    ck_assert_int_gt(solid.simulation.touching_steps(), 100);
    for (double speed : truth.velocity)
        ck_assert_double_lt(std::fabs(speed), 0.02);
    ck_assert_double_lt(fixture::go_to(solid.simulation, at_rest), 0.5);
    ck_assert_int_eq(solid.simulation.truth().touching, 0);
}
END_TEST

/* What joints join never touches: the waist over its whole range, elbow and shoulder over theirs.
 */
START_TEST(test_what_belongs_together_does_not_touch)
{
    World world;

    for (double waist : {-30.0, 30.0})
        for (double pitch : {-10.0, 30.0})
            for (double elbow : {20.0, 80.0})
                ck_assert_double_lt(
                    fixture::go_to(world.simulation, {-60, 40, 10, elbow, waist, -waist, pitch}),
                    0.5);
    ck_assert_int_eq(world.simulation.touching_steps(), 0);
}
END_TEST

/* Taken where the trunk is in its way, which its tip is 3 cm inside of: pushed out, not thrown. */
START_TEST(test_a_tool_that_is_taken_through_the_body_comes_out_gently)
{
    const Eigen::Vector3d front(0.05, 0, 0.72);
    World pose;
    Eigen::Isometry3d hand =
        sim::rig_link(pose.rig.hand, sim::rig_forward(pose.rig, pose.simulation.truth().position));
    Eigen::Vector3d way = hand.inverse() * front;
    std::string length = "tool1.length=" + std::to_string(way.norm() + 0.03);
    way.normalize();
    std::string direction = "tool1.direction=[" + std::to_string(way.x()) + ", " +
                            std::to_string(way.y()) + ", " + std::to_string(way.z()) + "]";
    World world({length.c_str(), direction.c_str()});
    double fastest = 0;

    ck_assert(world.simulation.set_tool(1));
    fixture::steps(world.simulation, 1);
    ck_assert_double_gt(world.simulation.truth().deepest, 0.02);
    for (int i = 0; i < 400; i++) {
        fixture::steps(world.simulation, 1);
        fastest = std::max(fastest, world.simulation.truth().ball_speed);
    }
    ck_assert_double_lt(fastest, 1.0);
    ck_assert_double_lt(world.simulation.truth().deepest, 0.001);
}
END_TEST

START_TEST(test_the_same_bumps_give_the_same_bits)
{
    World one, other;

    for (World *world : {&one, &other})
        for (int tool = 0; tool < 3; tool++) {
            ck_assert(world->simulation.set_tool(tool));
            fixture::go_to(world->simulation, into_trunk, 100);
            fixture::go_to(world->simulation, {-80, 0, 80, 80, 30, 10, 0}, 100);
        }
    sim::Truth a = one.simulation.truth(), b = other.simulation.truth();
    ck_assert_int_gt(one.simulation.touching_steps(), 100);
    ck_assert_int_eq(one.simulation.touching_steps(), other.simulation.touching_steps());
    ck_assert(a.position == b.position && a.velocity == b.velocity && a.ball == b.ball);
}
END_TEST

START_TEST(test_a_robot_of_ones_own_stops_at_its_bench)
{
    fixture::UrdfFile file(bench_and_hand("<box size=\"2 2 0.3\"/>"));
    World world(file.config({"robot.collisions=true"}, sixaxis));

    ck_assert_double_gt(fixture::go_to(world.simulation, {0, 78, 80, 0, 0, 0}), 5);
    ck_assert_int_gt(world.simulation.truth().touching, 0);
    ck_assert_double_lt(world.simulation.truth().deepest, 0.001);
}
END_TEST

START_TEST(test_what_cannot_collide_is_refused_where_it_should)
{
    std::initializer_list<const char *> on = {"robot.collisions=true"};
    fixture::UrdfFile mesh(bench_and_hand("<mesh filename=\"bench.stl\"/>"));
    fixture::UrdfFile bare(fixture::shipped_urdf(sixaxis));

    ck_assert_ptr_nonnull(strstr(complaint(mesh.config(on, sixaxis)).c_str(), "link bench"));
    ck_assert_ptr_nonnull(strstr(complaint(bare.config(on, sixaxis)).c_str(), "no link"));
    ck_assert_str_eq(complaint(mesh.config({}, sixaxis)).c_str(), "");
}
END_TEST

int main()
{
    const TTest *tests[] = {test_an_arm_stops_at_the_trunk,
                            test_what_belongs_together_does_not_touch,
                            test_a_tool_that_is_taken_through_the_body_comes_out_gently,
                            test_the_same_bumps_give_the_same_bits,
                            test_a_robot_of_ones_own_stops_at_its_bench,
                            test_what_cannot_collide_is_refused_where_it_should};
    return SUITE_RUN("contacts", tests);
}
