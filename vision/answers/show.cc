#include "vision/answers/show.h"

#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>

static const char title[] = "reachd vision";
static const cv::Scalar found_colour(0, 0, 255);
static const cv::Scalar refused_colour(0, 200, 255);
static const cv::Scalar text_colour(255, 255, 255);
static const int fraction_bits = 4; /* OpenCV draws to fractions of a pixel in fixed point */

static cv::Mat to_bgr(const image_view &image)
{
    const cv::Mat wrapped(image.height, image.width, CV_8UC3, const_cast<uint8_t *>(image.data),
                          image.stride);
    cv::Mat copy;

    if (image.order == PIXEL_RGB)
        cv::cvtColor(wrapped, copy, cv::COLOR_RGB2BGR);
    else
        copy = wrapped.clone();
    return copy;
}

static int fixed_point(double px)
{
    return static_cast<int>(px * (1 << fraction_bits));
}

static void draw_ball(cv::Mat *picture, const blob &found)
{
    const cv::Point centre(fixed_point(found.pixel.column), fixed_point(found.pixel.row));

    cv::circle(*picture, centre, fixed_point(found.radius), found_colour, 1, cv::LINE_AA,
               fraction_bits);
    cv::drawMarker(*picture, {centre.x >> fraction_bits, centre.y >> fraction_bits}, found_colour,
                   cv::MARKER_CROSS, 9);
}

static void draw_refused(cv::Mat *picture, const pixel_point &at, double radius, const char *why)
{
    const cv::Point centre(static_cast<int>(at.column), static_cast<int>(at.row));

    cv::circle(*picture, centre, static_cast<int>(radius), refused_colour, 1, cv::LINE_AA);
    cv::putText(*picture, why, centre, cv::FONT_HERSHEY_SIMPLEX, 0.4, text_colour, 1, cv::LINE_AA);
}

static bool same(const blob &a, const blob &b)
{
    return a.pixel.column == b.pixel.column && a.pixel.row == b.pixel.row;
}

static void draw_eye(cv::Mat *picture, const eye_findings &seen, const blob &taken,
                     stereo_reason reason)
{
    for (int i = 0; i < seen.n_refused; i++)
        draw_refused(picture, seen.refused[i].pixel, seen.refused[i].radius,
                     blob_fault_text(seen.refused[i].fault));
    for (int i = 0; i < seen.n_found; i++)
        if (reason != STEREO_SEEN)
            draw_refused(picture, seen.found[i].pixel, seen.found[i].radius,
                         stereo_reason_text(reason));
        else if (!same(seen.found[i], taken))
            draw_refused(picture, seen.found[i].pixel, seen.found[i].radius,
                         "another is more like the ball");
    if (reason == STEREO_SEEN)
        draw_ball(picture, taken);
}

cv::Mat show_draw(const image_view &left, const image_view &right, const eyes &who,
                  stereo_reason reason, const char *caption)
{
    cv::Mat left_picture = to_bgr(left);
    cv::Mat right_picture = to_bgr(right);
    cv::Mat both;

    draw_eye(&left_picture, who.in_left, who.left_blob, reason);
    draw_eye(&right_picture, who.in_right, who.right_blob, reason);
    cv::hconcat(left_picture, right_picture, both);
    cv::putText(both, caption, {8, both.rows - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.5, text_colour, 1,
                cv::LINE_AA);
    return both;
}

static struct {
    show_click_fn *call;
    void *user;
} on_click;

static void take_event(int event, int column, int row, int, void *)
{
    if (event == cv::EVENT_LBUTTONDOWN)
        on_click.call(column, row, on_click.user);
}

void show_on_click(show_click_fn *click, void *user)
{
    on_click = {click, user};
}

bool show_possible()
{
    return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
}

bool show_window(const cv::Mat &picture)
{
    try {
        cv::imshow(title, picture);
        if (on_click.call)
            cv::setMouseCallback(title, take_event);
        cv::waitKey(1);
    } catch (const cv::Exception &) {
        return false;
    }
    return true;
}
