#include "tools/pictures/picture.h"

#include <turbojpeg.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#include "tools/pictures/surroundings.h"

static const double pi = 3.14159265358979323846;

const char *const picture_rows[] = {"clean",
                                    "prints",
                                    "glints",
                                    "prints and glints",
                                    "over-exposed",
                                    "blurred",
                                    "at a border",
                                    "before its colour",
                                    "covered",
                                    "large",
                                    "beside smaller ones",
                                    "distorted",
                                    "not quite round",
                                    "JPEG",
                                    "no ball",
                                    nullptr};
enum row {
    ROW_CLEAN,
    ROW_PRINTS,
    ROW_GLINTS,
    ROW_PRINTS_AND_GLINTS,
    ROW_OVER_EXPOSED,
    ROW_BLURRED,
    ROW_BORDER,
    ROW_CLUTTER,
    ROW_COVERED,
    ROW_LARGE,
    ROW_SMALLER_ONES,
    ROW_DISTORTED,
    ROW_STRETCHED,
    ROW_JPEG,
    ROW_NO_BALL,
};

struct ball_colour {
    double hue; /* deg */
    cv::Vec3f bgr;
};
static const ball_colour colours[] = {
    {2, {0.12F, 0.1F, 0.85F}},    /* red, around the hue's wrap */
    {18, {0.1F, 0.36F, 0.95F}},   /* orange */
    {54, {0.12F, 0.82F, 0.9F}},   /* yellow */
    {128, {0.22F, 0.72F, 0.15F}}, /* green */
    {218, {0.8F, 0.38F, 0.1F}},   /* blue */
};

static camera draw_eye(random_source *random, int row)
{
    camera eye = {640, 480, random_between(random, 500, 1200), 0, 0, 0, 0};

    if (row == ROW_DISTORTED) {
        eye.focal = random_between(random, 450, 650);
        eye.k1 = random_between(random, -0.35, -0.1);
        eye.k2 = random_between(random, 0, 0.1);
    }
    if (row == ROW_STRETCHED)
        eye.aspect = random_between(random, 0.92, 1.08);
    return eye;
}

/* Inside the picture with its whole outline, or with 25 to 60 % of it outside. */
static void put_ball(random_source *random, int row, const camera &eye, drawn_ball *ball)
{
    const double margin = 1.15 * ball->radius + 8;

    ball->centre = {random_between(random, margin, eye.width - margin),
                    random_between(random, margin, eye.height - margin)};
    if (row != ROW_BORDER)
        return;
    const double inside = ball->radius * std::cos(pi * random_between(random, 0.25, 0.6));
    const int side = random_whole(random, 4);
    if (side == 0)
        ball->centre.column = inside;
    else if (side == 1)
        ball->centre.column = eye.width - 1 - inside;
    else if (side == 2)
        ball->centre.row = inside;
    else
        ball->centre.row = eye.height - 1 - inside;
}

static drawn_ball draw_ball(random_source *random, int row, const camera &eye,
                            const ball_colour &colour)
{
    drawn_ball ball = ball_plain(random, colour.bgr);

    ball.radius = std::exp(random_between(random, std::log(14), std::log(105)));
    if (row == ROW_LARGE)
        ball.radius = random_between(random, 110, 190);
    if (row == ROW_PRINTS || row == ROW_PRINTS_AND_GLINTS)
        ball_add_prints(random, &ball);
    if (row == ROW_GLINTS || row == ROW_PRINTS_AND_GLINTS)
        ball_add_glints(random, &ball);
    if (row == ROW_OVER_EXPOSED) { /* white in its middle, and more light than the chip can hold */
        ball.exposure = random_between(random, 1, 1.8);
        ball.glints.push_back({direction_normalised({random_between(random, -0.4, 0.4),
                                                     random_between(random, -0.4, 0.4), -1}),
                               random_between(random, 3, 12), random_between(random, 0.9, 1.6)});
    }
    put_ball(random, row, eye, &ball);
    return ball;
}

static void draw_smaller_ones(random_source *random, const drawn_ball &ball, const camera &eye,
                              cv::Mat *picture)
{
    for (int i = 0; i < 4; i++) {
        drawn_ball other = ball;
        other.radius = std::max(8.0, ball.radius * random_between(random, 0.1, 0.7));
        put_ball(random, ROW_SMALLER_ONES, eye, &other);
        if (std::hypot(other.centre.column - ball.centre.column,
                       other.centre.row - ball.centre.row) > 1.1 * (ball.radius + other.radius))
            ball_draw(other, eye, picture);
    }
}

/* Motion along a line, then a lens out of focus. */
static void blur(random_source *random, double most, cv::Mat *picture)
{
    const double length = random_between(random, 0, most);
    const double turn = random_between(random, 0, pi);
    const int half = static_cast<int>(length / 2) + 1;
    cv::Mat kernel = cv::Mat::zeros(2 * half + 1, 2 * half + 1, CV_32FC1);
    const cv::Point2d along(length / 2 * std::cos(turn), length / 2 * std::sin(turn));
    const cv::Point2d middle(half, half);

    cv::line(kernel, (middle - along) * 16, (middle + along) * 16, cv::Scalar(1), 1, cv::LINE_8, 4);
    kernel /= cv::sum(kernel)[0];
    cv::filter2D(*picture, *picture, -1, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::GaussianBlur(*picture, *picture, {0, 0}, random_between(random, 0.5, 2.5));
}

/* What the chip makes of the light: noise, eight bits. */
static cv::Mat expose(random_source *random, const cv::Mat &picture)
{
    const double deviation = random_between(random, 0.5, 4);
    cv::Mat bgr(picture.size(), CV_8UC3);

    for (int y = 0; y < picture.rows; y++)
        for (int x = 0; x < picture.cols; x++)
            for (int c = 0; c < 3; c++) {
                double noise = -6; /* twelve evenly distributed numbers: nearly normal */
                for (int i = 0; i < 3; i++)
                    noise += 4 * random_between(random, 0, 1);
                bgr.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uint8_t>(
                    255 * picture.at<cv::Vec3f>(y, x)[c] + deviation * noise / 2);
            }
    return bgr;
}

/* Through JPEG of six kinds and back. */
static void through_jpeg(uint64_t index, cv::Mat *bgr)
{
    static const struct {
        int sampling;
        int quality;
        int flags;
    } kinds[] = {{TJSAMP_444, 90, 0}, {TJSAMP_422, 75, 0},
                 {TJSAMP_420, 75, 0}, {TJSAMP_420, 40, TJFLAG_PROGRESSIVE},
                 {TJSAMP_440, 70, 0}, {TJSAMP_411, 70, 0}};
    const auto &kind = kinds[index % 6];
    unsigned char *bytes = nullptr;
    unsigned long size = 0;
    tjhandle writer = tjInitCompress();
    tjhandle reader = tjInitDecompress();

    if (tjCompress2(writer, bgr->data, bgr->cols, static_cast<int>(bgr->step), bgr->rows, TJPF_BGR,
                    &bytes, &size, kind.sampling, kind.quality, kind.flags) < 0 ||
        tjDecompress2(reader, bytes, size, bgr->data, bgr->cols, static_cast<int>(bgr->step),
                      bgr->rows, TJPF_BGR, 0) < 0)
        CV_Error(cv::Error::StsError, "libturbojpeg refuses its own picture");
    tjFree(bytes);
    tjDestroy(writer);
    tjDestroy(reader);
}

hard_picture picture_draw(int row, uint64_t index)
{
    random_source seeded(0x9e3779b97f4a7c15ULL * (static_cast<uint64_t>(row) + 1) + index);
    random_source *const random = &seeded;
    const ball_colour &colour = colours[index % 5];
    const camera eye = draw_eye(random, row);
    const drawn_ball ball = draw_ball(random, row, eye, colour);
    cv::Mat picture(eye.height, eye.width, CV_32FC3);

    surroundings_room(random, &picture);
    if (row == ROW_CLUTTER || row == ROW_NO_BALL)
        surroundings_clutter(random, ball, &picture);
    if (row == ROW_SMALLER_ONES)
        draw_smaller_ones(random, ball, eye, &picture);
    if (row != ROW_NO_BALL)
        ball_draw(ball, eye, &picture);
    if (row == ROW_COVERED)
        surroundings_cover(random, ball, &picture);
    if (row == ROW_BLURRED)
        blur(random, 0.3 * ball.radius, &picture);
    else
        cv::GaussianBlur(picture, picture, {0, 0}, random_between(random, 0.4, 0.9));
    hard_picture made = {expose(random, picture), eye,         colour.hue * pi / 180,
                         row != ROW_NO_BALL,      ball.centre, ball.radius};
    made.eye.aspect = 1; /* nobody knows */
    if (row == ROW_JPEG)
        through_jpeg(index, &made.bgr);
    return made;
}
