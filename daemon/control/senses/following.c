#include "daemon/control/senses/following.h"

#include <math.h>
#include <string.h>

static const double window = 0.25; /* s; a joint that slowly leans on something is no trouble */
static const double look_period = 0.02; /* s, at least */
static const double share = 0.5;        /* of what was commanded, that may be missed */
static const int looks = 2;             /* in a row, before it is believed */

void following_init(struct following *following, const struct config *config)
{
    memset(following, 0, sizeof *following);
    following->config = config;
}

void following_forget(struct following *following)
{
    following_init(following, following->config);
}

/* Index of the entry `age` ticks ago. */
static int entry(const struct following *following, int age)
{
    return (following->newest - age + FOLLOWING_KEPT) % FOLLOWING_KEPT;
}

/* Ticks of a look. */
static int stride(const struct config *config)
{
    return config->period < look_period ? (int)(look_period / config->period + 0.5) : 1;
}

static void push(struct following *following, const double *q)
{
    size_t size = sizeof(double) * (size_t)config_joints(following->config);

    following->newest = (following->newest + 1) % FOLLOWING_KEPT;
    memcpy(following->commanded[following->newest], following->total, size);
    memcpy(following->measured[following->newest], q, size);
    following->kept += following->kept < FOLLOWING_KEPT;
}

/* Motion of a joint over so many looks: measured, and the least and greatest that was commanded
 * with any of the delays. */
struct motion {
    double measured, least, greatest;
};

static struct motion motion_over(const struct following *following, int joint, int span, int late)
{
    struct motion motion = {.measured = following->measured[entry(following, 0)][joint] -
                                        following->measured[entry(following, span)][joint],
                            .least = INFINITY,
                            .greatest = -INFINITY};

    for (int d = 0; d <= late; d++) {
        double commanded = following->commanded[entry(following, d)][joint] -
                           following->commanded[entry(following, d + span)][joint];
        motion.least = fmin(motion.least, commanded);
        motion.greatest = fmax(motion.greatest, commanded);
    }
    return motion;
}

static double nearest(const struct motion *motion)
{
    return fmin(fmax(motion->measured, motion->least), motion->greatest);
}

static enum following_fault judge(const struct following *following, const struct motion *motion)
{
    double tolerance = following->config->safety_following;
    double most = fmax(fabs(motion->least), fabs(motion->greatest));
    double missed = motion->measured - nearest(motion);

    if (most < tolerance || fabs(missed) <= tolerance + share * most)
        return FOLLOWING_WELL;
    if (fabs(motion->measured) <= 0.25 * most)
        return FOLLOWING_STILL;
    return motion->measured * nearest(motion) < 0 ? FOLLOWING_REVERSED : FOLLOWING_ASTRAY;
}

static void look_over(struct following *following)
{
    const struct config *config = following->config;
    double period = stride(config) * config->period;
    int span = (int)ceil(window / period - 1e-9);
    int late = (int)ceil(config->safety_latency / period - 1e-9) + 2;

    if (span + late >= following->kept)
        return;
    for (int i = 0; i < config_joints(config); i++) {
        struct motion motion = motion_over(following, i, span, late);
        enum following_fault fault = judge(following, &motion);
        if (fault == FOLLOWING_WELL)
            continue;
        following->wrong[i] += 2; /* one is taken back at each look */
        if (following->wrong[i] <= looks || following->joint)
            continue;
        following->joint = i + 1;
        following->fault = fault;
        following->missed = motion.measured - nearest(&motion);
    }
}

void following_look(struct following *following, const double *velocity, const double *q)
{
    int n = config_joints(following->config);

    for (int i = 0; i < n; i++)
        following->total[i] += velocity[i] * following->config->period;
    if (++following->ticks < stride(following->config))
        return;
    following->ticks = 0;
    push(following, q);
    for (int i = 0; i < n; i++)
        following->wrong[i] -= following->wrong[i] > 0;
    look_over(following);
}

bool following_doubts(const struct following *following)
{
    for (int i = 0; i < MAX_JOINTS; i++)
        if (following->wrong[i] > 0)
            return true;
    return false;
}
