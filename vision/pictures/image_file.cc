#include "vision/pictures/image_file.h"

#include <opencv2/imgcodecs.hpp>

cv::Mat image_file_read(const char *path)
{
    try {
        return cv::imread(path, cv::IMREAD_COLOR);
    } catch (const cv::Exception &) {
        return {};
    }
}

bool image_file_write(const char *path, const cv::Mat &picture)
{
    try {
        return cv::imwrite(path, picture);
    } catch (const cv::Exception &) {
        return false;
    }
}
