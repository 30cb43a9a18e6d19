/* Reaching (paper sections 6.2 and 7.3): the head, if there is one, rests, and the arm brings the
 * end-effector to targets in the image or in the ground frame. */
#include "daemon/control/behaviours/behaviour.h"
#include "daemon/control/behaviours/practice.h"
#include "daemon/control/behaviours/targets.h"

#include <reach_status_t.h>
#include <string.h>

static bool reach_step(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    const double *target = NULL;
    double *setpoint = behaviour->targets.setpoint;
    double velocity[SPACE_DIMENSIONS];

    if (practice_step(behaviour, control))
        return true;
    switch (targets_step(behaviour, control, &target)) {
    case TARGETS_PREPARE:
        memcpy(setpoint, control->sight->carried, sizeof behaviour->targets.setpoint);
        return true;
    case TARGETS_DONE:
        return false;
    default:
        break;
    }
    targets_slide(config->period, config->task_smoothing, target, setpoint, SPACE_DIMENSIONS);
    control_approach(control, setpoint, config->task_gain, velocity);
    memcpy(control->target, target, sizeof control->target);
    if (sight_seen(control->sight, control->now)) {
        control->gaze->last_seen = control->now;
        control_task_velocity(control, velocity);
    } else if ((double)(control->now - control->gaze->last_seen) * 1e-6 >
               config->fixation_timeout) {
        targets_refixate(behaviour);
    }
    /* What is measured wherever it is, is learned wherever it is. */
    if (control->sight->new_frame && !config->space.fixates)
        control_gather(control, 1);
    return true;
}

const struct behaviour_ops behaviour_reach = {
    .name = "reach",
    .code = REACH_STATUS_T_REACH,
    .start = targets_start,
    .step = reach_step,
};
