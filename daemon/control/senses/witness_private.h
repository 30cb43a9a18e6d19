/* Motion over the last frames: witness_motion.c compares it, witness.c draws the conclusions. */
#ifndef REACH_DAEMON_CONTROL_SENSES_WITNESS_PRIVATE_H
#define REACH_DAEMON_CONTROL_SENSES_WITNESS_PRIVATE_H

#include "daemon/control/senses/witness.h"

enum {
    WITNESS_STRIDE = 5,  /* frames over which motion is measured, */
    WITNESS_WINDOW = 30, /* and how often */
};

/* Squared motion over the window: seen, expected so many frames before, and their difference. */
struct witness_motion {
    double seen, expected, missed;
};

/* The frame so many before the newest. */
static inline const struct witness_frame *witness_frame_at(const struct witness *witness, int age)
{
    return &witness->frame[(witness->newest - age + WITNESS_FRAMES) % WITNESS_FRAMES];
}

/* So many times the noise of an output, in scaled units. */
static inline double witness_noise(const struct config *config, int row, double times)
{
    return config->eyes_doubt * times * config->space.noise[row] / config->space.scale[row];
}

/* Of all rows together, expected `lag` frames before. `worst` becomes the misfit of that row that
 * moved and fits worst; 0 = none moved. Wants WITNESS_WINDOW + WITNESS_STRIDE + `lag` frames. */
struct witness_motion witness_motion(const struct witness *witness, int lag, double *worst);

/* 0 = as expected, 1 = the two have nothing in common. */
double witness_misfit(const struct witness_motion *motion);

/* Whether next to nothing moved, where much was expected. */
bool witness_is_still(const struct witness *witness, const struct witness_motion *motion);

/* Whether the motion of another time fits far better than this misfit. */
bool witness_fits_another_time(const struct witness *witness, double misfit);

/* Whether disparity moves as only one eye's being late or frozen can make it. */
bool witness_one_eye_is_late(const struct witness *witness);

#endif
