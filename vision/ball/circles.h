/* Circles that show as edges alone: a ball before things of its own colour. */
#ifndef VISION_BALL_CIRCLES_H
#define VISION_BALL_CIRCLES_H

#include <opencv2/core.hpp>

#include "vision/ball/camera.h"
#include "vision/ball/image.h"
#include "vision/ball/outline.h"

enum { CIRCLES_CONES = 6 };

/* Hough's transform over a part of the picture, of radii in px. Writes the strongest, first of all,
 * exact to some px; returns how many. */
int circles_find(const image_view &image, const camera &eye, const image_region &region,
                 double radius_min, double radius_max, outline *cones);

#endif
