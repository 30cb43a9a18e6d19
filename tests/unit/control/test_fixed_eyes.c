/* The control step in a task space of two cameras that nobody turns, on a robot without bodies: it
 * learns wherever its cameras see the marker, and reaches for places in their images. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static void begin(void)
{
    world_begin(fixture_robot_config("watched.yaml"), 0.3);
    world_step();
}

/* What the cameras see when each joint is so far through its babbled range. */
static void image_at(const double share[4], double image[3])
{
    double kept[MAX_JOINTS];

    memcpy(kept, world.robot.q, sizeof kept);
    for (int i = 0; i < 4; i++)
        world.robot.q[i] =
            world.config.babble_min.value[i] +
            share[i] * (world.config.babble_max.value[i] - world.config.babble_min.value[i]);
    fake_robot_image(&world.robot, image);
    memcpy(world.robot.q, kept, sizeof kept);
}

/* Reaches for places in the images. Returns the largest error, px. */
static double worst_reach(void)
{
    const double shares[4][4] = {
        {.3, .4, .5, .6}, {.7, .6, .5, .4}, {.5, .3, .6, .3}, {.4, .7, .4, .7}};
    double worst = 0;

    for (int i = 0; i < 4; i++) {
        reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 4};
        double image[3], sum = 0;
        image_at(shares[i], request.target[0]);
        world_run(request);
        fake_robot_image(&world.robot, image);
        for (int axis = 0; axis < 3; axis++)
            sum += pow(image[axis] - request.target[0][axis], 2);
        worst = fmax(worst, sqrt(sum));
    }
    return worst;
}

START_TEST(every_image_on_the_way_is_a_sample)
{
    begin();
    world_babble(300, 1);
    ck_assert_int_eq(world.outputs.status.samples, 300);
    ck_assert_int_eq(world.outputs.status.space, REACH_STATUS_T_FIXED);
    ck_assert_int_eq(world.outputs.command.n_joints, 4);
    ck_assert_int_lt(world.outputs.status.seq, 320);
    world_end();
}
END_TEST

START_TEST(it_reaches_with_hand_and_tool)
{
    double error;

    begin();
    world_babble(2000, 1);
    error = worst_reach();
    ck_assert_msg(error < 2, "hand: %g px", error);
    world.robot.tool = 0.28;
    world_babble(2000, 2);
    ck_assert_int_eq(world.outputs.status.solutions, 2);
    error = worst_reach();
    ck_assert_msg(error < 2, "tool: %g px", error);
    ck_assert_int_eq(world.outputs.status.context, 2);
    world.robot.tool = 0;
    for (int i = 0; i < 50; i++)
        world_step();
    ck_assert_int_eq(world.outputs.status.context, 1);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

START_TEST(it_explores_from_nothing)
{
    double error;

    begin();
    world_run(
        (reach_request_t){.kind = REACH_REQUEST_T_EXPLORE, .count = 2000, .seed = 3, .learn = 1});
    error = worst_reach();
    ck_assert_msg(error < 4, "%g px", error);
    world_end();
}
END_TEST

START_TEST(an_arm_that_is_not_seen_holds)
{
    begin();
    world_babble(300, 1);
    ck_assert_int_eq(
        world_ask((reach_request_t){
            .kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 10, .target = {{10, 10, 40}}}),
        REACH_STATUS_T_ACCEPTED);
    world.robot.blind = true;
    for (int i = 0; i < 50; i++)
        world_step();
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq(world.outputs.command.velocity[i], 0);
    world_end();
}
END_TEST

START_TEST(no_head_follows_targets)
{
    begin();
    ck_assert_int_eq(world_ask((reach_request_t){
                         .kind = REACH_REQUEST_T_COORDINATE, .n_targets = 1, .period = 2}),
                     REACH_STATUS_T_REFUSED_VALUE);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_image_on_the_way_is_a_sample, it_reaches_with_hand_and_tool, it_explores_from_nothing,
        an_arm_that_is_not_seen_holds,      no_head_follows_targets,
    };

    return SUITE_RUN("fixed_eyes", tests);
}
