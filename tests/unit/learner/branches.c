#include <math.h>

#include "branches.h"

enum { QUERIES = 200 };

struct learner_config branches_cubic(int capacity)
{
    struct learner_config config = learner_config_default(BRANCHES_INPUTS, BRANCHES_OUTPUTS);

    config.features = LEARNER_POLYNOMIAL;
    config.capacity = capacity;
    config.clustering = LEARNER_CLUSTER_LEADER;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = 1e-5;
    config.noise_share = 1e-3;
    config.gamma_floor = 0.05;
    config.inherit = true;
    config.births = LEARNER_BIRTHS_EVIDENCE;
    config.n_outliers = BRANCHES_OUTLIERS;
    for (int i = 0; i < BRANCHES_OUTPUTS; i++)
        config.psi0[i] = branches_tolerance * branches_tolerance;
    for (int i = 0; i < BRANCHES_INPUTS; i++) {
        config.sigma0[i] = 10.0;
        config.scale[i] = 1.5;
    }
    return config;
}

void branches_draw(double *z)
{
    for (int i = 0; i < BRANCHES_INPUTS; i++)
        z[i] = bed_uniform(-0.7, 0.7);
}

void branches_value_at(const double *z, double branch, double *x)
{
    for (int i = 0; i < BRANCHES_OUTPUTS; i++)
        x[i] = 0.4 * sin(z[i] + 0.5 * z[i + 1]) + branches_step * branch;
}

void branches_teach(struct learner *learner, int n, double branch, int *counts)
{
    for (int k = 0; k < n; k++) {
        double z[BRANCHES_INPUTS], x[BRANCHES_OUTPUTS];
        branches_draw(z);
        branches_value_at(z, branch, x);
        for (int i = 0; i < BRANCHES_OUTPUTS; i++)
            x[i] += 5e-4 * bed_normal();
        enum learner_update_result result = learner_update(learner, z, x);
        if (counts)
            counts[result]++;
    }
}

int branches_experts(const struct learner *learner)
{
    return learner_get_statistics(learner).experts;
}

double branches_error_of(struct learner *learner, double branch)
{
    static double queries[QUERIES][BRANCHES_INPUTS];
    static bool drawn;
    double sum = 0.0;

    for (int k = 0; k < QUERIES && !drawn; k++)
        branches_draw(queries[k]);
    drawn = true;
    for (int k = 0; k < QUERIES; k++) {
        double x[BRANCHES_OUTPUTS];
        branches_value_at(queries[k], branch, x);
        sum += bed_square_off(learner, queries[k], x, BRANCHES_OUTPUTS);
    }
    return sqrt(sum / QUERIES);
}
