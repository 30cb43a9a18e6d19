/* Reaching (paper sections 6.2 and 7.3): the head, if there is one, rests, and the arm brings the
 * end-effector to targets in the image or in the ground frame. */
#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/imagine.h"
#include "daemon/control/behaviours/practice.h"
#include "daemon/control/behaviours/targets.h"

#include <math.h>
#include <reach_status_t.h>
#include <string.h>

/* What becomes of the present target. */
enum way { WAY_STRAIGHT, WAY_IMAGINED, WAY_BY_JOINTS };

struct reach {
    struct targets targets; /* first: whoever knows of reaching only its targets finds them here */
    struct practice practice;
    enum way way;
    struct imagine imagine;
    double nearest;     /* to the present target since the way was found, scaled */
    int64_t nearest_at; /* us */
};

static const double progress_most = 0.9; /* of the nearest distance: anything less is progress */
static const int64_t patience_us = 1000000;
static const double close = 0.05;  /* to the target, scaled: no detour would be shorter */
static const double arrived = 0.1; /* rad from the imagined posture: the rest is the target's */

/* A body that is known holds over the whole range of the joints: it can say how to get somewhere,
 * which polynomials cannot. In an image the head decides what the target is in the end. */
static bool imagines(const struct senses *senses)
{
    return learner_body(senses->learner) && !senses->config->space.fixates;
}

/* Whether the arm gets no nearer on the straight way: the model's, and the arm's own, may differ.
 */
static bool is_stuck(struct reach *reach, const double *target, const struct senses *senses)
{
    const double *scale = senses->config->space.scale;
    double sum = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        double left = (target[row] - senses->sight->carried[row]) / scale[row];
        sum += left * left;
    }
    if (sqrt(sum) < progress_most * reach->nearest) {
        reach->nearest = sqrt(sum);
        reach->nearest_at = senses->time;
    }
    return reach->nearest > close && senses->time - reach->nearest_at > patience_us;
}

static void go_straight(struct reach *reach, const struct senses *senses)
{
    reach->way = WAY_STRAIGHT;
    reach->nearest = INFINITY;
    reach->nearest_at = senses->time;
}

/* Imagines the way to a new target, then drives to the posture that was found where the straight
 * way ends elsewhere. Returns whether that is still going on. */
static bool find_way(struct reach *reach, const double *target, const struct senses *senses,
                     struct wants *wants)
{
    double farthest = 0;

    if (!imagines(senses)) { /* nor does it follow what a body said that is gone by now */
        go_straight(reach, senses);
        return false;
    }
    if (reach->way == WAY_STRAIGHT) {
        if (!is_stuck(reach, target, senses))
            return false;
        reach->way = WAY_IMAGINED;
        imagine_detour(&reach->imagine, target, senses);
    }
    if (reach->way == WAY_IMAGINED) {
        enum imagined imagined = imagine_go_on(&reach->imagine, senses);
        if (imagined == IMAGINED_NOT_YET)
            return true;
        go_straight(reach, senses);
        if (imagined != IMAGINED_BY_JOINTS)
            return false;
        reach->way = WAY_BY_JOINTS;
    }
    control_arm_to(senses, wants, reach->imagine.q);
    for (int i = 0; i < config_arm_joints(senses->config); i++)
        farthest = fmax(farthest, fabs(reach->imagine.q[i] - senses->q[i]));
    if (farthest > arrived)
        return true;
    go_straight(reach, senses);
    return false;
}

static void reach_start(struct behaviour *behaviour, const reach_request_t *request,
                        const struct senses *senses, struct wants *wants)
{
    struct reach *reach = behaviour_state(behaviour);

    (void)wants;
    targets_begin(&reach->targets, &behaviour->progress, request, senses->config);
}

/* The law of the paper, towards the set-point that slides to the target. */
static void approach(struct reach *reach, struct progress *progress, const double *target,
                     const struct senses *senses, struct wants *wants)
{
    const struct config *config = senses->config;
    struct targets *targets = &reach->targets;
    double velocity[SPACE_DIMENSIONS];

    targets_slide(config->period, config->task_smoothing, target, targets->setpoint,
                  SPACE_DIMENSIONS);
    control_approach(senses, wants, targets->setpoint, config->task_gain, velocity);
    memcpy(wants->target, target, sizeof wants->target);
    if (sight_seen(senses->sight, senses->now)) {
        wants->gaze->last_seen = senses->time;
        control_task_velocity(senses, wants, velocity);
    } else if ((double)(senses->time - wants->gaze->last_seen) * 1e-6 > config->fixation_timeout) {
        targets_refixate(targets, progress);
    }
}

static bool reach_step(struct behaviour *behaviour, const struct senses *senses,
                       struct wants *wants)
{
    const struct config *config = senses->config;
    struct reach *reach = behaviour_state(behaviour);
    struct targets *targets = &reach->targets;
    const double *target = NULL;
    double *setpoint = targets->setpoint;

    if (practice_step(&reach->practice, behaviour, targets, senses, wants))
        return true;
    switch (targets_step(targets, &behaviour->progress, senses, wants, &target)) {
    case TARGETS_PREPARE:
        memcpy(setpoint, senses->sight->carried, sizeof targets->setpoint);
        return true;
    case TARGETS_DONE:
        return false;
    case TARGETS_PRESENT:
        go_straight(reach, senses);
        if (imagines(senses))
            reach->way = WAY_IMAGINED;
        imagine_begin(&reach->imagine, target, senses);
        break;
    default:
        break;
    }
    /* What is measured wherever it is, is learned wherever it is. */
    if (senses->sight->new_frame && !config->space.fixates)
        control_gather(senses, wants, 1);
    if (find_way(reach, target, senses, wants)) {
        memcpy(wants->target, target, sizeof wants->target);
        wants->has_target = true;
        memcpy(setpoint, senses->sight->carried, sizeof targets->setpoint);
        return true;
    }
    approach(reach, &behaviour->progress, target, senses, wants);
    return true;
}

BEHAVIOUR_STATE_FITS(struct reach);

const struct behaviour_ops behaviour_reach = {
    .name = "reach",
    .kind = REACH_REQUEST_T_REACH,
    .code = REACH_STATUS_T_REACH,
    .state_size = sizeof(struct reach),
    .accepts = targets_accept,
    .start = reach_start,
    .step = reach_step,
};
