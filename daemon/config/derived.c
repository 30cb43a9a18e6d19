#include "daemon/config/derived.h"

static const double largest_px = 10000; /* no image is so large */

static void set_visual(struct config *config)
{
    const double per_pixel = 1 / config->eyes_pixels_per_radian;

    config->space = (struct space){
        .kind = SPACE_VISUAL,
        .n_head = 2,
        .fixates = true,
        .unit = {-per_pixel, per_pixel, 1},
        .scale = {config->task_scale_angle, config->task_scale_angle, config->task_scale_disparity},
        .noise = {config->learner_noise_angle, config->learner_noise_angle,
                  config->learner_noise_disparity},
        .norm = {config->learner_lwpr_norm_angle, config->learner_lwpr_norm_angle,
                 config->learner_lwpr_norm_disparity},
        .largest = largest_px,
    };
}

static void set_cartesian(struct config *config)
{
    config->space = (struct space){.kind = SPACE_CARTESIAN, .largest = 100 /* m: no arm is */};
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        config->space.unit[row] = 1;
        config->space.scale[row] = config->task_scale_position;
        config->space.noise[row] = config->learner_noise_position;
        config->space.norm[row] = config->learner_lwpr_norm_position;
    }
}

/* What is an angle of a head that turns is so many pixels in an eye that does not. */
static void set_fixed(struct config *config)
{
    const double pixels = config->eyes_pixels_per_radian;

    set_visual(config);
    config->space.kind = SPACE_FIXED;
    config->space.n_head = 0;
    config->space.fixates = false;
    for (int row = 0; row < 2; row++) {
        config->space.unit[row] = 1;
        config->space.scale[row] *= pixels;
        config->space.noise[row] *= pixels;
        config->space.norm[row] *= pixels;
    }
}

static void set_space(struct config *config)
{
    switch ((enum space_kind)config->task_space) {
    case SPACE_CARTESIAN:
        set_cartesian(config);
        break;
    case SPACE_FIXED:
        set_fixed(config);
        break;
    default:
        set_visual(config);
        break;
    }
}

/* Nobody has said which part of the range is of use: all of it, and babbling finds out. */
static void set_babble_range(struct config *config)
{
    config->babble_min = config->babble_min_given;
    config->babble_max = config->babble_max_given;
    if (config->babble_min.n > 0 || config->babble_max.n > 0)
        return;
    config->babble_min = config->arm_min;
    config->babble_max = config->arm_max;
    for (int i = 0; i < config_arm_joints(config); i++) {
        config->babble_min.value[i] += config->motion_margin;
        config->babble_max.value[i] -= config->motion_margin;
    }
}

void config_derive(struct config *config)
{
    set_space(config);
    set_babble_range(config);
}

struct joint_limits config_joint_limits(const struct config *config, int joint)
{
    int n_arm = config_arm_joints(config);

    if (joint < n_arm)
        return (struct joint_limits){
            .min = config->arm_min.value[joint],
            .max = config->arm_max.value[joint],
            .velocity = config->motion_arm_velocity,
            .acceleration = config->motion_arm_acceleration,
            .safety_velocity = config->safety_arm_velocity,
            .safety_acceleration = config->safety_arm_acceleration,
        };
    return (struct joint_limits){
        .min = config->head_min.value[joint - n_arm],
        .max = config->head_max.value[joint - n_arm],
        .velocity = config->motion_head_velocity,
        .acceleration = config->motion_head_acceleration,
        .safety_velocity = config->safety_head_velocity,
        .safety_acceleration = config->safety_head_acceleration,
    };
}

static double square(double x)
{
    return x * x;
}

struct learner_config config_learner(const struct config *config)
{
    struct learner_config learner = config->learner;

    learner.kind = (enum learner_kind)config->learner_kind;
    learner.n_inputs = config_arm_joints(config);
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        learner.psi0[row] = square(config->space.noise[row]);
        learner.lwpr.norm_out[row] = config->space.norm[row];
    }
    for (int i = 0; i < learner.n_inputs; i++) {
        learner.reference[i] = config->learner_reference.value[i];
        learner.scale[i] = config->learner_scale;
        learner.sigma0[i] = square(config->learner_reach);
        learner.body.low[i] = config->babble_min.value[i];
        learner.body.high[i] = config->babble_max.value[i];
        if (config->learner_body_order.n == learner.n_inputs)
            learner.body.order[i] = (int)config->learner_body_order.value[i] - 1;
    }
    learner.body.space =
        config->space.kind == SPACE_CARTESIAN ? LEARNER_BODY_PLACE : LEARNER_BODY_EYES;
    learner.body.degrees = false;
    if (learner.lwpr.max_projections > learner.n_inputs)
        learner.lwpr.max_projections = learner.n_inputs;
    return learner;
}
