/* The options of vision, and what they mean to its parts. */
#ifndef VISION_CONFIG_H
#define VISION_CONFIG_H

#include <cstddef>
#include <cstdio>

#include "vision/ball/eyes.h"

/* One field for each row of the option table in config.cc; units and meaning stand there. */
struct vision_config {
    int width, height;
    double left_focal, left_centre_u, left_centre_v, left_k1, left_k2;
    double left_k3, left_p1, left_p2, left_aspect, left_yaw, left_pitch, left_roll;
    double right_focal, right_centre_u, right_centre_v, right_k1, right_k2;
    double right_k3, right_p1, right_p2, right_aspect, right_yaw, right_pitch, right_roll;
    double vergence, baseline, most_apart;
    int tag_dictionary, tag_id;
    double tag_size;
    double hue, hue_tolerance, saturation_min, saturation_max, value_min;
    double ball_radius, radius_min, radius_max, coverage_min, fill_min, roughness;
    double height_tolerance, size_tolerance, disparity_min, disparity_max;
    double window_margin, window_growth, memory;
    int window_step, whole_step, recheck;
    double drop_after, video_rate, camera_rate;
};

/* Reads the table's defaults, then the file (nullptr: none), then the overrides "name=value".
 *   returns 0, or -1 with one line in `error`. */
int config_load(vision_config *config, const char *path, const char *const *overrides,
                int n_overrides, char *error, size_t error_size);

/* Prints every option with unit, default, range and meaning. */
void config_print(FILE *out);

eyes_config config_eyes(const vision_config &config);

#endif
