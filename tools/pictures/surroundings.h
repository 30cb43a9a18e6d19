/* What is around the ball, and what stands before it. Pictures are CV_32FC3, BGR, 0 .. 1. */
#ifndef REACH_TOOLS_PICTURES_SURROUNDINGS_H
#define REACH_TOOLS_PICTURES_SURROUNDINGS_H

#include "tools/pictures/ball.h"

/* A wall with light that falls off, texture, and things of dull colours. */
void surroundings_room(random_source *random, cv::Mat *picture);

/* Things of the ball's colour that are no balls: boards, leaves, bands, some behind `ball`. */
void surroundings_clutter(random_source *random, const drawn_ball &ball, cv::Mat *picture);

/* A hand or tool before the ball: hides 12 to 45 % of a disc that it crosses in the middle. */
void surroundings_cover(random_source *random, const drawn_ball &ball, cv::Mat *picture);

#endif
