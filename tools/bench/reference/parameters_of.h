/* The learner's configuration, in the oracle's words. */
#ifndef REACH_TOOLS_BENCH_REFERENCE_PARAMETERS_OF_H
#define REACH_TOOLS_BENCH_REFERENCE_PARAMETERS_OF_H

#include "learner/learner.h"
#include "tools/bench/reference/textbook_imle.h"

namespace oracle
{

inline Parameters parameters_of(const learner_config &c)
{
    Parameters p;
    p.d = c.n_inputs;
    p.D = c.n_outputs;
    p.psi0 = Eigen::Map<const Eigen::VectorXd>(c.psi0, c.n_outputs);
    p.sigma0 = Eigen::Map<const Eigen::VectorXd>(c.sigma0, c.n_inputs);
    p.alpha = c.alpha;
    p.w_sigma = c.hyper_sigma;
    p.w_psi = c.hyper_psi;
    p.w_Sigma = c.prior_sigma;
    p.w_nu = c.prior_nu;
    p.w_Psi = c.prior_psi;
    p.w_Lambda = c.ridge;
    p.floor = c.prior_floor;
    p.skip = c.skip;
    p.n_outliers = c.n_outliers;
    p.p0 = c.p0;
    p.significance = c.significance;
    p.n_solutions_max = c.n_solutions_max;
    p.em_pred_iterations = c.em_pred_iterations;
    return p;
}

} // namespace oracle
#endif
