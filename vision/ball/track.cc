#include "vision/ball/track.h"

#include <cmath>

bool track_predict(const track &known, const track_window &window, int64_t utime,
                   image_region *region)
{
    const double seconds = static_cast<double>(utime - known.utime) * 1e-6;

    if (known.sightings == 0 || utime <= known.utime || utime - known.utime > window.memory)
        return false;
    const double column = known.at.column + known.speed.column * seconds;
    const double row = known.at.row + known.speed.row * seconds;
    const double reach = known.radius + window.margin + window.growth * seconds;
    region->left = static_cast<int>(std::floor(column - reach));
    region->top = static_cast<int>(std::floor(row - reach));
    region->right = static_cast<int>(std::ceil(column + reach)) + 1;
    region->bottom = static_cast<int>(std::ceil(row + reach)) + 1;
    return true;
}

void track_saw(track *known, int64_t utime, const pixel_point &at, double radius)
{
    if (known->sightings > 0 && utime > known->utime) {
        const double seconds = static_cast<double>(utime - known->utime) * 1e-6;
        known->speed.column = (at.column - known->at.column) / seconds;
        known->speed.row = (at.row - known->at.row) / seconds;
    }
    known->sightings++;
    known->utime = utime;
    known->at = at;
    known->radius = radius;
}
