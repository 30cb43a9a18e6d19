/* The set of hard pictures: each row of it is one thing that makes a ball hard to find. */
#ifndef REACH_TOOLS_PICTURES_PICTURE_H
#define REACH_TOOLS_PICTURES_PICTURE_H

#include <cstdint>

#include "tools/pictures/ball.h"

/* The rows' names, in order; ends with nullptr. */
extern const char *const picture_rows[];

struct hard_picture {
    cv::Mat bgr; /* CV_8UC3 */
    camera eye;
    double hue;         /* of the ball as it is set up; rad */
    bool has_ball;      /* false: there is nothing to find */
    pixel_point centre; /* image of its centre; px */
    double radius;      /* px */
};

/* Picture `index` of a row, the same on every machine. */
hard_picture picture_draw(int row, uint64_t index);

#endif
