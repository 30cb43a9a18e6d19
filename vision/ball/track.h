/* Where the ball will be in the next picture of one eye. Pure arithmetic on what was seen before:
 * the same findings at the same stamps give the same windows. */
#ifndef VISION_BALL_TRACK_H
#define VISION_BALL_TRACK_H

#include <cstdint>

#include "vision/ball/camera.h"
#include "vision/ball/image.h"

struct track {
    int sightings = 0; /* in a row: 0 nothing known, 1 no speed known */
    int64_t utime = 0; /* newest sighting; us */
    pixel_point at = {0, 0};
    pixel_point speed = {0, 0}; /* px/s */
    double radius = 0;          /* px */
};

struct track_window {
    double margin;  /* px around the predicted ball */
    double growth;  /* px more for each second since it was seen, for speed that is not known */
    int64_t memory; /* us after which the ball can be anywhere */
};

/* The part of the picture to look in at `utime`. Returns false when it could be anywhere. */
bool track_predict(const track &known, const track_window &window, int64_t utime,
                   image_region *region);

/* Takes in a sighting later than all before. */
void track_saw(track *known, int64_t utime, const pixel_point &at, double radius);

#endif
