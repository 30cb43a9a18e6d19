/* Where to begin: colours that the ball may have, from a point on it or from what moves. */
#ifndef VISION_COLOUR_SEEDS_H
#define VISION_COLOUR_SEEDS_H

#include <opencv2/core.hpp>

#include <vector>

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"

/* A wide range about the colour at a point of a BGR picture. Returns false, and the colour's
 * saturation and value, where it is too near to white, grey or black to have a hue. */
bool seed_at(const cv::Mat &picture, const pixel_point &at, colour_range *range,
             colour_hsv *colour);

/* Ranges about the hues that moving pixels have most, the commonest first; of a single picture,
 * about those of all its coloured pixels. */
std::vector<colour_range> seeds_that_move(const std::vector<cv::Mat> &pictures);

/* Pixels, 255 or 0, that differ from the other picture. */
cv::Mat seed_motion(const cv::Mat &picture, const cv::Mat &other);

#endif
