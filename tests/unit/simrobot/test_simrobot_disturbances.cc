/* What keeps the eyes' pictures from being perfect: the sensor's noise, the light on the scene, and
 * the mounts of the eyes, each as much as configured. */
#include <algorithm>
#include <cmath>

#include "fixture.h"
#include "simrobot/disturbances/light.h"
#include "simrobot/disturbances/mounts.h"
#include "simrobot/eyes/sensor.h"
#include "tests/unit/suite.h"

using fixture::degree;

START_TEST(test_sensor_noise_is_as_configured)
{
    std::vector<uint8_t> pixels(1 << 20, 100), again(1 << 20, 100), next(1 << 20, 100);
    sim::Sensor sensor(2.0, 5);
    double sum = 0, squares = 0;

    sensor.expose(1, &pixels);
    sensor.expose(1, &again);
    sensor.expose(2, &next);
    ck_assert(pixels == again);
    ck_assert(pixels != next);
    for (uint8_t p : pixels) {
        sum += p - 100.0;
        squares += (p - 100.0) * (p - 100.0);
    }
    ck_assert_double_eq_tol(sum / (1 << 20), 0, 0.02);
    /* Rounding to whole grey levels adds 1/12. */
    ck_assert_double_eq_tol(std::sqrt(squares / (1 << 20)), std::sqrt(4 + 1.0 / 12), 0.03);
}
END_TEST

/* Dark and bright pixels stay what they can be. */
START_TEST(test_sensor_noise_does_not_wrap_around)
{
    std::vector<uint8_t> dark(100000, 0), bright(100000, 255);
    sim::Sensor sensor(10, 5);

    sensor.expose(1, &dark);
    sensor.expose(1, &bright);
    ck_assert_int_lt(*std::max_element(dark.begin(), dark.end()), 80);
    ck_assert_int_gt(*std::min_element(bright.begin(), bright.end()), 175);
}
END_TEST

/* Over minutes the light on the scene changes, but never goes out. */
START_TEST(test_light_wanders_within_bounds)
{
    sim::Config config = fixture::config();
    sim::Light light(config, fixture::test_seed());
    float dimmest = 10, brightest = 0;
    Eigen::Vector3f first = light.at(0, 1, 1).direction;
    double farthest = 0;

    for (int64_t i = 0; i < 3000; i++) {
        sim::LightState state = light.at(0.1 * static_cast<double>(i), i, 1);
        dimmest = std::min(dimmest, state.colour.minCoeff());
        brightest = std::max(brightest, state.colour.maxCoeff());
        farthest =
            std::max<double>(farthest, std::acos(std::min(1.0f, first.dot(state.direction))));
        ck_assert_double_eq_tol(state.direction.norm(), 1, 1e-5);
        ck_assert(state.direction.z() > 0);
    }
    ck_assert_double_gt(dimmest, 0.4);
    ck_assert_double_lt(brightest, 1.5);
    ck_assert_double_gt(farthest, 10 * degree);
    ck_assert_double_eq_tol(light.at(5, 3, 0.5).colour.x() / light.at(5, 3, 1).colour.x(), 0.5,
                            1e-6);
}
END_TEST

/* Frame to frame some 0.3 px, slowly less than 2 px, in both eyes nearly alike. */
START_TEST(test_mounts_give_as_configured)
{
    sim::Config config = fixture::config();
    sim::Mounts mounts(config, fixture::test_seed());
    const int n = 6000;
    double last[2] = {}, squares[2] = {}, farthest = 0;

    for (int i = 0; i < n; i++) {
        sim::MountTurns turns = mounts.at(i / 30.0, i);
        Eigen::Vector3d left = turns.left * Eigen::Vector3d::UnitX();
        Eigen::Vector3d right = turns.right * Eigen::Vector3d::UnitX();
        double now[2] = {right.y() * config.focal_length,
                         (left.y() - right.y()) * config.focal_length};
        for (int k = 0; k < 2; k++) {
            squares[k] += i ? (now[k] - last[k]) * (now[k] - last[k]) / 2 / n : 0;
            last[k] = now[k];
        }
        farthest = std::max(farthest, std::fabs(now[0]));
    }
    double expected = config.eye_tremble * config.focal_length;
    ck_assert_double_eq_tol(std::sqrt(squares[0]), expected, 0.1 * expected);
    ck_assert_double_lt(std::sqrt(squares[1]), 0.6 * expected);
    ck_assert_double_lt(farthest, 2.5);
}
END_TEST

int main()
{
    const TTest *tests[] = {test_sensor_noise_is_as_configured,
                            test_sensor_noise_does_not_wrap_around,
                            test_light_wanders_within_bounds, test_mounts_give_as_configured};
    return SUITE_RUN("simrobot disturbances", tests);
}
