#include "vision/ball/circles.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

static const int side_most = 200; /* px: larger parts are made smaller first */
static const double smooth = 1.2; /* px */
static const double canny = 60;   /* levels: the upper threshold of an edge */
static const double votes = 12;
static const double apart = 6; /* px between two circles */

/* The cone that stands out of the picture above a small circle. */
static bool cone_over(const camera &eye, const pixel_point &centre, double radius, outline *cone)
{
    const double half = 0.5 * radius;
    const double side = 0.8660254037844386 * radius;

    return outline_through(camera_direction(eye, {centre.column + radius, centre.row}),
                           camera_direction(eye, {centre.column - half, centre.row + side}),
                           camera_direction(eye, {centre.column - half, centre.row - side}), cone);
}

int circles_find(const image_view &image, const camera &eye, const image_region &region,
                 double radius_min, double radius_max, outline *cones)
{
    const int width = region.right - region.left;
    const int height = region.bottom - region.top;
    const double scale = std::min(1.0, static_cast<double>(side_most) / std::max(width, height));
    const cv::Mat part(height, width, CV_8UC3,
                       const_cast<uint8_t *>(image_pixel(image, region.left, region.top)),
                       image.stride);
    std::vector<cv::Vec3f> circles;
    cv::Mat grey;
    int n = 0;

    cv::resize(part, grey, {}, scale, scale, cv::INTER_AREA);
    cv::cvtColor(grey, grey, image.order == PIXEL_RGB ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey, grey, {0, 0}, smooth);
    cv::HoughCircles(grey, circles, cv::HOUGH_GRADIENT, 1, apart, canny, votes,
                     static_cast<int>(radius_min * scale),
                     static_cast<int>(radius_max * scale) + 1);
    for (size_t i = 0; i < circles.size() && n < CIRCLES_CONES; i++) {
        const pixel_point centre = {region.left + (circles[i][0] + 0.5) / scale - 0.5,
                                    region.top + (circles[i][1] + 0.5) / scale - 0.5};
        n += cone_over(eye, centre, circles[i][2] / scale, &cones[n]);
    }
    return n;
}
