#include "daemon/control/behaviours/tour.h"

#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/imagine.h"

#include <math.h>
#include <string.h>

/* Long enough for a circle's axis, short enough to stay clear of what stands around. */
static const double turned = 0.45;   /* rad */
static const double differs = 0.035; /* rad, two degrees */
static const int postures = 12;      /* of which one is chosen; a fraction of a millisecond */

static void set_deadline(struct tour *tour, const struct senses *senses)
{
    tour->deadline = senses->time + (int64_t)(senses->config->babble_timeout * 1e6);
}

bool tour_shows_body(const struct config *config)
{
    return config->learner.features == LEARNER_BODY && !config->space.fixates;
}

void tour_init(struct tour *tour, const struct senses *senses, const double *low,
               const double *high)
{
    int n = config_arm_joints(senses->config);

    memset(tour, 0, sizeof *tour);
    memcpy(tour->low, low, (size_t)n * sizeof *low);
    memcpy(tour->high, high, (size_t)n * sizeof *high);
    if (!learner_body(senses->learner))
        return;
    tour->begun = true;
    tour->joint = n;
}

/* The joint goes to the side where there is more room. */
static void aim(struct tour *tour, const struct senses *senses)
{
    const struct config *config = senses->config;
    int i = tour->joint;

    memcpy(tour->goal, tour->home, sizeof tour->goal);
    if (i < config_arm_joints(config) && !tour->back) {
        double above = tour->high[i] - tour->home[i];
        double below = tour->home[i] - tour->low[i];
        tour->goal[i] += above > below ? fmin(turned, above) : -fmin(turned, below);
    }
    set_deadline(tour, senses);
}

static void begin(struct tour *tour, const struct senses *senses)
{
    const struct config *config = senses->config;

    tour->begun = true;
    for (int i = 0; i < config_arm_joints(config); i++)
        tour->home[i] = fmin(fmax(senses->q[i], tour->low[i]), tour->high[i]);
    aim(tour, senses);
}

int tour_ticks(const struct config *config)
{
    double there_and_back = 2 * turned / config->motion_arm_velocity;

    return (int)(config_arm_joints(config) * there_and_back / config->period);
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

/* How unsure the model is of the place at q: variance, scaled; 0 when it has nothing to say. */
static double doubt_at(const double *q, const struct senses *senses)
{
    const struct learner_solution *solution = imagine_solution(senses, q);
    double doubt = 0;

    for (int row = 0; solution && row < SPACE_DIMENSIONS; row++) {
        double scale = senses->config->space.scale[row];
        doubt += solution->variance[row] / (scale * scale);
    }
    return doubt;
}

/* Of some random postures the one that tells most. */
static void choose_posture(struct tour *tour, struct random_state *random,
                           const struct senses *senses)
{
    double most = -1;

    for (int k = 0; k < postures; k++) {
        double q[MAX_JOINTS] = {0};
        for (int i = 0; i < config_arm_joints(senses->config); i++)
            q[i] = random_uniform(random, tour->low[i], tour->high[i]);
        double doubt = doubt_at(q, senses);
        if (doubt <= most)
            continue;
        most = doubt;
        memcpy(tour->goal, q, sizeof tour->goal);
    }
}

void tour_visit_postures(struct tour *tour, struct random_state *random,
                         const struct senses *senses, struct wants *wants)
{
    if (!control_arm_to(senses, wants, tour->goal) && senses->time < tour->deadline)
        return;
    choose_posture(tour, random, senses);
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
