/* Robots that nobody here wrote: what their files leave out, get wrong, or have too much of. */
#include <cmath>
#include <cstring>

#include "fixture.h"
#include "tests/unit/suite.h"

using fixture::degree;
using fixture::replaced;
using fixture::UrdfFile;

namespace
{

const char inertial[] = "<inertial><origin xyz='0.1 0 0'/><mass value='1'/><inertia ixx='0.002' "
                        "ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial>";

/* Line 3: joint one; line 4: link upper. SECOND stands for the second joint's type and what is in
 * it, and its axis is y. */
std::string arm(const std::string &second)
{
    return replaced(
        replaced(
            "<robot name='arm'>\n<link name='base'/>\n"
            "<joint name='one' type='revolute'><parent link='base'/><child link='upper'/>"
            "<axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='50' velocity='2'/></joint>\n"
            "<link name='upper'>INERTIAL</link>\n"
            "<joint name='two' SECOND<parent link='upper'/><child link='lower'/>"
            "<origin xyz='0.3 0 0'/><axis xyz='0 1 0'/></joint>\n"
            "<link name='lower'>INERTIAL</link>\n"
            "<joint name='last' type='fixed'><parent link='lower'/><child link='hand'/>"
            "<origin xyz='0.2 0 0'/></joint>\n<link name='hand'/>\n</robot>\n",
            "INERTIAL", inertial),
        "SECOND", second);
}

const char turning[] = "type='revolute'><limit lower='-1.5' upper='1.5' effort='50' velocity='2'/>";
const char sliding[] = "type='prismatic'><limit lower='0' upper='0.4' effort='50' velocity='0.5'/>";
const char following[] = "type='revolute'><limit lower='-3' upper='3' effort='5' velocity='2'/>"
                         "<mimic joint='one' multiplier='-0.5' offset='0.2'/>";

sim::Config config_of(const UrdfFile &file, std::initializer_list<const char *> more,
                      const char *joints = "robot.arm_joints=one two")
{
    sim::Config config = file.config({joints, "robot.hand_link=hand", "robot.start=[]",
                                      "robot.collisions=false", "physics.step=1"},
                                     "simrobot-icub.yaml");
    for (const char *one : more) {
        if (!strncmp(one, "repair", 6))
            config.repair_inertia = true;
        else
            config.start = {2, {strtod(one, nullptr), strtod(strchr(one, ' '), nullptr)}};
    }
    return config;
}

/* What loading says; `more`: "repair", or two angles of the start in rad. */
std::string complaint(const UrdfFile &file, std::initializer_list<const char *> more = {},
                      const char *joints = "robot.arm_joints=one two")
{
    sim::Rig rig;
    std::string error;
    return sim::rig_load(config_of(file, more, joints), &rig, &error) ? "" : error;
}

void assert_says(const std::string &text, std::initializer_list<const char *> words)
{
    for (const char *word : words)
        if (!strstr(text.c_str(), word))
            ck_abort_msg("'%s' does not say '%s'", text.c_str(), word);
}

void assert_taken(const std::string &text)
{
    ck_assert_str_eq(text.c_str(), "");
}

std::string notes_of(const UrdfFile &file)
{
    sim::Rig rig = fixture::rig(config_of(file, {}));
    std::string notes;
    for (const std::string &note : rig.notes)
        notes += note + "\n";
    return notes;
}

Eigen::Vector3d hand(const sim::Rig &rig, const std::vector<double> &angles)
{
    return sim::rig_link(rig.hand, sim::rig_forward(rig, angles)).translation();
}

} // namespace

/* ODE itself takes such an inertia: the largest moment is more than the others' sum. */
START_TEST(test_an_inertia_that_no_body_has_is_refused_or_repaired)
{
    UrdfFile file(replaced(arm(turning), "ixx='0.002'", "ixx='0.05'"));
    std::string said = complaint(file);

    assert_says(said, {":4: link upper", "0.05", "robot.repair_inertia", ":6: link lower"});
    assert_taken(complaint(file, {"repair"}));
    sim::Rig rig = fixture::rig(config_of(file, {"repair"}));
    double radius = std::cbrt(3 / (4 * M_PI * 1000)); /* of a litre of water */
    for (int i : {1, 2}) {
        const sim::Segment &segment = rig.description.segments[static_cast<size_t>(i)];
        ck_assert_double_eq(segment.mass, 1);
        ck_assert_double_eq(segment.centre_of_mass.x(), 0.1);
        ck_assert_double_eq_tol(segment.inertia(0, 0), 0.4 * radius * radius, 1e-12);
    }
    ck_assert_uint_eq(rig.notes.size(), 2);
}
END_TEST

/* Rounding, a flat plate, and the small parts that hang on a large one are taken. */
START_TEST(test_inertias_of_real_files_are_taken)
{
    UrdfFile plate(replaced(arm(turning), "ixx='0.002'", "ixx='0.02009'"));
    assert_taken(complaint(plate));
    UrdfFile part(
        replaced(arm(turning), "<link name='hand'/>",
                 "<link name='hand'><inertial><mass value='0.01'/><inertia ixx='0' ixy='0' "
                 "ixz='0' iyy='0' iyz='0' izz='1e-5'/></inertial></link>"));
    assert_taken(complaint(part));
    UrdfFile negative(replaced(arm(turning), "<link name='hand'/>",
                               "<link name='hand'><inertial><mass value='-0.01'/><inertia ixx='0' "
                               "ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link>"));
    assert_says(complaint(negative), {"link hand", "negative"});
}
END_TEST

START_TEST(test_a_joint_without_direction_is_refused)
{
    UrdfFile file(replaced(arm(turning), "xyz='0 1 0'", "xyz='0 1e-9 0'"));
    assert_says(complaint(file), {":5: joint two", "direction"});
}
END_TEST

/* urdfdom leaves out the rest of the link then, and returns the robot. */
START_TEST(test_what_urdfdom_gives_up_is_refused)
{
    UrdfFile bare(replaced(arm(turning),
                           "<inertia ixx='0.002' ixy='0' ixz='0' iyy='0.01' iyz='0' "
                           "izz='0.01'/>",
                           ""));
    assert_says(complaint(bare), {bare.path(), "upper"});
    UrdfFile round(replaced(arm(turning), "<link name='hand'/>",
                            "<link name='hand'><visual><geometry><sphere radius='round'/>"
                            "</geometry></visual></link>"));
    assert_says(complaint(round), {round.path(), "hand"});
}
END_TEST

START_TEST(test_what_urdfdom_reads_otherwise_is_read_as_meant)
{
    UrdfFile plain(arm(turning));
    UrdfFile spaced(replaced(replaced(arm(turning), "xyz='0.3 0 0'", "xyz='0.3\t0\n0'"),
                             "xyz='0 1 0'", "xyz=' 0\n\n1\t 0 '"));
    assert_taken(complaint(spaced));
    ck_assert((hand(fixture::rig(config_of(spaced, {})), {0.3, 0.4}) -
               hand(fixture::rig(config_of(plain, {})), {0.3, 0.4}))
                  .norm() < 1e-15);

    /* A quarter turn about x, then 0.2 m along what was x: the second axis points along z. */
    UrdfFile quaternion(replaced(arm(turning), "<origin xyz='0.3 0 0'/>",
                                 "<origin xyz='0.3 0 0' quat_xyzw='0.70710678118654752 0 0 "
                                 "0.70710678118654752'/>"));
    Eigen::Vector3d at = hand(fixture::rig(config_of(quaternion, {})), {0, 0.4});
    ck_assert_double_eq_tol(at.x(), 0.3 + 0.2 * std::cos(0.4), 1e-12);
    ck_assert_double_eq_tol(at.y(), 0.2 * std::sin(0.4), 1e-12);
    assert_says(notes_of(quaternion), {":5: joint two", "quat_xyzw"});

    UrdfFile colour(replaced(arm(turning), "<link name='hand'/>",
                             "<link name='hand'><visual><geometry><sphere radius='0.1'/></geometry>"
                             "<material name='m'><color rgba='0.5 0.25 1'/></material></visual>"
                             "</link>"));
    sim::Rig rig = fixture::rig(config_of(colour, {}));
    ck_assert(rig.description.segments[2].shapes.at(0).colour == Eigen::Vector3f(0.5f, 0.25f, 1));
    assert_says(notes_of(colour), {"link hand", "rgba"});
}
END_TEST

START_TEST(test_limits_that_leave_no_range_are_refused)
{
    for (const char *limit : {"lower='2' upper='-1'", "lower='1' upper='1'", ""}) {
        UrdfFile file(replaced(arm(turning), "lower='-1' upper='2'", limit));
        assert_says(complaint(file), {":3: joint one", *limit ? "range" : "neither"});
    }
    UrdfFile half(replaced(arm(turning), "lower='-1' upper='2'", "upper='2'"));
    assert_says(notes_of(half), {":3: joint one", "lower", "0 deg .. 114.6 deg"});
}
END_TEST

START_TEST(test_a_start_outside_the_limits_is_refused)
{
    UrdfFile file(arm(turning));
    assert_says(complaint(file, {"2.5 0"}), {"joint one", "143.2 deg", "-57.3 deg .. 114.6 deg"});
    UrdfFile raised(replaced(arm(turning), "lower='-1.5'", "lower='0.5'"));
    sim::Rig rig = fixture::rig(config_of(raised, {}));
    ck_assert_double_eq(rig.start[0], 0);
    ck_assert_double_eq(rig.start[1], 1);
    assert_says(notes_of(raised), {"joint two", "57.3 deg"});
}
END_TEST

/* Whatever kind of joint it is and whatever is wrong with its motor. */
START_TEST(test_joints_that_nobody_drives_stand_still_and_cost_nothing)
{
    for (const char *second :
         {turning, sliding, "type='floating'>", "type='planar'>", "type='revolute'>",
          "type='continuous'><limit effort='0' velocity='0'/>", "type='prismatic'>"}) {
        UrdfFile file(arm(second));
        sim::Rig rig = fixture::rig(config_of(file, {}, "robot.arm_joints=one"));
        ck_assert_uint_eq(rig.description.segments.size(), 2);
        ck_assert_double_eq(rig.description.segments[1].mass, 2);
        ck_assert_double_eq_tol(hand(rig, {0}).x(), 0.5, 1e-12);
    }
    UrdfFile loop(arm("type='revolute'><mimic joint='two'/>"));
    assert_says(complaint(loop, {}, "robot.arm_joints=one"), {"joint two", "itself"});
    UrdfFile lost(arm("type='revolute'><mimic joint='three'/>"));
    assert_says(complaint(lost, {}, "robot.arm_joints=one"), {"joint two", "three"});
}
END_TEST

/* Commands for some seconds; the bodies stay where kinematics has them. */
static void run_and_compare(const sim::Config &config, const sim::Rig &rig, double tolerance)
{
    sim::Simulation simulation(config, rig, 1);
    std::vector<double> speeds(rig.joints.size());

    for (int i = 0; i < 4000; i++) {
        for (size_t k = 0; k < speeds.size(); k++)
            speeds[k] = 0.4 * std::sin(0.002 * i + static_cast<double>(k));
        simulation.command(speeds);
        simulation.step();
        if (i % 50 == 0)
            ck_assert_double_lt(
                (hand(rig, simulation.truth().position) - simulation.truth().ball).norm(),
                tolerance);
    }
}

START_TEST(test_a_joint_that_follows_another_does)
{
    UrdfFile file(arm(following));
    sim::Config config = config_of(file, {}, "robot.arm_joints=one");
    sim::Rig rig = fixture::rig(config);

    double second = -0.5 * 0.8 + 0.2;
    Eigen::Vector3d out(0.3 + 0.2 * std::cos(second), 0, -0.2 * std::sin(second));
    ck_assert_double_lt(
        (hand(rig, {0.8}) - Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) * out).norm(), 1e-12);
    run_and_compare(config, rig, 1e-4);
    assert_says(complaint(file), {":5: joint two", "joint one"});

    UrdfFile fixed(replaced(arm(following), "joint='one'", "joint='last'"));
    sim::Rig still = fixture::rig(config_of(fixed, {}, "robot.arm_joints=one"));
    ck_assert_double_eq_tol(hand(still, {0}).z(), -0.2 * std::sin(0.2), 1e-12);
    ck_assert_uint_eq(still.description.segments.size(), 2);
}
END_TEST

START_TEST(test_a_joint_that_slides_does)
{
    UrdfFile file(arm(sliding));
    sim::Config config = config_of(file, {"0.3 0.0034906585"}); /* 0.2 "degrees": 0.2 m */
    sim::Rig rig = fixture::rig(config);

    ck_assert_double_eq_tol(rig.start[1], 0.2, 1e-9);
    Eigen::Vector3d out(0.5, 0.2, 0);
    ck_assert_double_lt(
        (hand(rig, {0.3, 0.2}) - Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) * out).norm(),
        1e-12);
    run_and_compare(config, rig, 1e-4);
    sim::Simulation simulation(config, rig, 1);
    double fastest = 0;
    for (int i = 0; i < 4000; i++) {
        simulation.command({0, i / 1000 % 2 ? -0.5 : 0.5});
        simulation.step();
        fastest = std::max(fastest, std::fabs(simulation.truth().velocity[1]));
        ck_assert_double_gt(simulation.truth().position[1], -0.004);
        ck_assert_double_lt(simulation.truth().position[1], 0.404);
        if (i == 999)
            ck_assert_double_gt(simulation.truth().position[1], 0.399);
    }
    ck_assert_double_gt(fastest, 0.49);
    ck_assert_double_lt(fastest, 0.55);
}
END_TEST

START_TEST(test_all_that_is_wrong_is_said_at_once)
{
    UrdfFile file(replaced(replaced(arm(turning), "lower='-1' upper='2'", "lower='2' upper='1'"),
                           "xyz='0 1 0'", "xyz='0 1e-9 0'"));
    std::string said = complaint(file, {}, "robot.arm_joints=one two three");
    assert_says(said, {"joint one", "joint two", "joint three"});
    ck_assert_int_eq(std::count(said.begin(), said.end(), '\n'), 2);
}
END_TEST

START_TEST(test_joint_names_may_have_blanks)
{
    UrdfFile file(replaced(replaced(arm(turning), "name='one'", "name='the shoulder'"),
                           "name='two'", "name='an elbow'"));
    assert_taken(complaint(file, {}, "robot.arm_joints=[the shoulder, an elbow]"));
    assert_says(complaint(file, {}, "robot.arm_joints=the shoulder"), {"joint the is missing"});
}
END_TEST

START_TEST(test_xacro_says_what_to_run)
{
    UrdfFile file(replaced(arm(turning), "<link name='hand'/>",
                           "<link name='hand'/><xacro:wheel name='w'/>"));
    assert_says(complaint(file), {"xacro ", " > robot.urdf"});
    sim::Config config = config_of(file, {});
    snprintf(config.urdf, sizeof config.urdf, "some/arm.urdf.xacro");
    sim::Rig rig;
    std::string error;
    ck_assert(!sim::rig_load(config, &rig, &error));
    assert_says(error, {"xacro some/arm.urdf.xacro > robot.urdf"});
}
END_TEST

int main()
{
    const TTest *tests[] = {test_an_inertia_that_no_body_has_is_refused_or_repaired,
                            test_inertias_of_real_files_are_taken,
                            test_a_joint_without_direction_is_refused,
                            test_what_urdfdom_gives_up_is_refused,
                            test_what_urdfdom_reads_otherwise_is_read_as_meant,
                            test_limits_that_leave_no_range_are_refused,
                            test_a_start_outside_the_limits_is_refused,
                            test_joints_that_nobody_drives_stand_still_and_cost_nothing,
                            test_a_joint_that_follows_another_does,
                            test_a_joint_that_slides_does,
                            test_all_that_is_wrong_is_said_at_once,
                            test_joint_names_may_have_blanks,
                            test_xacro_says_what_to_run};
    return SUITE_RUN("simrobot public", tests);
}
