/* Motor babbling: random configurations, fixation, one sample at each (paper section 7.1); or,
 * where the end-effector is measured wherever it is, every measurement along the way (section 6.1).
 */
#include "daemon/control/behaviours/behaviour.h"

#include <reach_status_t.h>
#include <string.h>

static const int most_draws = 20;  /* for a posture that promises something */
static const double daring = 0.05; /* chance of a posture that promises nothing */

static void draw(struct babble *babble, const struct config *config)
{
    for (int i = 0; i < config_arm_joints(config); i++)
        babble->goal[i] = random_uniform(&babble->random, babble->min[i], babble->max[i]);
}

/* A random posture that promises to be of use, or now and then one that does not. */
static void next_goal(struct babble *babble, struct progress *progress, struct control *control)
{
    const struct config *config = control->config;

    draw(babble, config);
    for (int k = 1; k < most_draws && !tried_promises(control->tried, config, babble->goal); k++) {
        if (random_uniform(&babble->random, 0, 1) < daring)
            break;
        draw(babble, config);
    }
    babble->deadline = control->now + (int64_t)(config->babble_timeout * 1e6);
    progress->phase = REACH_STATUS_T_MOVE;
}

static void gather(struct progress *progress, struct control *control)
{
    control_gather(control, sight_pair_frames(control->config));
    progress->done++;
}

void babble_begin(struct babble *babble, int64_t seed, const double *min, const double *max,
                  struct progress *progress, struct control *control)
{
    size_t size = sizeof(double) * (size_t)config_arm_joints(control->config);

    babble->random = random_seed(seed);
    memcpy(babble->min, min, size);
    memcpy(babble->max, max, size);
    next_goal(babble, progress, control);
}

static void babble_start(struct behaviour *behaviour, const reach_request_t *request,
                         struct control *control)
{
    const struct config *config = control->config;

    behaviour->progress.total = request->count;
    babble_begin(&behaviour->babble, request->seed, config->babble_min.value,
                 config->babble_max.value, &behaviour->progress, control);
}

/* The arm is there, or as near as it gets: wait for the eyes. */
static void move(struct babble *babble, struct progress *progress, struct control *control)
{
    bool there = control_arm_to(control, babble->goal);

    control_gaze(control, false);
    if (!control->config->space.fixates) {
        if (control->sight->new_frame)
            gather(progress, control);
        if (there || control->now >= babble->deadline)
            next_goal(babble, progress, control);
        return;
    }
    if (there || control->now >= babble->deadline) {
        babble->deadline = control->now + (int64_t)(control->config->fixation_timeout * 1e6);
        progress->phase = REACH_STATUS_T_FIXATE;
    }
}

static void fixate(struct babble *babble, struct progress *progress, struct control *control)
{
    enum gaze_state gaze;

    control_arm_to(control, babble->goal);
    gaze = control_gaze(control, true);
    progress->phase = gaze == GAZE_SEARCHING ? REACH_STATUS_T_SEARCH : REACH_STATUS_T_FIXATE;
    /* What was fixated before the eyes went blind is no new sample. */
    if (gaze == GAZE_ON_MARKER && sight_fixated(control->sight)) {
        tried_note(control->tried, babble->goal, true);
        gather(progress, control);
        next_goal(babble, progress, control);
    } else if (control->now >= babble->deadline) {
        tried_note(control->tried, babble->goal, false);
        progress->skipped++;
        next_goal(babble, progress, control);
    }
}

void babble_run(struct babble *babble, struct progress *progress, struct control *control)
{
    if (progress->phase == REACH_STATUS_T_MOVE)
        move(babble, progress, control);
    else
        fixate(babble, progress, control);
}

static bool babble_step(struct behaviour *behaviour, struct control *control)
{
    if (behaviour->progress.done >= behaviour->progress.total)
        return false;
    babble_run(&behaviour->babble, &behaviour->progress, control);
    return true;
}

const struct behaviour_ops behaviour_babble = {
    .name = "babble",
    .code = REACH_STATUS_T_BABBLE,
    .start = babble_start,
    .step = babble_step,
};
