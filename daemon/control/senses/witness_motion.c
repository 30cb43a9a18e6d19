#include "daemon/control/senses/witness_private.h"

#include <math.h>

enum {
    LAG_LEAST = 4, /* frames back from which a motion is looked for, */
    LAG_MOST = 40, /* and up to which */
};
static const double late_fits = 0.02;   /* misfit at another time that is none */
static const double late_gain = 0.3;    /* when another time fits so much better */
static const double still_share = 0.05; /* of the squared motion expected */
static const double still_noise = 0.03; /* and of what is noise */
static const double eye_fits = 0.1;     /* of the squared motion of disparity */
static const double least_motion = 1;   /* noises a stride, mean: less shows nothing */

/* Whether what was seen made a step in the stride that ended so many frames ago: that is none of
 * the arm's motion. */
static bool has_step(const struct witness *witness, int age)
{
    for (int i = age; i <= age + WITNESS_STRIDE; i++)
        if (witness_frame_at(witness, i)->strange)
            return true;
    return false;
}

static struct witness_motion motion_of(const struct witness *witness, int row, int lag)
{
    struct witness_motion sum = {0};

    for (int age = 0; age < WITNESS_WINDOW; age++) {
        if (has_step(witness, age))
            continue;
        double seen = witness_frame_at(witness, age)->x[row] -
                      witness_frame_at(witness, age + WITNESS_STRIDE)->x[row];
        double expected = witness_frame_at(witness, age + lag)->expected[row] -
                          witness_frame_at(witness, age + lag + WITNESS_STRIDE)->expected[row];
        sum.seen += seen * seen;
        sum.expected += expected * expected;
        sum.missed += (seen - expected) * (seen - expected);
    }
    return sum;
}

double witness_misfit(const struct witness_motion *motion)
{
    return motion->missed / (motion->seen + motion->expected);
}

/* Squared motion that would be noise alone. */
static double least_of(const struct config *config, int row)
{
    double least = witness_noise(config, row, least_motion);

    return WITNESS_WINDOW * least * least;
}

/* Adds up all rows. `worst` becomes the misfit of that row that moved and fits worst. */
struct witness_motion witness_motion(const struct witness *witness, int lag, double *worst)
{
    struct witness_motion sum = {0};

    *worst = 0;
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        const struct witness_motion motion = motion_of(witness, row, lag);
        if (fmax(motion.seen, motion.expected) >= least_of(witness->config, row))
            *worst = fmax(*worst, witness_misfit(&motion));
        sum.seen += motion.seen;
        sum.expected += motion.expected;
        sum.missed += motion.missed;
    }
    return sum;
}

bool witness_is_still(const struct witness *witness, const struct witness_motion *motion)
{
    double least = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        least += least_of(witness->config, row);
    return motion->seen < still_share * motion->expected && motion->seen < still_noise * least;
}

bool witness_fits_another_time(const struct witness *witness, double misfit)
{
    double worst;

    for (int lag = LAG_LEAST;
         lag <= LAG_MOST && lag + WITNESS_WINDOW + WITNESS_STRIDE < witness->modelled; lag++) {
        const struct witness_motion then = witness_motion(witness, lag, &worst);
        if (witness_misfit(&then) < fmin(late_gain * misfit, late_fits))
            return true;
    }
    return false;
}

/* Where the left eye shows what was `lag` frames ago, disparity moves by as much as the right image
 * has moved on since; where it is frozen, by as much as the right image moves. */
static bool left_lags(const struct witness *witness, int lag)
{
    double moved = 0, missed = 0;

    for (int age = 0; age < WITNESS_WINDOW; age++) {
        const struct witness_frame *now = witness_frame_at(witness, age),
                                   *then = witness_frame_at(witness, age + WITNESS_STRIDE);
        double right = now->image[0] - then->image[0];
        double disparity = now->image[2] - then->image[2];
        if (lag > 0)
            right -= witness_frame_at(witness, age + lag)->image[0] -
                     witness_frame_at(witness, age + lag + WITNESS_STRIDE)->image[0];
        moved += disparity * disparity;
        missed += (disparity + right) * (disparity + right);
    }
    return missed < eye_fits * moved;
}

/* Whether disparity moves as only one eye's being late or frozen can make it. */
bool witness_one_eye_is_late(const struct witness *witness)
{
    const struct config *config = witness->config;
    double least = witness_noise(config, 2, least_motion) * config->space.scale[2], moved = 0;

    if (config->space.kind != SPACE_VISUAL || witness->kept <= WITNESS_WINDOW + WITNESS_STRIDE)
        return false;
    for (int age = 0; age < WITNESS_WINDOW; age++) {
        double step = witness_frame_at(witness, age)->image[2] -
                      witness_frame_at(witness, age + WITNESS_STRIDE)->image[2];
        moved += step * step;
    }
    if (moved < WITNESS_WINDOW * least * least)
        return false;
    for (int lag = 0; lag <= LAG_MOST && lag + WITNESS_WINDOW + WITNESS_STRIDE < witness->kept;
         lag += lag ? 1 : LAG_LEAST)
        if (left_lags(witness, lag))
            return true;
    return false;
}
