/* Reaching (paper sections 6.2 and 7.3): the head, if there is one, rests, and the arm brings the
 * end-effector to targets in the image or in the ground frame. */
#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/practice.h"
#include "daemon/control/behaviours/targets.h"

#include <reach_status_t.h>
#include <string.h>

struct reach {
    struct targets targets; /* first: whoever knows of reaching only its targets finds them here */
    struct practice practice;
};

static void reach_start(struct behaviour *behaviour, const reach_request_t *request,
                        const struct senses *senses, struct wants *wants)
{
    struct reach *reach = behaviour_state(behaviour);

    (void)wants;
    targets_begin(&reach->targets, &behaviour->progress, request, senses->config);
}

static bool reach_step(struct behaviour *behaviour, const struct senses *senses,
                       struct wants *wants)
{
    const struct config *config = senses->config;
    struct reach *reach = behaviour_state(behaviour);
    struct targets *targets = &reach->targets;
    const double *target = NULL;
    double *setpoint = targets->setpoint;
    double velocity[SPACE_DIMENSIONS];

    if (practice_step(&reach->practice, behaviour, targets, senses, wants))
        return true;
    switch (targets_step(targets, &behaviour->progress, senses, wants, &target)) {
    case TARGETS_PREPARE:
        memcpy(setpoint, senses->sight->carried, sizeof targets->setpoint);
        return true;
    case TARGETS_DONE:
        return false;
    default:
        break;
    }
    targets_slide(config->period, config->task_smoothing, target, setpoint, SPACE_DIMENSIONS);
    control_approach(senses, wants, setpoint, config->task_gain, velocity);
    memcpy(wants->target, target, sizeof wants->target);
    if (sight_seen(senses->sight, senses->now)) {
        wants->gaze->last_seen = senses->now;
        control_task_velocity(senses, wants, velocity);
    } else if ((double)(senses->now - wants->gaze->last_seen) * 1e-6 > config->fixation_timeout) {
        targets_refixate(targets, &behaviour->progress);
    }
    /* What is measured wherever it is, is learned wherever it is. */
    if (senses->sight->new_frame && !config->space.fixates)
        control_gather(senses, wants, 1);
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
