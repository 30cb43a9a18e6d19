/* The learner's parameters as rows of an option table, once for all who read, check or print them:
 * the daemon (daemon/config/table.c), the offline tools (tools/measure/learner_options.c) and the
 * learner's own check (parameters.c). Defaults are those of learner_config_default().
 *
 * X(name, type, field of struct learner_config, minimum, maximum, choices, help)
 *
 * What has a number for each input or output (reference, scale, sigma0, psi0, lwpr.norm_out) is not
 * here: people write it in other units for a robot than for recorded samples. */
#ifndef REACH_LEARNER_PARAMETERS_ROWS_H
#define REACH_LEARNER_PARAMETERS_ROWS_H

#include <math.h>

#include "common/options/options.h"
#include "learner/learner.h"

#define LEARNER_ROWS(X)                                                                            \
    X("capacity", OPTION_INT, capacity, 1, 65536, NULL,                                            \
      "greatest number of experts (LWPR: of receptive fields of all outputs together)"),           \
        X("most_bytes", OPTION_NUMBER, most_bytes, 1, HUGE_VAL, NULL,                              \
          "greatest memory of the learner in bytes; lowers the capacity to what fits"),            \
        X("experts", OPTION_CHOICE, features, 0, 0, "linear|polynomial|body",                      \
          "what an expert is linear in: linear = the inputs (as published), polynomial = their "   \
          "monomials, body = a tip on the body that is found from the samples"),                   \
        X("degree", OPTION_INT, degree, 1, 6, NULL,                                                \
          "greatest degree of the monomials when experts is polynomial"),                          \
        X("alpha", OPTION_NUMBER, alpha, 0.9, 1, NULL,                                             \
          "forgetting exponent of the experts; 1 = nothing is forgotten"),                         \
        X("hyper_sigma", OPTION_NUMBER, hyper_sigma, 1e-3, HUGE_VAL, NULL,                         \
          "w_sigma: strength of sigma_0 in the estimate of the input variances that experts "      \
          "share"),                                                                                \
        X("hyper_psi", OPTION_NUMBER, hyper_psi, 1e-3, HUGE_VAL, NULL,                             \
          "w_psi: strength of Psi_0 in the estimate of the output variances that experts share"),  \
        X("prior_sigma", OPTION_NUMBER, prior_sigma, 1, 1e9, NULL,                                 \
          "w_Sigma: strength of the prior on an expert's input covariance; at least the number "   \
          "of inputs"),                                                                            \
        X("prior_nu", OPTION_NUMBER, prior_nu, 0, 1e9, NULL,                                       \
          "w_nu: strength of the prior on an expert's centre"),                                    \
        X("prior_psi", OPTION_NUMBER, prior_psi, 1e-9, HUGE_VAL, NULL,                             \
          "w_Psi: strength of the prior on an expert's output noise; .inf = the noise is "         \
          "always Psi_0"),                                                                         \
        X("ridge", OPTION_NUMBER, ridge, 1e-12, 1e9, NULL,                                         \
          "w_Lambda: strength of the prior on an expert's slopes"),                                \
        X("prior_floor", OPTION_NUMBER, prior_floor, 1e-9, 1, NULL,                                \
          "least share of their initial strength that the priors keep when old samples are "       \
          "forgotten"),                                                                            \
        X("births", OPTION_CHOICE, births, 0, 0, "auto|published|evidence",                        \
          "when samples that fit nothing make a new expert: published = after n_outliers, "        \
          "evidence = when a candidate has learned several of them; auto = evidence, but "         \
          "published for linear experts"),                                                         \
        X("n_outliers", OPTION_INT, n_outliers, 0, 1000, NULL,                                     \
          "number of outliers in a row that make no new expert; the next one does"),               \
        X("p0", OPTION_NUMBER, p0, 1e-9, 1 - 1e-9, NULL,                                           \
          "outlier probability; with a smaller one a sample must be further off to make a new "    \
          "expert"),                                                                               \
        X("inherit", OPTION_BOOL, inherit, 0, 0, NULL,                                             \
          "true = a new expert starts from the slopes of its parent"),                             \
        X("skip", OPTION_NUMBER, skip, 0, 0.1, NULL,                                               \
          "an expert does not learn a sample for which its responsibility is below this"),         \
        X("n_solutions_max", OPTION_INT, n_solutions_max, 1, LEARNER_MAX_SOLUTIONS, NULL,          \
          "greatest number of solutions that a prediction returns"),                               \
        X("clustering", OPTION_CHOICE, clustering, 0, 0, "published|split|leader",                 \
          "rule that gathers the answers of experts into solutions"),                              \
        X("significance", OPTION_NUMBER, significance, 0, 1, NULL,                                 \
          "level of the chi-square test in the clustering rules published and split"),             \
        X("leader_level", OPTION_NUMBER, leader_level, 0, 1 - 1e-9, NULL,                          \
          "level of the test in the clustering rule leader"),                                      \
        X("kappa", OPTION_NUMBER, kappa, 0, 4, NULL,                                               \
          "exponent of an expert's distance to the query in the clustering rules split and "       \
          "leader"),                                                                               \
        X("em_pred_iterations", OPTION_INT, em_pred_iterations, 0, 100, NULL,                      \
          "number of EM iterations in the clustering rules published and split"),                  \
        X("noise_share", OPTION_NUMBER, noise_share, 1e-12, 1e6, NULL,                             \
          "variance of the samples' noise as a share of Psi; 1 = as published"),                   \
        X("gamma_floor", OPTION_NUMBER, gamma_floor, 0, 1e6, NULL,                                 \
          "least uncertainty of an expert when answers are averaged; 0 = as published"),           \
        X("average_jacobian", OPTION_BOOL, average_jacobian, 0, 0, NULL,                           \
          "Jacobian of a solution: true = mean of the experts' slopes, false = exact "             \
          "derivative of the prediction"),                                                         \
        X("kernels", OPTION_CHOICE, kernels, 0, 0, "auto|plain|avx2|avx512",                       \
          "vector instructions of the inner loops; auto = widest of this machine; all give the "   \
          "same bits"),                                                                            \
        X("body.space", OPTION_CHOICE, body.space, 0, 0, "place|eyes",                             \
          "body: what outputs are, a place in space or yaw, pitch and disparity of a head"),       \
        X("body.degrees", OPTION_BOOL, body.degrees, 0, 0, NULL,                                   \
          "body: yaw and pitch are in degrees instead of radians"),                                \
        X("body.starts", OPTION_INT, body.starts, 1, 10000, NULL,                                  \
          "body: most random starts of one search for a body"),                                    \
        X("body.noise_share", OPTION_NUMBER, body.noise_share, 0, 1e6, NULL,                       \
          "body: variance of the samples' noise as a share of Psi_0; 0 = noise_share"),            \
        X("lwpr.init_d", OPTION_NUMBER, lwpr.init_d, 1e-6, 1e9, NULL,                              \
          "LWPR: diagonal of the metric of a new receptive field, for inputs in units of scale"),  \
        X("lwpr.diagonal_only", OPTION_BOOL, lwpr.diagonal_only, 0, 0, NULL,                       \
          "LWPR: true = metrics stay diagonal, false = metrics are full matrices"),                \
        X("lwpr.init_alpha", OPTION_NUMBER, lwpr.init_alpha, 0, 1e9, NULL,                         \
          "LWPR: learning rate of the metrics; 0 = each receptive field keeps its first metric"),  \
        X("lwpr.penalty", OPTION_NUMBER, lwpr.penalty, 0, 1e9, NULL,                               \
          "LWPR: weight of the penalty on large metrics"),                                         \
        X("lwpr.w_gen", OPTION_NUMBER, lwpr.w_gen, 1e-9, 0.99, NULL,                               \
          "LWPR: a sample that activates no receptive field this much makes a new one"),           \
        X("lwpr.w_prune", OPTION_NUMBER, lwpr.w_prune, 1e-9, 1, NULL,                              \
          "LWPR: a sample that activates two receptive fields this much removes one; at least "    \
          "w_gen"),                                                                                \
        X("lwpr.cutoff", OPTION_NUMBER, lwpr.cutoff, 1e-12, 0.99, NULL,                            \
          "LWPR: a receptive field activated less than this takes no part; at most w_gen"),        \
        X("lwpr.add_threshold", OPTION_NUMBER, lwpr.add_threshold, 0, 1, NULL,                     \
          "LWPR: a projection that leaves less than this share of the error is followed by "       \
          "another"),                                                                              \
        X("lwpr.max_projections", OPTION_INT, lwpr.max_projections, 1, LEARNER_MAX_INPUTS, NULL,   \
          "LWPR: greatest number of projections of a receptive field; at most the number of "      \
          "inputs"),                                                                               \
        X("lwpr.init_lambda", OPTION_NUMBER, lwpr.init_lambda, 0.9, 1, NULL,                       \
          "LWPR: forgetting factor of a new projection; 1 = nothing is forgotten"),                \
        X("lwpr.final_lambda", OPTION_NUMBER, lwpr.final_lambda, 0.9, 1, NULL,                     \
          "LWPR: forgetting factor that a projection approaches; 1 = nothing is forgotten"),       \
        X("lwpr.tau_lambda", OPTION_NUMBER, lwpr.tau_lambda, 0, 1, NULL,                           \
          "LWPR: share of the way to final_lambda that is still left after each sample"),          \
        X("lwpr.init_s2", OPTION_NUMBER, lwpr.init_s2, 1e-30, 1e9, NULL,                           \
          "LWPR: initial value of a projection's sum of squares")

#endif
