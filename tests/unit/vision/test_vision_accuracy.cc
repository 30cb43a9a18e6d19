/* Where vision says that the ball is, against where it was drawn. */
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "fixture.h"
#include "vision/answers/show.h"
#include "vision/answers/statistics.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int n_pairs = 16;

/* Distribution of one error over the pairs. */
struct errors {
    double squares = 0;
    double largest = 0;
    int n = 0;
};

static void add(errors *all, double error)
{
    all->squares += error * error;
    all->largest = std::max(all->largest, std::fabs(error));
    all->n++;
}

static void judge(const char *name, const errors &all, double rms_limit, double largest_limit)
{
    const double rms = std::sqrt(all.squares / all.n);

    printf("%-9s rms %.3f px, largest %.3f px\n", name, rms, all.largest);
    ck_assert_double_lt(rms, rms_limit);
    ck_assert_double_lt(all.largest, largest_limit);
}

START_TEST(shaded_ball_is_found_to_a_tenth_of_a_pixel)
{
    const scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(fixture_seed(1));
    errors u, v, disparity;
    time_histogram whole;

    for (int i = 0; i < n_pairs; i++) {
        const scene what = scene_random(random);
        const picture_pair pair = fixture_draw(what, rig, random);
        const fixture_truth truth = fixture_truth_of(what, rig);
        eyes who;
        eyes_init(&who, fixture_config());
        const double start = statistics_thread_us();
        const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
        time_histogram_add(&whole, statistics_thread_us() - start);
        ck_assert_int_eq(marker.reason, STEREO_SEEN);
        add(&u, marker.u_right - truth.u_right);
        add(&v, marker.v_right - truth.v_right);
        add(&disparity, marker.disparity - truth.disparity);
    }
    judge("u", u, 0.04, 0.12);
    judge("v", v, 0.04, 0.12);
    judge("disparity", disparity, 0.06, 0.16);
    printf("whole pictures: %.0f us of processor time a pair at the median\n",
           time_histogram_quantile(whole, 0.5));
}
END_TEST

/* A large ball at the picture's rim: the outline's middle lies 1 px beside the centre's image. */
START_TEST(perspective_does_not_shift_the_centre)
{
    scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(2);
    scene what = fixture_plain_scene();

    rig.vergence = 0;
    rig.left.focal = rig.right.focal = 600;
    what.spheres[0].centre = {0.16, 0.12, 0.42};
    what.spheres[0].radius = 0.035;
    eyes_config config = fixture_config();
    config.rig.left = rig.left;
    config.rig.right = rig.right;
    config.rig.vergence = 0;
    eyes who;
    eyes_init(&who, config);
    const picture_pair pair = fixture_draw(what, rig, random);
    const fixture_truth truth = fixture_truth_of(what, rig);
    const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
    ck_assert_int_eq(marker.reason, STEREO_SEEN);
    ck_assert_double_lt(std::fabs(marker.u_right - truth.u_right), 0.15);
    ck_assert_double_lt(std::fabs(marker.v_right - truth.v_right), 0.15);
    ck_assert_double_lt(std::fabs(marker.disparity - truth.disparity), 0.2);
}
END_TEST

START_TEST(distortion_is_removed)
{
    scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(3);
    scene what = fixture_plain_scene();

    what.spheres[0].centre = {0.08, 0.06, 0.5};
    rig.right.k1 = rig.left.k1 = -0.4;
    eyes_config config = fixture_config();
    config.rig.left = rig.left;
    config.rig.right = rig.right;
    eyes who;
    eyes_init(&who, config);
    const picture_pair pair = fixture_draw(what, rig, random);
    const fixture_truth truth = fixture_truth_of(what, rig);
    const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
    ck_assert_int_eq(marker.reason, STEREO_SEEN);
    ck_assert_double_lt(std::fabs(marker.u_right - truth.u_right), 0.15);
    ck_assert_double_lt(std::fabs(marker.v_right - truth.v_right), 0.15);
}
END_TEST

/* A bar moves across the ball: what is still said must be right, and what is gone must not be
 * said. */
START_TEST(hidden_ball_is_right_or_not_seen)
{
    const scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(fixture_seed(4));
    scene what = fixture_plain_scene();
    int seen = 0;

    what.bar = true;
    const fixture_truth truth = fixture_truth_of(what, rig);
    const double middle = truth.u_right + 319.5;
    for (int i = 0; i <= 6; i++) {
        what.bar_right = middle - 66 + 22 * i;
        what.bar_left = 0;
        const picture_pair pair = fixture_draw(what, rig, random);
        eyes who;
        eyes_init(&who, fixture_config());
        const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
        if (marker.reason == STEREO_SEEN) {
            seen++;
            ck_assert_double_lt(std::fabs(marker.u_right - truth.u_right), 0.6);
            ck_assert_double_lt(std::fabs(marker.v_right - truth.v_right), 0.6);
            ck_assert_double_lt(std::fabs(marker.disparity - truth.disparity), 0.8);
            ck_assert_double_lt(what.bar_right, middle + 25);
        } else {
            ck_assert_double_gt(what.bar_right, middle - 35);
        }
    }
    ck_assert_int_ge(seen, 2);
}
END_TEST

/* Where the picture ends so does the outline. What is left must be seen, and be enough. */
START_TEST(ball_cut_by_the_rim_needs_enough_outline)
{
    scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(7);
    scene what = fixture_plain_scene();
    eyes_config config = fixture_config();

    /* A little more than half of the disc lies below the lower rim. */
    what.spheres[0].centre = {0, 0.102, 0.5};
    const picture_pair pair = fixture_draw(what, rig, random);
    const fixture_truth truth = fixture_truth_of(what, rig);
    for (double coverage_min : {0.95, 0.6}) {
        eyes who;
        config.limits.coverage_min = coverage_min;
        eyes_init(&who, config);
        const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
        if (coverage_min > 0.9) {
            ck_assert_int_eq(marker.reason, STEREO_NOT_IN_RIGHT);
        } else {
            ck_assert_int_eq(marker.reason, STEREO_SEEN);
            ck_assert_double_lt(std::fabs(marker.u_right - truth.u_right), 0.3);
            ck_assert_double_lt(std::fabs(marker.v_right - truth.v_right), 1);
        }
    }
}
END_TEST

START_TEST(other_greenish_things_are_not_the_ball)
{
    const scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(fixture_seed(5));

    for (int i = 0; i < 4; i++) {
        scene what = scene_random(random);
        const scene_sphere ball = what.spheres[0];
        /* A yellow-green ball, larger, beside the other. */
        const double side = ball.centre.x > 0 ? -1 : 1;
        what.spheres.push_back({{side * 0.05 * ball.centre.z / 0.5, ball.centre.y * 0.5, 0.8},
                                0.045,
                                {0.52, 0.62, 0.2}});
        const picture_pair both = fixture_draw(what, rig, random);
        const fixture_truth truth = fixture_truth_of(what, rig);
        eyes who;
        eyes_init(&who, fixture_config());
        stereo_marker marker = eyes_look(&who, 1000000, both.left.view(), both.right.view());
        if (marker.reason == STEREO_SEEN)
            ck_assert_double_lt(
                std::hypot(marker.u_right - truth.u_right, marker.v_right - truth.v_right), 1);
        what.spheres.erase(what.spheres.begin());
        const picture_pair other = fixture_draw(what, rig, random);
        marker = eyes_look(&who, 1033000, other.left.view(), other.right.view());
        ck_assert_int_ne(marker.reason, STEREO_SEEN);
    }
}
END_TEST

/* Why it was not seen: the fault of the largest thing of its colour. */
START_TEST(what_was_refused_is_named)
{
    const double degree = 3.14159265358979323846 / 180;
    std::mt19937_64 random(8);
    const picture_pair pair = fixture_draw(fixture_plain_scene(), scene_default_eyes(), random);
    eyes_config large = fixture_config();
    eyes_config small = fixture_config();
    eyes_config pale = fixture_config();

    large.limits.radius_max = degree;
    small.limits.radius_min = 4 * degree;
    pale.limits.fill_min = 1.01;
    const struct {
        eyes_config config;
        blob_fault fault;
    } cases[] = {{large, BLOB_TOO_LARGE}, {small, BLOB_TOO_SMALL}, {pale, BLOB_FILL}};
    for (const auto &one : cases) {
        eyes who;
        eyes_init(&who, one.config);
        const stereo_marker marker = eyes_look(&who, 1, pair.left.view(), pair.right.view());
        ck_assert_int_eq(marker.reason, STEREO_NOT_IN_RIGHT);
        ck_assert_int_eq(who.in_right.n_found, 0);
        ck_assert_int_ge(who.in_right.n_refused, 1);
        ck_assert_int_eq(who.in_right.refused[0].fault, one.fault);
        statistics counts;
        char line[512];
        counts.faults[one.fault] = 3;
        statistics_unseen(counts, line, sizeof line);
        ck_assert_ptr_nonnull(strstr(line, blob_fault_text(one.fault)));
        ck_assert_ptr_nonnull(strstr(line, ": 3"));
    }
}
END_TEST

/* Pixels of about this colour, as smooth lines have it, in a half of the drawn pair. */
static int drawn_in(const cv::Mat &pair, bool left, const cv::Scalar &colour)
{
    cv::Mat same;

    cv::inRange(pair.colRange(left ? 0 : 640, left ? 640 : 1280), colour - cv::Scalar::all(60),
                colour + cv::Scalar::all(60), same);
    return cv::countNonZero(same);
}

/* In the picture for people: the ball red, what was refused orange, in each eye. */
START_TEST(candidates_are_drawn)
{
    static const cv::Scalar red(0, 0, 255);
    static const cv::Scalar orange(0, 200, 255);
    std::mt19937_64 random(9);
    const picture_pair pair = fixture_draw(fixture_plain_scene(), scene_default_eyes(), random);
    eyes_config small = fixture_config();
    eyes_config crooked = fixture_config();

    small.limits.radius_min = 4 * 3.14159265358979323846 / 180;
    crooked.rig.left.pitch = 0.02;
    const struct {
        eyes_config config;
        stereo_reason reason;
        bool left, right; /* refused ones there */
    } cases[] = {{fixture_config(), STEREO_SEEN, false, false},
                 {small, STEREO_NOT_IN_RIGHT, false, true},
                 {crooked, STEREO_HEIGHTS_DIFFER, true, true}};
    for (const auto &one : cases) {
        eyes who;
        eyes_init(&who, one.config);
        const stereo_marker marker = eyes_look(&who, 1, pair.left.view(), pair.right.view());
        ck_assert_int_eq(marker.reason, one.reason);
        const cv::Mat drawn =
            show_draw(pair.left.view(), pair.right.view(), who, marker.reason, "");
        for (const bool left : {true, false}) {
            ck_assert_int_eq(drawn_in(drawn, left, red) > 5, one.reason == STEREO_SEEN);
            ck_assert_int_eq(drawn_in(drawn, left, orange) > 5, left ? one.left : one.right);
        }
    }
}
END_TEST

START_TEST(no_usable_pair_at_all_is_noticed)
{
    statistics counts;

    ck_assert(!statistics_nothing_usable(counts));
    counts.pairs = counts.reasons[STEREO_UNUSABLE] = 3;
    ck_assert(statistics_nothing_usable(counts));
    counts.pairs++;
    ck_assert(!statistics_nothing_usable(counts));
}
END_TEST

START_TEST(nothing_is_seen_where_nothing_is)
{
    const scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(6);
    scene what = fixture_plain_scene();
    eyes who;

    what.spheres.clear();
    eyes_init(&who, fixture_config());
    const picture_pair pair = fixture_draw(what, rig, random);
    const stereo_marker marker = eyes_look(&who, 1000000, pair.left.view(), pair.right.view());
    ck_assert_int_eq(marker.reason, STEREO_NOT_IN_RIGHT);
    ck_assert_double_eq(marker.u_right, 0);
    ck_assert_double_eq(marker.disparity, 0);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        shaded_ball_is_found_to_a_tenth_of_a_pixel,
        perspective_does_not_shift_the_centre,
        distortion_is_removed,
        hidden_ball_is_right_or_not_seen,
        ball_cut_by_the_rim_needs_enough_outline,
        other_greenish_things_are_not_the_ball,
        what_was_refused_is_named,
        candidates_are_drawn,
        no_usable_pair_at_all_is_noticed,
        nothing_is_seen_where_nothing_is,
    };

    return SUITE_RUN("vision accuracy", tests);
}
