#include "daemon/control/behaviours/tour.h"

#include "daemon/control/behaviours/helpers.h"

#include <math.h>
#include <string.h>

/* Long enough for a circle's axis, short enough to stay clear of what stands around. */
static const double turned = 0.45;   /* rad */
static const double differs = 0.035; /* rad, two degrees */

static void set_deadline(struct tour *tour, const struct senses *senses)
{
    tour->deadline = senses->time + (int64_t)(senses->config->babble_timeout * 1e6);
}

static double lowest(const struct config *config, int i)
{
    return config->arm_min.value[i] + config->motion_margin;
}

static double highest(const struct config *config, int i)
{
    return config->arm_max.value[i] - config->motion_margin;
}

/* The joint goes to the side where there is more room. */
static void aim(struct tour *tour, const struct senses *senses)
{
    const struct config *config = senses->config;
    int i = tour->joint;

    memcpy(tour->goal, tour->home, sizeof tour->goal);
    if (i < config_arm_joints(config) && !tour->back) {
        double above = highest(config, i) - tour->home[i];
        double below = tour->home[i] - lowest(config, i);
        tour->goal[i] += above > below ? fmin(turned, above) : -fmin(turned, below);
    }
    set_deadline(tour, senses);
}

static void begin(struct tour *tour, const struct senses *senses)
{
    const struct config *config = senses->config;

    tour->begun = true;
    for (int i = 0; i < config_arm_joints(config); i++)
        tour->home[i] = fmin(fmax(senses->q[i], lowest(config, i)), highest(config, i));
    aim(tour, senses);
}

bool tour_turn_joints(struct tour *tour, const struct senses *senses, struct wants *wants)
{
    int n = config_arm_joints(senses->config);

    if (!tour->begun)
        begin(tour, senses);
    if (tour->joint >= n)
        return false;
    if (!control_arm_to(senses, wants, tour->goal) && senses->time < tour->deadline)
        return true;
    tour->joint += tour->back;
    tour->back = !tour->back;
    aim(tour, senses);
    return tour->joint < n;
}

void tour_visit_postures(struct tour *tour, struct random_state *random,
                         const struct senses *senses, struct wants *wants)
{
    const struct config *config = senses->config;

    if (!control_arm_to(senses, wants, tour->goal) && senses->time < tour->deadline)
        return;
    for (int i = 0; i < config_arm_joints(config); i++)
        tour->goal[i] = random_uniform(random, lowest(config, i), highest(config, i));
    set_deadline(tour, senses);
}

static bool is_near(const double *a, const double *b, int n)
{
    for (int i = 0; i < n; i++)
        if (fabs(a[i] - b[i]) >= differs)
            return false;
    return true;
}

bool tour_counts(struct tour *tour, const struct config *config, const double *q)
{
    int n = config_arm_joints(config);

    for (int k = 0; k < tour->n_counted; k++)
        if (is_near(tour->counted[k], q, n))
            return false;
    memcpy(tour->counted[tour->next_counted], q, (size_t)n * sizeof *q);
    tour->next_counted = (tour->next_counted + 1) % TOUR_COUNTED;
    tour->n_counted += tour->n_counted < TOUR_COUNTED;
    return true;
}
