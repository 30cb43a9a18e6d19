/* Reaching from nothing: no babbling, on both kinds of robot, without bodies. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double low[MAX_JOINTS], high[MAX_JOINTS]; /* of the joints so far, rad */
static double least[3], most[3];                 /* of the position so far, m */

static void watch(void)
{
    for (int i = 0; i < config_arm_joints(&world.config); i++) {
        low[i] = fmin(low[i], world.robot.q[i]);
        high[i] = fmax(high[i], world.robot.q[i]);
    }
    if (world.config.space.kind == SPACE_CARTESIAN) {
        double position[3];
        fake_robot_position(&world.robot, position);
        for (int axis = 0; axis < 3; axis++) {
            least[axis] = fmin(least[axis], position[axis]);
            most[axis] = fmax(most[axis], position[axis]);
        }
    }
}

static void begin(const char *name, double noise)
{
    world_begin(fixture_overlaid_config(name, "learner-polynomial.yaml"), noise);
    for (int axis = 0; axis < 3; axis++) {
        least[axis] = INFINITY;
        most[axis] = -INFINITY;
    }
    memcpy(low, world.robot.q, sizeof low);
    memcpy(high, world.robot.q, sizeof high);
    world.watch = watch;
    world_step();
}

static void run_request(reach_request_t request, int most_ticks)
{
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    world_finish(most_ticks);
}

static void explore(int count, int64_t seed)
{
    reach_request_t request = {
        .kind = REACH_REQUEST_T_EXPLORE, .count = count, .seed = seed, .learn = 1};

    run_request(request, 10 * count);
    ck_assert_int_eq(world.outputs.status.samples, count);
}

/* What is seen of the end-effector, without noise: px, or m. */
static void now(double *seen)
{
    if (world.config.space.kind == SPACE_CARTESIAN)
        fake_robot_position(&world.robot, seen);
    else
        fake_robot_image(&world.robot, seen);
}

/* Share of `n` targets, `spread` about the middle of the range, that end within `bound`. */
static double reached(int n, const double middle[3], const double spread[3], double bound)
{
    struct random_state random = random_seed(5);
    int good = 0;

    for (int i = 0; i < n; i++) {
        reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 4};
        double seen[3], sum = 0;
        for (int axis = 0; axis < 3; axis++)
            request.target[0][axis] =
                middle[axis] + random_uniform(&random, -spread[axis], spread[axis]);
        run_request(request, 1000);
        now(seen);
        for (int axis = 0; axis < 3; axis++)
            sum += pow(seen[axis] - request.target[0][axis], 2);
        good += sqrt(sum) < bound;
    }
    return (double)good / n;
}

START_TEST(it_reaches_in_metres_from_nothing)
{
    double middle[3], share;

    begin("icub.yaml", 0.0005);
    now(middle);
    explore(2000, 3);
    for (int axis = 0; axis < 3; axis++)
        ck_assert_double_gt(most[axis] - least[axis], 0.12);
    /* Also the joints that no place in particular asks for. */
    for (int i = 0; i < 7; i++)
        ck_assert(high[i] - low[i] >
                  0.45 * (world.config.arm_max.value[i] - world.config.arm_min.value[i]));
    share = reached(20, middle, (double[]){0.05, 0.08, 0.08}, 0.01);
    ck_assert_msg(share >= 0.9, "%g of the targets", share);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

/* Nobody tells it of the tool: what moving does is no longer what the model says. */
START_TEST(it_goes_on_with_a_tool)
{
    double middle[3], share;

    begin("icub.yaml", 0.0005);
    now(middle);
    explore(1500, 3);
    world.robot.tool = 0.28;
    run_request(
        (reach_request_t){.kind = REACH_REQUEST_T_EXPLORE, .count = 1500, .seed = 4, .learn = 1},
        15000);
    ck_assert_int_eq(world.outputs.status.contexts, 2);
    middle[0] += 0.05;
    middle[2] += 0.08;
    share = reached(10, middle, (double[]){0.04, 0.06, 0.06}, 0.01);
    ck_assert_msg(share >= 0.9, "%g of the targets", share);
    world.robot.tool = 0;
    middle[0] -= 0.05;
    middle[2] -= 0.08;
    share = reached(10, middle, (double[]){0.04, 0.06, 0.06}, 0.01);
    ck_assert_msg(share >= 0.9, "%g of the targets with the hand again", share);
    world_end();
}
END_TEST

/* Commands of the first ticks, and much later, of a robot that has learned before but begins to
 * explore anew; `gain` draws the joints that a goal leaves free to its posture. */
static void commands(double gain, double first[3][MAX_JOINTS], double later[MAX_JOINTS])
{
    reach_request_t again = {.kind = REACH_REQUEST_T_EXPLORE, .count = 500, .seed = 4};

    begin("icub.yaml", 0.0005);
    explore(800, 3);
    world.config.explore_secondary_gain = gain;
    for (int i = 0; i < 100; i++) {
        if (i == 0)
            world_ask(again);
        else
            world_step();
        memcpy(i < 3 ? first[i] : later, world.outputs.command.velocity, sizeof first[0]);
    }
    world_end();
}

/* Until a movement has shown that the model is right, goals draw no joint to a posture: that would
 * be babbling. Then they do. */
START_TEST(free_joints_are_drawn_to_postures_only_where_it_knows)
{
    double first[2][3][MAX_JOINTS], later[2][MAX_JOINTS], moved = 0, apart = 0;

    commands(0, first[0], later[0]);
    commands(1, first[1], later[1]);
    for (int i = 0; i < config_arm_joints(&world.config); i++) {
        for (int k = 0; k < 3; k++) {
            ck_assert_double_eq(first[0][k][i], first[1][k][i]);
            moved += fabs(first[0][k][i]);
        }
        apart += fabs(later[0][i] - later[1][i]);
    }
    ck_assert_double_gt(moved, 0);
    ck_assert_double_gt(apart, 0.05);
}
END_TEST

START_TEST(it_reaches_in_the_image_from_nothing)
{
    double share;

    begin("kobian.yaml", 0.3);
    explore(2000, 3);
    share = reached(16, (double[]){0, 0, 20}, (double[]){50, 50, 0}, 5);
    ck_assert_msg(share >= 0.9, "%g of the targets", share);
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {it_reaches_in_metres_from_nothing,
                                  it_reaches_in_the_image_from_nothing, it_goes_on_with_a_tool,
                                  free_joints_are_drawn_to_postures_only_where_it_knows};

    return SUITE_RUN("explore", tests);
}
