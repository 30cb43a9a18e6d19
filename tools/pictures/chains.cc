#include "tools/pictures/chains.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#include "vision/config.h"

static const double degree = 3.14159265358979323846 / 180;
/* What a user would set: generous, and the same for every picture. */
static const double hue_tolerance = 22 * degree;
static const double saturation_min = 0.4;
static const double value_min = 0.12;

static eyes_config configure(const hard_picture &picture)
{
    char error[256];
    vision_config defaults;

    if (config_load(&defaults, nullptr, nullptr, 0, error, sizeof error))
        CV_Error(cv::Error::StsError, error);
    eyes_config config = config_eyes(defaults);
    config.colour = {picture.hue, hue_tolerance, saturation_min, 1, value_min};
    config.rig.left = config.rig.right = picture.eye;
    config.rig.vergence = 0;
    return config;
}

finding chain_ours(const hard_picture &picture)
{
    const cv::Mat &bgr = picture.bgr;
    const image_view view = {bgr.data, bgr.cols, bgr.rows, bgr.step, PIXEL_BGR};
    eyes who;

    eyes_init(&who, configure(picture));
    const stereo_marker marker = eyes_look(&who, 1, view, view);
    return {marker.reason == STEREO_SEEN, who.right_blob.pixel, who.right_blob.radius};
}

/* OpenCV's hue counts half degrees. */
static cv::Mat in_range(const hard_picture &picture)
{
    const double middle = picture.hue / degree / 2;
    const double half = hue_tolerance / degree / 2;
    const cv::Scalar low(0, 255 * saturation_min, 255 * value_min);
    const cv::Scalar high(180, 255, 255);
    cv::Mat hsv;
    cv::Mat mask;

    cv::cvtColor(picture.bgr, hsv, cv::COLOR_BGR2HSV);
    cv::inRange(hsv, cv::Scalar(std::max(0.0, middle - half), low[1], low[2]),
                cv::Scalar(middle + half, high[1], high[2]), mask);
    if (middle < half) { /* around the wrap */
        cv::Mat rest;
        cv::inRange(hsv, cv::Scalar(180 + middle - half, low[1], low[2]), high, rest);
        mask |= rest;
    }
    return mask;
}

finding chain_contour(const hard_picture &picture)
{
    std::vector<std::vector<cv::Point>> contours;
    cv::Point2f centre;
    float radius = 0;

    cv::findContours(in_range(picture), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    const auto largest = std::max_element(contours.begin(), contours.end(), [](auto &a, auto &b) {
        return cv::contourArea(a) < cv::contourArea(b);
    });
    if (largest != contours.end())
        cv::minEnclosingCircle(*largest, centre, radius);
    return {radius > 8, {centre.x, centre.y}, radius};
}

finding chain_hough(const hard_picture &picture)
{
    std::vector<cv::Vec3f> circles;
    cv::Mat grey;

    cv::cvtColor(picture.bgr, grey, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey, grey, {9, 9}, 2);
    cv::HoughCircles(grey, circles, cv::HOUGH_GRADIENT, 1, 40, 100, 30, 8, 240);
    if (circles.empty())
        return {};
    return {true, {circles[0][0], circles[0][1]}, circles[0][2]};
}
