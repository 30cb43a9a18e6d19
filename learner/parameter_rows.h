/* The learner's parameters as rows of an option table, once for all who read, check or print them:
 * the daemon (daemon/config/table.c), the offline tools (tools/measure/learner_options.c) and the
 * learner's own check (parameters.c). Defaults are those of learner_config_default().
 *
 * X(name, type, field of struct learner_config, minimum, maximum, choices, help)
 *
 * What has a number for each input or output (reference, scale, sigma0, psi0, lwpr.norm_out) is not
 * here: people write it in other units for a robot than for recorded samples. */
#ifndef REACH_LEARNER_PARAMETER_ROWS_H
#define REACH_LEARNER_PARAMETER_ROWS_H

#include <math.h>

#include "common/options/options.h"
#include "learner/learner.h"

#define LEARNER_ROWS(X)                                                                            \
    X("capacity", OPTION_INT, capacity, 1, 65536, NULL,                                            \
      "most experts (LWPR: receptive fields of all outputs together)"),                            \
        X("most_bytes", OPTION_NUMBER, most_bytes, 1, HUGE_VAL, NULL,                              \
          "memory; lowers the capacity to what fits"),                                             \
        X("experts", OPTION_CHOICE, features, 0, 0, "linear|polynomial|body",                      \
          "what an expert is linear in: the inputs (as published), their monomials, or a tip on "  \
          "the body that is found from the samples"),                                              \
        X("degree", OPTION_INT, degree, 1, 6, NULL, "of the polynomial"),                          \
        X("alpha", OPTION_NUMBER, alpha, 0.9, 1, NULL, "forgetting exponent, 1 = none"),           \
        X("hyper_sigma", OPTION_NUMBER, hyper_sigma, 1e-3, HUGE_VAL, NULL,                         \
          "w_sigma, strength of sigma_0"),                                                         \
        X("hyper_psi", OPTION_NUMBER, hyper_psi, 1e-3, HUGE_VAL, NULL,                             \
          "w_psi, strength of Psi_0"),                                                             \
        X("prior_sigma", OPTION_NUMBER, prior_sigma, 1, 1e9, NULL,                                 \
          "w_Sigma, an expert's input prior; at least the number of inputs"),                      \
        X("prior_nu", OPTION_NUMBER, prior_nu, 0, 1e9, NULL, "w_nu, prior on an expert's centre"), \
        X("prior_psi", OPTION_NUMBER, prior_psi, 1e-9, HUGE_VAL, NULL,                             \
          "w_Psi, an expert's noise prior; .inf: Psi_0 always"),                                   \
        X("ridge", OPTION_NUMBER, ridge, 1e-12, 1e9, NULL, "w_Lambda, prior on the slopes"),       \
        X("prior_floor", OPTION_NUMBER, prior_floor, 1e-9, 1, NULL,                                \
          "least share of the priors left by forgetting"),                                         \
        X("n_outliers", OPTION_INT, n_outliers, 0, 1000, NULL,                                     \
          "outliers in a row that are dropped before an expert is born"),                          \
        X("p0", OPTION_NUMBER, p0, 1e-9, 1 - 1e-9, NULL, "outlier probability"),                   \
        X("inherit", OPTION_BOOL, inherit, 0, 0, NULL,                                             \
          "a new expert starts from its parent's slopes"),                                         \
        X("skip", OPTION_NUMBER, skip, 0, 0.1, NULL,                                               \
          "responsibilities under this are not learned"),                                          \
        X("n_solutions_max", OPTION_INT, n_solutions_max, 1, LEARNER_MAX_SOLUTIONS, NULL,          \
          "most solutions of a prediction"),                                                       \
        X("clustering", OPTION_CHOICE, clustering, 0, 0, "published|split|leader",                 \
          "how experts are gathered into solutions"),                                              \
        X("significance", OPTION_NUMBER, significance, 0, 1, NULL,                                 \
          "level of the rules that split"),                                                        \
        X("leader_level", OPTION_NUMBER, leader_level, 0, 1 - 1e-9, NULL,                          \
          "level of the leader rule"),                                                             \
        X("kappa", OPTION_NUMBER, kappa, 0, 4, NULL,                                               \
          "exponent of distance in the rules split and leader"),                                   \
        X("em_pred_iterations", OPTION_INT, em_pred_iterations, 0, 100, NULL,                      \
          "of the rules that split"),                                                              \
        X("noise_share", OPTION_NUMBER, noise_share, 1e-12, 1e6, NULL,                             \
          "variance of the samples' noise, in units of Psi; 1 = as published"),                    \
        X("gamma_floor", OPTION_NUMBER, gamma_floor, 0, 1e6, NULL,                                 \
          "least uncertainty of an expert in an average, 0 = as published"),                       \
        X("average_jacobian", OPTION_BOOL, average_jacobian, 0, 0, NULL,                           \
          "mean of slopes instead of the exact derivative"),                                       \
        X("kernels", OPTION_CHOICE, kernels, 0, 0, "auto|plain|avx2|avx512",                       \
          "vector width; all give the same bits"),                                                 \
        X("body.space", OPTION_CHOICE, body.space, 0, 0, "place|eyes",                             \
          "body: what outputs are, a place in space or yaw, pitch and disparity of a head"),       \
        X("body.degrees", OPTION_BOOL, body.degrees, 0, 0, NULL,                                   \
          "body: yaw and pitch are in degrees instead of radians"),                                \
        X("body.starts", OPTION_INT, body.starts, 1, 10000, NULL,                                  \
          "body: most random starts of one search for a body"),                                    \
        X("lwpr.init_d", OPTION_NUMBER, lwpr.init_d, 1e-6, 1e9, NULL,                              \
          "LWPR: metric of a new receptive field, per square of scale"),                           \
        X("lwpr.diagonal_only", OPTION_BOOL, lwpr.diagonal_only, 0, 0, NULL,                       \
          "LWPR: metrics stay diagonal"),                                                          \
        X("lwpr.init_alpha", OPTION_NUMBER, lwpr.init_alpha, 0, 1e9, NULL,                         \
          "LWPR: learning rate of the metric, 0 = metrics stay as they are born"),                 \
        X("lwpr.penalty", OPTION_NUMBER, lwpr.penalty, 0, 1e9, NULL, "LWPR: on large metrics"),    \
        X("lwpr.w_gen", OPTION_NUMBER, lwpr.w_gen, 1e-9, 0.99, NULL,                               \
          "LWPR: activation under which a sample gets a field of its own"),                        \
        X("lwpr.w_prune", OPTION_NUMBER, lwpr.w_prune, 1e-9, 1, NULL,                              \
          "LWPR: activation of two fields at which one goes; at least w_gen"),                     \
        X("lwpr.cutoff", OPTION_NUMBER, lwpr.cutoff, 1e-12, 0.99, NULL,                            \
          "LWPR: activation under which a field takes no part; at most w_gen"),                    \
        X("lwpr.add_threshold", OPTION_NUMBER, lwpr.add_threshold, 0, 1, NULL,                     \
          "LWPR: share of the error under which a projection is followed by another"),             \
        X("lwpr.max_projections", OPTION_INT, lwpr.max_projections, 1, LEARNER_MAX_INPUTS, NULL,   \
          "LWPR: most projections of a field; at most the number of inputs"),                      \
        X("lwpr.init_lambda", OPTION_NUMBER, lwpr.init_lambda, 0.9, 1, NULL,                       \
          "LWPR: forgetting factor of a new projection, 1 = none"),                                \
        X("lwpr.final_lambda", OPTION_NUMBER, lwpr.final_lambda, 0.9, 1, NULL,                     \
          "LWPR: forgetting factor in the end"),                                                   \
        X("lwpr.tau_lambda", OPTION_NUMBER, lwpr.tau_lambda, 0, 1, NULL,                           \
          "LWPR: how slowly one goes to the other"),                                               \
        X("lwpr.init_s2", OPTION_NUMBER, lwpr.init_s2, 1e-30, 1e9, NULL,                           \
          "LWPR: what a projection's sum of squares begins with")

#endif
