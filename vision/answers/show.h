/* A window for people: both pictures with what was found in them. */
#ifndef VISION_ANSWERS_SHOW_H
#define VISION_ANSWERS_SHOW_H

#include <opencv2/core.hpp>

#include "vision/ball/eyes.h"

/* Left and right picture side by side, BGR. What was taken is drawn in, and every candidate that
 * was not, with the reason: why it is no ball, or why the eyes' findings (`reason`) are no pair. */
cv::Mat show_draw(const image_view &left, const image_view &right, const eyes &who,
                  stereo_reason reason, const char *caption);

/* Whether a display can be reached at all. */
bool show_possible();

/* Shows a picture and serves the window's events. Returns false when the display refuses. */
bool show_window(const cv::Mat &picture);

/* Calls back for each click of the left button with the pixel's column and row, from within
 * show_window. */
typedef void show_click_fn(int column, int row, void *user);
void show_on_click(show_click_fn *click, void *user);

#endif
