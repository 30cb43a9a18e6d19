#include "tools/reachctl/outcome.h"

#include "tools/reachctl/view/show.h"

#include <math.h>
#include <stdio.h>

/* A target that is missed by more was not reached: several times what a robot misses that has
 * learned its arm, and less than anybody would call arrived. */
static const double reached_px = 10, reached_m = 0.02;

/* No arm of ours is longer; an image is usually of 640 x 480 px. */
static const double far_m = 3, far_u = 320, far_v = 240;

static bool reached(const reach_status_t *status, double error)
{
    return error <= (status->space == REACH_STATUS_T_CARTESIAN ? reached_m : reached_px);
}

static void close_target(struct outcome *outcome, const reach_status_t *status)
{
    if (outcome->heard && !reached(status, outcome->last)) {
        outcome->missed++;
        outcome->missed_last = outcome->last;
        outcome->missed_least = outcome->nearest;
    }
    outcome->heard = false;
}

void outcome_take(struct outcome *outcome, const reach_status_t *status)
{
    if (status->progress != outcome->progress)
        close_target(outcome, status);
    outcome->progress = status->progress;
    if (!(status->error > 0))
        return;
    outcome->nearest = outcome->heard ? fmin(outcome->nearest, status->error) : status->error;
    outcome->last = status->error;
    outcome->heard = true;
}

int outcome_end(struct outcome *outcome, const reach_status_t *at_work, char *error,
                size_t error_size)
{
    double scale = at_work->space == REACH_STATUS_T_CARTESIAN ? 1e3 : 1;

    close_target(outcome, at_work);
    if (outcome->missed == 0)
        return 0;
    snprintf(error, error_size,
             "%d of %d targets not reached; the last of them by %.1f %s, %.1f %s "
             "where it was nearest",
             outcome->missed, at_work->progress_total, scale * outcome->missed_last,
             show_error_unit(at_work), scale * outcome->missed_least, show_error_unit(at_work));
    return -1;
}

bool outcome_doubtful(const reach_status_t *status, const reach_request_t *request, char *why,
                      size_t why_size)
{
    for (int i = 0; i < request->n_targets; i++) {
        const double *target = request->target[i];
        if (status->space == REACH_STATUS_T_CARTESIAN &&
            hypot(hypot(target[0], target[1]), target[2]) > far_m) {
            snprintf(
                why, why_size,
                "(%g, %g, %g) is farther than an arm is long: targets of this robot are x, y, z "
                "in m, not px",
                target[0], target[1], target[2]);
            return true;
        }
        if (status->space != REACH_STATUS_T_CARTESIAN &&
            (fabs(target[0]) > far_u || fabs(target[1]) > far_v)) {
            snprintf(why, why_size,
                     "(%g, %g) px is outside of the right image, if that is of 640 x 480 px",
                     target[0], target[1]);
            return true;
        }
    }
    return false;
}
