/* What the simulator refuses: robots and configurations that cannot be. */
#include <cstring>

#include "fixture.h"
#include "simrobot/eyes/exposures.h"
#include "tests/unit/suite.h"

using fixture::replaced;
using fixture::shipped_urdf;
using fixture::UrdfFile;

namespace
{

void assert_names(const std::string &complaint, std::initializer_list<const char *> words)
{
    for (const char *word : words)
        if (!strstr(complaint.c_str(), word))
            ck_abort_msg("'%s' does not name '%s'", complaint.c_str(), word);
    ck_assert_ptr_null(strchr(complaint.c_str(), '\n'));
}

} // namespace

START_TEST(test_missing_joint_is_named)
{
    UrdfFile file(replaced(shipped_urdf(), "name=\"elbow\"", "name=\"ellbow\""));
    assert_names(file.complaint(), {file.path(), "elbow"});
}
END_TEST

START_TEST(test_missing_link_is_named)
{
    UrdfFile file(replaced(shipped_urdf(), "\"left_eye\"", "\"left_ear\""));
    assert_names(file.complaint(), {file.path(), "left_eye"});
}
END_TEST

START_TEST(test_unusable_joints_are_refused)
{
    UrdfFile loose(replaced(shipped_urdf(), "name=\"elbow\" type=\"revolute\"",
                            "name=\"elbow\" type=\"floating\""));
    assert_names(loose.complaint(), {loose.path(), "elbow", "revolute"});
    UrdfFile weak(replaced(shipped_urdf(), "upper=\"-0.087266\" effort=\"40\"",
                           "upper=\"-0.087266\" effort=\"0\""));
    assert_names(weak.complaint(), {weak.path(), "positive"});
    UrdfFile massless(replaced(shipped_urdf(), "<mass value=\"1.3\"/>", "<mass value=\"0\"/>"));
    assert_names(massless.complaint(), {massless.path(), "upper_arm", "mass"});
}
END_TEST

START_TEST(test_what_is_no_urdf_is_refused)
{
    for (const char *text : {"", "hello", "<robot/>",
                             "<robot name='x'><link name='a'/><link "
                             "name='b'/></robot>"}) {
        UrdfFile file(text);
        assert_names(file.complaint(), {file.path()});
    }
    sim::Config config = fixture::config({"robot.urdf=/nonexistent.urdf"});
    sim::Rig rig;
    std::string error;
    ck_assert(!sim::rig_load(config, &rig, &error));
    assert_names(error, {"/nonexistent.urdf"});
}
END_TEST

/* Every cut of the shipped file: refused or taken, but never a crash. */
START_TEST(test_truncated_urdf_never_crashes)
{
    std::string text = shipped_urdf();
    for (size_t length = 0; length < text.size(); length += 197)
        UrdfFile(text.substr(0, length)).complaint();
}
END_TEST

START_TEST(test_configuration_that_contradicts_itself_is_refused)
{
    UrdfFile file(shipped_urdf());
    assert_names(file.complaint({"robot.arm_joints=elbow elbow"}), {"elbow", "twice"});
    assert_names(file.complaint({"robot.start=[1, 2]"}), {"robot.start", "6"});
    assert_names(file.complaint({"robot.head_joints=neck_yaw", "robot.start=[]"}),
                 {"robot.head_joints"});
    assert_names(file.complaint({"robot.hand_link=torso"}), {"torso", "move"});
    ck_assert(file.complaint().empty());
}
END_TEST

START_TEST(test_options_are_checked)
{
    const char *wrong[] = {"tool1.direction=[0, 0, 0]", "tool1.direction=[1, 0]",
                           "ball.colour=[1]",           "tool9.kind=tube",
                           "eyes.focal_length=-3",      "tool1.kind=whip"};
    std::string path = fixture::configuration_path();

    for (const char *override : wrong) {
        sim::Config config;
        std::string error, name(override, strchr(override, '='));
        ck_assert(!sim::config_load(&config, path.c_str(), &override, 1, &error));
        assert_names(error, {name.c_str()});
    }
}
END_TEST

/* 30 Hz in whole milliseconds, 33 33 34; the image due is the newest whose latency is over. */
START_TEST(test_exposures_keep_their_grid)
{
    sim::Exposures exposures(33000);
    std::vector<int64_t> at;

    for (int64_t step = 0; step <= 1000; step++)
        if (sim::Exposures::at_step(step)) {
            at.push_back(step);
            ck_assert_int_eq(exposures.add(step * 1000), static_cast<int64_t>(at.size()));
        }
    ck_assert_uint_eq(at.size(), 30);
    const int64_t first[] = {33, 66, 100, 133, 166, 200};
    ck_assert(std::equal(first, first + 6, at.begin()));
    ck_assert_int_eq(exposures.due(65999), 0);
    ck_assert_int_eq(exposures.due(66000), 33000);
    ck_assert_int_eq(exposures.due(98999), 33000);
    ck_assert_int_eq(exposures.due(99000), 66000);
}
END_TEST

int main()
{
    const TTest *tests[] = {
        test_missing_joint_is_named,       test_missing_link_is_named,
        test_unusable_joints_are_refused,  test_what_is_no_urdf_is_refused,
        test_truncated_urdf_never_crashes, test_configuration_that_contradicts_itself_is_refused,
        test_options_are_checked,          test_exposures_keep_their_grid};
    return SUITE_RUN("simrobot input", tests);
}
