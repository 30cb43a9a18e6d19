/* The ball's colour, learned from pictures of it. */
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "common/program/log.h"
#include "fixture.h"
#include "vision/colour/learner.h"
#include "vision/colour/seeds.h"
#include "vision/config.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const double degree = 3.14159265358979323846 / 180;
static const char path[] = "test_vision_colour.yaml";
static const int n_pictures = 6;
static const int64_t between = 150000; /* us */

static const struct {
    const char *name;
    double colour[3];
    double hue; /* deg */
} balls[] = {
    {"orange", {0.95, 0.45, 0.06}, 26},      {"red, below 360", {0.85, 0.05, 0.12}, 355},
    {"red, above 0", {0.85, 0.12, 0.06}, 5}, {"yellow", {0.90, 0.80, 0.08}, 53},
    {"blue", {0.10, 0.25, 0.85}, 228},       {"green", {0.16, 0.72, 0.22}, 126},
};
static const scene_sphere decoy = {{-0.045, 0.03, 0.5}, 0.03, {0.55, 0.16, 0.62}}; /* violet */

/* Small pictures do: colours are learned, not places. */
static scene_eyes small_eyes()
{
    scene_eyes eyes = scene_default_eyes();

    for (camera *eye : {&eyes.left, &eyes.right}) {
        eye->width = 320;
        eye->height = 240;
        eye->focal = 600;
    }
    return eyes;
}

static scene scene_with(const double *colour, int i)
{
    scene what = fixture_plain_scene();

    what.spheres[0].centre = {-0.02 + 0.01 * i, -0.035, 0.5};
    std::copy(colour, colour + 3, what.spheres[0].colour);
    what.spheres.push_back(decoy);
    what.gloss = 0.4;
    return what;
}

static void show_ball(colour_learner *learner, const double *colour, int i, std::mt19937_64 &random)
{
    const picture_pair pair = fixture_draw(scene_with(colour, i), small_eyes(), random);
    incoming_pair incoming;

    incoming.waited = 0;
    incoming.images.utime = 1000000 + between * i;
    incoming.images.left = fixture_encoded(pair.left);
    incoming.images.right = fixture_encoded(pair.right);
    learner->take(incoming);
}

static int finish(colour_learner *learner)
{
    FILE *out = fopen(path, "w");
    const int status = learner->finish(out, nullptr);

    fclose(out);
    return status;
}

/* What was learned finds the ball in a new pair, and nothing else. */
static void check_learned(const char *name, const double *colour, double hue,
                          std::mt19937_64 &random)
{
    const scene_eyes rig = small_eyes();
    const scene what = scene_with(colour, n_pictures);
    const picture_pair pair = fixture_draw(what, rig, random);
    eyes_config config = fixture_config();
    vision_config read;
    char error[256];
    eyes who;

    ck_assert_msg(config_load(&read, path, nullptr, 0, error, sizeof error) == 0, "%s", error);
    unlink(path);
    config.colour = config_eyes(read).colour;
    config.rig.left = rig.left;
    config.rig.right = rig.right;
    ck_assert_msg(colour_hue_distance(config.colour.hue, hue * degree) < 8 * degree, "%s: %g deg",
                  name, config.colour.hue / degree);
    ck_assert_double_lt(config.colour.hue_tolerance, 40 * degree);
    eyes_init(&who, config);
    const stereo_marker marker = eyes_look(&who, 1, pair.left.view(), pair.right.view());
    const fixture_truth truth = fixture_truth_of(what, rig);
    ck_assert_msg(marker.reason == STEREO_SEEN, "%s: %s", name, stereo_reason_text(marker.reason));
    ck_assert_double_eq_tol(marker.u_right, truth.u_right, 0.2);
    ck_assert_double_eq_tol(marker.v_right, truth.v_right, 0.2);
}

START_TEST(what_is_round_and_moves_is_the_ball)
{
    std::mt19937_64 random(fixture_seed(81));

    for (const auto &ball : balls) {
        colour_learner learner;
        for (int i = 0; i < n_pictures; i++)
            show_ball(&learner, ball.colour, i, random);
        ck_assert_msg(finish(&learner) == 0, "%s", ball.name);
        check_learned(ball.name, ball.colour, ball.hue, random);
    }
}
END_TEST

START_TEST(a_point_on_the_ball_is_enough)
{
    std::mt19937_64 random(fixture_seed(82));

    for (const auto &ball : balls) {
        double u;
        double v;
        colour_learner learner;
        scene_project(small_eyes(), false, scene_with(ball.colour, 0).spheres[0].centre, &u, &v);
        learner.point({u + 159.5, v + 119.5});
        show_ball(&learner, ball.colour, 0, random);
        ck_assert_msg(finish(&learner) == 0, "%s", ball.name);
        check_learned(ball.name, ball.colour, ball.hue, random);
    }
}
END_TEST

/* Of two coloured balls the one that was pointed at, though the other one moves. */
START_TEST(a_point_beats_what_moves)
{
    std::mt19937_64 random(83);
    colour_learner learner;
    double u;
    double v;

    scene_project(small_eyes(), false, decoy.centre, &u, &v);
    learner.point({u + 159.5, v + 119.5});
    for (int i = 0; i < n_pictures; i++)
        show_ball(&learner, balls[0].colour, i, random);
    ck_assert_int_eq(finish(&learner), 0);
    vision_config read;
    char error[256];
    ck_assert_int_eq(config_load(&read, path, nullptr, 0, error, sizeof error), 0);
    unlink(path);
    ck_assert_double_lt(colour_hue_distance(read.hue, 291 * degree), 8 * degree);
}
END_TEST

START_TEST(white_and_black_are_impossible)
{
    static const double colours[][3] = {{0.95, 0.95, 0.95}, {0.02, 0.02, 0.02}, {0.4, 0.4, 0.4}};
    std::mt19937_64 random(84);

    for (const auto &colour : colours) {
        double u;
        double v;
        colour_learner moving;
        for (int i = 0; i < n_pictures; i++)
            show_ball(&moving, colour, i, random);
        ck_assert_int_eq(finish(&moving), -1);
        colour_learner pointed;
        scene_project(small_eyes(), false, scene_with(colour, 0).spheres[0].centre, &u, &v);
        pointed.point({u + 159.5, v + 119.5});
        show_ball(&pointed, colour, 0, random);
        ck_assert_int_eq(finish(&pointed), -1);
        const cv::Mat plain(20, 20, CV_8UC3,
                            cv::Scalar(255 * colour[2], 255 * colour[1], 255 * colour[0]));
        colour_range range;
        colour_hsv seen;
        ck_assert(!seed_at(plain, {10, 10}, &range, &seen)); /* which is why, and is said */
    }
    unlink(path);
}
END_TEST

START_TEST(no_pictures_no_colour)
{
    colour_learner learner;

    ck_assert(!learner.done());
    ck_assert_int_eq(finish(&learner), -1);
    unlink(path);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        what_is_round_and_moves_is_the_ball,
        a_point_on_the_ball_is_enough,
        a_point_beats_what_moves,
        white_and_black_are_impossible,
        no_pictures_no_colour,
    };

    log_open("test_vision_colour", LOG_LEVEL_ERROR);
    return SUITE_RUN("vision colour", tests);
}
