/* Visually guided reaching (paper section 7.3): the head rests, the arm brings the marker to
 * targets in the image. */
#include "behaviour.h"
#include "targets.h"

#include <reach_status_t.h>

static bool reach_step(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    const double *target = NULL;
    double velocity[VISUAL_DIMENSIONS];

    switch (targets_step(behaviour, control, &target)) {
    case TARGETS_PREPARE:
        return true;
    case TARGETS_DONE:
        return false;
    default:
        break;
    }
    control_approach(control, target, config->task_gain, velocity);
    if (sight_seen(control->sight, control->now)) {
        control->gaze->last_seen = control->now;
        control_task_velocity(control, velocity);
    } else if ((double)(control->now - control->gaze->last_seen) * 1e-6 >
               config->fixation_timeout) {
        targets_refixate(behaviour);
    }
    return true;
}

const struct behaviour_ops behaviour_reach = {
    .name = "reach",
    .code = REACH_STATUS_T_REACH,
    .start = targets_start,
    .step = reach_step,
};
