/* Motor babbling: random configurations, fixation, one sample at each (paper section 7.1); or,
 * where the end-effector is measured wherever it is, every measurement along the way (section 6.1).
 */
#include "daemon/control/behaviours/babble.h"

#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/tour.h"

#include <reach_status_t.h>
#include <string.h>

static const int most_draws = 20;  /* for a posture that promises something */
static const double daring = 0.05; /* chance of a posture that promises nothing */

/* Without a body it begins with each joint alone (tour.h), where so many samples are wanted that
 * half of them are left for random postures. */
struct babbling {
    struct babble babble;
    struct tour tour;
    bool tours;
};

static void draw(struct babble *babble, const struct config *config)
{
    for (int i = 0; i < config_arm_joints(config); i++)
        babble->goal[i] = random_uniform(&babble->random, babble->min[i], babble->max[i]);
}

/* A random posture that promises to be of use, or now and then one that does not. */
static void next_goal(struct babble *babble, struct progress *progress, const struct senses *senses,
                      const struct tried *tried)
{
    const struct config *config = senses->config;

    draw(babble, config);
    for (int k = 1; k < most_draws && !tried_promises(tried, config, babble->goal); k++) {
        if (random_uniform(&babble->random, 0, 1) < daring)
            break;
        draw(babble, config);
    }
    babble->deadline = senses->time + (int64_t)(config->babble_timeout * 1e6);
    progress->phase = REACH_STATUS_T_MOVE;
}

static void gather_sample(struct progress *progress, const struct senses *senses,
                          struct wants *wants)
{
    control_gather(senses, wants, sight_pair_frames(senses->config));
    progress->done++;
}

void babble_begin(struct babble *babble, int64_t seed, struct progress *progress,
                  const struct senses *senses, const struct wants *wants)
{
    babble->random = random_seed(seed);
    next_goal(babble, progress, senses, wants->tried);
}

static bool babble_accepts(const struct config *config, const reach_request_t *request)
{
    (void)config;
    return control_count_ok(request);
}

static void babble_start(struct behaviour *behaviour, const reach_request_t *request,
                         const struct senses *senses, struct wants *wants)
{
    struct babbling *babbling = behaviour_state(behaviour);
    struct babble *babble = &babbling->babble;

    behaviour->progress.total = request->count;
    memcpy(babble->min, senses->config->babble_min.value, sizeof babble->min);
    memcpy(babble->max, senses->config->babble_max.value, sizeof babble->max);
    babble_begin(babble, request->seed, &behaviour->progress, senses, wants);
    babbling->tours = request->learn && tour_shows_body(senses->config) &&
                      request->count >= 2 * tour_ticks(senses->config);
    tour_init(&babbling->tour, senses, babble->min, babble->max);
}

/* The arm is there, or as near as it gets: wait for the eyes. */
static void go_to_goal(struct babble *babble, struct progress *progress,
                       const struct senses *senses, struct wants *wants)
{
    bool there = control_arm_to(senses, wants, babble->goal);

    control_gaze(senses, wants, false);
    if (!senses->config->space.fixates) {
        if (senses->sight->new_frame)
            gather_sample(progress, senses, wants);
        if (there || senses->time >= babble->deadline)
            next_goal(babble, progress, senses, wants->tried);
        return;
    }
    if (there || senses->time >= babble->deadline) {
        babble->deadline = senses->time + (int64_t)(senses->config->fixation_timeout * 1e6);
        progress->phase = REACH_STATUS_T_FIXATE;
    }
}

static void fixate_at_goal(struct babble *babble, struct progress *progress,
                           const struct senses *senses, struct wants *wants)
{
    enum gaze_state gaze;

    control_arm_to(senses, wants, babble->goal);
    gaze = control_gaze(senses, wants, true);
    progress->phase = gaze == GAZE_SEARCHING ? REACH_STATUS_T_SEARCH : REACH_STATUS_T_FIXATE;
    /* What was fixated before the eyes went blind is no new sample. */
    if (gaze == GAZE_ON_MARKER && sight_fixated(senses->sight)) {
        tried_note(wants->tried, babble->goal, true);
        gather_sample(progress, senses, wants);
        next_goal(babble, progress, senses, wants->tried);
    } else if (senses->time >= babble->deadline) {
        tried_note(wants->tried, babble->goal, false);
        progress->skipped++;
        next_goal(babble, progress, senses, wants->tried);
    }
}

void babble_continue(struct babble *babble, struct progress *progress, const struct senses *senses,
                     struct wants *wants)
{
    if (progress->phase == REACH_STATUS_T_MOVE)
        go_to_goal(babble, progress, senses, wants);
    else
        fixate_at_goal(babble, progress, senses, wants);
}

static bool babble_step(struct behaviour *behaviour, const struct senses *senses,
                        struct wants *wants)
{
    struct babbling *babbling = behaviour_state(behaviour);

    if (behaviour->progress.done >= behaviour->progress.total)
        return false;
    babbling->tours = babbling->tours && tour_turn_joints(&babbling->tour, senses, wants);
    if (!babbling->tours)
        babble_continue(&babbling->babble, &behaviour->progress, senses, wants);
    else if (senses->sight->new_frame)
        gather_sample(&behaviour->progress, senses, wants);
    return true;
}

BEHAVIOUR_STATE_FITS(struct babbling);

const struct behaviour_ops behaviour_babble = {
    .name = "babble",
    .kind = REACH_REQUEST_T_BABBLE,
    .code = REACH_STATUS_T_BABBLE,
    .state_size = sizeof(struct babbling),
    .accepts = babble_accepts,
    .start = babble_start,
    .step = babble_step,
};
