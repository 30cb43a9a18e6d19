/* Exploration: the robot learns to reach by reaching, from its first movement on.
 *
 * It sets itself a goal in task space, within what it has visited and a little beyond, and tries to
 * reach it with the model that it has; every sample on the way is learned. Where the model is wrong
 * about what a movement does, random motion is added, in proportion: all is noise at first, none
 * where it knows. Goals come with a random posture, which the joints that the goal leaves free go
 * to: a redundant arm would else know one posture for each place. A goal that gets no nearer is
 * given up: that is how the edge of the workspace is found.
 *
 * With experts on a body it first makes the motions that show one (tour.h), until the model knows
 * what moving does; its samples count where postures differ, for only these tell of a body. */
#include "common/base/random.h"
#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/tour.h"

#include <math.h>
#include <reach_status_t.h>
#include <string.h>

static const double reached = 0.03;      /* distance at which a goal counts as reached, scaled */
static const double progress_most = 0.9; /* of the nearest distance: anything less is progress */
static const double compare_at = 0.05;   /* motion after which prediction and truth are compared */
static const double compare_weight = 0.2;
static const double speed_least = 0.1; /* share of its speed that the arm keeps while eyes lag */
static const int64_t noise_us = 400000;
static const double ignorant = 0.2; /* the body is not known, or there is a new tool on it */

struct explore {
    struct random_state random;

    /* What was visited: a box in task space. Goals lie in it, and a little beyond. */
    bool any;
    double low[SPACE_DIMENSIONS], high[SPACE_DIMENSIONS];
    double q_seen[MAX_JOINTS]; /* where the end-effector was last seen well, rad */

    double goal[SPACE_DIMENSIONS]; /* task units */
    double posture[MAX_JOINTS];    /* that the null space goes to meanwhile, rad */
    double nearest;                /* to the goal so far, scaled */
    int64_t nearest_at;            /* us */

    double noise[MAX_JOINTS]; /* present direction, -1 .. 1 */
    int64_t noise_until;      /* us */

    /* How wrong the model is about what moving does: share of the motion, 1 = knows nothing. */
    double ignorance;
    bool compared;                      /* `q` and the rest hold */
    double q[MAX_JOINTS];               /* arm joints of the last sample, rad */
    double x_before[SPACE_DIMENSIONS];  /* where the comparison began */
    double predicted[SPACE_DIMENSIONS]; /* how far it should have moved since, task units */

    struct tour tour;
};

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

static bool explore_accepts(const struct config *config, const reach_request_t *request)
{
    (void)config;
    return control_count_ok(request);
}

static void explore_start(struct behaviour *behaviour, const reach_request_t *request,
                          const struct senses *senses, struct wants *wants)
{
    struct explore *explore = behaviour_state(behaviour);
    const struct config *config = senses->config;
    double low[MAX_JOINTS] = {0}, high[MAX_JOINTS] = {0};

    (void)wants;
    for (int i = 0; i < config_arm_joints(config); i++) {
        low[i] = config->arm_min.value[i] + config->motion_margin;
        high[i] = config->arm_max.value[i] - config->motion_margin;
    }
    tour_init(&explore->tour, senses, low, high);
    explore->random = random_seed(request->seed);
    explore->ignorance = 1;
    memcpy(explore->q_seen, senses->q, sizeof explore->q_seen);
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
static void compare_motion(struct explore *explore, const struct senses *senses,
                           const struct pair *pair)
{
    const struct config *config = senses->config;
    const double *jacobian = estimate_jacobian(senses->estimate);
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

static void gather_sample(struct behaviour *behaviour, const struct senses *senses,
                          struct wants *wants)
{
    struct explore *explore = behaviour_state(behaviour);

    if (!senses->sight->new_frame ||
        !sight_within(senses->sight, senses->config->explore_tolerance))
        return;
    control_gather(senses, wants, 1);
    if (!tour_shows_body(senses->config) ||
        tour_counts(&explore->tour, senses->config, wants->pair.q))
        behaviour->progress.done++;
    compare_motion(explore, senses, &wants->pair);
    if (!explore->any)
        next_goal(explore, senses->config, senses->time);
    widen(explore, wants->pair.x);
    memcpy(explore->q_seen, senses->q, sizeof explore->q_seen);
}

/* Goes on to the next goal when this one is reached, or gets no nearer. */
static void judge(struct behaviour *behaviour, const struct senses *senses, double distance)
{
    struct explore *explore = behaviour_state(behaviour);
    int64_t patience = (int64_t)(senses->config->explore_patience * 1e6);

    if (distance < progress_most * explore->nearest) {
        explore->nearest = distance;
        explore->nearest_at = senses->time;
    }
    if (distance < reached) {
        next_goal(explore, senses->config, senses->time);
    } else if (senses->time - explore->nearest_at > patience) {
        behaviour->progress.skipped++;
        next_goal(explore, senses->config, senses->time);
    }
}

/* Random motion of every joint, as strong as the model is ignorant. */
static void stir(struct explore *explore, const struct senses *senses, struct wants *wants)
{
    int n = config_arm_joints(senses->config);

    if (senses->time >= explore->noise_until) {
        for (int i = 0; i < n; i++)
            explore->noise[i] = random_uniform(&explore->random, -1, 1);
        explore->noise_until = senses->time + noise_us;
    }
    for (int i = 0; i < n; i++)
        wants->velocity[i] +=
            explore->ignorance * senses->config->explore_noise * explore->noise[i];
}

/* The eyes are to keep up: the arm slows down as the marker leaves the centre. */
static void wait_for_eyes(const struct senses *senses, struct wants *wants)
{
    const struct config *config = senses->config;
    double share = 1 - sight_eccentricity(senses->sight) / (2 * config->explore_tolerance);

    for (int i = 0; config->space.fixates && i < config_arm_joints(config); i++)
        wants->velocity[i] *= fmax(share, speed_least);
}

static void try_goal(struct behaviour *behaviour, const struct senses *senses, struct wants *wants)
{
    const struct config *config = senses->config;
    struct explore *explore = behaviour_state(behaviour);
    double x[SPACE_DIMENSIONS], left[SPACE_DIMENSIONS], distance, gain;

    sight_position(senses->sight, senses->q, x);
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        left[row] = explore->goal[row] - x[row];
    distance = scaled_norm(config, left);
    judge(behaviour, senses, distance);
    gain = fmin(config->task_gain, config->explore_speed / fmax(distance, 1e-9));
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        left[row] *= gain;
    /* Where it knows nothing, all joints are free: what it does then is `stir`'s. */
    control_task_velocity_by(senses, wants, left, explore->posture,
                             (1 - explore->ignorance) * config->explore_secondary_gain);
}

/* Returns false once the model knows what moving does. */
static bool go_on_tour(struct explore *explore, const struct senses *senses, struct wants *wants)
{
    if (tour_turn_joints(&explore->tour, senses, wants))
        return true;
    if (explore->ignorance < ignorant)
        return false;
    tour_visit_postures(&explore->tour, &explore->random, senses, wants);
    return true;
}

static bool explore_step(struct behaviour *behaviour, const struct senses *senses,
                         struct wants *wants)
{
    struct explore *explore = behaviour_state(behaviour);
    enum gaze_state gaze = control_gaze(senses, wants, true);

    if (behaviour->progress.done >= behaviour->progress.total)
        return false;
    behaviour->progress.phase =
        gaze == GAZE_ON_MARKER ? REACH_STATUS_T_TRACK : REACH_STATUS_T_SEARCH;
    if (gaze != GAZE_ON_MARKER) {
        control_arm_to(senses, wants, explore->q_seen);
        return true;
    }
    gather_sample(behaviour, senses, wants);
    if (tour_shows_body(senses->config) && go_on_tour(explore, senses, wants))
        return true;
    if (explore->any)
        try_goal(behaviour, senses, wants);
    stir(explore, senses, wants);
    wait_for_eyes(senses, wants);
    return true;
}

BEHAVIOUR_STATE_FITS(struct explore);

const struct behaviour_ops behaviour_explore = {
    .name = "explore",
    .kind = REACH_REQUEST_T_EXPLORE,
    .code = REACH_STATUS_T_EXPLORE,
    .state_size = sizeof(struct explore),
    .accepts = explore_accepts,
    .start = explore_start,
    .step = explore_step,
};
