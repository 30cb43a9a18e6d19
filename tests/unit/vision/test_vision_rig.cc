/* Rigs that nobody rectified: learned from a moved ball, and read from OpenCV's files. */
#include <opencv2/core.hpp>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "common/program/log.h"
#include "crooked.h"
#include "fixture.h"
#include "vision/rig/calibrate.h"
#include "vision/rig/from_opencv.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const double degree = 3.14159265358979323846 / 180;
static const int n_sightings = 80;

static void show_ball(rig_calibrator *learner, int i, std::mt19937_64 &random)
{
    const picture_pair pair = fixture_draw(scene_random(random), crooked_eyes(), random);
    incoming_pair incoming;

    incoming.waited = 0;
    incoming.images.utime = 1000000 + 100000 * i;
    incoming.images.left = fixture_encoded(pair.left);
    incoming.images.right = fixture_encoded(pair.right);
    learner->take(incoming);
}

START_TEST(a_moved_ball_tells_how_the_eyes_stand)
{
    const char *const path = "test_vision_rig.yaml";
    std::mt19937_64 random(fixture_seed(61));
    rig_calibrator learner(fixture_config());

    ck_assert_int_le(crooked_seen(fixture_config(), random), CROOKED_CHECKS / 4);
    for (int i = 0; i < n_sightings; i++)
        show_ball(&learner, i, random);
    ck_assert_int_eq(learner.finish(path, nullptr), 0);
    const eyes_config config = crooked_load(path);
    unlink(path);
    ck_assert_double_eq_tol(config.rig.left.aspect, 0.96, 0.003);
    ck_assert_double_eq_tol((config.rig.left.roll - config.rig.right.roll) / degree, 2, 0.1);
    ck_assert_int_eq(crooked_seen(config, random), CROOKED_CHECKS);
}
END_TEST

START_TEST(too_few_sightings_are_said)
{
    rig_calibrator learner(fixture_config());
    std::mt19937_64 random(62);

    show_ball(&learner, 0, random);
    ck_assert_int_eq(learner.finish("never-written.yaml", nullptr), -1);
}
END_TEST

static cv::Matx33d about_x(double a)
{
    return {1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a)};
}

static cv::Matx33d about_y(double a)
{
    return {std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)};
}

static cv::Matx33d about_z(double a)
{
    return {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1};
}

/* Points of the left camera's axes, seen by both, must be level and at their distance. */
START_TEST(stereo_calibration_of_opencv_is_taken)
{
    const char *const path = "test_vision_opencv.yml";
    const cv::Matx33d rotation = about_x(0.03) * about_y(0.12) * about_z(-0.05);
    const cv::Vec3d translation(-0.08, 0.006, 0.004);
    const cv::Matx33d matrix(600, 0, 330, 0, 580, 235, 0, 0, 1);
    stereo_rig rig = fixture_config().rig;
    char error[256] = "";

    cv::FileStorage file(path, cv::FileStorage::WRITE);
    file << "M1" << cv::Mat(matrix) << "D1"
         << cv::Mat(cv::Matx<double, 1, 5>(-.1, .05, .001, 0, .01));
    file << "M2" << cv::Mat(matrix) << "D2" << cv::Mat(cv::Matx<double, 1, 4>(-.1, .05, 0, .002));
    file << "R" << cv::Mat(rotation) << "T" << cv::Mat(translation);
    file.release();
    ck_assert_msg(rig_from_opencv(&path, 1, &rig, error, sizeof error) == 0, "%s", error);
    unlink(path);
    ck_assert_double_eq_tol(rig.left.aspect, 580.0 / 600, 1e-12);
    ck_assert_double_eq_tol(rig.right.p2, .002, 1e-12);
    ck_assert_double_eq_tol(rig.baseline, cv::norm(translation), 1e-9);
    for (int i = 0; i < 27; i++) {
        const cv::Vec3d left(0.1 * (i % 3 - 1), 0.1 * (i / 3 % 3 - 1), 0.5 + 0.2 * (i / 9));
        const cv::Vec3d right = rotation * left + translation;
        ck_assert_double_lt(std::fabs(stereo_height(rig, {left[0], left[1], left[2]},
                                                    {right[0], right[1], right[2]})),
                            1e-6);
    }
}
END_TEST

/* By OpenCV's formula for a lens, written down once more. */
START_TEST(lenses_are_those_of_opencv)
{
    const double x = 0.2, y = -0.15, r2 = x * x + y * y;
    camera eye = scene_default_eyes().left;

    eye.k1 = -0.2;
    eye.k2 = 0.1;
    eye.k3 = -0.05;
    eye.p1 = 0.002;
    eye.p2 = -0.003;
    eye.aspect = 1.05;
    const double radial = 1 - 0.2 * r2 + 0.1 * r2 * r2 - 0.05 * r2 * r2 * r2;
    const double xd = x * radial + 2 * 0.002 * x * y - 0.003 * (r2 + 2 * x * x);
    const double yd = y * radial + 0.002 * (r2 + 2 * y * y) + 2 * -0.003 * x * y;
    const pixel_point at = camera_project(eye, direction_normalised({x, y, 1}));
    ck_assert_double_eq_tol(at.column, 319.5 + 1200 * xd, 1e-9);
    ck_assert_double_eq_tol(at.row, 239.5 + 1200 * 1.05 * yd, 1e-9);
    const direction back = camera_direction(eye, at);
    ck_assert_double_eq_tol(back.x / back.z, x, 1e-6);
    ck_assert_double_eq_tol(back.y / back.z, y, 1e-6);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        a_moved_ball_tells_how_the_eyes_stand,
        too_few_sightings_are_said,
        stereo_calibration_of_opencv_is_taken,
        lenses_are_those_of_opencv,
    };

    log_open("test_vision_rig", LOG_LEVEL_WARNING);
    return SUITE_RUN("vision rig", tests);
}
