#include "daemon/control/behaviours/practice.h"

#include "daemon/control/behaviours/targets.h"

#include <math.h>
#include <reach_status_t.h>

static const unsigned window = 4; /* targets that "of late" goes over */

/* Whether the end-effector is too far from the target, in what is seen. */
static bool misses(const struct control *control, const double *target)
{
    const struct config *config = control->config;
    double sum = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        sum += pow(target[row] - control->sight->carried[row], 2);
    return sqrt(sum) > (config->space.fixates ? config->practice_tolerance
                                              : config->practice_tolerance_position);
}

static int missed_of_late(unsigned missed)
{
    int count = 0;

    for (unsigned k = 0; k < window; k++)
        count += (missed & 1u << k) != 0;
    return count;
}

/* At the end of a target's time: whether to practise. */
static bool is_due(struct behaviour *behaviour, const struct control *control)
{
    struct targets *targets = &behaviour->targets;
    struct practice *practice = &targets->practice;
    bool missed, again = practice->again;

    if (behaviour->progress.phase != REACH_STATUS_T_TRACK || targets->deadline == 0 ||
        control->now < targets->deadline)
        return false;
    missed = misses(control, targets->target[behaviour->progress.done]);
    practice->missed = (uint8_t)(practice->missed << 1 | missed);
    practice->again =
        missed && !again && missed_of_late(practice->missed) >= control->config->practice_missed;
    return practice->again;
}

static void begin(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    struct practice *practice = &behaviour->targets.practice;
    double min[MAX_JOINTS], max[MAX_JOINTS];

    for (int i = 0; i < config_arm_joints(config); i++) {
        double least = config->babble_min.value[i], most = config->babble_max.value[i];
        double here = fmin(fmax(control->q[i], least), most);
        min[i] = fmax(here - config->practice_range, least);
        max[i] = fmin(here + config->practice_range, most);
    }
    practice->on = true;
    practice->progress = (struct progress){.total = config->practice_samples};
    babble_begin(&practice->babble, behaviour->request_seq + behaviour->progress.done, min, max,
                 &practice->progress, control);
}

bool practice_step(struct behaviour *behaviour, struct control *control)
{
    struct practice *practice = &behaviour->targets.practice;

    if (control->config->practice_samples == 0 || !behaviour->learn)
        return false;
    if (!practice->on) {
        if (!is_due(behaviour, control))
            return false;
        begin(behaviour, control);
    }
    /* What cannot be fixated counts as well: it ends in any case. */
    if (practice->progress.done + practice->progress.skipped >= practice->progress.total) {
        practice->on = false;
        targets_restart(behaviour);
        return false;
    }
    babble_run(&practice->babble, &practice->progress, control);
    behaviour->progress.phase = REACH_STATUS_T_COLLECT;
    return true;
}
