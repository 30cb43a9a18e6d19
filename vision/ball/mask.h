/* The first look: where in a picture the ball's colour is, in connected pieces. */
#ifndef VISION_BALL_MASK_H
#define VISION_BALL_MASK_H

#include <opencv2/core.hpp>

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"
#include "vision/ball/image.h"

enum { MASK_PIECES = 10, MASK_STARTS = 4 };

/* A connected piece of the mask, in full-resolution pixels. */
struct mask_piece {
    pixel_point centre;
    double width;
    double height;
    double area;
    cv::Rect box; /* in the mask */
};

/* Kept so that pairs do not allocate. */
struct mask_work {
    cv::Mat mask, labels, stats, centroids; /* one element for each pixel that was looked at */
    cv::Mat closed, depth;
    image_region region;
    int step;            /* px between the pixels looked at */
    mask_piece left_out; /* the largest that mask_find did not take for its size; area 0: none */
};

/* Looks in the region, which lies inside the picture, at every `step`-th pixel of every `step`-th
 * row. Writes up to MASK_PIECES pieces of at least `area_min` px^2 and at most `side_max` px along
 * each side, the largest first; returns how many. */
int mask_find(mask_work *work, const image_view &image, const colour_table &colours,
              const image_region &region, int step, double area_min, double side_max,
              mask_piece *pieces);

/* Middles of the thickest parts of a piece, gaps of one pixel closed: where a ball can be even if
 * other things of its colour touch it. Writes up to MASK_STARTS; returns how many. */
int mask_starts(mask_work *work, const mask_piece &piece, pixel_point *starts);

#endif
