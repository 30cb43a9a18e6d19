/* Ways to find the ball in one picture: ours, and what is usually made of OpenCV's functions. */
#ifndef REACH_TOOLS_PICTURES_CHAINS_H
#define REACH_TOOLS_PICTURES_CHAINS_H

#include "tools/pictures/picture.h"

struct finding {
    bool seen;
    pixel_point centre; /* px, where seen */
    double radius;      /* px */
};

/* reach-vision's, with the picture for both of two parallel eyes and ball.radius unset. */
finding chain_ours(const hard_picture &picture);

/* HSV range, largest contour, its smallest enclosing circle. */
finding chain_contour(const hard_picture &picture);

/* The strongest circle of Hough's transform. */
finding chain_hough(const hard_picture &picture);

#endif
