/* Notices within a second that the pairs cannot be what they should: eyes swapped, one of them
 * frozen, or late, or no colours in them. */
#ifndef VISION_ANSWERS_DOUBTS_H
#define VISION_ANSWERS_DOUBTS_H

#include "vision/ball/image.h"
#include "vision/ball/stereo.h"
#include "vision/pictures/image_message.h"

struct doubts {
    int64_t since = 0; /* utime of the first pair counted; us */
    int pairs = 0;
    int behind = 0;     /* the lines of sight met behind the eyes */
    int heights = 0;    /* a ball in both eyes, at different heights */
    int sizes = 0;      /* a ball in both eyes, whose size does not fit */
    int grey = 0;       /* pictures without a colour */
    int still_left = 0; /* the eye's bytes were those of the pair before */
    int still_right = 0;
    int radii = 0; /* of the ball, as the eyes made it out; m: how many, their sum, and squares */
    double radius_sum = 0;
    double radius_squares = 0;
    uint64_t content_left = 0;
    uint64_t content_right = 0;
};

/* Counts a pair and what was said of it; `grey`: it has no colours, though one is sought. At the
 * end of each second of pairs returns what most of them have in common that should not be (a
 * constant text), else nullptr. */
const char *doubts_add(doubts *all, const image_message &pair, const stereo_marker &marker,
                       bool grey);

/* Whether no pixel of the picture has a colour; looks at some thousand of them. */
bool doubts_colourless(const image_view &image);

#endif
