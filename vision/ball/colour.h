/* Which colours the ball can have: a range in hue, saturation and value, turned into a table so
 * that asking costs one load a pixel. */
#ifndef VISION_BALL_COLOUR_H
#define VISION_BALL_COLOUR_H

#include <cstdint>
#include <vector>

#include "vision/ball/image.h"

/* Hue in rad (0 red, 2 pi/3 green, 4 pi/3 blue), saturation and value 0 .. 1. */
struct colour_hsv {
    double hue;
    double saturation;
    double value;
};

struct colour_range {
    double hue;            /* middle of the range; rad */
    double hue_tolerance;  /* rad */
    double saturation_min; /* 0 .. 1 */
    double saturation_max; /* 0 .. 1 */
    double value_min;      /* 0 .. 1 */
};

/* The table: one byte, 0 or 255, for each colour at 6 bits a channel. */
struct colour_table {
    std::vector<uint8_t> member;
};

/* Hue, saturation and value of a colour whose channels are 0 .. 255 (any common scale will do for
 * hue and saturation). Black and grey have hue 0. */
colour_hsv colour_to_hsv(double red, double green, double blue);

/* Shortest way round the circle between two hues; rad, 0 .. pi. */
double colour_hue_distance(double a, double b);

colour_table colour_table_create(const colour_range &range);

/* 255 for a colour of the ball, else 0. `red` is image_red() of the pixel's picture. */
inline uint8_t colour_member(const colour_table &table, const uint8_t *pixel, int red)
{
    const unsigned index = static_cast<unsigned>(pixel[red] >> 2) << 12 |
                           static_cast<unsigned>(pixel[1] >> 2) << 6 |
                           static_cast<unsigned>(pixel[2 - red] >> 2);
    return table.member[index];
}

#endif
