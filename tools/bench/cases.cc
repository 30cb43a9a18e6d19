#include "tools/bench/cases.h"

#include <climits>
#include <cmath>
#include <stdexcept>

#include "tools/measure/etc_directory.h"
#include "tools/measure/learner_options.h"

namespace
{

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

// A shipped configuration, its outputs in metres, but for `others`.
learner_config shipped(const char *file, int d, std::vector<const char *> others)
{
    others.push_back("psi0=1e-4");
    const learner_sources sources = {LEARNER_IMLE,      d, 3, &file, 1, others.data(),
                                     int(others.size())};
    learner_config config;
    char error[1024];
    if (learner_options_load(&sources, &config, error, sizeof error))
        throw std::runtime_error(error);
    return config;
}

// By evidence one place stays a candidate's, and no model can be filled.
const char *const published = "births=published";

// Experts linear in monomials, each of a tool of its own, as many as the configuration holds.
Case polynomial(const learner_config &config)
{
    static const char *const names[] = {"",        "affine",  "quadratic", "cubic",
                                        "quartic", "quintic", "sextic"};
    Case c{names[config.degree], config.n_inputs, config.capacity, 100000, 60, 0, 0.3, config};
    return c;
}

// So many tools on the arm's own body.
Case on_body(const learner_config &config, int experts)
{
    return {"body", config.n_inputs, experts, 100000, 200, 0, 0.3, config};
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
    char icub[PATH_MAX], kobian[PATH_MAX];
    etc_file("learner-icub.yaml", icub, sizeof icub);
    etc_file("learner-kobian-offline.yaml", kobian, sizeof kobian);
    return {
        linear(7, 40, 0.013, 20000, 0.14),
        linear(7, 130, 0.008, 10000, 0.3),
        linear(7, 280, 0.006, 10000, 1.0, 0.2),
        linear(7, 1000, 0.0038, 5000, 0.3),
        linear(4, 40, 0.010, 20000, 0.14),
        linear(4, 130, 0.005, 10000, 0.3),
        linear(4, 280, 0.003, 10000, 1.0, 0.2),
        linear(4, 1000, 0.002, 10000, 1.0, 0.5),
        polynomial(shipped(icub, 7, {published})),
        polynomial(shipped(icub, 7, {published, "degree=3", "capacity=64"})),
        polynomial(shipped(kobian, 4, {published})),
        on_body(shipped(icub, 7, {"experts=body", "noise_share=0.0025"}), 2),
        on_body(shipped(icub, 7, {"experts=body", "noise_share=0.0025"}), 16),
#ifdef REACH_BENCH_TICK
        tick(1000),
#endif
    };
}
