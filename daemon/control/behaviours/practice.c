#include "daemon/control/behaviours/practice.h"

#include <math.h>
#include <reach_status_t.h>

static const unsigned window = 4; /* targets that "of late" goes over */

/* Whether the end-effector is too far from the target, in what is seen. */
static bool misses(const struct senses *senses, const double *target)
{
    const struct config *config = senses->config;
    double sum = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        sum += pow(target[row] - senses->sight->carried[row], 2);
    return sqrt(sum) > (config->space.kind == SPACE_CARTESIAN ? config->practice_tolerance_position
                                                              : config->practice_tolerance);
}

static int missed_of_late(unsigned missed)
{
    int count = 0;

    for (unsigned k = 0; k < window; k++)
        count += (missed & 1u << k) != 0;
    return count;
}

/* At the end of a target's time: whether to practise. */
static bool is_due(struct practice *practice, const struct progress *progress,
                   const struct targets *targets, const struct senses *senses)
{
    bool missed, again = practice->again;

    if (progress->phase != REACH_STATUS_T_TRACK || targets->deadline == 0 ||
        senses->time < targets->deadline)
        return false;
    missed = misses(senses, targets->target[progress->done]);
    practice->missed = (uint8_t)(practice->missed << 1 | missed);
    practice->again =
        missed && !again && missed_of_late(practice->missed) >= senses->config->practice_missed;
    return practice->again;
}

/* About where the arm is. */
static void begin_practice(struct practice *practice, int64_t seed, const struct senses *senses,
                           const struct wants *wants)
{
    const struct config *config = senses->config;
    struct babble *babble = &practice->babble;

    for (int i = 0; i < config_arm_joints(config); i++) {
        double least = config->babble_min.value[i], most = config->babble_max.value[i];
        double here = fmin(fmax(senses->q[i], least), most);
        babble->min[i] = fmax(here - config->practice_range, least);
        babble->max[i] = fmin(here + config->practice_range, most);
    }
    practice->on = true;
    practice->progress = (struct progress){.total = config->practice_samples};
    babble_begin(babble, seed, &practice->progress, senses, wants);
}

bool practice_step(struct practice *practice, struct behaviour *behaviour, struct targets *targets,
                   const struct senses *senses, struct wants *wants)
{
    struct progress *progress = &behaviour->progress;

    if (senses->config->practice_samples == 0 || !behaviour->learn)
        return false;
    if (!practice->on) {
        if (!is_due(practice, progress, targets, senses))
            return false;
        begin_practice(practice, behaviour->request_seq + progress->done, senses, wants);
    }
    /* What cannot be fixated counts as well: it ends in any case. */
    if (practice->progress.done + practice->progress.skipped >= practice->progress.total) {
        practice->on = false;
        targets_restart(targets, progress);
        return false;
    }
    babble_continue(&practice->babble, &practice->progress, senses, wants);
    progress->phase = REACH_STATUS_T_COLLECT;
    return true;
}
