/* The rig that explains where both eyes saw the same ball. */
#ifndef VISION_RIG_SOLVE_H
#define VISION_RIG_SOLVE_H

#include <vector>

#include "vision/ball/outline.h"
#include "vision/ball/stereo.h"

/* The ball's edge as one eye saw it, px of its picture, distortion and all. */
struct seen_edge {
    outline cone; /* as the present rig makes it of the points */
    std::vector<pixel_point> points;
};

struct sighting {
    seen_edge left;
    seen_edge right;
    double height; /* difference of the eyes' heights that the solution leaves; px */
    bool used;     /* not an outlier */
};

struct solution {
    stereo_rig rig;
    double before; /* rms difference of heights of the used sightings; px */
    double after;
    int used;
};

/* The pixels' aspect, one for both eyes, with which the ball is roundest in the sightings. */
double rig_find_aspect(const stereo_rig &rig, std::vector<sighting> *sightings);

/* Finds the pixels' aspect (one for both eyes), from the ball's being round, and the eyes' roll,
 * pitch and yaw from both eyes' seeing it in one plane with the baseline. Focal lengths,
 * distortion, vergence and baseline are taken from `rig`, and what the sightings do not tell
 * stays near it, too. Sightings that disagree with the others are left out.
 *   returns false when too few are left. */
bool rig_solve(const stereo_rig &rig, std::vector<sighting> *sightings, solution *found);

#endif
