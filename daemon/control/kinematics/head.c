#include "daemon/control/kinematics/head.h"

#include <math.h>

static const double arrived = 0.02; /* rad; a place of the search counts as looked at */

void head_fixate(const struct config *config, const double image[SPACE_DIMENSIONS],
                 double velocity[HEAD_JOINTS])
{
    double turn[SPACE_DIMENSIONS];

    space_to_task(&config->space, image, turn);
    for (int i = 0; i < HEAD_JOINTS; i++)
        velocity[i] = config->head_gain * turn[i];
}

void head_turn(const struct config *config, const double *q, const double *goal,
               double velocity[HEAD_JOINTS])
{
    for (int i = 0; i < HEAD_JOINTS; i++)
        velocity[i] = config->head_gain * (goal[i] - q[i]);
}

void head_search_init(struct head_search *search, int64_t seed)
{
    *search = (struct head_search){.random = random_seed(seed)};
}

void head_search_end(struct head_search *search)
{
    search->active = false;
}

/* A new place to look at, anywhere the neck can turn to. */
static void choose_goal(struct head_search *search, const struct config *config)
{
    for (int i = 0; i < HEAD_JOINTS; i++)
        search->goal[i] =
            random_uniform(&search->random, config->head_min.value[i] + config->motion_margin,
                           config->head_max.value[i] - config->motion_margin);
    search->rest_until = 0;
    search->active = true;
}

static bool at_goal(const struct head_search *search, const double *q)
{
    return fabs(search->goal[0] - q[0]) < arrived && fabs(search->goal[1] - q[1]) < arrived;
}

void head_search_step(struct head_search *search, const struct config *config, int64_t now,
                      const double *q, double velocity[HEAD_JOINTS])
{
    if (!search->active || (search->rest_until && now >= search->rest_until))
        choose_goal(search, config);
    if (!search->rest_until && at_goal(search, q))
        search->rest_until = now + (int64_t)(config->head_search_dwell * 1e6);
    head_turn(config, q, search->goal, velocity);
    for (int i = 0; i < HEAD_JOINTS; i++)
        velocity[i] =
            fmax(-config->head_search_velocity, fmin(config->head_search_velocity, velocity[i]));
}
