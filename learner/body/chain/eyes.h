/* What a head that fixates says of a place: (yaw, pitch, disparity) to a point and back (paper,
 * equations 10 to 12).
 *
 *   P(x) = Rz(yaw) (neck + Ry(pitch) (eye + z a)),   1 / z = law_0 + law_1 d + law_2 d^2,
 *
 * a the optical axis, a = (1, tilt_0, tilt_1) normalised, d the disparity from its middle, over its
 * unit. Lengths are in a unit of the eyes' own, since only ratios of lengths can be seen: law_0 is
 * fixed and sets it. x forward, z up, the yaw's axis along z. */
#ifndef REACH_LEARNER_BODY_CHAIN_EYES_H
#define REACH_LEARNER_BODY_CHAIN_EYES_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Unknowns, in this order: neck, eye, tilt, law_1, law_2. */
#define EYES_UNKNOWNS 10

struct eyes {
    double angle_unit; /* of yaw and pitch, rad: 1, or pi / 180 where they are in degrees */
    double disparity_middle, disparity_unit; /* px */
    double neck[3];
    double eye[3];
    double tilt[2];
    double law[3];
};

/* A seen place and what depends on it. Matrices row by row. */
struct eyes_view {
    double point[3];
    double by_x[9];                       /* dP / dx, x in its own units */
    double by_unknown[3 * EYES_UNKNOWNS]; /* 3 x EYES_UNKNOWNS */
};

/* P at x[3]. false when x is none that eyes can see (behind them, or infinitely far). */
bool eyes_point(const struct eyes *eyes, const double *x, struct eyes_view *view);

/* The x that sees `point`, begun at x and left there. false when there is none near. */
bool eyes_look_at(const struct eyes *eyes, const double *point, double *x);

#ifdef __cplusplus
}
#endif
#endif
