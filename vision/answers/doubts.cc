#include "vision/answers/doubts.h"

#include <algorithm>
#include <cmath>

#include "vision/answers/answers.h"

static const int64_t period = 900000; /* us */
static const int least_pairs = 8;
static const double most_share = 0.8;   /* of the pairs: no chance */
static const double misfit_share = 0.5; /* a ball that swings fits by chance now and then */
static const int least_radii = 4;
static const double most_spread = 0.15; /* of the ball's true radius, which stays as it is */
static const int look_step = 8;         /* px */
static const int colour_least = 12;     /* levels between a pixel's channels */

static bool most(const doubts &all, int n)
{
    return n >= most_share * all.pairs;
}

/* Relative deviation of the ball's true radius from pair to pair. */
static double radius_spread(const doubts &all)
{
    const double mean = all.radius_sum / all.radii;

    return std::sqrt(std::max(0.0, all.radius_squares / all.radii - mean * mean)) / mean;
}

static const char *judge_eyes(const doubts &all)
{
    if (most(all, all.behind))
        return "the lines of sight meet behind the eyes: left and right are swapped, or "
               "eyes.vergence is wrong";
    if (most(all, all.heights))
        return "the eyes see the ball at different heights: one eye's pictures are late, or the "
               "rig is not as configured (reach-vision --calibrate)";
    if (all.heights + all.sizes >= misfit_share * all.pairs)
        return "the eyes' views of the ball do not fit each other: left and right are swapped, one "
               "eye's "
               "pictures are late, or ball.radius, eyes.baseline or eyes.vergence is wrong";
    if (all.radii >= least_radii && radius_spread(all) > most_spread)
        return "the ball's true size changes as it moves: left and right are swapped, one eye's "
               "pictures are late, or eyes.vergence is wrong";
    return nullptr;
}

static const char *judge(const doubts &all)
{
    const bool left = most(all, all.still_left);
    const bool right = most(all, all.still_right);

    if (all.pairs < least_pairs)
        return nullptr;
    /* Both at once can be a simulated robot at rest. */
    if (left != right)
        return left ? "the left eye's pictures do not change: its camera or driver hangs"
                    : "the right eye's pictures do not change: its camera or driver hangs";
    if (most(all, all.grey))
        return "the pictures have no colour: a black-and-white camera, or one in its night mode; a "
               "ball is found by its colour";
    return judge_eyes(all);
}

/* Returns 1 when the content is that of the pair before. */
static int same_as_before(uint64_t *known, uint64_t content)
{
    const int same = *known == content;

    *known = content;
    return same;
}

bool doubts_colourless(const image_view &image)
{
    for (int row = 0; row < image.height; row += look_step)
        for (int column = 0; column < image.width; column += look_step) {
            const uint8_t *pixel = image_pixel(image, column, row);
            if (std::max({pixel[0], pixel[1], pixel[2]}) -
                    std::min({pixel[0], pixel[1], pixel[2]}) >
                colour_least)
                return false;
        }
    return true;
}

static void add_radius(doubts *all, double radius)
{
    all->radii++;
    all->radius_sum += radius;
    all->radius_squares += radius * radius;
}

/* Forgets all but the newest pictures' contents. */
static void begin_anew(doubts *all)
{
    const uint64_t left = all->content_left;
    const uint64_t right = all->content_right;

    *all = doubts();
    all->content_left = left;
    all->content_right = right;
}

const char *doubts_add(doubts *all, const image_message &pair, const stereo_marker &marker,
                       bool grey)
{
    const char *doubt = nullptr;

    if (all->pairs > 0 && pair.utime - all->since >= period) {
        doubt = judge(*all);
        begin_anew(all);
    }
    if (all->pairs == 0 || pair.utime < all->since)
        all->since = pair.utime;
    all->pairs++;
    all->behind += marker.meets_behind;
    all->heights += marker.reason == STEREO_HEIGHTS_DIFFER;
    all->sizes += marker.reason == STEREO_SIZES_DIFFER || marker.reason == STEREO_DISPARITY_RANGE;
    all->grey += grey;
    if (marker.reason == STEREO_SEEN && marker.true_radius > 0)
        add_radius(all, marker.true_radius);
    all->still_left += same_as_before(&all->content_left, answers_content_of(pair.left));
    all->still_right += same_as_before(&all->content_right, answers_content_of(pair.right));
    return doubt;
}
