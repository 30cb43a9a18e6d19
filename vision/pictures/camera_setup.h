/* What a V4L2 camera is asked for, and what it gives. */
#ifndef VISION_PICTURES_CAMERA_SETUP_H
#define VISION_PICTURES_CAMERA_SETUP_H

#include <opencv2/videoio.hpp>

#include <cstddef>

#include "vision/ball/camera.h"

/* Asks for Motion JPEG, the eye's size and `rate` pictures a second (0: whatever it has), and says
 * on the log what it got; warns where that is another format or a lower rate.
 *   returns false with one line in `error` when the size is another one. */
bool camera_ask(cv::VideoCapture *capture, const char *path, const camera &eye, double rate,
                char *error, size_t error_size);

/* Warns when white balance, exposure or gain of the device are automatic, since the ball's colour
 * changes with them, with the command that locks them. Says nothing of what the device has not. */
void camera_warn_of_automatics(const char *path);

#endif
