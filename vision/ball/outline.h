/* The outline of a ball as an eye sees it.
 *
 * All lines of sight that touch a sphere make a circular cone around the line to its centre,
 * wherever it stands in the picture; in the picture they make an ellipse whose middle is NOT the
 * image of the centre (off by 1 px at the rim of a 640 px picture). So the cone is fitted, to the
 * directions of edge points: with m = axis / cos(half angle), every one has m . d = 1, which is
 * linear in m. */
#ifndef VISION_BALL_OUTLINE_H
#define VISION_BALL_OUTLINE_H

#include "vision/ball/camera.h"

enum { OUTLINE_RAYS = 96 };

/* Edge points in the order of their angle around the ball; those not `valid` were not found. */
struct outline_points {
    direction view[OUTLINE_RAYS];
    bool valid[OUTLINE_RAYS];
    bool outside[OUTLINE_RAYS]; /* of the picture; set by edges_fine */
};

struct outline {
    direction axis; /* unit vector to the ball's centre */
    double cosine;  /* of the cone's half angle */
    double tangent; /* of the cone's half angle */
    int support;    /* edge points that the cone agrees with */
    double rms;     /* of their distances from it; px */
    /* A ball is not quite round when it moves, or where a lens is known badly: the radius changes
     * by these shares with the cosine and sine of twice the angle about the axis. */
    double wide_cosine = 0;
    double wide_sine = 0;
};

/* What an outline's angles are counted in: unit vectors to the right and down, across the axis. */
struct outline_frame {
    direction right;
    direction down;
};
outline_frame outline_axes(const direction &axis);

/* How far from round: 0, or half the relative difference of the longest and shortest diameter. */
double outline_stretch(const outline &cone);

/* Of a direction from the cone, outwards positive; px at the focal length. */
double outline_distance(const outline &cone, const direction &view, double focal);

/* The cone through three directions. Returns false when there is none. */
bool outline_through(const direction &a, const direction &b, const direction &c, outline *cone);

/* The cone on which most points agree to `tolerance` px, however wrong the others are: tries cones
 * through three points in a fixed order. Returns false when no three points make a cone. */
bool outline_consensus(const outline_points &points, double focal, double tolerance, outline *cone);

/* Least squares over the points within `tolerance` px of the cone, repeated with the tolerance
 * shrinking to three times the rms (never under `tolerance_min`). Returns false, and leaves the
 * cone as it was, when too few points are left. */
bool outline_refine(const outline_points &points, double focal, double tolerance,
                    double tolerance_min, outline *cone);

/* The same with a stretch as well, which needs edge points all around. */
bool outline_refine_stretched(const outline_points &points, double focal, double tolerance,
                              double tolerance_min, outline *cone);

#endif
