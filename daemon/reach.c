/* Visually guided reaching (paper section 7.3): the head rests, the arm brings the marker to
 * targets in the image. */
#include "behaviour.h"
#include "targets.h"

#include <reach_status_t.h>
#include <string.h>

/* Equation 5 in image terms: the task velocity that takes the marker to the target. */
static void approach(struct control *control, const double *target)
{
    double error[VISUAL_DIMENSIONS];
    double velocity[VISUAL_DIMENSIONS];

    for (int row = 0; row < VISUAL_DIMENSIONS; row++)
        error[row] = target[row] - control->sight->carried[row];
    visual_to_task(control->config->pixels_per_radian, error, velocity);
    for (int row = 0; row < VISUAL_DIMENSIONS; row++)
        velocity[row] *= control->config->task_gain;
    control_task_velocity(control, velocity);
}

static bool reach_step(struct behaviour *behaviour, struct control *control)
{
    const double *target;
    bool is_new;

    if (behaviour->progress.phase != REACH_STATUS_T_TRACK) {
        if (targets_prepare(behaviour, control))
            control_gather(control, control->config->fixation_frames);
        return true;
    }
    target = targets_current(behaviour, control, &is_new);
    if (!target)
        return false;
    memcpy(control->target, target, sizeof control->target);
    control->has_target = true;
    if (sight_seen(control->sight, control->now))
        approach(control, target);
    else if ((double)(control->now - control->gaze->last_seen) * 1e-6 >
             control->config->fixation_timeout)
        targets_refixate(behaviour);
    if (sight_seen(control->sight, control->now))
        control->gaze->last_seen = control->now;
    return true;
}

const struct behaviour_ops behaviour_reach = {
    .name = "reach",
    .code = REACH_STATUS_T_REACH,
    .start = targets_start,
    .step = reach_step,
};
