#include "daemon/control/behaviours/imagine.h"

#include "daemon/control/behaviours/helpers.h"

#include <math.h>
#include <string.h>

static const int steps_a_tick = 40; /* some half a millisecond on a body */
static const int steps_most = 80;   /* of one attempt */
static const int attempts_most = 100;
static const double period = 0.2; /* of an imagined step, s */
static const double near = 0.02;  /* the target, scaled */

void imagine_begin(struct imagine *imagine, const double *target, const struct senses *senses)
{
    imagine->random = random_seed(senses->now);
    memcpy(imagine->target, target, sizeof imagine->target);
    imagine->attempt = imagine->step = 0;
    memcpy(imagine->q, senses->q, sizeof imagine->q);
}

static void attempt_again(struct imagine *imagine, const struct config *config)
{
    imagine->attempt++;
    imagine->step = 0;
    for (int i = 0; i < config_arm_joints(config); i++)
        imagine->q[i] =
            random_uniform(&imagine->random, config->arm_min.value[i], config->arm_max.value[i]);
}

void imagine_detour(struct imagine *imagine, const double *target, const struct senses *senses)
{
    imagine_begin(imagine, target, senses);
    attempt_again(imagine, senses->config);
}

const struct learner_solution *imagine_solution(const struct senses *senses, const double *q)
{
    const struct estimate *estimate = senses->estimate;
    struct learner_prediction *imagined = senses->imagined;

    if (estimate->solution < 0 || learner_predict(senses->learner, q, imagined) == 0)
        return NULL;
    int principal = estimate->prediction.solution[estimate->solution].principal;
    for (int k = 0; k < imagined->n_solutions; k++)
        if (imagined->solution[k].principal == principal)
            return &imagined->solution[k];
    return NULL;
}

/* Moves the imagined joints towards the target; returns the distance before that, scaled, or
 * INFINITY when the model has nothing to say. */
static double move_on(struct imagine *imagine, const struct senses *senses)
{
    const struct config *config = senses->config;
    const struct learner_solution *solution = imagine_solution(senses, imagine->q);
    double left[SPACE_DIMENSIONS], x_velocity[SPACE_DIMENSIONS];
    double velocity[MAX_JOINTS] = {0}, middle[MAX_JOINTS], sum = 0;

    if (!solution)
        return INFINITY;
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        left[row] = imagine->target[row] - solution->value[row];
        x_velocity[row] = config->task_gain * left[row];
        double scaled = left[row] / config->space.scale[row];
        sum += scaled * scaled;
    }
    for (int i = 0; i < config_arm_joints(config); i++)
        middle[i] = 0.5 * (config->arm_min.value[i] + config->arm_max.value[i]);
    control_joint_velocity(config, imagine->q, solution->jacobian, x_velocity, middle,
                           config->task_secondary_gain, velocity);
    for (int i = 0; i < config_arm_joints(config); i++)
        imagine->q[i] += period * velocity[i];
    return sqrt(sum);
}

enum imagined imagine_go_on(struct imagine *imagine, const struct senses *senses)
{
    for (int k = 0; k < steps_a_tick; k++) {
        double distance = move_on(imagine, senses);
        if (distance < near)
            return imagine->attempt == 0 ? IMAGINED_STRAIGHT : IMAGINED_BY_JOINTS;
        if (++imagine->step < steps_most && distance < INFINITY)
            continue;
        if (imagine->attempt == attempts_most || !(distance < INFINITY))
            return IMAGINED_NOTHING;
        attempt_again(imagine, senses->config);
    }
    return IMAGINED_NOT_YET;
}
