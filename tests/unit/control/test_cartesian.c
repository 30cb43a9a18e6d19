/* The control step in a Cartesian task space, on a robot without bodies: it learns while it moves,
 * tells tools apart by where they are measured, and reaches for places in metres. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static void begin(void)
{
    world_begin(fixture_robot_config("icub.yaml"), 0.0005);
    world_step();
}

static double error_to(const double target[3])
{
    double position[3], sum = 0;

    fake_robot_position(&world.robot, position);
    for (int axis = 0; axis < 3; axis++)
        sum += (position[axis] - target[axis]) * (position[axis] - target[axis]);
    return sqrt(sum);
}

/* A place that the end-effector has when each joint is so far through its range. */
static void place_at(const double share[7], double place[3])
{
    double kept[MAX_JOINTS];

    memcpy(kept, world.robot.q, sizeof kept);
    for (int i = 0; i < 7; i++)
        world.robot.q[i] =
            world.config.arm_min.value[i] +
            share[i] * (world.config.arm_max.value[i] - world.config.arm_min.value[i]);
    fake_robot_position(&world.robot, place);
    memcpy(world.robot.q, kept, sizeof kept);
}

/* Reaches for places all over the middle of the workspace. Returns the largest error, m. */
static double worst_reach(bool learn)
{
    const double shares[5][7] = {{.3, .4, .5, .6, .5, .4, .6},
                                 {.7, .6, .5, .4, .4, .6, .4},
                                 {.5, .3, .6, .3, .6, .5, .3},
                                 {.4, .7, .4, .7, .3, .6, .5},
                                 {.6, .5, .6, .5, .7, .3, .7}};
    double worst = 0;

    for (int i = 0; i < 5; i++) {
        reach_request_t request = {
            .kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 4, .learn = learn};
        place_at(shares[i], request.target[0]);
        world_run(request);
        worst = fmax(worst, error_to(request.target[0]));
    }
    return worst;
}

START_TEST(every_measurement_on_the_way_is_a_sample)
{
    begin();
    world_babble(500, 1);
    ck_assert_int_eq(world.outputs.status.progress, 500);
    ck_assert_int_eq(world.outputs.status.samples, 500);
    ck_assert_int_eq(world.outputs.status.space, REACH_STATUS_T_CARTESIAN);
    ck_assert_int_eq(world.outputs.command.n_joints, 7);
    ck_assert_int_lt(world.outputs.status.seq, 520);
    world_end();
}
END_TEST

START_TEST(it_reaches_with_each_tool_that_it_has_met)
{
    double hand, tool;

    begin();
    world_babble(4000, 1);
    hand = worst_reach(false);
    ck_assert_msg(hand < 0.003, "hand: %g m", hand);
    world.robot.tool = 0.28;
    world_babble(4000, 2);
    ck_assert_int_eq(world.outputs.status.solutions, 2);
    tool = worst_reach(false);
    ck_assert_msg(tool < 0.003, "tool: %g m", tool);
    ck_assert_int_eq(world.outputs.status.context, 2);
    /* Nothing but the measured place says that it is gone. */
    world.robot.tool = 0;
    for (int i = 0; i < 50; i++)
        world_step();
    ck_assert_int_eq(world.outputs.status.context, 1);
    hand = worst_reach(false);
    ck_assert_msg(hand < 0.003, "hand again: %g m", hand);
    ck_assert_int_eq(world.outputs.status.context, 1);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

START_TEST(a_tool_is_learned_while_it_reaches)
{
    int64_t before;
    double tool;

    begin();
    world_babble(3000, 1);
    world.robot.tool = 0.28;
    before = world.outputs.status.samples;
    worst_reach(true);
    ck_assert_int_gt(world.outputs.status.samples, before + 900);
    tool = worst_reach(true);
    ck_assert_msg(tool < 0.01, "%g m", tool);
    ck_assert_int_eq(world.outputs.status.contexts, 2);
    world_end();
}
END_TEST

START_TEST(an_arm_that_is_not_measured_holds)
{
    reach_request_t request = {
        .kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 10, .target = {{0.3, -0.1, 0.7}}};

    begin();
    world_babble(500, 1);
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    world.robot.blind = true;
    for (int i = 0; i < 50; i++)
        world_step();
    for (int i = 0; i < 7; i++)
        ck_assert_double_eq(world.outputs.command.velocity[i], 0);
    world_end();
}
END_TEST

START_TEST(what_makes_no_sense_here_is_refused)
{
    begin();
    ck_assert_int_eq(
        world_ask((reach_request_t){
            .kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 2, .target = {{120, 0, 0}}}),
        REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(world_ask((reach_request_t){
                         .kind = REACH_REQUEST_T_COORDINATE, .n_targets = 1, .period = 2}),
                     REACH_STATUS_T_REFUSED_VALUE);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_measurement_on_the_way_is_a_sample, it_reaches_with_each_tool_that_it_has_met,
        a_tool_is_learned_while_it_reaches,       an_arm_that_is_not_measured_holds,
        what_makes_no_sense_here_is_refused,
    };

    return SUITE_RUN("cartesian", tests);
}
