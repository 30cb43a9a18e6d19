#include "tools/pictures/surroundings.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

static const double pi = 3.14159265358979323846;
static const int fraction_bits = 4; /* OpenCV draws to fractions of a pixel in fixed point */

static cv::Scalar scalar(const cv::Vec3f &colour)
{
    return {colour[0], colour[1], colour[2]};
}

static cv::Point2d anywhere(random_source *random, const cv::Mat &picture)
{
    return {random_between(random, 0, picture.cols), random_between(random, 0, picture.rows)};
}

/* A box about `centre`, turned. */
static void draw_board(cv::Mat *picture, const cv::Point2d &centre, double length, double width,
                       double turn, const cv::Vec3f &colour)
{
    std::vector<cv::Point> corners;

    for (int i = 0; i < 4; i++) {
        const double along = (i == 0 || i == 3 ? -0.5 : 0.5) * length;
        const double across = (i < 2 ? -0.5 : 0.5) * width;
        const cv::Point2d corner(centre.x + along * std::cos(turn) - across * std::sin(turn),
                                 centre.y + along * std::sin(turn) + across * std::cos(turn));
        corners.emplace_back(corner * (1 << fraction_bits));
    }
    cv::fillConvexPoly(*picture, corners, scalar(colour), cv::LINE_AA, fraction_bits);
}

/* An ellipse too long for a ball. */
static void draw_leaf(random_source *random, cv::Mat *picture, const cv::Point2d &centre,
                      double length, const cv::Vec3f &colour)
{
    const double scale = length * (1 << fraction_bits);
    const cv::Size2d axes(scale, scale * random_between(random, 0.2, 0.55));

    cv::ellipse(*picture, centre * (1 << fraction_bits), axes, random_between(random, 0, 180), 0,
                360, scalar(colour), cv::FILLED, cv::LINE_8, fraction_bits);
}

/* Grey with a little of any colour. */
static cv::Vec3f dull(random_source *random)
{
    const double grey = random_between(random, 0.1, 0.85);
    cv::Vec3f colour;

    for (int c = 0; c < 3; c++)
        colour[c] = static_cast<float>(grey * random_between(random, 0.85, 1.15));
    return colour;
}

static void add_texture(random_source *random, cv::Mat *picture)
{
    const int cell = 4 << random_whole(random, 4);
    const double contrast = random_between(random, 0.02, 0.15);
    cv::Mat pattern(picture->rows / cell + 2, picture->cols / cell + 2, CV_32FC1);

    for (int i = 0; i < pattern.rows * pattern.cols; i++)
        pattern.at<float>(i / pattern.cols, i % pattern.cols) =
            static_cast<float>(random_between(random, 1 - contrast, 1 + contrast));
    cv::resize(pattern, pattern, picture->size(), 0, 0, cv::INTER_CUBIC);
    cv::merge(std::vector<cv::Mat>{pattern, pattern, pattern}, pattern);
    cv::multiply(*picture, pattern, *picture);
}

static void add_light(random_source *random, cv::Mat *picture)
{
    const cv::Point2d lamp = anywhere(random, *picture);
    const double reach = random_between(random, 0.8, 2) * picture->cols;

    for (int y = 0; y < picture->rows; y++)
        for (int x = 0; x < picture->cols; x++)
            picture->at<cv::Vec3f>(y, x) *=
                1.1 - 0.5 * std::min(1.0, std::hypot(x - lamp.x, y - lamp.y) / reach);
}

void surroundings_room(random_source *random, cv::Mat *picture)
{
    const int n = 6 + random_whole(random, 14);

    picture->setTo(scalar(dull(random)));
    for (int i = 0; i < n; i++) {
        const double length = random_between(random, 20, 260);
        const cv::Point2d centre = anywhere(random, *picture);
        if (random_whole(random, 3) == 0)
            draw_leaf(random, picture, centre, length / 2, dull(random));
        else
            draw_board(picture, centre, length, random_between(random, 4, 120),
                       random_between(random, 0, pi), dull(random));
    }
    add_texture(random, picture);
    add_light(random, picture);
}

void surroundings_clutter(random_source *random, const drawn_ball &ball, cv::Mat *picture)
{
    const int n = 5 + random_whole(random, 8);

    for (int i = 0; i < n; i++) {
        const cv::Vec3f colour = ball.colour * random_between(random, 0.35, 0.95);
        const double away = random_between(random, 0.6, 1.6) * ball.radius;
        const double round = random_between(random, 0, 2 * pi);
        const cv::Point2d beside(ball.centre.column + away * std::cos(round),
                                 ball.centre.row + away * std::sin(round));
        const cv::Point2d centre = i < 2 ? beside : anywhere(random, *picture);
        if (random_whole(random, 2) == 0)
            draw_leaf(random, picture, centre, random_between(random, 10, 70), colour);
        else
            draw_board(picture, centre, random_between(random, 30, 150),
                       random_between(random, 5, 40), random_between(random, 0, pi), colour);
    }
}

void surroundings_cover(random_source *random, const drawn_ball &ball, cv::Mat *picture)
{
    const int fingers = 1 + random_whole(random, 3);
    const double width = random_between(random, 0.25, 0.7) * ball.radius / fingers;
    const double turn = random_between(random, 0, pi);
    const cv::Vec3f colour = dull(random);

    for (int i = 0; i < fingers; i++) {
        const double aside = random_between(random, -1, 1) * ball.radius;
        const cv::Point2d centre(ball.centre.column - aside * std::sin(turn),
                                 ball.centre.row + aside * std::cos(turn));
        draw_board(picture, centre, 4 * ball.radius, width, turn, colour);
    }
}
