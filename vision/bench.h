/* Finding the ball in one stored pair, again and again: what it says, and what it costs. */
#ifndef VISION_BENCH_H
#define VISION_BENCH_H

#include "vision/ball/eyes.h"

/* `path` is a picture of both eyes side by side, left eye left. Prints the marker and the times of
 * whole pictures and of windows; with `drawing` also writes the picture with what was found.
 *   returns 0, or -1 after one line in the log. */
int bench_run(const char *path, const eyes_config &config, const char *drawing);

#endif
