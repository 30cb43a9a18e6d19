/* An arm of an industrial one's ranges, from nothing: the motions that show its body, the body
 * found from them, and reaching anywhere with it. The search for the body runs between two ticks
 * here. */
#include "fixture.h"
#include "learner/finder/seeker.h"
#include "tests/unit/suite.h"
#include "wide_arm.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double noise = 0.0005; /* m */
static struct seeker seeker;
static struct chain chain;
static int moving_at_once;

static void watch(void)
{
    int moving = 0;

    for (int i = 0; i < 7; i++)
        moving += fabs(world.outputs.command.velocity[i]) > 0.1;
    moving_at_once = moving > moving_at_once ? moving : moving_at_once;
}

static void begin_with(struct config config, int64_t seed)
{
    struct learner_config learner;

    chain = wide_arm(seed);
    world_begin(config, noise);
    world.robot.chain = &chain;
    for (int i = 0; i < 7; i++)
        world.robot.q[i] = 0.5 * (world.config.arm_min.value[i] + world.config.arm_max.value[i]);
    learner = config_learner(&world.config);
    seeker_init(&seeker, &learner);
    moving_at_once = 0;
    world.watch = watch;
    world_step();
}

static void begin(int64_t seed)
{
    begin_with(wide_arm_config(noise), seed);
}

/* Until the behaviour is over; returns how long that takes, s. */
static double finish(int most_ticks)
{
    int ticks = 0;

    for (; world.outputs.status.behaviour != REACH_STATUS_T_NONE; ticks++) {
        ck_assert_int_lt(ticks, most_ticks);
        world_step();
        if (world.outputs.has_sample)
            seeker_look(&seeker, tick_learner(world.tick));
    }
    return ticks * world.config.period;
}

static double explore(int count)
{
    reach_request_t request = {
        .kind = REACH_REQUEST_T_EXPLORE, .count = count, .seed = 3, .learn = 1};

    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    return finish(100000);
}

/* Targets anywhere in the joints' range, of which so many end within `bound` (m). */
static int reached(int n, double bound, double *errors)
{
    struct random_state random = random_seed(11);
    int good = 0;

    for (int k = 0; k < n; k++) {
        reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 20};
        struct fake_robot there = world.robot;
        double position[3], error = 0;
        for (int i = 0; i < 7; i++)
            there.q[i] = random_uniform(&random, world.config.babble_min.value[i],
                                        world.config.babble_max.value[i]);
        fake_robot_position(&there, request.target[0]);
        ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
        finish(4000);
        fake_robot_position(&world.robot, position);
        for (int axis = 0; axis < 3; axis++)
            error += pow(position[axis] - request.target[0][axis], 2);
        errors[k] = sqrt(error);
        good += errors[k] < bound;
    }
    return good;
}

static int smaller(const void *a, const void *b)
{
    double left = *(const double *)a, right = *(const double *)b;

    return (left > right) - (left < right);
}

START_TEST(it_reaches_anywhere_after_150_samples)
{
    enum { TARGETS = 12 };
    double errors[TARGETS];

    for (int64_t seed = 1; seed <= 3; seed++) {
        begin(seed);
        double seconds = explore(150);
        ck_assert_msg(learner_body(tick_learner(world.tick)) != NULL, "%s", seeker.report.why);
        ck_assert_double_lt(seconds, 90);
        int good = reached(TARGETS, 0.01, errors);
        qsort(errors, TARGETS, sizeof *errors, smaller);
        printf("arm %d: %.0f s of exploring, %d of %d within 1 cm, median %.2f mm, worst %.1f mm\n",
               (int)seed, seconds, good, TARGETS, 500 * (errors[5] + errors[6]),
               1000 * errors[TARGETS - 1]);
        ck_assert_int_eq(good, TARGETS);
        ck_assert_double_lt(0.5 * (errors[5] + errors[6]), 0.001);
        ck_assert_int_eq(world.outputs.status.gated, 0);
        world_end();
    }
}
END_TEST

START_TEST(it_first_turns_each_joint_alone)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_EXPLORE, .count = 150, .learn = 1};
    double home[7], most[7] = {0};
    int turned = 0;

    begin(1);
    memcpy(home, world.robot.q, sizeof home);
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    for (int tick = 0; moving_at_once <= 1; tick++) {
        ck_assert_int_lt(tick, 5000);
        world_step();
        for (int i = 0; i < 7; i++)
            most[i] = fmax(most[i], fabs(world.robot.q[i] - home[i]));
    }
    for (int i = 0; i < 7; i++)
        turned += most[i] > 0.4 && most[i] < 0.5;
    ck_assert_int_eq(turned, 7);
    world_end();
}
END_TEST

enum { TRACK = 400 };

/* Samples anywhere, learned without a search, then a target: where the joints go. */
static void track_of(enum learner_features features, double (*track)[7])
{
    reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 20};
    struct config config = wide_arm_config(noise);
    struct random_state random = random_seed(5);
    struct fake_robot there;

    config.learner.features = features;
    config.learner.capacity = 8; /* both have memory for that many */
    begin_with(config, 1);
    there = world.robot;
    for (int k = 0; k < 300; k++) {
        double position[3];
        for (int i = 0; i < 7; i++)
            there.q[i] = world.robot.q[i] + random_uniform(&random, -0.5, 0.5);
        fake_robot_position(&there, position);
        learner_update(tick_learner(world.tick), there.q, position);
    }
    fake_robot_position(&there, request.target[0]);
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    for (int tick = 0; tick < TRACK; tick++) {
        world_step();
        memcpy(track[tick], world.robot.q, sizeof track[tick]);
    }
    world_end();
}

/* Polynomials know nothing of where there are no samples: nobody imagines a way with them. */
START_TEST(without_a_body_it_reaches_as_polynomials_do)
{
    static double with_none[TRACK][7], polynomial[TRACK][7];
    double moved = 0;

    track_of(LEARNER_BODY, with_none);
    track_of(LEARNER_POLYNOMIAL, polynomial);
    for (int i = 0; i < 7; i++)
        moved = fmax(moved, fabs(polynomial[TRACK - 1][i] - polynomial[0][i]));
    ck_assert_double_gt(moved, 0.1);
    ck_assert_mem_eq(with_none, polynomial, sizeof polynomial);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {it_first_turns_each_joint_alone,
                                  it_reaches_anywhere_after_150_samples,
                                  without_a_body_it_reaches_as_polynomials_do};

    return SUITE_RUN("exploring with a body to be found", tests);
}
