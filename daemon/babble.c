/* Motor babbling: random configurations, fixation, one sample at each (paper section 7.1); or,
 * where the end-effector is measured wherever it is, every measurement along the way (section 6.1).
 */
#include "behaviour.h"

#include <reach_status_t.h>

static const int most_draws = 20;  /* for a posture that promises something */
static const double daring = 0.05; /* chance of a posture that promises nothing */

static void draw(struct babble *babble, const struct config *config)
{
    for (int i = 0; i < config_arm_joints(config); i++)
        babble->goal[i] = random_uniform(&babble->random, config->babble_min.value[i],
                                         config->babble_max.value[i]);
}

/* A random posture that promises to be of use, or now and then one that does not. */
static void next_goal(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    struct babble *babble = &behaviour->babble;

    draw(babble, config);
    for (int k = 1; k < most_draws && !tried_promises(control->tried, config, babble->goal); k++) {
        if (random_uniform(&babble->random, 0, 1) < daring)
            break;
        draw(babble, config);
    }
    babble->deadline = control->now + (int64_t)(config->babble_timeout * 1e6);
    behaviour->progress.phase = REACH_STATUS_T_MOVE;
}

static void gather(struct behaviour *behaviour, struct control *control)
{
    control_gather(control, sight_pair_frames(control->config));
    behaviour->progress.done++;
}

static void babble_start(struct behaviour *behaviour, const reach_request_t *request,
                         struct control *control)
{
    behaviour->babble.random = random_seed(request->seed);
    behaviour->progress.total = request->count;
    next_goal(behaviour, control);
}

/* The arm is there, or as near as it gets: wait for the eyes. */
static void move(struct behaviour *behaviour, struct control *control)
{
    struct babble *babble = &behaviour->babble;
    bool there = control_arm_to(control, babble->goal);

    control_gaze(control, false);
    if (!control->config->space.fixates) {
        if (control->sight->new_frame)
            gather(behaviour, control);
        if (there || control->now >= babble->deadline)
            next_goal(behaviour, control);
        return;
    }
    if (there || control->now >= babble->deadline) {
        babble->deadline = control->now + (int64_t)(control->config->fixation_timeout * 1e6);
        behaviour->progress.phase = REACH_STATUS_T_FIXATE;
    }
}

static void fixate(struct behaviour *behaviour, struct control *control)
{
    struct progress *progress = &behaviour->progress;
    enum gaze_state gaze;

    control_arm_to(control, behaviour->babble.goal);
    gaze = control_gaze(control, true);
    progress->phase = gaze == GAZE_SEARCHING ? REACH_STATUS_T_SEARCH : REACH_STATUS_T_FIXATE;
    /* What was fixated before the eyes went blind is no new sample. */
    if (gaze == GAZE_ON_MARKER && sight_fixated(control->sight)) {
        tried_note(control->tried, behaviour->babble.goal, true);
        gather(behaviour, control);
        next_goal(behaviour, control);
    } else if (control->now >= behaviour->babble.deadline) {
        tried_note(control->tried, behaviour->babble.goal, false);
        progress->skipped++;
        next_goal(behaviour, control);
    }
}

static bool babble_step(struct behaviour *behaviour, struct control *control)
{
    if (behaviour->progress.done >= behaviour->progress.total)
        return false;
    if (behaviour->progress.phase == REACH_STATUS_T_MOVE)
        move(behaviour, control);
    else
        fixate(behaviour, control);
    return true;
}

const struct behaviour_ops behaviour_babble = {
    .name = "babble",
    .code = REACH_STATUS_T_BABBLE,
    .start = babble_start,
    .step = babble_step,
};
