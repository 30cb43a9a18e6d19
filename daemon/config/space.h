/* The task space: how what the robot's sense tells (observation.h) becomes the output x that is
 * learned and controlled. One table of numbers for each, so that nothing else has to ask which.
 *
 * visual: seen is the image [u_R to the right, v_R down, u_L - u_R], px, and x = [head yaw to the
 *   left, head pitch down, u_L - u_R] (rad, rad, px) of the head that would fixate the marker (eq.
 *   12): a marker to the right of the centre (u > 0) is fixated by turning right (yaw falls), one
 *   below it (v > 0) by looking down (pitch rises). derived.c, which sets `unit`, is the one place
 *   that knows which way the image moves; the paper's "positive gains" K_0, K_1 of equation 11 hide
 *   these signs. `eyes.pixels_per_radian` is the linear relation that it assumes (section 5.2.1).
 * cartesian: seen and x are the end-effector's position in the ground frame, m.
 * fixed: seen and x are [u_R to the right, v_R down, u_L - u_R], px, in cameras that nobody turns.
 *
 * All are x_i = (angle of head joint i, where the space has one) + unit_i * seen_i. */
#ifndef REACH_DAEMON_CONFIG_SPACE_H
#define REACH_DAEMON_CONFIG_SPACE_H

#include <stdbool.h>

#define SPACE_DIMENSIONS 3

/* Values are those of status_t. */
enum space_kind { SPACE_VISUAL, SPACE_CARTESIAN, SPACE_FIXED };

struct space {
    enum space_kind kind;
    int n_head;                     /* head joints, which the first rows of x add to */
    bool fixates;                   /* seen well at the image centre alone: samples need fixation */
    double unit[SPACE_DIMENSIONS];  /* task units of one unit seen, with its sign */
    double scale[SPACE_DIMENSIONS]; /* task units that count as one */
    double noise[SPACE_DIMENSIONS]; /* sqrt(Psi0), task units */
    double norm[SPACE_DIMENSIONS];  /* LWPR: unit of an output, task units */
    double largest;                 /* of anything seen or wanted that makes sense, units seen */
};

/* The task displacement that a displacement of what is seen amounts to. */
static inline void space_to_task(const struct space *space, const double seen[SPACE_DIMENSIONS],
                                 double task[SPACE_DIMENSIONS])
{
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        task[row] = space->unit[row] * seen[row];
}

/* How far what is seen moves when the end-effector moves so in task space and the head rests. */
static inline void space_from_task(const struct space *space, const double task[SPACE_DIMENSIONS],
                                   double seen[SPACE_DIMENSIONS])
{
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        seen[row] = task[row] / space->unit[row];
}

#endif
