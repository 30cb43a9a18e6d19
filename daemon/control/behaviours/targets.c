#include "daemon/control/behaviours/targets.h"

#include "common/base/elementary.h"
#include "daemon/control/behaviours/helpers.h"

#include <reach_status_t.h>
#include <string.h>

static const double period_most = 3600; /* s */

bool targets_accept(const struct config *config, const reach_request_t *request)
{
    if (request->n_targets < 1 || request->n_targets > MAX_TARGETS ||
        !(request->period > 0 && request->period <= period_most))
        return false;
    for (int i = 0; i < request->n_targets; i++)
        if (!observation_is_sensible(&config->space, request->target[i]))
            return false;
    return request->count == 0 || request->count == 1;
}

void targets_begin(struct targets *targets, struct progress *progress,
                   const reach_request_t *request, const struct config *config)
{
    targets->n = request->n_targets;
    memcpy(targets->target, request->target, sizeof targets->target);
    targets->period = (int64_t)(request->period * 1e6);
    control_babble_centre(config, targets->start);
    progress->total = targets->n;
    progress->phase = request->count == 1 ? REACH_STATUS_T_MOVE : REACH_STATUS_T_FIXATE;
}

void targets_refixate(struct targets *targets, struct progress *progress)
{
    targets->deadline = 0;
    progress->phase = REACH_STATUS_T_FIXATE;
}

void targets_restart(struct targets *targets, struct progress *progress)
{
    targets->deadline = 0;
    progress->phase = REACH_STATUS_T_MOVE;
}

/* The phases before the first target. */
static void prepare(struct targets *targets, struct progress *progress, const struct senses *senses,
                    struct wants *wants)
{
    if (progress->phase == REACH_STATUS_T_MOVE) {
        if (control_arm_to(senses, wants, targets->start))
            progress->phase = REACH_STATUS_T_FIXATE;
        control_gaze(senses, wants, false);
        return;
    }
    if (control_gaze(senses, wants, true) == GAZE_SEARCHING)
        progress->phase = REACH_STATUS_T_SEARCH;
    else
        progress->phase = REACH_STATUS_T_FIXATE;
    if (!sight_fixated(senses->sight))
        return;
    control_gather(senses, wants, sight_pair_frames(senses->config));
    memcpy(targets->start, senses->q, sizeof targets->start);
    progress->phase = REACH_STATUS_T_TRACK;
}

void targets_slide(double period, double smoothing, const double *target, double *setpoint, int n)
{
    double share = smoothing > 0 ? 1 - elementary_exp(-period / smoothing) : 1;

    for (int i = 0; i < n; i++)
        setpoint[i] += share * (target[i] - setpoint[i]);
}

enum targets_work targets_step(struct targets *targets, struct progress *progress,
                               const struct senses *senses, struct wants *wants,
                               const double **target)
{
    bool is_new = targets->deadline == 0;

    if (progress->phase != REACH_STATUS_T_TRACK) {
        prepare(targets, progress, senses, wants);
        return TARGETS_PREPARE;
    }
    if (!is_new && senses->time >= targets->deadline) {
        progress->done++;
        is_new = true;
    }
    if (progress->done >= targets->n)
        return TARGETS_DONE;
    *target = targets->target[progress->done];
    if (!is_new)
        return TARGETS_PURSUE;
    targets->deadline = senses->time + targets->period;
    return TARGETS_PRESENT;
}
