/* The learner's parameters as rows of an option table, with the arrays that have a number for each
 * input or output, in YAML without a prefix: "degree: 4", "psi0: [1e-4, 1e-4, 9]". For programs
 * that know no robot: reach-eval, reach-learner. Such a program's own struct begins with a struct
 * learner_options, and its table with LEARNER_OPTION_ROWS. */
#ifndef REACH_LEARNER_PARAMETERS_YAML_H
#define REACH_LEARNER_PARAMETERS_YAML_H

#include <stddef.h>

#include "learner/learner.h"
#include "learner/parameters/rows.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the rows fill: the configuration, and arrays as people write them. */
struct learner_options {
    struct learner_config config;
    struct option_list reference, scale, psi0, sigma0, norm_out;
};

#define LEARNER_OPTION_SHARED(name, type, field, minimum, maximum, choices, help)                  \
    {                                                                                              \
        name, type, offsetof(struct learner_options, config.field), NULL, option_preset, minimum,  \
            maximum, help, choices                                                                 \
    }
#define LEARNER_OPTION_SPREAD(name, list, help)                                                    \
    {                                                                                              \
        name, OPTION_SPREAD, offsetof(struct learner_options, list), NULL, option_preset, 0, 0,    \
            help, NULL                                                                             \
    }
#define LEARNER_OPTION_ROWS                                                                        \
    LEARNER_ROWS(LEARNER_OPTION_SHARED),                                                           \
        LEARNER_OPTION_SPREAD("reference", reference,                                              \
                              "c: middle of each input's range, where polynomials are centred"),   \
        LEARNER_OPTION_SPREAD("scale", scale,                                                      \
                              "s: unit of each input in the polynomials and in LWPR's metric"),    \
        LEARNER_OPTION_SPREAD(                                                                     \
            "psi0", psi0,                                                                          \
            "Psi_0: variance of each output about an expert's prediction (unit squared)"),         \
        LEARNER_OPTION_SPREAD(                                                                     \
            "sigma0", sigma0,                                                                      \
            "sigma_0: variance of each input that a new expert covers (unit squared)"),            \
        LEARNER_OPTION_SPREAD("lwpr.norm_out", norm_out,                                           \
                              "LWPR: unit of each output in the cost that adapts the metric")

/* What holds where nobody says otherwise: learner_config_default(). Psi_0 and sigma_0 have no
 * default (an empty list), except for a learner that does not use them. */
struct learner_options learner_options_default(enum learner_kind kind, int n_inputs, int n_outputs);

/* After the rows were read: brings the arrays into the configuration and checks all of it.
 *   returns 0, or -1 with a reason in `error` that names the row */
int learner_options_finish(struct learner_options *options, char *error, size_t error_size);

/* Where the numbers of an OPTION_SPREAD row live in a configuration, and how many there are. */
double *learner_options_array(const struct option_row *row, struct learner_config *config, int *n);

#ifdef __cplusplus
}
#endif
#endif
