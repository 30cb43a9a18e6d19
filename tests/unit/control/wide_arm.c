#include "wide_arm.h"

#include "common/base/random.h"
#include "fixture.h"

#include <math.h>

struct chain wide_arm(int64_t seed)
{
    static const double axis[7][3] = {{0, 0, 1}, {0, 1, 0},  {0, 0, 1}, {0, -1, 0},
                                      {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
    static const double offset[7][3] = {{0, 0, 0.333},  {0, 0, 0},           {0, 0, 0.316},
                                        {0.0825, 0, 0}, {-0.0825, 0, 0.384}, {0, 0, 0},
                                        {0.088, 0, 0}};
    struct random_state random = random_seed(seed);
    struct chain chain = {.n = 7};

    for (int i = 0; i < 7; i++) {
        double length = 0;
        for (int k = 0; k < 3; k++) {
            chain.axis[i][k] = axis[i][k] + random_uniform(&random, -0.03, 0.03);
            chain.offset[i][k] = offset[i][k] + random_uniform(&random, -0.01, 0.01);
            length += chain.axis[i][k] * chain.axis[i][k];
        }
        for (int k = 0; k < 3; k++)
            chain.axis[i][k] /= sqrt(length);
    }
    return chain;
}

struct config wide_arm_config(double noise)
{
    static const double middle[7] = {0, 0, 0, -1.6, 0, 1.9, 0};
    static const double range[7] = {2.88, 1.76, 2.88, 1.4, 2.88, 1.9, 2.88};
    struct config config = fixture_robot_config("icub.yaml");

    config.learner.features = LEARNER_BODY;
    config.learner_body_order.n = 0;
    config.learner.body.noise_share = noise * noise / (0.01 * 0.01);
    for (int i = 0; i < 7; i++) {
        config.arm_min.value[i] = middle[i] - range[i];
        config.arm_max.value[i] = middle[i] + range[i];
        config.babble_min.value[i] = config.arm_min.value[i] + config.motion_margin;
        config.babble_max.value[i] = config.arm_max.value[i] - config.motion_margin;
        config.learner_reference.value[i] = middle[i];
    }
    return config;
}
