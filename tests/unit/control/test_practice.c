/* More babbling where reaching is poor, on the robot without bodies: what it buys, and that it
 * stays within its bounds. Prints what it measures. */
#include "daemon/control/kinematics/head.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEEDS = 6, SAMPLES = 3, TARGETS = 16, MOST = 12 };

static int collected; /* ticks in which it practised */

static void watch(void)
{
    collected += world.outputs.status.phase == REACH_STATUS_T_COLLECT;
}

static void begin(const char *name, int samples)
{
    struct config with = fixture_robot_config(name);

    /* With births by evidence, three samples do for almost every target, and nothing is missed. */
    with.learner.births = LEARNER_BIRTHS_PUBLISHED;
    with.practice_samples = samples;
    with.practice_missed = 1;
    world_begin(with, with.space.fixates ? 0.3 : 0.0005);
    world.watch = watch;
    collected = 0;
    world_step();
}

static void ask(reach_request_t request)
{
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
}

/* One tick of what was asked for, which is not to last for ever. */
static bool busy(int *ticks)
{
    ck_assert_msg(++*ticks < 60000, "%d of %d", world.outputs.status.progress,
                  world.outputs.status.progress_total);
    world_step();
    return world.outputs.status.behaviour != REACH_STATUS_T_NONE;
}

static void babble(int count, int64_t seed)
{
    int ticks = 0;

    ask((reach_request_t){
        .kind = REACH_REQUEST_T_BABBLE, .count = count, .seed = seed, .learn = 1});
    while (busy(&ticks))
        ;
}

/* The STAR's ends twice, 2 s each. */
static reach_request_t star(bool learn)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_REACH,
                               .n_targets = TARGETS,
                               .period = 2,
                               .count = 1,
                               .learn = learn};

    for (int i = 0; i < TARGETS; i++) {
        request.target[i][0] = 50 * cos(i * M_PI / 4);
        request.target[i][1] = 50 * sin(i * M_PI / 4);
        request.target[i][2] = 20;
    }
    return request;
}

/* How many of the second round end within 5 px. */
static int reach(bool learn)
{
    reach_request_t request = star(learn);
    double error[3], last[TARGETS] = {0};
    int reached = 0, ticks = 0;

    ask(request);
    do {
        int now = world.outputs.status.progress;
        fake_robot_image(&world.robot, error);
        for (int axis = 0; axis < 3; axis++)
            error[axis] -= request.target[now][axis];
        last[now] = sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2]);
    } while (busy(&ticks));
    ck_assert_int_eq(world.outputs.status.progress, TARGETS);
    for (int i = TARGETS / 2; i < TARGETS; i++)
        reached += last[i] < 5;
    return reached;
}

START_TEST(it_reaches_what_it_missed)
{
    int sum[2] = {0};

    for (int seed = 1; seed <= SEEDS; seed++)
        for (int with = 0; with < 2; with++) {
            begin("kobian.yaml", with ? MOST : 0);
            babble(SAMPLES, seed);
            int reached = reach(true);
            sum[with] += reached;
            printf("seed %d, %d babbled, practice %s: %d of %d reached, %d samples more\n", seed,
                   SAMPLES, with ? "on" : "off", reached, TARGETS / 2,
                   (int)world.outputs.status.samples - SAMPLES);
            ck_assert(with || collected == 0);
            ck_assert_int_eq(world.outputs.status.gated, 0);
            world_end();
        }
    printf("all seeds: %d of %d without, %d with\n", sum[0], SEEDS * TARGETS / 2, sum[1]);
    ck_assert_int_ge(sum[1], SEEDS * TARGETS / 2 - 2);
    ck_assert_int_ge(sum[1], sum[0] + SEEDS * TARGETS / 4);
}
END_TEST

START_TEST(it_does_not_practise_what_it_can_do_or_may_not_learn)
{
    begin("kobian.yaml", MOST);
    babble(80, 1);
    ck_assert_int_eq(reach(true), TARGETS / 2);
    ck_assert_int_eq(collected, 0);
    world_end();
    begin("kobian.yaml", MOST);
    babble(SAMPLES, 1);
    reach(false);
    ck_assert_int_eq(collected, 0);
    ck_assert_int_eq(world.outputs.status.samples, SAMPLES);
    world_end();
}
END_TEST

/* Targets in the image are where they are for the head as it was. */
START_TEST(the_head_goes_back_to_where_it_was)
{
    double head[HEAD_JOINTS] = {0};
    int ticks = 0;
    bool began = false;

    begin("kobian.yaml", MOST);
    babble(SAMPLES, 1);
    ask(star(true));
    while (busy(&ticks)) {
        const double *now = world.robot.q + config_arm_joints(&world.config);
        if (world.outputs.status.phase != REACH_STATUS_T_TRACK)
            continue;
        for (int i = 0; began && i < HEAD_JOINTS; i++)
            ck_assert_double_eq_tol(now[i], head[i], 0.02);
        memcpy(head, began ? head : now, sizeof head);
        began = true;
    }
    ck_assert_int_gt(collected, 0);
    world_end();
}
END_TEST

START_TEST(it_ends_where_nothing_can_be_fixated)
{
    int ticks = 0, blind = 0;

    begin("kobian.yaml", 2);
    babble(SAMPLES, 1);
    ask(star(true));
    while (busy(&ticks)) {
        world.robot.blind = world.outputs.status.phase == REACH_STATUS_T_COLLECT;
        blind += world.robot.blind;
    }
    ck_assert_int_gt(blind, 0);
    ck_assert_int_eq(world.outputs.status.progress, TARGETS);
    ck_assert_int_lt(world.outputs.status.samples, SAMPLES + TARGETS);
    world_end();
}
END_TEST

/* In metres, and never more than once for a target, though none is ever near enough. */
START_TEST(each_target_is_practised_for_once)
{
    for (int near = 0; near < 2; near++) {
        reach_request_t request = {
            .kind = REACH_REQUEST_T_REACH, .n_targets = 4, .period = 1, .learn = 1};
        int ticks = 0;
        begin("icub.yaml", MOST);
        world.config.practice_tolerance_position = near ? 10 : 1e-9;
        for (int i = 0; i < 4; i++)
            fake_robot_position(&world.robot, request.target[i]);
        babble(50, 1);
        collected = 0;
        ask(request);
        while (busy(&ticks))
            ;
        ck_assert_int_eq(collected > 0, !near);
        ck_assert_int_le(collected, 4 * (MOST + 1));
        ck_assert(near || collected >= 4 * (MOST - 1));
        world_end();
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        it_reaches_what_it_missed, it_does_not_practise_what_it_can_do_or_may_not_learn,
        the_head_goes_back_to_where_it_was, it_ends_where_nothing_can_be_fixated,
        each_target_is_practised_for_once};

    return SUITE_RUN("practice", tests);
}
