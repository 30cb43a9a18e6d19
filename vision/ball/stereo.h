/* Two eyes' findings into one marker, or the reason why not. */
#ifndef VISION_BALL_STEREO_H
#define VISION_BALL_STEREO_H

#include <cstdint>

#include "vision/ball/camera.h"
#include "vision/ball/segment.h"

/* How the eyes stand to each other, and what a pair of findings must obey. Ideal eyes stand level
 * beside each other and are turned by half the vergence each about the vertical axis; what a real
 * camera is turned besides is in its yaw, pitch and roll. Markers are those of the ideal eyes. */
struct stereo_rig {
    camera left;
    camera right;
    double vergence;         /* angle between the optical axes, 0 = parallel; rad */
    double baseline;         /* m; only used where ball_radius is */
    double ball_radius;      /* m; 0 = unknown */
    double height_tolerance; /* px, after the vergence is taken out; 2 % of the radius if more */
    double size_tolerance;   /* relative, between the eyes and to ball_radius */
    double disparity_min;    /* px */
    double disparity_max;    /* px */
};

/* The values of marker_t.reason. */
enum stereo_reason {
    STEREO_SEEN = 0,
    STEREO_NOT_IN_RIGHT = 1,
    STEREO_NOT_IN_LEFT = 2,
    STEREO_HEIGHTS_DIFFER = 3,
    STEREO_SIZES_DIFFER = 4,
    STEREO_DISPARITY_RANGE = 5,
    STEREO_UNUSABLE = 6,
    STEREO_REASONS,
};

/* What a person is told of it: "heights differ (check.height)". */
const char *stereo_reason_text(stereo_reason reason);

/* What is said of a pair. All zero unless `reason` is STEREO_SEEN. */
struct stereo_marker {
    stereo_reason reason = STEREO_UNUSABLE;
    double u_right = 0;   /* px to the right of the principal point, distortion removed */
    double v_right = 0;   /* px below it */
    double disparity = 0; /* u_left - u_right, px */
    double radius = 0;    /* px, right eye */
    /* The lines of sight to what was found in both eyes, also where it was refused, part ahead and
     * meet behind: as if the eyes were swapped. */
    bool meets_behind = false;
    /* The ball's true radius as both eyes make it out, if eyes.baseline is right; m. Likewise also
     * where it was refused; 0 where they do not meet ahead. */
    double true_radius = 0;
};

/* How much higher the left eye sees a thing than the right, where both directions (the cameras' own
 * axes) are to one thing: 0 but for errors. px at the right eye's focal length. */
double stereo_height(const stereo_rig &rig, const direction &left, const direction &right);

/* Whether two findings are one ball: on one height, of one size, at a possible distance. With
 * vergence the raw rows of one point differ by many px at the picture's rim, so both lines of sight
 * are first turned into the frame between the eyes, where they must lie in one plane with the
 * baseline.
 *   returns STEREO_SEEN or the first reason against it. */
stereo_reason stereo_check(const stereo_rig &rig, const blob &left, const blob &right);

/* The best pair among both eyes' candidates. `left_index` and `right_index` are set when it is
 * STEREO_SEEN. */
stereo_marker stereo_match(const stereo_rig &rig, const blob *left, int n_left, const blob *right,
                           int n_right, int *left_index, int *right_index);

#endif
