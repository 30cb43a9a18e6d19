/* The mixture: what it has learned, what follows from that, the memory of one call; and the jobs
 * that work on these, one file each.
 *
 * Letters: d inputs, D outputs, p features, M experts. What a scan over all experts reads (lanes,
 * gate) is laid out for vector instructions, number by number over the experts. What only the few
 * experts need that matter for one query (W, whitener, ...) is apart from it, expert after expert,
 * so that expert j's part begins at j times the part's size.
 *
 * An expert is kept CENTRED: means, and scatters about the means, instead of raw sums. It is the
 * published expert exactly (docs/learner.md has the derivation), free of the cancellation that
 * turns raw sums into NaN when the robot holds still or the inputs carry an offset. */
#ifndef REACH_LEARNER_IMLE_IMLE_H
#define REACH_LEARNER_IMLE_IMLE_H

#include "learner/features/feature_map.h"
#include "learner/imle/whitener.h"
#include "learner/kernels/kernels.h"
#include "learner/kind.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples that an expert remembers, where births are by evidence. */
enum { IMLE_REMEMBERED = 8 };

/* Numbers of one expert that are not vectors. */
struct imle_strengths {
    double H;           /* responsibility taken, all told */
    double S;           /* S_h: the same after forgetting */
    double prior_sigma; /* w_Sigma, w_nu, w_Psi after forgetting */
    double prior_nu;
    double prior_psi;
    double turn;      /* coordinate whose ridge is topped up next */
    double last;      /* number of the newest sample that was mostly its own; under 0: the place is
                         vacant (births by evidence alone, as what follows) */
    double row;       /* a candidate's newest samples that came in a row */
    double score;     /* of a candidate: samples that it foretold, the older ones count less */
    double known;     /* samples where it claimed to know, for */
    double error;     /* the mean square of what it was wrong by there, in units of Psi_bar */
    double again;     /* the mean product of two such errors, one after the other */
    double remembers; /* samples remembered, and for each of them */
    double need[IMLE_REMEMBERED]; /* how much worse the others would explain it (needs.c) */
};

/* Most answers that one prediction weighs against each other: it bounds the time. */
enum { IMLE_MOST_ANSWERS = 256 };

/* Most experts to be at a time. */
enum { IMLE_CANDIDATES = 2 };

/* Experts to a block of the sums behind the shared priors. */
enum { IMLE_SUM = 32 };

/* What densities need, one number an expert; recomputed whenever the expert changes. */
struct imle_gate {
    double *log_det;      /* log |Sigma^-1|^(1/2) */
    double *log_norm;     /* log t_j at q = 0 */
    double *exponent;     /* (dof + d) / 2 */
    double *per_a;        /* 1 / a, as in t_j */
    double *half_log_psi; /* 1/2 sum log Psi_i */
    double *log_S;
    double *log_peak; /* log_det - half_log_psi: log h_j where everything is met exactly */
};

/* One expert's answer to the query at hand. */
struct imle_answer {
    int expert;
    int cluster;
    double log_t;
    double t;      /* relative to the largest */
    double gamma;  /* regression's own uncertainty, in units of Psi */
    double spread; /* what R is, in units of Psi */
    double share;  /* phi_j */
    double xhat[LEARNER_MAX_OUTPUTS];
    double kappa[LEARNER_MAX_INPUTS];  /* d t_j / d z = -t_j kappa */
    double dgamma[LEARNER_MAX_INPUTS]; /* d gamma / d z, once sloped */
    bool sloped;
};

/* What is learned: it is saved, and grows with the samples. Arrays hold a part of each expert, one
 * after the other. */
struct imle_state {
    int M;          /* experts, and vacant places among them */
    int candidates; /* experts to be, from the last place downwards (candidates.c) */
    int outliers_in_row;
    double samples;    /* looked at so far */
    double *sigma_bar; /* d: the priors that all experts share */
    double *psi_bar;   /* D */
    double *seen; /* D, D: mean and mean square deviation of all outputs (births by evidence) */
    struct imle_strengths *strengths;
    double *nu;          /* d: centre */
    double *nu0;         /* d: where it was born */
    double *sigma_birth; /* d: Sigma_bar at its birth */
    double *spread;      /* packed d: whitener of Sigma's numerator */
    double *phibar;      /* p: mean features */
    double *xbar;        /* D: mean output */
    double *W;           /* D x p: slopes by feature */
    double *whitener;    /* packed p: of C, the features' scatter plus ridge */
    double *ridge;       /* p: what forgetting has left of the ridge in C */
    double *ssr;         /* D: squared residuals */
    double *psi;         /* D: Psi_j */
    double *typical;     /* D: mean size of the newest errors, the same unit */
    double *remembered;  /* IMLE_REMEMBERED x (d + D): some of its samples */
    double *residual;    /* D: what it was wrong by last, in units of sqrt(Psi_bar) */
};

/* What follows from the state, computed anew whenever an expert changes: neither saved nor loaded.
 */
struct imle_derived {
    double *lanes; /* blocks of 8 experts: nu, and the root R of Sigma^-1 = R' R (kernels.h) */
    struct imle_gate gate;
    double *precision;  /* M x d: diagonal of Sigma^-1 */
    double *regression; /* few features alone: blocks of 8 experts, what answers need (kernels.h,
                           regress) */
    double *prior_sums; /* blocks of IMLE_SUM experts: d + D sums over them */
    bool *stale;        /* each of these blocks: whether an expert has changed */
};

/* Memory of one call, and what is known so far of the sample or query that it is about. */
struct imle_query {
    double *phi;  /* p: features */
    double *dphi; /* d x p */
    double target[LEARNER_MAX_OUTPUTS];
    double *q;     /* M, up to a multiple of 8: squared distances */
    double *log_t; /* the same */

    /* One memory of M numbers, up to a multiple of 8: nothing needs two of them at once. */
    union {
        double *log_h;     /* learn.c: log h_j before normalising, or what it can be at most */
        double *h;         /* learn.c, after that: h_j in units of the largest */
        double *lag;       /* predict.c: how far an expert is behind the best, a logarithm */
        double *log_width; /* cluster_leader.c: log |R|^(1/2) of an answer */
        double *cost;      /* inverse.c: -log weight of the best input that an expert knows */
    };
    int *order; /* M: indices of experts or answers, chosen or sorted */

    /* of one expert */
    double *offset;              /* p: phi - phibar */
    double *white;               /* p: its whitener times that offset */
    double *gain;                /* p: C^-1 times that offset */
    int whitened;                /* the expert that white and gain are of, or -1 */
    double leverage;             /* of the same: |white|^2 */
    double *slope;               /* D x d */
    struct whitener_scratch add; /* p each */

    /* of all experts, where they have been asked */
    bool *answered;    /* each block of 8 experts: whether outputs, misfits are known */
    bool *levered;     /* the same for leverages */
    double *leverages; /* M, up to a multiple of 8 */
    double *misfits;   /* the same */
    double *outputs;   /* blocks of D x 8 */

    struct imle_answer *answers; /* IMLE_MOST_ANSWERS */
    int n_answers;
    double largest_log_t; /* of all experts */
    double all_t;         /* sum of t over the answers, and p_out(z), relative to that */
    struct imle_split_scratch *split;
};

struct imle {
    struct learner_config config;
    struct feature_map *map;
    const struct kernels *kernels;
    int d, D, p;
    bool small;         /* few features: experts answer in blocks */
    double log_c_joint; /* log c_{d+D}, log c_d of the outlier densities */
    double log_c_input;
    double leader_threshold; /* chi-square quantile of the leader rule */
    bool by_evidence;        /* how experts are born */
    struct imle_state state;
    struct imle_derived derived;
    struct imle_query query;
};

/* imle/layout.c ---------------------------------------------------------------------------- */

/* Takes every array from the arena; with arena NULL only counts. Returns the bytes needed, or 0
 * when the arena is exhausted. */
size_t imle_layout(struct imle *m, struct arena *arena);

/* A part of an expert's state. */
struct imle_part {
    double *begin;
    size_t size;
    int order;     /* over 0: a whitener of this order, its diagonal positive */
    bool positive; /* no number is zero or less */
};

/* The parts of an expert that are its state (all but strengths, caches and scratch), in the order
 * in which they are saved: k = 0, 1, ... until false. */
bool imle_state_part(const struct imle *m, int expert, int k, struct imle_part *part);

/* imle/expert.c ---------------------------------------------------------------------------- */

/* An expert at (z, x) in place j, whose slopes are those of `parent`, or zero for -1. phi are the
 * features at z. */
void imle_expert_birth(struct imle *m, int j, const double *z, const double *x, int parent);

/* Place `to` gets what `from` has learned. */
void imle_expert_copy(struct imle *m, int from, int to);

/* Takes expert j away: its place is vacant, out of every query's reach. */
void imle_expert_remove(struct imle *m, int j);
bool imle_vacant(const struct imle *m, int j);

/* Learns (z, x) with responsibility h in expert j; m->query.phi are the features at z. */
void imle_expert_update(struct imle *m, int j, double h, const double *z, const double *x);

/* Recomputes everything that is derived from the state of expert j. */
void imle_expert_refresh(struct imle *m, int j);

/* imle/gating.c ---------------------------------------------------------------------------- */

/* Numbers of one block of lanes, and the experts that lanes have room for. */
size_t imle_lanes_block(int d);
size_t imle_lanes_experts(const struct learner_config *config);

/* m->query.q of all experts at z. */
void imle_scan_distances(struct imle *m, const double *z);

/* m->query.log_t of expert j (and its neighbours), or of all, from m->query.q. */
void imle_density_near(struct imle *m, int j);
void imle_densities(struct imle *m);

/* Puts expert j's nu and the root `scale` times the packed rows of G into its lane. */
void imle_lanes_write(struct imle *m, int j, double scale, const double *G);

/* q = (z - nu)' Sigma^-1 (z - nu) of expert j; Sigma^-1 (z - nu) in pull[d]. */
double imle_gate_pull(const struct imle *m, int j, const double *z, double *pull);

/* Sigma^-1 of expert j, packed (imle/triangle.h). */
void imle_gate_precision(const struct imle *m, int j, double *packed);

/* log of the outlier densities p_out(z, x) and p_out(z). */
double imle_log_outlier_joint(const struct imle *m);
double imle_log_outlier_input(const struct imle *m);

/* imle/answer.c ---------------------------------------------------------------------------- */

/* The features m->query.phi are new, and x (or NULL) is what they lead to: nothing is known yet. */
void imle_new_query(struct imle *m, const double *x);

/* Numbers of one block of m->derived.regression. */
size_t imle_regression_block(int p, int D);

/* What expert j and its neighbours answered to this query is no longer true. */
void imle_forget_answers(struct imle *m, int j);

/* Expert j has changed: its lane, where lanes are in use. */
void imle_regression_write(struct imle *m, int j);

/* xhat[D] of expert j at the features m->query.phi. */
void imle_expert_output(struct imle *m, int j, double *xhat);

/* sum (x - xhat)^2 / Psi of expert j for the x of imle_new_query(); the second one's from j to the
 * end of its block, where experts answer in blocks. */
double imle_expert_misfit(struct imle *m, int j);
const double *imle_expert_misfits(struct imle *m, int j);

/* d xhat / d z of expert j at the derivative m->query.dphi: W dphi', D x d row-major, into
 * m->query.slope. */
void imle_expert_slope(struct imle *m, int j);

/* Leaves G (phi - phibar) of expert j in m->query.white and C^-1 (phi - phibar) in m->query.gain.
 */
void imle_expert_whiten(struct imle *m, int j);

/* gamma_j = noise_share (leverage + 1 / S_h): the regression's own uncertainty, in units of Psi. */
double imle_expert_gamma(struct imle *m, int j);

/* The answer's dgamma; the query's dphi must be in m->query.dphi. */
void imle_gamma_slope(struct imle *m, struct imle_answer *answer);

/* imle/priors.c ---------------------------------------------------------------------------- */

/* Sigma_bar and Psi_bar from all experts. */
void imle_priors_update(struct imle *m);

/* imle/learn.c ----------------------------------------------------------------------------- */
enum learner_update_result imle_learn(struct imle *m, const double *z, const double *x);

/* Distances and features of the sample; false when its features are too large to compute with. */
bool imle_look_at_sample(struct imle *m, const double *z, const double *x);

/* The expert that a newborn takes its slopes from: largest log t_j + log S_h of m->query.log_t. -1
 * for none. */
int imle_parent_of_newborn(const struct imle *m);

/* imle/predict.c --------------------------------------------------------------------------- */
int imle_predict(struct imle *m, const double *z, struct learner_prediction *prediction);
int imle_predict_single(struct imle *m, const double *z, struct learner_solution *solution);

/* imle/cluster_split.c, imle/cluster_leader.c ------------------------------------------------ */

/* Give each of m->query.answers its cluster; return how many there are (1 or more; none is empty).
 */
int imle_cluster_by_splitting(struct imle *m);
size_t imle_split_memory(void);
int imle_cluster_by_leaders(struct imle *m);

/* imle/sort.c ------------------------------------------------------------------------------ */

/* Sorts n indices by key[index], smallest first; equals by index. */
void imle_sort_by(const double *key, int *index, int n);

/* imle/fuse.c ------------------------------------------------------------------------------ */

/* The solution that the answers of one cluster give together, with its Jacobian; log_outlier is
 * log p_out(z). m->query.phi and m->query.dphi must be those of the query. */
void imle_fuse(struct imle *m, const double *z, int cluster, double log_outlier,
               struct learner_solution *solution);

/* imle/inverse.c --------------------------------------------------------------------------- */
int imle_predict_inverse(struct imle *m, const double *x, struct learner_inverse *inverse);

/* imle/candidates.c ------------------------------------------------------------------------ */

/* Where candidate k = 0, 1, ... is. */
int imle_candidate_place(const struct imle *m, int k);

/* imle/imle.c ------------------------------------------------------------------------------ */

/* Experts, without vacant places. */
int imle_experts(const void *self);

/* imle/state.c ----------------------------------------------------------------------------- */
/* As it was created: without experts. */
void imle_forget(struct imle *m);
int imle_saved_experts(const void *self);
size_t imle_state_size(const void *self, int n_experts);
void imle_save(const void *self, unsigned char *buffer);
int imle_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);

#ifdef __cplusplus
}
#endif
#endif
