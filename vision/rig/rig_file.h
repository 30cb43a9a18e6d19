/* A rig as a part of a configuration file. */
#ifndef VISION_RIG_RIG_FILE_H
#define VISION_RIG_RIG_FILE_H

#include <cstdio>

#include "vision/ball/stereo.h"

/* Writes camera, left, right and eyes of a YAML configuration; `comment` stands on its first line.
 */
void rig_write(const stereo_rig &rig, const char *comment, FILE *out);

/* The same into a file. Returns 0, or -1 after one line in the log. */
int rig_save(const stereo_rig &rig, const char *comment, const char *path);

#endif
