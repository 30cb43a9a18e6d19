#include "tools/bench/cases.h"

#include <cmath>

namespace
{

// What one tick may touch: the capacity of richer experts is counted in bytes.
constexpr size_t most_bytes = size_t(16) << 20;

// The published algorithm's parameters; psi0 (as a standard deviation, m) decides how many experts
// a stream needs.
Case linear(int d, int experts, double deviation, int samples_per_tool, double speed,
            double p0 = 0.1)
{
    Case c{"linear", d, experts, 200000, samples_per_tool, 3, speed, learner_config_default(d, 3)};
    c.config.capacity = 1024;
    for (double &psi0 : c.config.psi0)
        psi0 = deviation * deviation;
    for (double &sigma0 : c.config.sigma0)
        sigma0 = 10;
    c.config.hyper_psi = c.config.prior_psi = INFINITY;
    c.config.p0 = p0;
    c.config.hyper_sigma = 2 * d;
    c.config.prior_sigma = std::pow(2, d);
    c.config.significance = 0.95;
    c.config.em_pred_iterations = 10;
    return c;
}

// Experts linear in monomials, each of a tool of its own, as many as the bytes allow.
Case polynomial(const char *kind, int degree)
{
    const double reference[] = {0, 0, 0.17, -0.7, 0.7, 0.7, 0.87};
    Case c{kind, 7, 0, 100000, 60, 0, 0.3, learner_config_default(7, 3)};
    c.config.features = LEARNER_POLYNOMIAL;
    c.config.degree = degree;
    std::copy(std::begin(reference), std::end(reference), c.config.reference);
    for (double &psi0 : c.config.psi0)
        psi0 = 1e-4;
    for (double &sigma0 : c.config.sigma0)
        sigma0 = 10;
    c.config.hyper_psi = c.config.prior_psi = INFINITY;
    c.config.hyper_sigma = 14;
    c.config.prior_sigma = 128;
    c.config.ridge = 0.01;
    c.config.inherit = true;
    c.config.clustering = LEARNER_CLUSTER_LEADER;
    c.config.gamma_floor = 0.05;
    c.config.capacity = 1;
    while (c.config.capacity < 1024) {
        c.config.capacity++;
        if (learner_memory(&c.config) > most_bytes) {
            c.config.capacity--;
            break;
        }
    }
    c.experts = c.config.capacity;
    return c;
}

#ifdef REACH_BENCH_TICK
// The whole control step; its stream is its own, see tick.c.
Case tick(int experts)
{
    Case c = linear(4, experts, 0.01, 0, 0);
    c.kind = "tick";
    return c;
}
#endif

} // namespace

std::vector<Case> all_cases()
{
    return {
        linear(7, 40, 0.013, 20000, 0.14),
        linear(7, 130, 0.008, 10000, 0.3),
        linear(7, 280, 0.006, 10000, 1.0, 0.2),
        linear(7, 1000, 0.0038, 5000, 0.3),
        linear(4, 40, 0.010, 20000, 0.14),
        linear(4, 130, 0.005, 10000, 0.3),
        linear(4, 280, 0.003, 10000, 1.0, 0.2),
        linear(4, 1000, 0.0015, 5000, 1.0),
        polynomial("cubic", 3),
        polynomial("quartic", 4),
#ifdef REACH_BENCH_TICK
        tick(1000),
#endif
    };
}
