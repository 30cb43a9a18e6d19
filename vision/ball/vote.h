/* Which cones agree with most of the rays, where each ray offers several edges: a ball with prints,
 * glints or things of its own colour behind it. */
#ifndef VISION_BALL_VOTE_H
#define VISION_BALL_VOTE_H

#include "vision/ball/edges.h"
#include "vision/ball/outline.h"

enum { VOTE_CONES = 3 };

/* Which cones are asked for; radii as focal length times tangent, px. */
struct vote_limits {
    double focal;
    double tolerance; /* px: distance at which a ray agrees, or this share of the radius: */
    double tolerance_share;
    double radius_min;
    double radius_max;
};

/* Tries cones through three ends of different rays, drawn always in the same order. Writes the
 * best that differ from each other, the best first, their `support` the number of rays that agree;
 * returns how many. */
int vote_cones(const outline_ends &ends, const vote_limits &limits, outline *cones);

/* Each ray's end that is nearest to the cone. */
void vote_nearest(const outline_ends &ends, const outline &cone, double focal,
                  outline_points *points);

#endif
