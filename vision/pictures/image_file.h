/* Pictures as files, without OpenCV's exceptions. */
#ifndef VISION_PICTURES_IMAGE_FILE_H
#define VISION_PICTURES_IMAGE_FILE_H

#include <opencv2/core.hpp>

/* BGR, 8 bit; empty when the file is no picture that can be read. */
cv::Mat image_file_read(const char *path);

/* In the format of the name's ending. Returns false when that cannot be. */
bool image_file_write(const char *path, const cv::Mat &picture);

#endif
