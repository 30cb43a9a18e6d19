/* What is wrong with the samples is told, and a tracker that repeats itself teaches nothing. */
#include "common/bus/troubles_text.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <string.h>

static struct observation repeated;

/* A tick in which the tracker says again what it said, under a new stamp. */
static void step_with_a_frozen_tracker(void)
{
    world.inputs.has_state = true;
    world.inputs.state = fake_robot_state(&world.robot);
    world.inputs.state_age = 0;
    world.inputs.n_requests = 0;
    repeated.seq++;
    repeated.utime = world.inputs.state.utime;
    world.inputs.observation[0] = repeated;
    world.inputs.n_observations = 1;
    world_decide();
    while (tick_learn(world.tick))
        ;
    fake_robot_step(&world.robot, &world.outputs.command);
}

static void babble(int count)
{
    ck_assert_int_eq(world_ask((reach_request_t){
                         .kind = REACH_REQUEST_T_BABBLE, .count = count, .seed = 1, .learn = 1}),
                     REACH_STATUS_T_ACCEPTED);
}

static bool tells(int kind, const char *part)
{
    char text[300];

    return trouble_text(&world.outputs.status, kind, text, sizeof text) && strstr(text, part);
}

START_TEST(a_frozen_tracker_teaches_nothing)
{
    const reach_status_t *status = &world.outputs.status;
    int64_t before;

    world_begin(fixture_robot_config("icub.yaml"), 0.0005);
    world_step();
    babble(1000);
    for (int i = 0; i < 200; i++)
        world_step();
    ck_assert_int_eq(status->frozen_samples, 0);
    ck_assert_int_eq(status->troubles & REACH_STATUS_T_STILL, 0);
    before = status->samples;
    ck_assert_int_gt(before, 150);
    ck_assert_int_gt(world.inputs.n_observations, 0);
    repeated = world.inputs.observation[0];
    for (int i = 0; i < 100; i++)
        step_with_a_frozen_tracker();
    ck_assert_int_le(status->samples, before + 10); /* until a joint has moved by 1 % */
    ck_assert_int_ge(status->frozen_samples, 90);
    ck_assert(tells(4, "stood still"));
    ck_assert(!world.outputs.sample.learned);
    before = status->samples;
    for (int i = 0; i < 50; i++)
        world_step();
    ck_assert_int_ge(status->samples, before + 45); /* and what comes after it is learned */
    world_end();
}
END_TEST

START_TEST(a_joint_far_off_is_named)
{
    const char *const overrides[] = {"learner.scale=0.01"};
    const reach_status_t *status = &world.outputs.status;

    world_begin(fixture_config(overrides, 1), 0);
    world_step();
    babble(3);
    world_finish(20000);
    ck_assert_int_ne(status->troubles & REACH_STATUS_T_FAR, 0);
    ck_assert_int_ge(status->trouble_joint, 1);
    ck_assert_int_le(status->trouble_joint, 4);
    ck_assert_double_gt(status->trouble_scales, 4);
    ck_assert(tells(2, "learner.scale"));
    world_end();
}
END_TEST

START_TEST(each_trouble_has_a_line)
{
    reach_status_t status = {.troubles = 1 | 2 | 4 | 16 | 32 | 64 | 128 | 256 | 512 | 1024};
    char text[300];
    int lines = 0;

    for (int kind = 0; kind < TROUBLES; kind++)
        lines += trouble_text(&status, kind, text, sizeof text);
    ck_assert_int_eq(lines, 10);
    status.troubles = 0;
    for (int kind = 0; kind < TROUBLES; kind++)
        ck_assert(!trouble_text(&status, kind, text, sizeof text));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_frozen_tracker_teaches_nothing, a_joint_far_off_is_named,
                                  each_trouble_has_a_line};

    return SUITE_RUN("troubles", tests);
}
