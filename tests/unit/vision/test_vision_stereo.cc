/* The checks between the eyes, on findings made by hand. */
#include <cmath>

#include "fixture.h"
#include "vision/config.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

/* What an eye would find of a ball whose centre stands at `point`. */
static blob finding(const scene_eyes &eyes, bool left, const direction &point, double radius)
{
    const camera &eye = left ? eyes.left : eyes.right;
    const double x = point.x + (left ? eyes.baseline : -eyes.baseline) / 2;
    const double squared = x * x + point.y * point.y + point.z * point.z;
    blob found = {};
    double u;
    double v;

    scene_project(eyes, left, point, &u, &v);
    found.cone.axis = direction_normalised({u / eye.focal, v / eye.focal, 1});
    found.cone.tangent = radius / std::sqrt(squared - radius * radius);
    found.cone.cosine = 1 / std::sqrt(1 + found.cone.tangent * found.cone.tangent);
    found.pixel = camera_project(eye, found.cone.axis);
    found.radius = found.cone.tangent * eye.focal;
    found.score = 1;
    return found;
}

/* Moves a finding by pixels. */
static blob moved(const camera &eye, blob found, double right, double down)
{
    found.pixel = {found.pixel.column + right, found.pixel.row + down};
    found.cone.axis = camera_direction(eye, found.pixel);
    return found;
}

static blob resized(blob found, double factor)
{
    found.cone.tangent *= factor;
    found.cone.cosine = 1 / std::sqrt(1 + found.cone.tangent * found.cone.tangent);
    return found;
}

START_TEST(pixels_count_from_the_middle_of_the_picture)
{
    camera eye = {640, 480, 1200, 0, 0, 0, 0};

    /* The middle of the picture lies between columns 319 and 320. */
    direction view = camera_direction(eye, {319.5 + 120, 239.5 - 60});
    ck_assert_double_eq_tol(view.x / view.z, 0.1, 1e-12);
    ck_assert_double_eq_tol(view.y / view.z, -0.05, 1e-12);
    eye.centre_u = 7;
    eye.centre_v = -3;
    eye.k1 = -0.2;
    eye.k2 = 0.1;
    const pixel_point pixel = {20, 450};
    view = camera_direction(eye, pixel);
    const pixel_point back = camera_project(eye, view);
    ck_assert_double_eq_tol(back.column, pixel.column, 1e-6);
    ck_assert_double_eq_tol(back.row, pixel.row, 1e-6);
    ck_assert_double_eq_tol(camera_direction(eye, {326.5, 236.5}).z, 1, 1e-12);
}
END_TEST

START_TEST(one_ball_anywhere_agrees_with_itself)
{
    const scene_eyes eyes = scene_default_eyes();
    std::mt19937_64 random(fixture_seed(21));
    std::uniform_real_distribution<double> side(-0.2, 0.2);
    stereo_rig rig = fixture_config().rig;

    rig.height_tolerance = 0.01;
    rig.size_tolerance = 0.01;
    rig.ball_radius = 0.025;
    rig.disparity_min = -1000;
    rig.disparity_max = 1000;
    for (int i = 0; i < 1000; i++) {
        const double z = 0.6 + side(random);
        const direction point = {z * side(random), z * side(random), z};
        ck_assert_int_eq(stereo_check(rig, finding(eyes, true, point, 0.025),
                                      finding(eyes, false, point, 0.025)),
                         STEREO_SEEN);
    }
}
END_TEST

START_TEST(different_heights_are_told)
{
    const scene_eyes eyes = scene_default_eyes();
    const stereo_rig rig = fixture_config().rig;
    const blob left = finding(eyes, true, {0.05, 0.05, 0.5}, 0.025);
    const blob right = finding(eyes, false, {0.05, 0.05, 0.5}, 0.025);

    ck_assert_int_eq(stereo_check(rig, moved(rig.left, left, 0, 2.5), right), STEREO_SEEN);
    ck_assert_int_eq(stereo_check(rig, moved(rig.left, left, 0, 3.5), right),
                     STEREO_HEIGHTS_DIFFER);
    ck_assert_int_eq(stereo_check(rig, left, moved(rig.right, right, 0, 3.5)),
                     STEREO_HEIGHTS_DIFFER);
}
END_TEST

START_TEST(different_sizes_are_told)
{
    const scene_eyes eyes = scene_default_eyes();
    stereo_rig rig = fixture_config().rig;
    const blob left = finding(eyes, true, {0, 0.05, 0.5}, 0.025);
    const blob right = finding(eyes, false, {0, 0.05, 0.5}, 0.025);

    ck_assert_int_eq(stereo_check(rig, resized(left, 1.1), right), STEREO_SEEN);
    ck_assert_int_eq(stereo_check(rig, resized(left, 1.2), right), STEREO_SIZES_DIFFER);
    ck_assert_int_eq(stereo_check(rig, left, resized(right, 1.2)), STEREO_SIZES_DIFFER);
    /* Both alike, but not the ball that was named. */
    ck_assert_int_eq(stereo_check(rig, resized(left, 1.4), resized(right, 1.4)), STEREO_SEEN);
    rig.ball_radius = 0.025;
    ck_assert_int_eq(stereo_check(rig, left, right), STEREO_SEEN);
    ck_assert_int_eq(stereo_check(rig, resized(left, 1.4), resized(right, 1.4)),
                     STEREO_SIZES_DIFFER);
}
END_TEST

START_TEST(impossible_disparities_are_told)
{
    const scene_eyes eyes = scene_default_eyes();
    stereo_rig rig = fixture_config().rig;
    const direction near = {0, 0, 0.42};
    const direction far = {0, 0, 0.9};

    rig.disparity_min = -60;
    rig.disparity_max = 30;
    ck_assert_int_eq(
        stereo_check(rig, finding(eyes, true, near, 0.025), finding(eyes, false, near, 0.025)),
        STEREO_DISPARITY_RANGE);
    ck_assert_int_eq(
        stereo_check(rig, finding(eyes, true, far, 0.025), finding(eyes, false, far, 0.025)),
        STEREO_DISPARITY_RANGE);
}
END_TEST

START_TEST(the_reason_names_the_eye)
{
    const stereo_rig rig = fixture_config().rig;
    const blob one = finding(scene_default_eyes(), true, {0, 0, 0.5}, 0.025);
    int i = -1;
    int j = -1;

    ck_assert_int_eq(stereo_match(rig, &one, 1, nullptr, 0, &i, &j).reason, STEREO_NOT_IN_RIGHT);
    ck_assert_int_eq(stereo_match(rig, nullptr, 0, &one, 1, &i, &j).reason, STEREO_NOT_IN_LEFT);
    ck_assert_int_eq(stereo_match(rig, nullptr, 0, nullptr, 0, &i, &j).reason, STEREO_NOT_IN_RIGHT);
}
END_TEST

START_TEST(the_pair_that_agrees_wins_over_better_scores)
{
    const scene_eyes eyes = scene_default_eyes();
    const stereo_rig rig = fixture_config().rig;
    const direction point = {0.01, 0.02, 0.55};
    blob left[2] = {finding(eyes, true, {0, -0.05, 0.5}, 0.025), finding(eyes, true, point, 0.025)};
    blob right[2] = {finding(eyes, false, point, 0.025),
                     finding(eyes, false, {0, 0.09, 0.5}, 0.03)};
    int i = -1;
    int j = -1;

    left[1].score = right[0].score = 0.4;
    const stereo_marker marker = stereo_match(rig, left, 2, right, 2, &i, &j);
    ck_assert_int_eq(marker.reason, STEREO_SEEN);
    ck_assert_int_eq(i, 1);
    ck_assert_int_eq(j, 0);
    double u_left, u, v;
    scene_project(eyes, true, point, &u_left, &v);
    scene_project(eyes, false, point, &u, &v);
    ck_assert_double_eq_tol(marker.u_right, u, 1e-6);
    ck_assert_double_eq_tol(marker.v_right, v, 1e-6);
    ck_assert_double_eq_tol(marker.disparity, u_left - u, 1e-6);
}
END_TEST

START_TEST(disparity_is_positive_when_near)
{
    const scene_eyes eyes = scene_default_eyes();
    const stereo_rig rig = fixture_config().rig;
    int i;
    int j;

    for (double z : {0.4, 0.7}) {
        const blob left = finding(eyes, true, {0, 0, z}, 0.025);
        const blob right = finding(eyes, false, {0, 0, z}, 0.025);
        const stereo_marker marker = stereo_match(rig, &left, 1, &right, 1, &i, &j);
        ck_assert_int_eq(marker.reason, STEREO_SEEN);
        ck_assert(z < 0.5 ? marker.disparity > 10 : marker.disparity < -10);
    }
}
END_TEST

START_TEST(a_cone_is_fitted_through_gross_errors)
{
    std::mt19937_64 random(fixture_seed(22));
    std::normal_distribution<double> noise(0, 0.1);
    const camera eye = scene_default_eyes().left;
    const double radius = 40;
    const pixel_point centre = {410, 150};
    outline_points points;
    outline cone;

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const double angle = 2 * M_PI * i / OUTLINE_RAYS;
        /* A third of the outline is cut off by a straight edge. */
        double length = radius + noise(random);
        if (std::cos(angle) > 0.5)
            length = 0.5 * radius / std::cos(angle);
        points.valid[i] = i % 11 != 0;
        points.view[i] = camera_direction(
            eye, {centre.column + length * std::cos(angle), centre.row + length * std::sin(angle)});
    }
    ck_assert(outline_consensus(points, eye.focal, 2, &cone));
    ck_assert(outline_refine(points, eye.focal, 2, 0.35, &cone));
    const pixel_point found = camera_project(eye, cone.axis);
    /* A circle in the picture is not quite a cone: 0.1 px here. */
    ck_assert_double_eq_tol(found.column, centre.column, 0.3);
    ck_assert_double_eq_tol(found.row, centre.row, 0.3);
    ck_assert_double_eq_tol(cone.tangent * eye.focal, radius, 0.4);
    ck_assert_int_lt(cone.support, 70);
}
END_TEST

/* What is right for a ball of 40 px in a picture 640 px wide is too strict for larger ones. */
START_TEST(tolerances_grow_with_ball_and_picture)
{
    const scene_eyes eyes = scene_default_eyes();
    const stereo_rig rig = fixture_config().rig;
    const direction point = {0, 0, 0.5};
    const char *const wide[] = {"camera.width=1920", "camera.height=1080"};
    vision_config usual;
    vision_config large;
    char error[256];

    for (const double radius : {0.02, 0.1}) {
        const blob left = finding(eyes, true, point, radius);
        const blob right = moved(eyes.right, finding(eyes, false, point, radius), 0, 4);
        ck_assert_int_eq(stereo_check(rig, left, right),
                         radius > 0.05 ? STEREO_SEEN : STEREO_HEIGHTS_DIFFER);
    }
    ck_assert_int_eq(config_load(&usual, nullptr, nullptr, 0, error, sizeof error), 0);
    ck_assert_int_eq(config_load(&large, nullptr, wide, 2, error, sizeof error), 0);
    const eyes_config a = config_eyes(usual);
    const eyes_config b = config_eyes(large);
    ck_assert_double_eq_tol(a.rig.height_tolerance, 3, 1e-12);
    ck_assert_double_eq_tol(b.rig.height_tolerance, 9, 1e-12);
    ck_assert_double_eq_tol(b.rig.disparity_max, 3 * a.rig.disparity_max, 1e-9);
    ck_assert_double_eq_tol(b.rig.disparity_min, 3 * a.rig.disparity_min, 1e-9);
    ck_assert_double_eq_tol(b.window.margin, 3 * a.window.margin, 1e-9);
    ck_assert_double_eq_tol(b.window.growth, 3 * a.window.growth, 1e-9);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        pixels_count_from_the_middle_of_the_picture,
        one_ball_anywhere_agrees_with_itself,
        different_heights_are_told,
        different_sizes_are_told,
        impossible_disparities_are_told,
        the_reason_names_the_eye,
        the_pair_that_agrees_wins_over_better_scores,
        disparity_is_positive_when_near,
        a_cone_is_fitted_through_gross_errors,
        tolerances_grow_with_ball_and_picture,
    };

    return SUITE_RUN("vision stereo", tests);
}
