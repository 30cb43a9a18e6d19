/* A printed tag in the ball's place. Its pictures are drawn by casting rays on a plane. */
#include <opencv2/core.hpp>

#include <cmath>
#include <cstring>

#include "common/program/log.h"
#include "fixture.h"
#include "vision/answers/observer.h"
#include "vision/config.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const double degree = 3.14159265358979323846 / 180;
static const int rays = 5; /* along each side of a pixel */
static const int tag_px = 400;

/* A tag in space: its centre, and unit vectors along its sides; m, common frame. */
struct paper {
    cv::Vec3d centre, across, down;
    double size;
    cv::Mat print; /* with its white margin */
};

static cv::Vec3d turned(const cv::Vec3d &v, double a)
{
    return {std::cos(a) * v[0] + std::sin(a) * v[2], v[1], std::cos(a) * v[2] - std::sin(a) * v[0]};
}

/* Grey of the paper where a line from the eye meets it, or of what is behind. */
static double look(const paper &tag, const cv::Vec3d &from, const cv::Vec3d &along)
{
    const cv::Vec3d normal = tag.across.cross(tag.down);
    const double distance = (tag.centre - from).dot(normal) / along.dot(normal);
    const cv::Vec3d at = from + distance * along - tag.centre;
    const double scale = tag_px / tag.size;
    const int column =
        static_cast<int>(std::floor(at.dot(tag.across) * scale + tag.print.cols / 2.0));
    const int row = static_cast<int>(std::floor(at.dot(tag.down) * scale + tag.print.rows / 2.0));

    if (column < 0 || row < 0 || column >= tag.print.cols || row >= tag.print.rows)
        return 0.5 + 0.2 * std::sin(40 * along[0]) * std::sin(31 * along[1]);
    return tag.print.at<uint8_t>(row, column) ? 0.8 : 0.12;
}

static picture draw(const paper &tag, const scene_eyes &eyes, bool left, std::mt19937_64 &random)
{
    const camera &eye = left ? eyes.left : eyes.right;
    const double turn = left ? eyes.vergence / 2 : -eyes.vergence / 2;
    const cv::Vec3d from((left ? -0.5 : 0.5) * eyes.baseline, 0, 0);
    std::normal_distribution<double> noise(0, 2);
    picture result;

    result.width = eye.width;
    result.height = eye.height;
    for (int i = 0; i < eye.width * eye.height; i++) {
        double sum = 0;
        for (int k = 0; k < rays * rays; k++) {
            const direction view =
                camera_direction(eye, {i % eye.width + (k % rays + 0.5) / rays - 0.5,
                                       static_cast<int>(i / eye.width) +
                                           (static_cast<int>(k / rays) + 0.5) / rays - 0.5});
            sum += look(tag, from, turned({view.x, view.y, view.z}, turn));
        }
        const double level = 255 * sum / (rays * rays) + noise(random);
        const uint8_t grey = static_cast<uint8_t>(std::fmin(255, std::fmax(0, level + 0.5)));
        result.rgb.insert(result.rgb.end(), {grey, grey, grey});
    }
    return result;
}

/* Small pictures, or the rays take long. */
static scene_eyes tag_eyes()
{
    scene_eyes eyes = scene_default_eyes();

    for (camera *eye : {&eyes.left, &eyes.right}) {
        eye->width = 320;
        eye->height = 240;
        eye->focal = 600;
        eye->k1 = -0.1;
    }
    return eyes;
}

static eyes_config tag_settings(const tag_config &tag, double size)
{
    const scene_eyes eyes = tag_eyes();
    eyes_config config = fixture_config();

    config.tag = tag;
    config.rig.left = eyes.left;
    config.rig.right = eyes.right;
    config.rig.ball_radius = size / 2;
    return config;
}

/* Somewhere in view, slanted by up to 35 degrees and turned in its plane. */
static paper random_paper(const tag_config &tag, std::mt19937_64 &random)
{
    auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double z = between(0.4, 0.6);
    const double a = between(-180, 180) * degree;
    const double slant = between(-35, 35) * degree;
    const double about = between(-35, 35) * degree;
    const cv::Matx33d x(1, 0, 0, 0, std::cos(slant), -std::sin(slant), 0, std::sin(slant),
                        std::cos(slant));
    const cv::Matx33d y(std::cos(about), 0, std::sin(about), 0, 1, 0, -std::sin(about), 0,
                        std::cos(about));

    return {{z * between(-0.1, 0.1), z * between(-0.08, 0.08), z},
            y * (x * cv::Vec3d(std::cos(a), std::sin(a), 0)),
            y * (x * cv::Vec3d(-std::sin(a), std::cos(a), 0)),
            0.05,
            tag_picture(tag, tag_px)};
}

static picture_pair draw_pair(const paper &tag, std::mt19937_64 &random)
{
    return {draw(tag, tag_eyes(), true, random), draw(tag, tag_eyes(), false, random)};
}

START_TEST(its_centre_is_found_to_a_fraction_of_a_pixel)
{
    static const tag_config tags[] = {{1, 7}, {1, 49}, {9, 3}, {17, 5}, {20, 2}};
    std::mt19937_64 random(fixture_seed(71));
    double worst = 0;
    double squares = 0;
    int n = 0;

    for (const tag_config &tag : tags) {
        const paper sheet = random_paper(tag, random);
        const picture_pair pair = draw_pair(sheet, random);
        const direction centre = {sheet.centre[0], sheet.centre[1], sheet.centre[2]};
        double u[2];
        double v[2];
        eyes who;
        eyes_init(&who, tag_settings(tag, sheet.size));
        for (int i = 0; i < 2; i++) { /* whole pictures, then a window */
            const stereo_marker marker =
                eyes_look(&who, 1 + i, pair.left.view(), pair.right.view());
            ck_assert_msg(marker.reason == STEREO_SEEN, "tag %d of %d: %s", tag.id, tag.dictionary,
                          stereo_reason_text(marker.reason));
            ck_assert_int_eq(who.used_window, i);
            scene_project(tag_eyes(), true, centre, &u[0], &v[0]);
            scene_project(tag_eyes(), false, centre, &u[1], &v[1]);
            for (const double error :
                 {marker.u_right - u[1], marker.v_right - v[1], marker.disparity - (u[0] - u[1])}) {
                worst = std::fmax(worst, std::fabs(error));
                squares += error * error;
                n++;
            }
        }
    }
    const double rms = std::sqrt(squares / n);
    printf("error of u, v and disparity: %.3f px rms, %.3f px at most\n", rms, worst);
    ck_assert_double_lt(rms, 0.08);
    ck_assert_double_lt(worst, 0.25);
}
END_TEST

/* The checks of a ball hold: size, height, number. */
START_TEST(what_is_not_the_tag_is_refused)
{
    std::mt19937_64 random(fixture_seed(72));
    const tag_config tag = {1, 7};
    const paper sheet = random_paper(tag, random);
    const picture_pair pair = draw_pair(sheet, random);
    eyes who;

    eyes_init(&who, tag_settings({1, 8}, sheet.size));
    ck_assert_int_eq(eyes_look(&who, 1, pair.left.view(), pair.right.view()).reason,
                     STEREO_NOT_IN_RIGHT);
    ck_assert_int_eq(who.in_right.n_refused, 1);
    ck_assert_int_eq(who.in_right.refused[0].fault, BLOB_OTHER_TAG);

    eyes_init(&who, tag_settings(tag, 0.03));
    ck_assert_int_eq(eyes_look(&who, 1, pair.left.view(), pair.right.view()).reason,
                     STEREO_SIZES_DIFFER);

    eyes_config crooked = tag_settings(tag, sheet.size);
    crooked.rig.left.pitch = 2 * degree;
    eyes_init(&who, crooked);
    ck_assert_int_eq(eyes_look(&who, 1, pair.left.view(), pair.right.view()).reason,
                     STEREO_HEIGHTS_DIFFER);
}
END_TEST

static int load(const char *text, vision_config *config, char *error, size_t size)
{
    const char *const path = "test_vision_tag.yaml";
    FILE *out = fopen(path, "w");

    fputs(text, out);
    fclose(out);
    const int status = config_load(config, path, nullptr, 0, error, size);
    remove(path);
    return status;
}

START_TEST(one_line_of_yaml_is_enough)
{
    char error[256] = "";
    vision_config config;

    ck_assert_int_eq(load("marker: {dictionary: apriltag_36h11, id: 12, size: 0.04}\n", &config,
                          error, sizeof error),
                     0);
    ck_assert_int_eq(config_eyes(config).tag.id, 12);
    ck_assert_int_eq(tag_count(config_eyes(config).tag.dictionary), 587);
    ck_assert_double_eq_tol(config_eyes(config).rig.ball_radius, 0.02, 1e-12);
    ck_assert_int_eq(load("marker: {dictionary: 4x4_50, id: 50}\n", &config, error, sizeof error),
                     -1);
    ck_assert_ptr_nonnull(strstr(error, "marker.id"));
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        its_centre_is_found_to_a_fraction_of_a_pixel,
        what_is_not_the_tag_is_refused,
        one_line_of_yaml_is_enough,
    };

    log_open("test_vision_tag", LOG_LEVEL_ERROR);
    return SUITE_RUN("vision tag", tests);
}
