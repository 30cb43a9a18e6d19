/* One eye's picture: which things in it could be the ball, and where exactly. */
#ifndef VISION_BALL_SEGMENT_H
#define VISION_BALL_SEGMENT_H

#include <opencv2/core.hpp>

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"
#include "vision/ball/image.h"
#include "vision/ball/outline.h"

enum { SEGMENT_CANDIDATES = 4 };

struct segment_limits {
    double radius_min;   /* px */
    double radius_max;   /* px */
    double coverage_min; /* share of the outline that must be seen, 0 .. 1 */
    double fill_min;     /* share of the disc that must have the ball's colour, 0 .. 1 */
    double roughness;    /* largest rms distance of the seen edge from the outline; px */
};

/* A thing that may be the ball. */
struct blob {
    outline cone;      /* where it is, and how large */
    pixel_point pixel; /* image of its centre; px */
    double radius;     /* apparent radius, focal length times tan(half angle); px */
    double coverage;   /* share of the outline that is seen, 0 .. 1 */
    double fill;       /* share of the disc that has the ball's colour, 0 .. 1 */
    double score;      /* how much it is like the ball, 0 .. 1 */
};

struct segmenter {
    colour_range range;
    colour_table colours;
    segment_limits limits;
    cv::Mat mask, labels, stats, centroids; /* kept so that pairs do not allocate */
};

/* Looks in the region at every `step`-th pixel of every `step`-th row, then closely at what it
 * found. Writes up to SEGMENT_CANDIDATES blobs, the most ball-like first; returns how many. */
int segment_find(segmenter *work, const image_view &image, const camera &eye,
                 const image_region &region, int step, blob *blobs);

#endif
