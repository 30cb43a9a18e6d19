#include "daemon/config/check.h"

#include "daemon/config/sizes.h"

#include <math.h>
#include <stdio.h>

/* What one tick can touch. */
enum { MOST_EXPERTS = 1024 };

/* Two lists of limits: as long as each other and in order. */
static int check_range(const char *name, const struct option_list *min,
                       const struct option_list *max, char *error, size_t error_size)
{
    if (min->n != max->n) {
        snprintf(error, error_size, "%s.min and %s.max must have as many entries", name, name);
        return -1;
    }
    for (int i = 0; i < min->n; i++)
        if (min->value[i] >= max->value[i]) {
            snprintf(error, error_size, "%s.min is not below %s.max at joint %d", name, name,
                     i + 1);
            return -1;
        }
    return 0;
}

static int check_babble(const struct config *config, char *error, size_t error_size)
{
    if (config->babble_min.n != config_arm_joints(config)) {
        snprintf(error, error_size, "babble.min must have an entry for each arm joint");
        return -1;
    }
    for (int i = 0; i < config->babble_min.n; i++)
        if (config->babble_min.value[i] < config->arm_min.value[i] ||
            config->babble_max.value[i] > config->arm_max.value[i]) {
            snprintf(error, error_size, "babble range of joint %d is outside arm.min .. arm.max",
                     i + 1);
            return -1;
        }
    return 0;
}

/* Whether the gate (safety.c) would brake at this wanted velocity where slowing down only begins.
 * While a joint slows down, its earlier commands were faster by the exponential. */
static bool gate_is_closer(const struct config *config, double velocity, double acceleration)
{
    double late = config->period + config->safety_latency,
           still = config->period + config->safety_reaction;
    double longest =
        fmax(late * (1 + exp(config->motion_slow_down * late)), config->period + still);

    return longest + velocity / (2 * acceleration) > 1 / config->motion_slow_down;
}

static int check_motion(const struct config *config, char *error, size_t error_size)
{
    const char *wrong = NULL;

    if (config->motion_arm_velocity > config->safety_arm_velocity)
        wrong = "motion.arm_velocity exceeds safety.arm_velocity";
    else if (config->motion_head_velocity > config->safety_head_velocity)
        wrong = "motion.head_velocity exceeds safety.head_velocity";
    else if (config->motion_arm_acceleration > config->safety_arm_acceleration)
        wrong = "motion.arm_acceleration exceeds safety.arm_acceleration";
    else if (config->motion_head_acceleration > config->safety_head_acceleration)
        wrong = "motion.head_acceleration exceeds safety.head_acceleration";
    else if (config->motion_slow_down * config->motion_arm_velocity >
                 config->motion_arm_acceleration ||
             config->motion_slow_down * config->motion_head_velocity >
                 config->motion_head_acceleration)
        wrong = "motion.slow_down times a motion velocity exceeds the motion acceleration: "
                "slowing down before a joint limit could not be followed";
    else if (gate_is_closer(config, config->motion_arm_velocity, config->safety_arm_acceleration) ||
             gate_is_closer(config, config->motion_head_velocity, config->safety_head_acceleration))
        wrong = "motion.slow_down is too great for safety.reaction, latency and acceleration: "
                "the safety gate would have to brake before the motion slows down";
    else if (config->motion_slow_down * config->period > 0.25)
        wrong = "motion.slow_down is too great for the period: at most 0.25 / period";
    else if (config->safety_state_suspend < config->safety_state_hold)
        wrong = "safety.state_suspend is below safety.state_hold";
    else if (config->safety_latency > 0.5 * SAFETY_RECENT * config->period)
        wrong = "safety.latency is more than 32 periods";
    else if (config->safety_loop_stall < STALL_LEAST_PERIODS * config->period - 1e-9)
        wrong =
            "safety.loop_stall is below three periods: the watchdog, which looks once a period, "
            "could not see a standstill";
    else if (config->safety_reaction < config->safety_loop_stall + config->period - 1e-9)
        wrong =
            "safety.reaction is below safety.loop_stall and a period: a joint could pass its limit "
            "before the watchdog acts";
    else if (config->head_search_velocity > config->motion_head_velocity)
        wrong = "head.search_velocity exceeds motion.head_velocity";
    if (wrong)
        snprintf(error, error_size, "%s", wrong);
    return wrong ? -1 : 0;
}

/* What the task space wants. */
static int check_space(const struct config *config, char *error, size_t error_size)
{
    const char *wrong = NULL;

    if (config_head_joints(config) != config->space.n_head)
        wrong = config->space.n_head > 0
                    ? "head.min and head.max must name two joints, yaw and pitch; cameras that "
                      "nobody turns want task.space: fixed"
                    : "head.min and head.max: only the visual task space has a head";
    else if (config->space.kind != SPACE_CARTESIAN && config->eyes_pixels_per_radian < 1)
        wrong = "eyes.pixels_per_radian must be given, 1 or more";
    else if (config->space.kind == SPACE_FIXED && config->learner.features == LEARNER_BODY)
        wrong = "learner.experts must be polynomial or linear where task.space is fixed: no body "
                "is found through cameras that nobody turns";
    else if (config->learner_body_start[0] && config->space.kind != SPACE_CARTESIAN)
        wrong = "learner.body.start helps where task.space is cartesian: eyes see no metres";
    if (wrong)
        snprintf(error, error_size, "%s", wrong);
    return wrong ? -1 : 0;
}

static int check_sizes(const struct config *config, char *error, size_t error_size)
{
    if (config_arm_joints(config) == 0) {
        snprintf(error, error_size, "arm.min and arm.max name no joint");
        return -1;
    }
    if (config_joints(config) > OPTION_MAX_LIST) {
        snprintf(error, error_size, "more than %d joints", OPTION_MAX_LIST);
        return -1;
    }
    if (config->learner_reference.n != config_arm_joints(config)) {
        snprintf(error, error_size, "learner.reference must have an entry for each arm joint");
        return -1;
    }
    if (config->learner_body_order.n != 0 &&
        config->learner_body_order.n != config_arm_joints(config)) {
        snprintf(error, error_size, "learner.body.order must have an entry for each arm joint");
        return -1;
    }
    return 0;
}

static int check_learner(const struct config *config, char *error, size_t error_size)
{
    struct learner_config learner = config_learner(config);
    char reason[256];

    if (learner.capacity > MOST_EXPERTS) {
        snprintf(error, error_size, "learner.capacity is more than the %d that one tick can touch",
                 MOST_EXPERTS);
        return -1;
    }
    if (learner_config_check(&learner, reason, sizeof reason) == 0)
        return 0;
    snprintf(error, error_size, "learner: %s", reason);
    return -1;
}

int config_check(const struct config *config, char *error, size_t error_size)
{
    return check_range("arm", &config->arm_min, &config->arm_max, error, error_size) ||
                   check_range("head", &config->head_min, &config->head_max, error, error_size) ||
                   check_range("babble", &config->babble_min, &config->babble_max, error,
                               error_size) ||
                   check_space(config, error, error_size) ||
                   check_sizes(config, error, error_size) ||
                   check_babble(config, error, error_size) ||
                   check_motion(config, error, error_size) ||
                   check_learner(config, error, error_size)
               ? -1
               : 0;
}
