/* A rig that nobody rectified, and how good its calibration must be. */
#ifndef TEST_CROOKED_H
#define TEST_CROOKED_H

#include <random>

#include "scene.h"
#include "vision/ball/eyes.h"

/* Webcams on a home-made mount: the left one with roll 2 and pitch 1 degrees, pixels of 0.96. */
scene_eyes crooked_eyes();

/* fixture_config() with the rig of a configuration file. */
eyes_config crooked_load(const char *path);

/* How many of CROOKED_CHECKS new pairs are seen. Of those the heights must agree to 0.5 px and the
 * disparity be right to 0.3 px. */
enum { CROOKED_CHECKS = 12 };
int crooked_seen(const eyes_config &config, std::mt19937_64 &random);

#endif
