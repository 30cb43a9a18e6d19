#include "daemon/control/behaviours/targets.h"

#include "common/base/elementary.h"

#include <reach_status_t.h>
#include <string.h>

void targets_start(struct behaviour *behaviour, const reach_request_t *request,
                   struct control *control)
{
    struct targets *targets = &behaviour->targets;

    targets->n = request->n_targets;
    memcpy(targets->target, request->target, sizeof targets->target);
    targets->period = (int64_t)(request->period * 1e6);
    control_babble_centre(control->config, targets->start);
    behaviour->progress.total = targets->n;
    behaviour->progress.phase = request->count == 1 ? REACH_STATUS_T_MOVE : REACH_STATUS_T_FIXATE;
}

void targets_refixate(struct behaviour *behaviour)
{
    behaviour->targets.deadline = 0;
    behaviour->progress.phase = REACH_STATUS_T_FIXATE;
}

void targets_restart(struct behaviour *behaviour)
{
    behaviour->targets.deadline = 0;
    behaviour->progress.phase = REACH_STATUS_T_MOVE;
}

/* The phases before the first target. */
static void prepare(struct behaviour *behaviour, struct control *control)
{
    struct progress *progress = &behaviour->progress;
    struct targets *targets = &behaviour->targets;

    if (progress->phase == REACH_STATUS_T_MOVE) {
        if (control_arm_to(control, targets->start))
            progress->phase = REACH_STATUS_T_FIXATE;
        control_gaze(control, false);
        return;
    }
    if (control_gaze(control, true) == GAZE_SEARCHING)
        progress->phase = REACH_STATUS_T_SEARCH;
    else
        progress->phase = REACH_STATUS_T_FIXATE;
    if (!sight_fixated(control->sight))
        return;
    control_gather(control, sight_pair_frames(control->config));
    memcpy(targets->start, control->q, sizeof targets->start);
    progress->phase = REACH_STATUS_T_TRACK;
}

void targets_slide(double period, double smoothing, const double *target, double *setpoint, int n)
{
    double share = smoothing > 0 ? 1 - elementary_exp(-period / smoothing) : 1;

    for (int i = 0; i < n; i++)
        setpoint[i] += share * (target[i] - setpoint[i]);
}

enum targets_work targets_step(struct behaviour *behaviour, struct control *control,
                               const double **target)
{
    struct targets *targets = &behaviour->targets;
    struct progress *progress = &behaviour->progress;
    bool is_new = targets->deadline == 0;

    if (progress->phase != REACH_STATUS_T_TRACK) {
        prepare(behaviour, control);
        return TARGETS_PREPARE;
    }
    if (!is_new && control->now >= targets->deadline) {
        progress->done++;
        is_new = true;
    }
    if (progress->done >= targets->n)
        return TARGETS_DONE;
    *target = targets->target[progress->done];
    if (!is_new)
        return TARGETS_PURSUE;
    targets->deadline = control->now + targets->period;
    return TARGETS_PRESENT;
}
