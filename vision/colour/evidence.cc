#include "vision/colour/evidence.h"

#include <algorithm>
#include <cmath>

#include "vision/colour/seeds.h"

static const double pi = 3.14159265358979323846;
static const double degree = pi / 180;
static const double usual_focal = 1.2; /* of the width, where the camera is not known */
static const int step = 3;             /* px */
static const double moved_least =
    0.25; /* of the radius: a ball that rests is a thing of the room */
static const double still_weight = 0.02; /* of a ball of which no pixel moves */
static const double inner = 0.9;         /* of the radius: the rim is mixed with what is behind */
static const double beside = 1.3;        /* times the radius: further away is not the ball */
static const int blown = 250;            /* levels: such a pixel has lost its colour */
static const double alike = 35 * degree; /* hues further from the ball's are prints */
static const double pale = 0.15;         /* saturation: less is a glint, or grey */
static const size_t least_pixels = 60;
static const double outer_share = 0.02; /* of the pixels, that may lie outside the range's bounds */
static const double hue_margin = 6 * degree, hue_least = 10 * degree, hue_most = 60 * degree;
static const double saturation_margin = 0.8; /* times what was seen */
static const double value_margin = 0.6;
static const double saturation_floor = 0.15, value_floor = 0.04;

static camera camera_of(const cv::Mat &picture)
{
    return {picture.cols, picture.rows, usual_focal * picture.cols, 0, 0, 0, 0};
}

static image_view view_of(const cv::Mat &picture)
{
    return {picture.data, picture.cols, picture.rows, picture.step, PIXEL_BGR};
}

/* Share of the ball's square that moves. */
static double moving_share(const cv::Mat &motion, const blob &ball)
{
    const int side = static_cast<int>(2 * ball.radius);
    const cv::Rect square = cv::Rect(static_cast<int>(ball.pixel.column - ball.radius),
                                     static_cast<int>(ball.pixel.row - ball.radius), side, side) &
                            cv::Rect({0, 0}, motion.size());

    return square.empty() ? 0
                          : cv::countNonZero(motion(square)) / static_cast<double>(square.area());
}

/* Index of the blob that moves most. */
static int best_of(const std::vector<cv::Mat> &pictures, size_t i, const blob *blobs, int n)
{
    int best = 0;
    double most = -1;

    if (pictures.size() == 1)
        return 0;
    const cv::Mat motion = seed_motion(pictures[i], pictures[i > 0 ? i - 1 : 1]);
    for (int k = 0; k < n; k++) {
        const double weight = blobs[k].score * (still_weight + moving_share(motion, blobs[k]));
        if (weight > most) {
            most = weight;
            best = k;
        }
    }
    return best;
}

static double quantile(std::vector<double> values, double share)
{
    const auto place = values.begin() + static_cast<long>(share * (values.size() - 1));

    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/* Whether the ball was in many places. What rests seems to move once when something passes before
 * it, so the middle half of its places counts. */
static bool moved(const std::vector<colour_sighting> &sightings)
{
    std::vector<double> columns;
    std::vector<double> rows;
    std::vector<double> radii;

    for (const colour_sighting &one : sightings) {
        columns.push_back(one.ball.pixel.column);
        rows.push_back(one.ball.pixel.row);
        radii.push_back(one.ball.radius);
    }
    return std::max(quantile(columns, 0.75) - quantile(columns, 0.25),
                    quantile(rows, 0.75) - quantile(rows, 0.25)) >
           moved_least * quantile(radii, 0.5);
}

std::vector<colour_sighting> evidence_follow(const std::vector<cv::Mat> &pictures,
                                             const colour_range &range)
{
    std::vector<colour_sighting> sightings;
    segmenter work = {};

    work.range = range;
    work.colours = colour_table_create(range);
    work.limits = {0.4 * degree, 40 * degree, 0.5, 0.5, 0.8};
    for (size_t i = 0; i < pictures.size(); i++) {
        blob blobs[SEGMENT_CANDIDATES];
        const image_view view = view_of(pictures[i]);
        const int n =
            segment_find(&work, view, camera_of(pictures[i]), image_whole(view), step, blobs);
        if (n > 0)
            sightings.push_back({i, blobs[best_of(pictures, i, blobs, n)]});
    }
    if (pictures.size() > 1 && !sightings.empty() && !moved(sightings))
        sightings.clear();
    return sightings;
}

double evidence_weight(const std::vector<colour_sighting> &sightings)
{
    double sum = 0;

    for (const colour_sighting &one : sightings)
        sum += one.ball.score;
    return sum;
}

bool evidence_holds(const std::vector<colour_sighting> &sightings, size_t picture,
                    const pixel_point &at)
{
    return std::any_of(sightings.begin(), sightings.end(), [&](const colour_sighting &one) {
        return one.picture == picture && std::hypot(one.ball.pixel.column - at.column,
                                                    one.ball.pixel.row - at.row) <= one.ball.radius;
    });
}

static void take_disc(const cv::Mat &picture, const blob &ball, std::vector<colour_hsv> *pixels)
{
    const double reach = inner * ball.radius;

    for (int row = static_cast<int>(ball.pixel.row - reach); row <= ball.pixel.row + reach; row++)
        for (int column = static_cast<int>(ball.pixel.column - reach);
             column <= ball.pixel.column + reach; column++) {
            if (row < 0 || column < 0 || row >= picture.rows || column >= picture.cols ||
                std::hypot(column - ball.pixel.column, row - ball.pixel.row) > reach)
                continue;
            const cv::Vec3b &bgr = picture.at<cv::Vec3b>(row, column);
            const colour_hsv hsv = colour_to_hsv(bgr[2], bgr[1], bgr[0]);
            if (hsv.saturation >= pale && std::min({bgr[0], bgr[1], bgr[2]}) < blown)
                pixels->push_back(hsv);
        }
}

/* The mean of hues weighted by how much hue there is. */
static double mean_hue(const std::vector<colour_hsv> &pixels)
{
    double cosine = 0;
    double sine = 0;

    for (const colour_hsv &one : pixels) {
        cosine += one.saturation * one.value * std::cos(one.hue);
        sine += one.saturation * one.value * std::sin(one.hue);
    }
    const double hue = std::atan2(sine, cosine);
    return hue < 0 ? hue + 2 * pi : hue;
}

bool evidence_range(const std::vector<colour_hsv> &pixels, colour_range *range)
{
    std::vector<double> off;
    std::vector<double> saturation;
    std::vector<double> value;

    const double first = mean_hue(pixels);
    std::vector<colour_hsv> own;
    std::copy_if(
        pixels.begin(), pixels.end(), std::back_inserter(own),
        [first](const colour_hsv &one) { return colour_hue_distance(one.hue, first) <= alike; });
    if (own.size() < least_pixels)
        return false;
    range->hue = mean_hue(own);
    for (const colour_hsv &one : own) {
        off.push_back(colour_hue_distance(one.hue, range->hue));
        saturation.push_back(one.saturation);
        value.push_back(one.value);
    }
    range->hue_tolerance =
        std::clamp(quantile(off, 1 - outer_share) + hue_margin, hue_least, hue_most);
    range->saturation_min =
        std::max(saturation_floor, saturation_margin * quantile(saturation, outer_share));
    range->saturation_max = 1;
    range->value_min = std::max(value_floor, value_margin * quantile(value, outer_share));
    return true;
}

void evidence_pixels(const std::vector<cv::Mat> &pictures,
                     const std::vector<colour_sighting> &sightings, std::vector<colour_hsv> *pixels)
{
    for (const colour_sighting &one : sightings)
        take_disc(pictures[one.picture], one.ball, pixels);
}

double evidence_clutter(const std::vector<cv::Mat> &pictures,
                        const std::vector<colour_sighting> &sightings, const colour_range &range)
{
    const colour_table colours = colour_table_create(range);
    double n = 0;
    double members = 0;

    for (const colour_sighting &one : sightings) {
        const image_view view = view_of(pictures[one.picture]);
        for (int row = 0; row < view.height; row += step)
            for (int column = 0; column < view.width; column += step) {
                if (std::hypot(column - one.ball.pixel.column, row - one.ball.pixel.row) <
                    beside * one.ball.radius)
                    continue;
                n++;
                members +=
                    colour_member(colours, image_pixel(view, column, row), image_red(view)) != 0;
            }
    }
    return n > 0 ? members / n : 0;
}
