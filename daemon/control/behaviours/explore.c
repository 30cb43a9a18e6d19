/* Exploration: the robot learns to reach by reaching, from its first movement on.
 *
 * It sets itself a goal in task space, within what it has visited and a little beyond, and tries to
 * reach it with the model that it has; every sample on the way is learned. Where the model is wrong
 * about what a movement does, random motion is added, in proportion: all is noise at first, none
 * where it knows. Goals come with a random posture, which the joints that the goal leaves free go
 * to: a redundant arm would else know one posture for each place. A goal that gets no nearer is
 * given up: that is how the edge of the workspace is found. */
#include "daemon/control/behaviours/behaviour.h"

#include <math.h>
#include <reach_status_t.h>
#include <string.h>

static const double reached = 0.03;      /* distance at which a goal counts as reached, scaled */
static const double progress_most = 0.9; /* of the nearest distance: anything less is progress */
static const double compare_at = 0.05;   /* motion after which prediction and truth are compared */
static const double compare_weight = 0.2;
static const double speed_least = 0.1; /* share of its speed that the arm keeps while eyes lag */
static const int64_t noise_us = 400000;

static double scaled_norm(const struct config *config, const double *x)
{
    double sum = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        sum += x[row] / config->space.scale[row] * (x[row] / config->space.scale[row]);
    return sqrt(sum);
}

static void next_goal(struct explore *explore, const struct config *config, int64_t now)
{
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        double beyond = config->explore_widen * config->space.scale[row];
        explore->goal[row] = random_uniform(&explore->random, explore->low[row] - beyond,
                                            explore->high[row] + beyond);
    }
    for (int i = 0; i < config_arm_joints(config); i++)
        explore->posture[i] =
            random_uniform(&explore->random, config->arm_min.value[i], config->arm_max.value[i]);
    explore->nearest = INFINITY;
    explore->nearest_at = now;
}

static void explore_start(struct behaviour *behaviour, const reach_request_t *request,
                          struct control *control)
{
    struct explore *explore = &behaviour->explore;

    explore->random = random_seed(request->seed);
    explore->ignorance = 1;
    memcpy(explore->q_seen, control->q, sizeof explore->q_seen);
    behaviour->progress.total = request->count;
    behaviour->progress.phase = REACH_STATUS_T_TRACK;
}

static void widen(struct explore *explore, const double *x)
{
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        explore->low[row] = explore->any ? fmin(explore->low[row], x[row]) : x[row];
        explore->high[row] = explore->any ? fmax(explore->high[row], x[row]) : x[row];
    }
    explore->any = true;
}

/* Adds the motion since the last sample as the model sees it, and compares once there is enough. */
static void compare(struct explore *explore, const struct control *control, const struct pair *pair)
{
    const struct config *config = control->config;
    const double *jacobian = estimate_jacobian(control->estimate);
    int n = config_arm_joints(config);
    double moved[SPACE_DIMENSIONS], missed[SPACE_DIMENSIONS], most;

    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        for (int i = 0; jacobian && explore->compared && i < n; i++)
            explore->predicted[row] += jacobian[row * n + i] * (pair->q[i] - explore->q[i]);
        if (!explore->compared)
            explore->x_before[row] = pair->x[row];
        moved[row] = pair->x[row] - explore->x_before[row];
        missed[row] = moved[row] - explore->predicted[row];
    }
    memcpy(explore->q, pair->q, sizeof explore->q);
    explore->compared = true;
    most = fmax(scaled_norm(config, moved), scaled_norm(config, explore->predicted));
    if (most < compare_at)
        return;
    explore->ignorance +=
        compare_weight * (fmin(1, scaled_norm(config, missed) / most) - explore->ignorance);
    memcpy(explore->x_before, pair->x, sizeof explore->x_before);
    memset(explore->predicted, 0, sizeof explore->predicted);
}

static void gather(struct behaviour *behaviour, struct control *control)
{
    struct explore *explore = &behaviour->explore;

    if (!control->sight->new_frame ||
        !sight_within(control->sight, control->config->explore_tolerance))
        return;
    control_gather(control, 1);
    behaviour->progress.done++;
    compare(explore, control, &control->pair);
    if (!explore->any)
        next_goal(explore, control->config, control->now);
    widen(explore, control->pair.x);
    memcpy(explore->q_seen, control->q, sizeof explore->q_seen);
}

/* Goes on to the next goal when this one is reached, or gets no nearer. */
static void judge(struct behaviour *behaviour, const struct control *control, double distance)
{
    struct explore *explore = &behaviour->explore;
    int64_t patience = (int64_t)(control->config->explore_patience * 1e6);

    if (distance < progress_most * explore->nearest) {
        explore->nearest = distance;
        explore->nearest_at = control->now;
    }
    if (distance < reached) {
        next_goal(explore, control->config, control->now);
    } else if (control->now - explore->nearest_at > patience) {
        behaviour->progress.skipped++;
        next_goal(explore, control->config, control->now);
    }
}

/* Random motion of every joint, as strong as the model is ignorant. */
static void stir(struct explore *explore, struct control *control)
{
    int n = config_arm_joints(control->config);

    if (control->now >= explore->noise_until) {
        for (int i = 0; i < n; i++)
            explore->noise[i] = random_uniform(&explore->random, -1, 1);
        explore->noise_until = control->now + noise_us;
    }
    for (int i = 0; i < n; i++)
        control->velocity[i] +=
            explore->ignorance * control->config->explore_noise * explore->noise[i];
}

/* The eyes are to keep up: the arm slows down as the marker leaves the centre. */
static void wait_for_eyes(struct control *control)
{
    const struct config *config = control->config;
    double share = 1 - sight_eccentricity(control->sight) / (2 * config->explore_tolerance);

    for (int i = 0; config->space.fixates && i < config_arm_joints(config); i++)
        control->velocity[i] *= fmax(share, speed_least);
}

static void try_goal(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    struct explore *explore = &behaviour->explore;
    double x[SPACE_DIMENSIONS], left[SPACE_DIMENSIONS], distance, gain;

    sight_position(control->sight, control->q, x);
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        left[row] = explore->goal[row] - x[row];
    distance = scaled_norm(config, left);
    judge(behaviour, control, distance);
    gain = fmin(config->task_gain, config->explore_speed / fmax(distance, 1e-9));
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        left[row] *= gain;
    /* Where it knows nothing, all joints are free: what it does then is `stir`'s. */
    control_task_velocity_by(control, left, explore->posture,
                             (1 - explore->ignorance) * config->explore_secondary_gain);
}

static bool explore_step(struct behaviour *behaviour, struct control *control)
{
    struct explore *explore = &behaviour->explore;
    enum gaze_state gaze = control_gaze(control, true);

    if (behaviour->progress.done >= behaviour->progress.total)
        return false;
    behaviour->progress.phase =
        gaze == GAZE_ON_MARKER ? REACH_STATUS_T_TRACK : REACH_STATUS_T_SEARCH;
    if (gaze != GAZE_ON_MARKER) {
        control_arm_to(control, explore->q_seen);
        return true;
    }
    gather(behaviour, control);
    if (explore->any)
        try_goal(behaviour, control);
    stir(explore, control);
    wait_for_eyes(control);
    return true;
}

const struct behaviour_ops behaviour_explore = {
    .name = "explore",
    .code = REACH_STATUS_T_EXPLORE,
    .start = explore_start,
    .step = explore_step,
};
