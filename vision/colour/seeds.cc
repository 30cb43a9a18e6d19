#include "vision/colour/seeds.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

static const double pi = 3.14159265358979323846;
static const double seed_hue = 25 * pi / 180; /* on both sides: shading, and what light does */
static const double seed_saturation = 0.5;    /* of the seed's own: the least */
static const double seed_value = 0.35;        /* likewise: the ball's dark side */
static const double saturation_least = 0.2;   /* paler things have no hue to speak of */
static const double value_least = 0.1;        /* nor have darker ones */
static const double moving_saturation = 0.3;  /* what a seed that moves must have */
static const int patch = 3;                   /* px on each side of a point */
static const int moved_levels = 25;           /* of 255 */
static const int hues = 36;                   /* bins */
static const int most_seeds = 5;
static const int stride = 2; /* px */

static colour_hsv hsv_of(const cv::Vec3b &bgr)
{
    return colour_to_hsv(bgr[2], bgr[1], bgr[0]);
}

static colour_range about(double hue, double saturation, double value)
{
    return {hue, seed_hue, seed_saturation * saturation, 1, seed_value * value};
}

bool seed_at(const cv::Mat &picture, const pixel_point &at, colour_range *range, colour_hsv *colour)
{
    const cv::Rect around =
        cv::Rect(static_cast<int>(at.column) - patch, static_cast<int>(at.row) - patch,
                 2 * patch + 1, 2 * patch + 1) &
        cv::Rect({0, 0}, picture.size());
    const cv::Scalar mean = around.empty() ? cv::Scalar() : cv::mean(picture(around));

    *colour = colour_to_hsv(mean[2], mean[1], mean[0]);
    *range = about(colour->hue, colour->saturation, colour->value);
    return colour->saturation >= saturation_least && colour->value >= value_least;
}

cv::Mat seed_motion(const cv::Mat &picture, const cv::Mat &other)
{
    cv::Mat difference;
    cv::Mat channels[3];

    cv::absdiff(picture, other, difference);
    cv::split(difference, channels);
    cv::max(channels[0], channels[1], channels[0]);
    cv::max(channels[0], channels[2], channels[0]);
    return channels[0] > moved_levels;
}

namespace
{
/* The pixels of one hue. */
struct hue_bin {
    int n = 0;
    double saturation = 0; /* sums */
    double value = 0;
    double cosine = 0; /* of the hue, for a mean that minds no wrap */
    double sine = 0;

    void add(const hue_bin &other)
    {
        n += other.n;
        saturation += other.saturation;
        value += other.value;
        cosine += other.cosine;
        sine += other.sine;
    }
};
} // namespace

static void count(const cv::Mat &picture, const cv::Mat &moving, std::vector<hue_bin> *bins)
{
    for (int row = 0; row < picture.rows; row += stride)
        for (int column = 0; column < picture.cols; column += stride) {
            const colour_hsv hsv = hsv_of(picture.at<cv::Vec3b>(row, column));
            if ((!moving.empty() && !moving.at<uint8_t>(row, column)) ||
                hsv.saturation < moving_saturation || hsv.value < value_least)
                continue;
            const int bin = std::min(hues - 1, static_cast<int>(hsv.hue / (2 * pi) * hues));
            (*bins)[bin].add({1, hsv.saturation, hsv.value, std::cos(hsv.hue), std::sin(hsv.hue)});
        }
}

/* Each with its neighbours: a hue lies between two bins as often as in one. */
static std::vector<hue_bin> smoothed(const std::vector<hue_bin> &bins)
{
    std::vector<hue_bin> smooth(bins);

    for (int i = 0; i < hues; i++) {
        smooth[i].add(bins[(i + 1) % hues]);
        smooth[i].add(bins[(i + hues - 1) % hues]);
    }
    return smooth;
}

std::vector<colour_range> seeds_that_move(const std::vector<cv::Mat> &pictures)
{
    std::vector<hue_bin> bins(hues);
    std::vector<int> order(hues);
    std::vector<colour_range> seeds;

    if (pictures.size() == 1)
        count(pictures[0], cv::Mat(), &bins);
    for (size_t i = 1; i < pictures.size(); i++)
        count(pictures[i], seed_motion(pictures[i], pictures[i - 1]), &bins);
    bins = smoothed(bins);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&bins](int a, int b) { return bins[a].n > bins[b].n; });
    for (const int i : order) {
        const hue_bin &bin = bins[i];
        const double hue = std::atan2(bin.sine, bin.cosine);
        if (bin.n == 0 || seeds.size() == most_seeds)
            break;
        if (std::none_of(seeds.begin(), seeds.end(), [hue](const colour_range &known) {
                return colour_hue_distance(known.hue, hue) < seed_hue / 2;
            }))
            seeds.push_back(about(hue, bin.saturation / bin.n, bin.value / bin.n));
    }
    return seeds;
}
