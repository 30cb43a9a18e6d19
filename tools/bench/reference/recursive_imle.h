/* The published mixture as its authors program it: every inverse is carried along by rank-1 updates
 * (Sherman and Morrison), every expert takes part in every step, and nothing is cached that the
 * formulas do not ask for. It computes what TextbookImle computes, some ten times as fast, and is
 * what the benches compare the daemon's learner with: a plain program, but not a straw man. A test
 * holds it against TextbookImle. It shares no code with the daemon.
 *
 * With `skip` 0 every expert is updated with every sample, as published; a positive one leaves out
 * those that take less of it.
 *
 * Left out: a prior on the centre (w_nu is 0), and the floor of the priors (they fade by a few per
 * cent only while alpha is near 1). */
#ifndef REACH_TOOLS_BENCH_REFERENCE_RECURSIVE_IMLE_H
#define REACH_TOOLS_BENCH_REFERENCE_RECURSIVE_IMLE_H

#include <cstddef>
#include <vector>

#include "tools/bench/reference/textbook_imle.h"

namespace oracle
{

class RecursiveImle
{
public:
    explicit RecursiveImle(const Parameters &parameters);

    Result update(const double *z, const double *x);
    /* Strongest first; valid until the next call. */
    const std::vector<Solution> &predict(const double *z);
    int experts() const
    {
        return static_cast<int>(experts_.size());
    }
    /* Experts whose responsibility for the last sample was above 1e-6. */
    int concerned() const
    {
        return concerned_;
    }

private:
    using Numbers = std::vector<double>;

    struct Expert {
        double H, S_h, w_Sigma, w_Psi;
        double log_det_N_inverse;
        double log_det_at_birth; /* of Sigma^-1, before the first sample is learned */
        Numbers nu, mu;          /* w_nu = 0: also the means of its samples */
        Numbers Lambda;          /* D x d */
        Numbers C_inverse;       /* d x d, C_zz^-1 */
        Numbers N_inverse;       /* d x d, N = Sigma's numerator */
        Numbers ssr, Psi;
    };
    struct Answer {
        double t, gamma, q, kappa_factor;
        int cluster;
    };

    double sigma_divisor(const Expert &e) const;
    double log_t(const Expert &e, double q, double *dof, double *a) const;
    void give_birth(const double *z, const double *x);
    double joint_density(const Expert &e, const double *z, const double *x);
    double responsibility(const Expert &e, const double *z, const double *x);
    void learn(Expert &e, double h, const double *z, const double *x);
    void update_noise(Expert &e) const;
    void update_priors();
    double outlier_input() const;
    double outlier_joint() const;

    double answer_of(size_t j, const double *z);
    void answer_all(const double *z);
    double deviation(size_t j, const double *center) const;
    void move_center(size_t k, const double *probability);
    double level(int cluster) const;
    size_t farthest(int cluster, const double *x) const;
    void em_iteration();
    bool assign();
    int cluster();
    Solution fuse(int cluster) const;
    void add_jacobian(size_t j, double W, const Numbers &dW, const Numbers &precision,
                      Solution &s) const;

    Parameters p_;
    size_t d_, D_;
    double c_input_, c_joint_;
    std::vector<Expert> experts_;
    Numbers sigma_bar_, psi_bar_;
    int outliers_in_row_ = 0;
    int concerned_ = 0;

    /* of one call */
    Numbers dz_, v_, dx_, k_, h_;
    std::vector<Answer> answers_;
    Numbers xhat_;      /* M x D */
    Numbers R_inverse_; /* M x D */
    Numbers precision_; /* M x d: Sigma^-1 (z - nu) */
    Numbers dgamma_;    /* M x d */
    Numbers centers_;   /* clusters x D */
    Numbers probability_;
    std::vector<Solution> solutions_;
};

} /* namespace oracle */

#endif
