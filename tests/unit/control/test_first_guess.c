/* Whether the joints that the model has for a far target (inverse prediction) help the arm there,
 * on a robot without bodies: places drawn from the whole joint range, few samples and enough of
 * them. Prints what it measures; docs/daemon.md says what follows. */
#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/targets.h"
#include "daemon/control/tick_private.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEEDS = 4, PLACES = 32, MOST = SEEDS * PLACES };

/* What is made of the guess. */
enum use {
    IGNORE,  /* as the daemon does: the null space draws to the middle of the joints' range */
    POSTURE, /* the null space draws to the guess */
    DRIVE,   /* far from the target the joints go straight to the guess */
    USES
};

static const double far_off = 0.5; /* scaled task units from the target */

static enum use use;
static double guess[MAX_JOINTS]; /* rad */
static bool guessed;

/* The task position that brings what is seen to `target`. */
static void wanted(const struct senses *senses, const double *target, double *x)
{
    double error[SPACE_DIMENSIONS];

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        error[row] = target[row] - senses->sight->carried[row];
    space_to_task(&senses->config->space, error, x);
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        x[row] += estimate_value(senses->estimate)[row];
}

/* The nearest of the joints that the model knows for the target, within their limits. */
static void make_guess(const struct senses *senses, const double *target)
{
    static struct learner_inverse inverse; /* too large for the stack */
    const struct config *config = senses->config;
    double x[SPACE_DIMENSIONS], least = INFINITY;

    wanted(senses, target, x);
    guessed = learner_predict_inverse(world.tick->learner, x, &inverse) > 0;
    for (int k = 0; k < inverse.n_solutions; k++) {
        const double *z = inverse.solution[k].z;
        double distance = 0;
        for (int i = 0; i < config_arm_joints(config); i++)
            distance += pow(z[i] - senses->q[i], 2);
        if (distance >= least)
            continue;
        least = distance;
        for (int i = 0; i < config_arm_joints(config); i++)
            guess[i] = fmin(fmax(z[i], config->babble_min.value[i]), config->babble_max.value[i]);
    }
}

static bool is_far(const struct senses *senses, const double *target)
{
    const struct space *space = &senses->config->space;
    double sum = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        sum += pow(
            space->unit[row] * (target[row] - senses->sight->carried[row]) / space->scale[row], 2);
    return sqrt(sum) > far_off;
}

/* What is made of the guess instead of what reaching wants. */
static void turn_to_guess(struct targets *targets, const struct senses *senses, struct wants *wants,
                          const double *target)
{
    const struct config *config = senses->config;
    double velocity[SPACE_DIMENSIONS];

    if (use == DRIVE && is_far(senses, target)) {
        for (int i = 0; i < config_arm_joints(config); i++)
            wants->velocity[i] = config->task_gain * (guess[i] - senses->q[i]);
        memcpy(targets->setpoint, senses->sight->carried, sizeof targets->setpoint);
    } else if (use == POSTURE) {
        control_approach(senses, wants, targets->setpoint, config->task_gain, velocity);
        control_task_velocity_by(senses, wants, velocity, guess, config->task_secondary_gain);
    }
}

static bool guessing_step(struct behaviour *behaviour, const struct senses *senses,
                          struct wants *wants)
{
    struct targets *targets = behaviour_state(behaviour); /* reaching has them first */
    int64_t deadline = targets->deadline;
    const struct behaviour_ops *reaching = behaviour_find(behaviour_table, REACH_REQUEST_T_REACH);

    if (!reaching->step(behaviour, senses, wants))
        return false;
    if (behaviour->progress.phase != REACH_STATUS_T_TRACK)
        return true;
    const double *target = targets->target[behaviour->progress.done];
    if (targets->deadline != deadline) /* it was just presented */
        make_guess(senses, target);
    if (guessed)
        turn_to_guess(targets, senses, wants, target);
    return true;
}

static const struct behaviour_ops guessing = {
    .name = "guessing", .code = REACH_STATUS_T_REACH, .step = guessing_step};

static double error_to(const double target[3])
{
    double position[3], sum = 0;

    fake_robot_position(&world.robot, position);
    for (int axis = 0; axis < 3; axis++)
        sum += pow(position[axis] - target[axis], 2);
    return sqrt(sum);
}

/* Where the end-effector is at random joints. */
static void draw_place(struct random_state *random, double place[3])
{
    const struct config *config = &world.config;
    double kept[MAX_JOINTS];

    memcpy(kept, world.robot.q, sizeof kept);
    for (int i = 0; i < config_arm_joints(config); i++)
        world.robot.q[i] =
            random_uniform(random, config->babble_min.value[i], config->babble_max.value[i]);
    fake_robot_position(&world.robot, place);
    memcpy(world.robot.q, kept, sizeof kept);
}

static void run_request(reach_request_t request, const struct behaviour_ops *ops)
{
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    if (ops)
        world.tick->behaviour.ops = ops;
    world_finish(20000);
}

/* Errors at places, 5 s each, after so many babbled samples; m. */
static void reach(int samples, int seed, double *errors)
{
    struct random_state random = random_seed(seed);

    world_begin(fixture_overlaid_config("icub.yaml", "learner-polynomial.yaml"), 0.0005);
    world_step();
    run_request(
        (reach_request_t){
            .kind = REACH_REQUEST_T_BABBLE, .count = samples, .seed = seed, .learn = 1},
        NULL);
    for (int i = 0; i < PLACES; i++) {
        reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 1, .period = 5};
        draw_place(&random, request.target[0]);
        run_request(request, &guessing);
        errors[i] = error_to(request.target[0]);
    }
    ck_assert_int_eq(world.outputs.status.gated, 0);
    world_end();
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How many places are reached within 1 cm. */
static int measure(enum use this_use, const char *word, int samples)
{
    double errors[MOST];
    int reached = 0;

    use = this_use;
    for (int seed = 1; seed <= SEEDS; seed++)
        reach(samples, seed, errors + (seed - 1) * PLACES);
    for (int i = 0; i < MOST; i++)
        reached += errors[i] < 0.01;
    qsort(errors, MOST, sizeof *errors, ascending);
    printf("%4d samples, guess %-8s %d of %d within 1 cm, median %5.2f mm, worst %5.1f mm\n",
           samples, word, reached, (int)MOST, 1e3 * errors[MOST / 2], 1e3 * errors[MOST - 1]);
    return reached;
}

/* Fails as well on the day on which the guess is worth having. */
START_TEST(a_guess_gains_nothing)
{
    const int samples[] = {100, 300, 1000};
    const int least[] = {MOST / 2, MOST * 9 / 10, MOST};

    for (size_t k = 0; k < sizeof samples / sizeof samples[0]; k++) {
        int without = measure(IGNORE, "ignored", samples[k]);
        int posture = measure(POSTURE, "posture", samples[k]);
        int drive = measure(DRIVE, "driven", samples[k]);
        ck_assert_int_ge(without, least[k]);
        ck_assert_int_le(posture, without + MOST / 20);
        ck_assert_int_ge(posture, without - MOST / 20);
        ck_assert_int_le(drive, without);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_guess_gains_nothing};

    return SUITE_RUN("first_guess", tests);
}
