/* The learner: a map from joints z to task position x that may have several
 * values (one for each tool met), learned one sample at a time.
 *
 * Units are the caller's (radians in; radians, metres or pixels out). All
 * variances are squares of those units. All memory comes from an arena at
 * creation; no other call allocates, locks, or does input or output. A learner
 * is used by one thread at a time. The same samples in the same order give the
 * same bytes. Formulas: docs/learner.md.
 */
#ifndef REACH_LEARNER_LEARNER_H
#define REACH_LEARNER_LEARNER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/base/arena.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LEARNER_MAX_INPUTS 16
#define LEARNER_MAX_OUTPUTS 8
#define LEARNER_MAX_SOLUTIONS 16
/* Inputs and outputs beyond this are refused, so that their squares can be computed with. */
#define LEARNER_LARGEST_NUMBER 1e9

enum learner_kind {
    LEARNER_IMLE, /* infinite mixture of experts linear in features */
    LEARNER_LWPR, /* locally weighted projection regression: one value everywhere */
};

/* What an expert is linear in. */
enum learner_features {
    LEARNER_LINEAR,     /* the inputs themselves: the published algorithm */
    LEARNER_POLYNOMIAL, /* monomials up to `degree` under a Gaussian: a truncated kernel */
    LEARNER_BODY,       /* polynomial until a body is given, a few numbers on that body then */
};

/* When samples that no expert explains make a new one. */
enum learner_births {
    LEARNER_BIRTHS_AUTO, /* by evidence, but for linear experts, which are local: as published */
    LEARNER_BIRTHS_PUBLISHED, /* at once after `n_outliers`; experts stay for good */
    LEARNER_BIRTHS_EVIDENCE,  /* of a candidate that has learned and foretold several */
};

/* How experts are gathered into solutions. */
enum learner_clustering {
    LEARNER_CLUSTER_PUBLISHED, /* split while a chi-square test refuses */
    LEARNER_CLUSTER_SPLIT,     /* the same with variances free of t_j/W */
    LEARNER_CLUSTER_LEADER,    /* one pass, in order of precision */
};

/* Vector width of the inner loops. All give the same bits. */
enum learner_kernels {
    LEARNER_KERNELS_AUTO,  /* the widest that the machine has */
    LEARNER_KERNELS_PLAIN, /* what every machine has */
    LEARNER_KERNELS_AVX2,
    LEARNER_KERNELS_AVX512,
};

/* Parameters of LEARNER_LWPR alone, by their published names. The metric is
 * that of inputs in units of `scale`. docs/lwpr.md. */
struct learner_lwpr_config {
    double init_d;        /* diagonal of a new field's metric D, > 0; 10 */
    bool diagonal_only;   /* D stays diagonal; true */
    double init_alpha;    /* learning rate of the metric, >= 0 (D stays); 50 */
    double penalty;       /* on large metrics, >= 0; 1e-6 */
    double w_gen;         /* a sample that activates no field as much gets one, 0 .. 1; 0.1 */
    double w_prune;       /* a sample that activates two this much removes one, w_gen .. 1; 0.9 */
    double cutoff;        /* activation under which a field takes no part, 0 .. w_gen; 0.001 */
    double add_threshold; /* a projection that leaves less than this share of the error is
                             followed by another, 0 .. 1; 0.5 */
    int max_projections;  /* of a field, 1 .. n_inputs; n_inputs */
    double init_lambda;   /* forgetting factor of a new projection, 1 - 1 / (3 n_inputs) .. 1 and
                             >= 0.9; 0.999 */
    double final_lambda;  /* what it goes to, the same range; 0.99999 */
    double tau_lambda;    /* how slowly, 0 .. 1; 0.9999 */
    double init_s2;       /* what a projection's sum of squares begins with, > 0; 1e-10 */
    double norm_out[LEARNER_MAX_OUTPUTS]; /* unit of an output, > 0; 1 */
};

/* What outputs are, to a learner with LEARNER_BODY. */
enum learner_body_space {
    LEARNER_BODY_PLACE, /* a place in space, all in one unit */
    LEARNER_BODY_EYES,  /* yaw, pitch and disparity of a head that fixates (paper, eq. 10 to 12) */
};

/* Parameters of LEARNER_BODY alone: what the finder of the body is told. docs/body.md. */
struct learner_body_config {
    enum learner_body_space space; /* LEARNER_BODY_PLACE */
    bool degrees;                  /* yaw and pitch are in degrees; false */
    int starts;                    /* most random starts of one search, >= 1; 40 */
    /* Which input each joint is, from the base to the tip, counted from 0; 0, 1, 2, ... */
    int order[LEARNER_MAX_INPUTS];
    double noise_share; /* variance of the samples' noise in units of psi0, which the
                           search reckons with; 0 = noise_share below */
    /* Of each input what the robot may use, rad: a body is to be sure there. low >= high: not
     * known; 0, 0 */
    double low[LEARNER_MAX_INPUTS], high[LEARNER_MAX_INPUTS];
};

/* Every parameter. learner_config_default() fills all rows but psi0 and
 * sigma0, which must be given (LEARNER_LWPR does without). The symbol is that of the algorithm's
 * paper. */
struct learner_config {
    enum learner_kind kind; /* LEARNER_IMLE */
    int n_inputs;           /* d, 1 .. LEARNER_MAX_INPUTS */
    int n_outputs;          /* D, 1 .. LEARNER_MAX_OUTPUTS */
    double most_bytes;      /* the learner's memory, lowers the capacity to what fits (one at
                               least); INFINITY. One tick can touch some 16 MB */
    int capacity;           /* most experts (or receptive fields, of all outputs together),
                               >= 1; default 256 */

    enum learner_features features;       /* LEARNER_LINEAR */
    int degree;                           /* of the polynomial, 1 .. 6; 3 */
    double reference[LEARNER_MAX_INPUTS]; /* c, middle of the range; 0 */
    double scale[LEARNER_MAX_INPUTS];     /* s, > 0, features see (z-c)/s: the kernel's width; 1 */

    double psi0[LEARNER_MAX_OUTPUTS];  /* Psi0, VARIANCE of an output, > 0 */
    double sigma0[LEARNER_MAX_INPUTS]; /* VARIANCE of an expert's inputs, > 0 */
    double alpha;                      /* forgetting exponent, 0.9 .. 1 (none); 0.999 */
    double hyper_sigma;                /* w_sigma, strength of sigma0, or INFINITY; 2^d */
    double hyper_psi;                  /* w_psi, strength of psi0, or INFINITY; 2 D */
    double prior_sigma;                /* w_Sigma, an expert's input prior, >= d; 2^d */
    double prior_nu;                   /* w_nu, prior on an expert's centre, >= 0; 0 */
    double prior_psi;                  /* w_Psi, an expert's noise prior, or INFINITY; 2^d */
    double ridge;                      /* w_Lambda, prior on the slopes, > 0; 0.1 */
    double prior_floor;                /* least share of the last four left by forgetting;
                                          0.01 (prior_sigma also never under d) */

    enum learner_births births; /* LEARNER_BIRTHS_AUTO */
    int n_outliers;             /* outliers in a row that make no expert yet, >= 0; 1 */
    double p0;                  /* outlier probability, 0 .. 1; 0.1 */
    bool inherit;               /* a newborn starts from its parent's slopes; false */
    double skip;                /* responsibilities under this are not learned, 0 .. 0.1;
                                   an expert misses less than this a sample; 1e-6 */

    int n_solutions_max;                /* 1 .. LEARNER_MAX_SOLUTIONS; 16 */
    enum learner_clustering clustering; /* LEARNER_CLUSTER_PUBLISHED */
    double significance;                /* level of the two splitting rules, 0 .. 1; 0.99 */
    double leader_level;                /* level of the leader rule, 0 .. 1; 0.9 */
    double kappa;                       /* exponent of distance in SPLIT and LEADER, 0 .. 4; 0.5 */
    int em_pred_iterations;             /* of the splitting rules, 0 .. 100; 2 */
    double noise_share;                 /* variance of the samples' noise in units of Psi, > 0:
                                           what a regression's own uncertainty scales with;
                                           1 = as published */
    double gamma_floor;                 /* g0: an expert's uncertainty counts as at least
                                           this when experts are averaged; 0 = as
                                           published; 0 */
    bool average_jacobian;              /* weighted mean of slopes instead of the exact
                                           derivative of the prediction; false */

    enum learner_kernels kernels; /* LEARNER_KERNELS_AUTO; what the machine lacks is refused */

    struct learner_lwpr_config lwpr;
    struct learner_body_config body;
};

/* All defaults for these dimensions; psi0 and sigma0 are left at zero. */
struct learner_config learner_config_default(int n_inputs, int n_outputs);

/* 0 when every row is in range; otherwise -1, with one line in err that names
 * the row and its range. */
int learner_config_check(const struct learner_config *config, char *err, size_t err_size);

/* Bytes that learner_create() takes from the arena; 0 for a configuration
 * that learner_config_check() refuses. */
size_t learner_memory(const struct learner_config *config);

struct learner;

/* A learner that knows nothing. It lives as long as the arena. The
 * configuration is copied. Returns NULL, with one line in err, when a row is
 * out of range or the arena too small (some of it is then lost). */
struct learner *learner_create(const struct learner_config *config, struct arena *arena, char *err,
                               size_t err_size);

enum learner_update_result {
    LEARNER_UPDATED, /* learned */
    LEARNER_BORN,    /* learned, by a new expert */
    LEARNER_OUTLIER, /* fits nothing known: dropped, and counted */
    LEARNER_FULL,    /* would need a new expert, none is left: dropped */
    LEARNER_REFUSED, /* not finite, or beyond what can be computed */
};

/* Learns one sample: z[n_inputs] -> x[n_outputs]. Only LEARNER_UPDATED and
 * LEARNER_BORN change what is predicted. */
enum learner_update_result learner_update(struct learner *learner, const double *z,
                                          const double *x);

/* One value of the map at the query. */
struct learner_solution {
    double value[LEARNER_MAX_OUTPUTS];
    double variance[LEARNER_MAX_OUTPUTS]; /* may be INFINITY far away */
    double weight;                        /* 0 .. 1 */
    /* d value / d z, row-major n_outputs x n_inputs, no padding. */
    double jacobian[LEARNER_MAX_OUTPUTS * LEARNER_MAX_INPUTS];
    int members;   /* experts that took part */
    int principal; /* number of the one with the largest share: its own as long as it lives */
};

struct learner_prediction {
    int n_solutions; /* strongest first; equal weights by `principal` */
    struct learner_solution solution[LEARNER_MAX_SOLUTIONS];
};

/* All values at z[n_inputs]. Returns the number of solutions: 0 before the
 * first expert and for a query that is not finite. */
int learner_predict(struct learner *learner, const double *z,
                    struct learner_prediction *prediction);

/* The one value that averages all experts. Returns 1, or 0 as above. */
int learner_predict_single(struct learner *learner, const double *z,
                           struct learner_solution *solution);

/* One input that gives the wanted output. */
struct learner_inverse_solution {
    double z[LEARNER_MAX_INPUTS];
    double variance[LEARNER_MAX_INPUTS]; /* diagonal of its covariance */
    double weight;                       /* relative; strongest first */
    int principal;
};

struct learner_inverse {
    int n_solutions;
    struct learner_inverse_solution solution[LEARNER_MAX_SOLUTIONS];
};

/* All inputs known to give x[n_outputs]: first guesses, to be checked by
 * predicting forward. Returns their number, 0 as above. */
int learner_predict_inverse(struct learner *learner, const double *x,
                            struct learner_inverse *inverse);

/* A robot's body: a chain of screws that somebody found from samples (learner/body/chain/body.h).
 */
struct body;

/* From now on experts stand on this body (LEARNER_BODY alone): each is learned anew from the
 * samples that it has kept, the first body's from those that came before it. Takes milliseconds, so
 * it is not for a control loop. The body is copied. One without joints takes the body away: what
 * was kept teaches polynomials again, and waits for another body. Returns 0, or -1 with one line in
 * err and the learner as it was. */
int learner_give_body(struct learner *learner, const struct body *body, char *err, size_t err_size);

/* The body that it stands on; NULL when there is none. */
const struct body *learner_body(const struct learner *learner);

/* What a LEARNER_BODY has noticed of changes of its body, and followed without a new search: a
 * joint's zero that moved, or the place or direction from which all is seen; and a tool that slips.
 */
struct learner_body_change {
    uint64_t changes; /* of the body, followed since it was found */
    int cause;    /* of the newest: an input, counted from 0; n_inputs: the view; -1: none yet */
    double by[3]; /* by how much since another cause was: of a joint rad (by[0]); of the view m, or
                     of eyes the optical axis' two tilts (rad) and px */
    bool unsettled; /* the newest samples may be of a change: a search had better wait for some */
    double slip;    /* how far the tip that slips most is from where it was; m, or the eyes' own
                       unit; 0 when none does */
};
struct learner_body_change learner_get_body_change(const struct learner *learner);

/* How much of the motion with the tool most in use no rigid chain explains, rms over the samples
 * kept of it, beyond the noise told: each output in its own unit. 0, or -1 where there is no body,
 * or nothing was kept. It looks at 512 samples: not for a control loop. */
int learner_not_rigid(struct learner *learner, double share[LEARNER_MAX_OUTPUTS]);

/* Samples that a LEARNER_BODY keeps to find a body from, spread over the joints: of context 0, 1,
 * ... on a body, or all of them (context 0) before there is one. n is 0 for contexts that are not,
 * and for other learners. They hold until the next update. */
struct learner_samples {
    bool rigid; /* the context's tip keeps its place in the last frame */
    int n;
    const double *z; /* n rows of n_inputs */
    const double *x; /* n rows of n_outputs */
};
struct learner_samples learner_kept_samples(const struct learner *learner, int context);

struct learner_statistics {
    int experts;       /* now */
    int capacity;      /* at most */
    uint64_t samples;  /* learned: UPDATED and BORN */
    uint64_t births;   /* BORN */
    uint64_t outliers; /* OUTLIER */
    uint64_t full;     /* FULL */
    uint64_t refused;  /* REFUSED */
};

struct learner_statistics learner_get_statistics(const struct learner *learner);

/* The state as bytes. learner_save() writes learner_save_size() bytes into
 * the caller's buffer and returns how many, or 0 when `size` is too small. */
size_t learner_save_size(const struct learner *learner);
size_t learner_save(const struct learner *learner, void *buffer, size_t size);

/* Saved states that one learner takes begin with the same bytes, so many (what a state holds may
 * still be more than the capacity). */
enum { LEARNER_SAVED_IDENTITY = 48 };

/* Replaces the state by a saved one. Returns 0, or -1 with one line in err
 * when the bytes are damaged, of another version, of other dimensions or
 * parameters (capacity may differ), or have more experts than fit; the state
 * is then as before. */
int learner_load(struct learner *learner, const void *buffer, size_t size, char *err,
                 size_t err_size);

#ifdef __cplusplus
}
#endif
#endif
