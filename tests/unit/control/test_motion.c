/* Shaping: direction kept, limits kept, smooth start. */
#include "daemon/config/sizes.h"
#include "daemon/control/limits/motion.h"
#include "fixture.h"
#include "tests/unit/suite.h"

#include <math.h>

START_TEST(direction_is_kept)
{
    struct config config = fixture_config(NULL, 0);
    double q[MAX_JOINTS] = {-0.7, -0.3, 0, -0.8};
    double velocity[MAX_JOINTS] = {4, -2, 1, 0.5};
    double previous[MAX_JOINTS] = {0.65, -0.33, 0.17, 0.08};

    motion_shape(&config, 0, 4, q, previous, velocity);
    ck_assert_double_eq_tol(velocity[0], config.motion_arm_velocity, 1e-12);
    ck_assert_double_eq_tol(velocity[1] / velocity[0], -0.5, 1e-9);
    ck_assert_double_eq_tol(velocity[3] / velocity[0], 0.125, 1e-9);
}
END_TEST

START_TEST(a_joint_comes_to_rest_before_its_margin)
{
    struct config config = fixture_config(NULL, 0);
    double q[MAX_JOINTS] = {-0.7, -0.3, 0, -0.8};
    double previous[MAX_JOINTS] = {0}, velocity[MAX_JOINTS];

    for (int tick = 0; tick < 500; tick++) {
        for (int i = 0; i < 4; i++)
            velocity[i] = i % 2 ? -3 : 3;
        motion_shape(&config, 0, 4, q, previous, velocity);
        for (int i = 0; i < 4; i++) {
            ck_assert(fabs(velocity[i] - previous[i]) <=
                      config.motion_arm_acceleration * 0.02 + 1e-12);
            q[i] += velocity[i] * 0.02;
            previous[i] = velocity[i];
        }
    }
    ck_assert_double_eq_tol(q[0], config.arm_max.value[0] - config.motion_margin, 1e-4);
    ck_assert_double_eq_tol(q[1], config.arm_min.value[1] + config.motion_margin, 1e-4);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {direction_is_kept, a_joint_comes_to_rest_before_its_margin};

    return SUITE_RUN("motion", tests);
}
