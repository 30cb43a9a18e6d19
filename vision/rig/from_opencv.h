/* A rig from the files that OpenCV's stereo calibration leaves. */
#ifndef VISION_RIG_FROM_OPENCV_H
#define VISION_RIG_FROM_OPENCV_H

#include "vision/ball/stereo.h"

/* Reads M1, D1, M2, D2, R and T (stereoCalibrate's cameras and how the second, the right eye,
 * stands to the first) from the files together, as OpenCV's example stereo_calib writes them to
 * two. Lengths are in metres. The pictures' size is taken from `rig` and stays.
 *   returns 0, or -1 with one line in `error`. */
int rig_from_opencv(const char *const *paths, int n_paths, stereo_rig *rig, char *error,
                    size_t error_size);

#endif
