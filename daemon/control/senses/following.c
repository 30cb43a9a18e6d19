#include "daemon/control/senses/following.h"

#include <math.h>
#include <string.h>

static const double window = 0.25;      /* s */
static const double look_period = 0.02; /* s, at least */
static const double share = 0.5;        /* of what was commanded, that may be missed */
/* Tolerances that must be commanded in a window, of a joint that did follow: when it is slow it may
 * lean on something, and when it is pushed meanwhile that says nothing of its motor. */
static const double judged = 1.5;
static const double proof = 1; /* s of motion after which a joint has shown that it follows */
static const int looks = 2;    /* in a row, for one that has not */

void following_init(struct following *following, const struct config *config)
{
    memset(following, 0, sizeof *following);
    following->config = config;
}

void following_forget(struct following *following)
{
    following->kept = 0;
    following->doubts = false;
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

static double greatest_of(const struct motion *motion)
{
    return fmax(fabs(motion->least), fabs(motion->greatest));
}

static enum following_fault judge(const struct following *following, const struct motion *motion)
{
    double missed = motion->measured - nearest(motion), most = greatest_of(motion);

    if (fabs(missed) <= following->config->safety_following + share * most)
        return FOLLOWING_WELL;
    if (fabs(motion->measured) <= 0.25 * most)
        return FOLLOWING_STILL;
    return motion->measured * nearest(motion) < 0 ? FOLLOWING_REVERSED : FOLLOWING_ASTRAY;
}

static bool has_followed(const struct following *following, int joint)
{
    return following->well[joint] >= proof;
}

/* What is well counts twice. */
static void count(struct following *following, int joint, const struct motion *motion,
                  double period)
{
    double *wrong = &following->wrong[joint], *well = &following->well[joint];
    enum following_fault fault = judge(following, motion);
    double patience =
        has_followed(following, joint) ? following->config->safety_following_time : looks * period;

    if (fault == FOLLOWING_WELL) {
        /* A motor that is dead misses little while little is commanded: that shows nothing. */
        if (motion->measured * nearest(motion) > 0 &&
            fabs(motion->measured) >= share * greatest_of(motion)) {
            *well += period;
            *wrong = fmax(*wrong - 2 * period, 0);
        }
        return;
    }
    *wrong += period;
    following->doubts = true;
    if (*wrong < patience - 1e-9 || following->joint)
        return;
    following->joint = joint + 1;
    following->fault = fault;
    following->missed = motion->measured - nearest(motion);
}

static void look_over(struct following *following)
{
    const struct config *config = following->config;
    double period = stride(config) * config->period;
    int span = (int)ceil(window / period - 1e-9);
    int late = (int)ceil(config->safety_latency / period - 1e-9) + 2;

    following->doubts = false;
    if (span + late >= following->kept)
        return;
    for (int i = 0; i < config_joints(config); i++) {
        struct motion motion = motion_over(following, i, span, late);
        double least = config->safety_following * (has_followed(following, i) ? judged : 1);
        if (greatest_of(&motion) >= least)
            count(following, i, &motion, period);
    }
}

void following_look(struct following *following, const double *velocity, const double *q)
{
    for (int i = 0; i < config_joints(following->config); i++)
        following->total[i] += velocity[i] * following->config->period;
    if (++following->ticks < stride(following->config))
        return;
    following->ticks = 0;
    push(following, q);
    look_over(following);
}
