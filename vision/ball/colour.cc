#include "vision/ball/colour.h"

#include <algorithm>
#include <cmath>

static const double pi = 3.14159265358979323846;
static const int levels = 64; /* a channel's steps in the table */

colour_hsv colour_to_hsv(double red, double green, double blue)
{
    const double most = std::max({red, green, blue});
    const double spread = most - std::min({red, green, blue});
    double sixth = 0; /* hue in sixths of the circle */

    if (spread > 0) {
        if (most == green)
            sixth = 2 + (blue - red) / spread;
        else if (most == blue)
            sixth = 4 + (red - green) / spread;
        else
            sixth = (green - blue) / spread;
    }
    if (sixth < 0)
        sixth += 6;
    return {sixth * pi / 3, most > 0 ? spread / most : 0, most / 255};
}

double colour_hue_distance(double a, double b)
{
    const double difference = std::fabs(std::fmod(a - b, 2 * pi));

    return std::min(difference, 2 * pi - difference);
}

static bool in_range(const colour_range &range, const colour_hsv &hsv)
{
    return hsv.saturation >= range.saturation_min && hsv.saturation <= range.saturation_max &&
           hsv.value >= range.value_min &&
           colour_hue_distance(hsv.hue, range.hue) <= range.hue_tolerance;
}

colour_table colour_table_create(const colour_range &range)
{
    const double step = 256.0 / levels;
    const double middle = (step - 1) / 2;
    colour_table table;

    table.member.reserve(levels * levels * levels);
    for (int red = 0; red < levels; red++)
        for (int green = 0; green < levels; green++)
            for (int blue = 0; blue < levels; blue++) {
                const colour_hsv hsv =
                    colour_to_hsv(red * step + middle, green * step + middle, blue * step + middle);
                table.member.push_back(in_range(range, hsv) ? 255 : 0);
            }
    return table;
}
