/* The whole control step on a robot without bodies: each loop closed, learning from nothing, with
 * signs that must be right or nothing converges. */
#include "fixture.h"
#include "learner/learner.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static int samples;
static double worst_sample; /* error of the newest samples' predictions, degrees */

static void check_limits(void)
{
    for (int i = 0; i < config_joints(&world.config); i++) {
        struct joint_limits limits = config_joint_limits(&world.config, i);
        ck_assert(world.robot.q[i] >= limits.min - 1e-9 && world.robot.q[i] <= limits.max + 1e-9);
        ck_assert(fabs(world.outputs.command.velocity[i]) <= limits.velocity + 1e-9);
    }
}

static void watch(void)
{
    samples += world.outputs.has_sample;
    check_limits();
}

static void begin_with(struct config config)
{
    world_begin(config, 0.3);
    world.watch = watch;
    samples = 0;
    worst_sample = 0;
}

static void begin(void)
{
    begin_with(fixture_config(NULL, 0));
}

static void ask(reach_request_t request)
{
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
}

static void babble(int count, bool learn)
{
    world_step(); /* the supervisor must first know a state */
    ask((reach_request_t){
        .kind = REACH_REQUEST_T_BABBLE, .count = count, .seed = 7, .learn = learn});
    world_finish(50 * 10 * count);
    ck_assert_int_eq(world.outputs.status.progress, count);
}

static double image_error(const double *target)
{
    double image[3], sum = 0;

    fake_robot_image(&world.robot, image);
    for (int i = 0; i < 3; i++)
        sum += (target[i] - image[i]) * (target[i] - image[i]);
    return sqrt(sum);
}

START_TEST(the_head_fixates)
{
    double image[3];

    begin();
    world.robot.q[4] = -0.2;
    world_step();
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 1, .seed = 1});
    world_finish(50 * 10);
    fake_robot_image(&world.robot, image);
    ck_assert(fabs(image[0]) < 4 && fabs(image[1]) < 4);
    world_end();
}
END_TEST

START_TEST(the_head_searches_what_is_out_of_view)
{
    begin();
    world.robot.half_width = 100;
    world.robot.half_height = 80;
    world.robot.q[4] = 0.6; /* looks far to the left of it */
    babble(1, true);
    ck_assert_int_eq(world.outputs.status.skipped, 0);
    world_end();
}
END_TEST

/* Targets of a STAR, reached with the learned Jacobian; learning from nothing before. */
static void star(double bound)
{
    reach_request_t request = {
        .kind = REACH_REQUEST_T_REACH, .n_targets = 9, .period = 4, .count = 1};
    const double u[] = {0, 50, -50, 0, 0, 50, -50, 50, -50};
    const double v[] = {0, 0, 0, 50, -50, 50, -50, -50, 50};
    int reached = 0;

    for (int i = 0; i < 9; i++)
        memcpy(request.target[i], (double[]){u[i], v[i], 20}, sizeof request.target[i]);
    ask(request);
    for (int i = 0; i < 9 * 250 && world.outputs.status.behaviour != REACH_STATUS_T_NONE; i++) {
        int done = world.outputs.status.progress;
        double error = done < 9 ? image_error((double[]){u[done], v[done], 20}) : 0;
        world_step();
        if (world.outputs.status.progress > done) {
            ck_assert_msg(error < bound, "target %d: %g px", done, error);
            reached++;
        }
    }
    ck_assert_int_eq(reached, 9);
}

static void expect_context(int current, int count)
{
    ck_assert_int_eq(world.outputs.status.context, current);
    ck_assert_int_eq(world.outputs.status.contexts, count);
}

START_TEST(it_learns_two_tools_and_reaches_with_both)
{
    begin();
    babble(120, true);
    expect_context(1, 1);
    world.robot.tool = 0.35;
    babble(120, true);
    ck_assert_int_eq(world.outputs.status.solutions, 2);
    expect_context(2, 2);
    star(3);
    expect_context(2, 2);
    world.robot.tool = 0;
    star(3);
    expect_context(1, 2);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

START_TEST(linear_experts_do_too)
{
    begin_with(fixture_learner_config("learner-linear.yaml"));
    babble(120, true);
    world.robot.tool = 0.35;
    babble(120, true);
    star(5);
    world.robot.tool = 0;
    star(5);
    world_end();
}
END_TEST

/* It knows one value for a posture, so one tool. */
START_TEST(receptive_fields_reach_with_the_hand)
{
    begin_with(fixture_learner_config("learner-lwpr.yaml"));
    babble(200, true);
    ck_assert_int_eq(world.outputs.status.solutions, 1);
    star(5);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

START_TEST(a_frozen_model_does_not_change)
{
    begin();
    babble(30, true);
    ck_assert_int_eq(world.outputs.status.samples, 30);
    babble(5, false);
    ck_assert_int_eq(world.outputs.status.samples, 30);
    ck_assert_int_eq(samples, 35);
    world_end();
}
END_TEST

START_TEST(the_arm_follows_the_head)
{
    reach_request_t request = {
        .kind = REACH_REQUEST_T_COORDINATE, .n_targets = 4, .period = 3, .count = 1, .learn = 1};
    const double u[] = {50, -50, -50, 50}, v[] = {0, 50, -50, 0};
    double worst = 0, head[2];

    begin();
    babble(120, true);
    for (int i = 0; i < 4; i++)
        memcpy(request.target[i], (double[]){u[i], v[i], 20}, sizeof request.target[i]);
    ask(request);
    for (int i = 0; i < 3000 && world.outputs.status.behaviour != REACH_STATUS_T_NONE; i++) {
        double error[3];
        world_step();
        fake_robot_image(&world.robot, error);
        if (world.outputs.status.phase == REACH_STATUS_T_TRACK)
            worst = fmax(worst, hypot(error[0], error[1]));
        memcpy(head, world.robot.q + 4, sizeof head);
    }
    ck_assert_int_eq(world.outputs.status.progress, 4);
    ck_assert_msg(worst < 3, "%g px", worst);
    ck_assert(hypot(head[0], head[1]) > 0);
    world_end();
}
END_TEST

START_TEST(an_arm_whose_marker_is_hidden_holds)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_REACH,
                               .n_targets = 1,
                               .period = 100,
                               .target = {{40, 0, 20}},
                               .count = 1};

    begin();
    babble(60, true);
    ask(request);
    while (world.outputs.status.phase != REACH_STATUS_T_TRACK)
        world_step();
    world.robot.blind = true;
    for (int i = 0; i < 50; i++)
        world_step();
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq(world.outputs.command.velocity[i], 0);
    world.robot.blind = false;
    for (int i = 0; i < 200; i++)
        world_step();
    ck_assert(image_error((double[]){40, 0, 20}) < 3);
    world_end();
}
END_TEST

static double arm_speed(void)
{
    double sum = 0;

    for (int i = 0; i < config_arm_joints(&world.config); i++)
        sum += world.outputs.command.velocity[i] * world.outputs.command.velocity[i];
    return sqrt(sum);
}

/* Share of its highest speed that the arm has 60 ms after a target was given. */
static double early_speed(const char *smoothing)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_REACH,
                               .n_targets = 1,
                               .period = 3,
                               .target = {{50, 0, 20}},
                               .count = 1};
    double early, highest = 0;

    begin_with(fixture_config(&smoothing, 1));
    babble(60, true);
    ask(request);
    while (world.outputs.status.phase != REACH_STATUS_T_TRACK)
        world_step();
    for (int i = 0; i < 3; i++)
        world_step();
    early = arm_speed();
    for (int i = 0; i < 30; i++) {
        world_step();
        highest = fmax(highest, arm_speed());
    }
    world_end();
    return early / highest;
}

START_TEST(reaching_sets_off_softly)
{
    /* By the filter 0.55, and at once all there is, but for the motors' greatest acceleration. */
    double soft = early_speed("task.smoothing=0.15"), hard = early_speed("task.smoothing=0");

    ck_assert_msg(soft < 0.7 && hard > 0.85, "%g with smoothing, %g without", soft, hard);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_head_fixates,
        the_head_searches_what_is_out_of_view,
        it_learns_two_tools_and_reaches_with_both,
        linear_experts_do_too,
        receptive_fields_reach_with_the_hand,
        a_frozen_model_does_not_change,
        the_arm_follows_the_head,
        an_arm_whose_marker_is_hidden_holds,
        reaching_sets_off_softly,
    };

    return SUITE_RUN("closed loop", tests);
}
