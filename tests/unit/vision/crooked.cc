#include "crooked.h"

#include <cmath>

#include "fixture.h"
#include "vision/config.h"

#include "tests/unit/suite.h"

static const double degree = 3.14159265358979323846 / 180;

scene_eyes crooked_eyes()
{
    scene_eyes eyes = scene_default_eyes();

    eyes.left.roll = 2 * degree;
    eyes.left.pitch = 1 * degree;
    eyes.left.aspect = eyes.right.aspect = 0.96;
    return eyes;
}

eyes_config crooked_load(const char *path)
{
    eyes_config config = fixture_config();
    vision_config read;
    char error[256];

    ck_assert_msg(config_load(&read, path, nullptr, 0, error, sizeof error) == 0, "%s", error);
    const stereo_rig rig = config_eyes(read).rig;
    config.rig.left = rig.left;
    config.rig.right = rig.right;
    config.rig.vergence = rig.vergence;
    config.rig.baseline = rig.baseline;
    return config;
}

int crooked_seen(const eyes_config &config, std::mt19937_64 &random)
{
    const scene_eyes rig = crooked_eyes();
    int seen = 0;

    for (int i = 0; i < CROOKED_CHECKS; i++) {
        const scene what = scene_random(random);
        const picture_pair pair = fixture_draw(what, rig, random);
        const fixture_truth truth = fixture_truth_of(what, rig);
        eyes who;
        eyes_init(&who, config);
        const stereo_marker marker = eyes_look(&who, 1, pair.left.view(), pair.right.view());
        if (marker.reason != STEREO_SEEN)
            continue;
        seen++;
        ck_assert_double_eq_tol(marker.disparity, truth.disparity, 0.3);
        ck_assert_double_lt(
            std::fabs(stereo_height(config.rig, who.left_blob.cone.axis, who.right_blob.cone.axis)),
            0.5);
    }
    return seen;
}
