/* Signs that a learner is in trouble, counted while it learns, and told in one line each.
 *
 * For every program that learns: it is plain data of a fixed size, and health_look(),
 * health_count() and health_judge() allocate nothing, wait for nothing and take a few hundred
 * operations at most, so that a control loop may call them. Only health_tell() writes text. */
#ifndef REACH_LEARNER_HEALTH_H
#define REACH_LEARNER_HEALTH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What can be wrong; each is told in one line. */
enum health_trouble {
    HEALTH_FULL,     /* over 5 % of the samples were dropped since no expert was left */
    HEALTH_OUTLIERS, /* over 5 % of the samples were dropped as outliers */
    HEALTH_FAR,      /* an input was more than HEALTH_MOST_SCALES from its reference */
    HEALTH_CONSTANT, /* an input does not change */
    HEALTH_FROZEN,   /* outputs stood still while inputs moved */
    HEALTH_EXPERTS,  /* more experts than there can be branches */
    HEALTH_TROUBLES
};

/* The Gaussian under the polynomials is 3e-4 there: a sample further off leaves hardly a trace. */
#define HEALTH_MOST_SCALES 4.0

/* Newest samples that a program which runs for long judges by. */
enum { HEALTH_WINDOW = 2000 };

/* One input, over all samples. */
struct health_input {
    double low, high;
    uint64_t far;             /* samples further than HEALTH_MOST_SCALES from its reference */
    double farthest;          /* the value furthest from it */
    uint64_t farthest_sample; /* which sample that was in, from 1 */
};

struct health {
    int n_inputs, n_outputs;
    bool has_scale; /* the learner looks at (z - reference) / scale */
    double reference[LEARNER_MAX_INPUTS], scale[LEARNER_MAX_INPUTS];
    int least_samples;        /* for each expert; 0: a branch may have many experts */
    const char *const *names; /* of the inputs, or NULL */
    uint64_t window;

    uint64_t seen;                            /* samples that were looked at, all */
    uint64_t samples, outliers, full, frozen; /* of the window */
    uint64_t first_frozen;                    /* number of the first frozen sample, from 1 */
    struct health_input input[LEARNER_MAX_INPUTS];

    bool repeats;                     /* the newest outputs are those before */
    double run_z[LEARNER_MAX_INPUTS]; /* inputs with which the present outputs came first */
    double run_x[LEARNER_MAX_OUTPUTS];
    uint64_t changes, runs; /* outputs that differ from those before; repetitions that began */

    uint64_t predictions, solutions; /* of the window */
};

/* Begins with nothing seen. Shares are those of the newest samples, between `window` / 2 and
 * `window` of them; 0: of all. */
void health_init(struct health *health, const struct learner_config *config, uint64_t window);

/* As after health_init(); the configuration and names stay. */
void health_forget(struct health *health);

/* Looks at a sample z[n_inputs] -> x[n_outputs] before it is learned. Returns whether it is sound.
 * It is not when all outputs are bit for bit those of a sample before, no other outputs came
 * between, and an input has moved by more than 1 % of its range since then, as behind a tracker
 * that repeats its last answer. Outputs that repeat by their nature (whole pixels, a function with
 * steps) are sound: they begin to repeat more often than at every tenth change. */
bool health_look(struct health *health, const double *z, const double *x);

/* Counts what became of a sample that was handed to the learner. */
void health_count(struct health *health, enum learner_update_result result);

/* Counts a prediction that the program made anyway. */
void health_count_solutions(struct health *health, int n_solutions);

/* How many scales an input is from its reference; 0 where the learner has no scale. */
double health_scales(const struct health *health, int input, double value);

/* The input that was most scales from its reference: of HEALTH_FAR, else 0. */
int health_farthest(const struct health *health);

/* The troubles now, bit 1 << enum health_trouble each. `experts` and `capacity` are read. */
unsigned health_judge(const struct health *health, const struct learner_statistics *statistics);

/* One line about a trouble that health_judge() found, without a line's end. */
void health_tell(const struct health *health, const struct learner_statistics *statistics,
                 enum health_trouble trouble, char *text, size_t size);

#ifdef __cplusplus
}
#endif
#endif
