/* The eyes: what is drawn is where the projection says, half hidden is half hidden, and the same
 * seed draws the same bytes. */
#include <bot_core_image_t.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fixture.h"
#include "simrobot/eyes/image_message.h"
#include "simrobot/eyes/renderer.h"
#include "simrobot/eyes/sensor.h"
#include "simrobot/world/visibility.h"
#include "tests/unit/suite.h"

using fixture::degree;

namespace
{

#define STUDIO "eyes.noise=0", "eyes.tremble=0", "eyes.creep=0", "light.drift=0", "light.flicker=0"

std::unique_ptr<sim::Renderer> renderer(const sim::Config &config)
{
    std::string error;
    std::unique_ptr<sim::Renderer> result = sim::Renderer::create(config, &error);
    if (!result)
        ck_abort_msg("%s", error.c_str());
    return result;
}

/* The pixels in which two pictures of one eye differ. */
struct Spot {
    double u = 0, v = 0;
    int pixels = 0;
};

Spot find_difference(const sim::Config &config, const sim::StereoPixels &pixels,
                     const sim::StereoPixels &others, int eye)
{
    Spot spot;

    for (int y = 0; y < config.height; y++)
        for (int x = 0; x < config.width; x++) {
            auto at = static_cast<size_t>(4 * ((2 * y + eye) * config.width + x));
            int most = 0;
            for (size_t c = at; c < at + 3; c++)
                most = std::max(most, std::abs(pixels[c] - others[c]));
            if (most < 8)
                continue;
            spot.u += x + 0.5 - config.width / 2.0;
            spot.v += y + 0.5 - config.height / 2.0;
            spot.pixels++;
        }
    spot.u /= std::max(spot.pixels, 1);
    spot.v /= std::max(spot.pixels, 1);
    return spot;
}

/* The same picture without its ball. */
sim::StereoPixels without_ball(sim::Renderer &draws, sim::Snapshot snapshot)
{
    sim::StereoPixels pixels;
    snapshot.ball = snapshot.right_eye * Eigen::Vector3d(-5, 0, 0);
    draws.draw(snapshot, &pixels);
    return pixels;
}

/* A sphere off the axis is drawn as an ellipse whose middle lies a little outside of its centre's
 * projection.
 *   returns how far the spot is from that middle, px. */
double off_outline(const Spot &spot, double u, double v, double focal_length, double angular_radius)
{
    double r = std::hypot(u, v), angle = std::atan(r / focal_length);
    double middle =
        focal_length / 2 * (std::tan(angle + angular_radius) + std::tan(angle - angular_radius));
    double scale = r > 0 ? middle / r : 1;
    return std::hypot(spot.u - scale * u, spot.v - scale * v);
}

/* A robot that looks at its ball, off centre by these angles (deg). */
std::unique_ptr<fixture::Stage> looking(const std::vector<double> &arm, int tool, double yaw_off,
                                        double pitch_off)
{
    std::vector<double> joints = arm;
    joints.insert(joints.end(), {0, 0});
    auto before = fixture::stage({STUDIO}, joints, tool);
    sim::Fixation fixation = before->simulation->truth().fixation;
    joints[4] = fixation.yaw / degree + yaw_off;
    joints[5] = fixation.pitch / degree + pitch_off;
    return fixture::stage({STUDIO}, joints, tool);
}

} // namespace

START_TEST(test_ball_is_drawn_where_the_projection_says)
{
    double worst = 0;

    for (int tool : {0, 1})
        for (double off : {-2.0, 0.0, 2.0}) {
            auto stage = looking({-64, -15, 5, -70}, tool, off, -off / 2);
            std::unique_ptr<sim::Renderer> draws = renderer(stage->config);
            sim::StereoPixels pixels;
            sim::Snapshot snapshot = stage->simulation->snapshot(1);
            /* The ball alone: what holds it covers a little of its rim. */
            snapshot.shapes.clear();
            draws->draw(snapshot, &pixels);
            sim::Projection p = stage->simulation->truth().projection;
            sim::StereoPixels blank = without_ball(*draws, snapshot);
            Spot left = find_difference(stage->config, pixels, blank, 0);
            Spot right = find_difference(stage->config, pixels, blank, 1);
            ck_assert_int_gt(left.pixels, 500);
            ck_assert_int_gt(right.pixels, 500);
            double f = stage->config.focal_length;
            double left_radius = std::asin(
                snapshot.ball_radius / (snapshot.left_eye.translation() - snapshot.ball).norm());
            double right_radius = std::asin(
                snapshot.ball_radius / (snapshot.right_eye.translation() - snapshot.ball).norm());
            worst = std::max({worst, off_outline(left, p.u_left, p.v_left, f, left_radius),
                              off_outline(right, p.u_right, p.v_right, f, right_radius)});
        }
    printf("drawn ball against projection: %.2f px at worst\n", worst);
    ck_assert_double_lt(worst, 0.3);
}
END_TEST

/* A part of the robot is drawn where the projection says, up and down, left and right. */
START_TEST(test_shapes_are_drawn_where_the_projection_says)
{
    auto stage = looking({-64, -15, 5, -70}, 0, 0, 0);
    std::unique_ptr<sim::Renderer> draws = renderer(stage->config);
    sim::Snapshot blank = stage->simulation->snapshot(1);
    sim::StereoPixels with_it, without_it;

    blank.shapes.clear();
    blank.ball = blank.right_eye * Eigen::Vector3d(-5, 0, 0);
    draws->draw(blank, &without_it);
    for (double y : {-0.08, 0.06})
        for (double z : {-0.05, 0.07}) {
            sim::Snapshot snapshot = blank;
            Eigen::Vector3d at = snapshot.right_eye * Eigen::Vector3d(0.6, y, z);
            Eigen::Isometry3d pose(Eigen::Translation3d(at.x(), at.y(), at.z()));
            snapshot.shapes.push_back(
                {sim::ShapeKind::sphere, {0.015, 0, 0}, pose, {0.9f, 0.1f, 0.1f}});
            draws->draw(snapshot, &with_it);
            sim::Projection p =
                sim::rig_project(stage->rig, snapshot.left_eye, snapshot.right_eye, at);
            Spot left = find_difference(stage->config, with_it, without_it, 0);
            Spot right = find_difference(stage->config, with_it, without_it, 1);
            /* A mesh's outline has corners: half a pixel. */
            ck_assert_double_lt(std::hypot(left.u - p.u_left, left.v - p.v_left), 0.5);
            ck_assert_double_lt(std::hypot(right.u - p.u_right, right.v - p.v_right), 0.5);
        }
}
END_TEST

/* A board before the ball hides as much in the picture as the rays say. */
START_TEST(test_hidden_share_is_that_of_the_picture)
{
    auto stage = looking({-64, -15, 5, -70}, 0, 0, 0);
    std::unique_ptr<sim::Renderer> draws = renderer(stage->config);
    sim::Snapshot snapshot = stage->simulation->snapshot(1);
    sim::StereoPixels pixels;

    draws->draw(snapshot, &pixels);
    int whole = find_difference(stage->config, pixels, without_ball(*draws, snapshot), 1).pixels;
    ck_assert_double_gt(sim::visibility_of_ball(snapshot.shapes, snapshot.right_eye.translation(),
                                                snapshot.ball, snapshot.ball_radius),
                        0.99);
    for (double shift : {-0.06, -0.045, -0.03}) {
        sim::Snapshot hidden = snapshot;
        sim::Shape board = {sim::ShapeKind::box,
                            {0.01, 0.06, 0.2},
                            snapshot.right_eye * Eigen::Translation3d(0.3, shift, 0),
                            {0.5f, 0.4f, 0.4f}};
        hidden.shapes.push_back(board);
        draws->draw(hidden, &pixels);
        Spot seen = find_difference(stage->config, pixels, without_ball(*draws, hidden), 1);
        double drawn = static_cast<double>(seen.pixels) / whole;
        double rays = sim::visibility_of_ball(hidden.shapes, hidden.right_eye.translation(),
                                              hidden.ball, hidden.ball_radius);
        ck_assert_double_eq_tol(rays, drawn, 0.06);
    }
}
END_TEST

START_TEST(test_rays_meet_every_kind_of_shape)
{
    Eigen::Vector3d from(-1, 0, 0), to(1, 0, 0);
    Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d aside(Eigen::Translation3d(0, 0.3, 0));

    for (sim::ShapeKind kind : {sim::ShapeKind::sphere, sim::ShapeKind::cylinder,
                                sim::ShapeKind::box, sim::ShapeKind::capsule}) {
        sim::Shape shape = {kind, {0.2, 0.2, 0.2}, upright, {1, 1, 1}};
        ck_assert(sim::visibility_blocks(shape, from, to));
        ck_assert(!sim::visibility_blocks(shape, from, Eigen::Vector3d(-0.5, 0, 0)));
        shape.pose = aside;
        ck_assert(!sim::visibility_blocks(shape, from, to));
    }
    /* The round end of a capsule reaches beyond its length. */
    sim::Shape capsule = {sim::ShapeKind::capsule, {0.1, 0.2, 0}, upright, {1, 1, 1}};
    ck_assert(sim::visibility_blocks(capsule, {-1, 0, 0.17}, {1, 0, 0.17}));
    ck_assert(!sim::visibility_blocks(capsule, {-1, 0, 0.23}, {1, 0, 0.23}));
}
END_TEST

START_TEST(test_same_seed_draws_the_same_bytes)
{
    std::vector<uint8_t> messages[3];

    for (int run = 0; run < 3; run++) {
        uint64_t seed = run < 2 ? 3 : 4;
        auto stage = fixture::stage({}, {-65, -17.5, 0, -65, -22, 3}, 1, seed);
        std::unique_ptr<sim::Renderer> draws = renderer(stage->config);
        std::string error;
        auto encoder = sim::ImageMessage::create(stage->config, &error);
        ck_assert_ptr_nonnull(encoder.get());
        sim::StereoPixels pixels;
        sim::Sensor sensor(stage->config.sensor_noise, seed);
        for (int64_t number = 1; number <= 3; number++) {
            fixture::steps(*stage->simulation, 33);
            draws->draw(stage->simulation->snapshot(number), &pixels);
            sensor.expose(number, &pixels);
            std::vector<uint8_t> bytes = encoder->encode(number, pixels, &error);
            messages[run].insert(messages[run].end(), bytes.begin(), bytes.end());
        }
    }
    ck_assert(messages[0] == messages[1]);
    ck_assert(messages[0] != messages[2]);
}
END_TEST

/* Raw pixels go out as they are, and JPEG decodes to nearly the same. */
START_TEST(test_jpeg_and_raw_agree)
{
    auto stage = looking({-64, -15, 5, -70}, 0, 0, 0);
    sim::StereoPixels pixels;
    std::string error;
    sim::Config raw = stage->config;
    raw.image_format = static_cast<int>(sim::ImageFormat::rgb);
    auto raw_encoder = sim::ImageMessage::create(raw, &error);
    auto jpeg_encoder = sim::ImageMessage::create(stage->config, &error);
    const size_t size = static_cast<size_t>(3 * raw.width * raw.height);

    renderer(stage->config)->draw(stage->simulation->snapshot(1), &pixels);
    std::vector<uint8_t> raw_bytes = raw_encoder->encode(1, pixels, &error);
    std::vector<uint8_t> jpeg_bytes = jpeg_encoder->encode(1, pixels, &error);
    ck_assert_str_eq(error.c_str(), "");
    ck_assert_uint_gt(raw_bytes.size(), 2 * size);
    const uint8_t soi[] = {0xff, 0xd8, 0xff};
    auto jpeg = std::search(jpeg_bytes.begin(), jpeg_bytes.end(), soi, soi + 3);
    ck_assert(jpeg != jpeg_bytes.end());
    std::vector<uint8_t> decoded(size);
    tjhandle decompressor = tjInitDecompress();
    tjDecompress2(decompressor, &*jpeg, static_cast<unsigned long>(jpeg_bytes.end() - jpeg),
                  decoded.data(), raw.width, 0, raw.height, TJPF_RGB, 0);
    tjDestroy(decompressor);
    double sum = 0;
    for (int y = 0; y < raw.height; y++)
        for (int x = 0; x < 3 * raw.width; x++)
            sum += std::abs(decoded[static_cast<size_t>(3 * raw.width * y + x)] -
                            pixels[static_cast<size_t>(4 * (2 * raw.width * y + x / 3) + x % 3)]);
    ck_assert_double_lt(sum / static_cast<double>(size), 2.5);
}
END_TEST

START_TEST(test_missing_graphics_are_said_in_one_line)
{
    std::string error;

    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    ck_assert(!sim::Renderer::create(fixture::config(), &error));
    ck_assert_ptr_nonnull(strstr(error.c_str(), "--no-eyes"));
    ck_assert_ptr_null(strchr(error.c_str(), '\n'));
}
END_TEST

int main()
{
    const TTest *tests[] = {test_ball_is_drawn_where_the_projection_says,
                            test_shapes_are_drawn_where_the_projection_says,
                            test_hidden_share_is_that_of_the_picture,
                            test_rays_meet_every_kind_of_shape,
                            test_same_seed_draws_the_same_bytes,
                            test_jpeg_and_raw_agree,
                            test_missing_graphics_are_said_in_one_line};
    return SUITE_RUN("simrobot eyes", tests);
}
