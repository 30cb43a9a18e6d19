/* What the simulator says of a daemon that refuses its states, or stops for a joint. */
#include <cstring>

#include "fixture.h"
#include "simrobot/run/daemon_watch.h"
#include "tests/unit/suite.h"

namespace
{

constexpr int64_t second = 1000000;

/* The six-axis arm, whose shoulder holds it with 120 N m. */
class Watched
{
public:
    explicit Watched(double effort = 120)
        : config_(fixture::config({}, "simrobot-sixaxis.yaml")), rig_(fixture::rig(config_)),
          watch_(rig_, config_.ball_mass)
    {
        rig_.description.segments[static_cast<size_t>(rig_.joints[1])].effort = effort;
        state.n_joints = 6;
        state.position[1] = 1.3; /* leans far out */
    }

    std::string look(int64_t now)
    {
        return watch_.look(status, state, now);
    }

    reach_status_t status = {};
    reach_robot_state_t state = {};

private:
    sim::Config config_;
    sim::Rig rig_;
    sim::DaemonWatch watch_;
};

bool says(const std::string &line, const char *part)
{
    return strstr(line.c_str(), part) != nullptr;
}

} // namespace

START_TEST(test_a_refused_state_is_told_by_the_joints_name)
{
    Watched watched;

    ck_assert_str_eq(watched.look(second).c_str(), "");
    watched.status.refused_state = 7;
    watched.status.refused_joint = 3;
    watched.status.refused_value = 1.25;
    watched.status.refused_max = 0.5;
    std::string line = watched.look(2 * second);
    ck_assert_msg(says(line, "refuses state 7: joint elbow is at 1.25"), "%s", line.c_str());
    ck_assert(says(line, "arm.max"));
}
END_TEST

START_TEST(test_what_goes_on_is_said_again_but_seldom)
{
    Watched watched;
    int said = 0;

    for (int i = 1; i <= 250; i++) { /* 25 s */
        watched.status.refused_state = i;
        said += !watched.look(i * second / 10).empty();
    }
    ck_assert_int_eq(said, 3);
    said = 0;
    for (int i = 251; i <= 500; i++) /* and no state was refused any more */
        said += !watched.look(i * second / 10).empty();
    ck_assert_int_eq(said, 0);
}
END_TEST

START_TEST(test_another_number_of_joints)
{
    Watched watched;

    for (int joint : {0, 7, -1}) {
        watched.status.refused_state++;
        watched.status.refused_joint = joint;
        std::string line = watched.look(watched.status.refused_state * 11 * second);
        ck_assert_msg(says(line, "configured for these 6 joints?"), "%s", line.c_str());
    }
}
END_TEST

START_TEST(test_a_joint_that_stops_is_too_weak_or_held)
{
    Watched weak(10), strained(16), strong;

    for (Watched *watched : {&weak, &strained, &strong}) {
        watched->status.fault = REACH_STATUS_T_FAULT_STILL;
        watched->status.fault_joint = 2;
    }
    std::string line = weak.look(second);
    ck_assert_msg(says(line, "joint shoulder does not follow; its motor has 10 N m, and"), "%s",
                  line.c_str());
    ck_assert(says(line, "too weak for this posture"));
    line = strained.look(second);
    ck_assert_msg(says(line, "little is left to move the arm with"), "%s", line.c_str());
    line = strong.look(second);
    ck_assert_msg(says(line, "something holds it"), "%s", line.c_str());
    ck_assert_str_eq(strong.look(2 * second).c_str(), "");
    weak.status.fault = REACH_STATUS_T_FAULT_EMERGENCY;
    ck_assert_str_eq(weak.look(3 * second).c_str(), "");
}
END_TEST

int main()
{
    const TTest *tests[] = {
        test_a_refused_state_is_told_by_the_joints_name, test_what_goes_on_is_said_again_but_seldom,
        test_another_number_of_joints, test_a_joint_that_stops_is_too_weak_or_held};
    return SUITE_RUN("simrobot's look at the daemon", tests);
}
