/* The state of the mixture, and the jobs that work on it, one file each.
 *
 * Letters: d inputs, D outputs, p features, M experts. Arrays that hold something of every expert
 * are laid out expert after expert, so that expert j's part begins at j times the part's size;
 * arrays that a scan over all experts reads (nu, gate, the cached numbers) are apart from the large
 * ones that only a few experts need for one query (W, factor).
 *
 * An expert is kept CENTRED: means, and scatters about the means, instead of raw sums. It is the
 * published expert exactly (docs/learner.md has the derivation), free of the cancellation that
 * turns raw sums into NaN when the robot holds still or the inputs carry an offset. */
#ifndef REACH_IMLE_PRIVATE_H
#define REACH_IMLE_PRIVATE_H

#include "daemon/feature_map.h"
#include "daemon/learner_private.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers of one expert that are not vectors. */
struct imle_strengths {
    double H;           /* responsibility taken, all told */
    double S;           /* S_h: the same after forgetting */
    double prior_sigma; /* w_Sigma, w_nu, w_Psi after forgetting */
    double prior_nu;
    double prior_psi;
    double turn; /* coordinate whose ridge is topped up next */
};

/* What densities need, recomputed whenever the expert changes. */
struct imle_gate {
    double log_det;      /* log |Sigma^-1|^(1/2) */
    double log_norm;     /* log t_j at q = 0 */
    double exponent;     /* (dof + d) / 2 */
    double a;            /* as in t_j */
    double half_log_psi; /* 1/2 sum log Psi_i */
    double log_S;
};

/* One expert's answer to the query at hand. */
struct imle_answer {
    int expert;
    int cluster;
    double q;
    double log_t;
    double t;      /* relative to the largest */
    double gamma;  /* regression's own uncertainty, in units of Psi */
    double spread; /* what R is, in units of Psi */
    double share;  /* phi_j */
    double xhat[LEARNER_MAX_OUTPUTS];
};

struct imle {
    struct learner_config config;
    struct feature_map *map;
    int d, D, p;
    int M;
    int outliers_in_row;
    double log_c_joint; /* log c_{d+D}, log c_d of the outlier densities */
    double log_c_input;
    double leader_threshold; /* chi-square quantile of the leader rule */

    double *sigma_bar; /* d: the shared priors */
    double *psi_bar;   /* D */

    /* M experts each */
    struct imle_strengths *strengths;
    struct imle_gate *gate;
    double *nu;          /* d: centre */
    double *root;        /* packed d: G with Sigma^-1 = G' G */
    double *precision;   /* d: diagonal of Sigma^-1 */
    double *nu0;         /* d: where it was born */
    double *sigma_birth; /* d: Sigma_bar at its birth */
    double *spread;      /* packed d: Cholesky factor of Sigma's numerator */
    double *phibar;      /* p: mean features */
    double *xbar;        /* D: mean output */
    double *W;           /* p x D: slopes by feature */
    double *factor;      /* packed p: Cholesky factor of C, the features' scatter plus ridge */
    double *ridge;       /* p: what forgetting has left of the ridge in C */
    double *ssr;         /* D: squared residuals */
    double *psi;         /* D: Psi_j */

    /* scratch for one call */
    double *phi;                 /* p */
    double *dphi;                /* p x d */
    double *offset;              /* p */
    double *gain;                /* p */
    double *log_t;               /* M */
    double *log_h;               /* M */
    double *q;                   /* M */
    double *slope;               /* D x d */
    int *order;                  /* M */
    struct imle_answer *answers; /* M */
    int n_answers;
};

/* imle_layout.c ---------------------------------------------------------------------------- */

/* Takes every array from the arena; with arena NULL only counts. Returns the bytes needed, or 0
 * when the arena is exhausted. */
size_t imle_layout(struct imle *m, struct arena *arena);

/* A part of an expert's state. */
struct imle_part {
    double *begin;
    size_t size;
    int order;     /* over 0: a packed triangle of this order, its diagonal positive */
    bool positive; /* no number is zero or less */
};

/* The parts of an expert that are its state (all but strengths, caches and scratch), in the order
 * in which they are saved: k = 0, 1, ... until false. */
bool imle_state_part(const struct imle *m, int expert, int k, struct imle_part *part);

/* imle_expert.c ---------------------------------------------------------------------------- */

/* Appends an expert at (z, x) whose slopes are those of `parent`, or zero for -1. M must be under
 * the capacity. phi are the features at z. */
void imle_expert_birth(struct imle *m, const double *z, const double *x, int parent);

/* Learns (z, x) with responsibility h in expert j; m->phi are the features at z. */
void imle_expert_update(struct imle *m, int j, double h, const double *z, const double *x);

/* Recomputes everything that is derived from the state of expert j. */
void imle_expert_refresh(struct imle *m, int j);

/* imle_density.c --------------------------------------------------------------------------- */

/* q = (z - nu)' Sigma^-1 (z - nu) of expert j. */
double imle_distance(const struct imle *m, int j, const double *z);

/* log t_j at that distance. */
double imle_log_t(const struct imle *m, int j, double q);

/* xhat[D] of expert j at the features m->phi. */
void imle_expert_output(const struct imle *m, int j, double *xhat);

/* d xhat / d z of expert j at the derivative m->dphi: W' dphi, D x d row-major, into m->slope. */
void imle_expert_slope(struct imle *m, int j);

/* (phi - phibar)' C^-1 (phi - phibar) of expert j at the features m->phi. Leaves
 * L^-1 (phi - phibar) in m->gain. */
double imle_expert_leverage(struct imle *m, int j);

/* gamma_j = noise_share (leverage + 1 / S_h): the regression's own uncertainty, in units of Psi. */
double imle_expert_gamma(struct imle *m, int j);

/* log of the outlier densities p_out(z, x) and p_out(z). */
double imle_log_outlier_joint(const struct imle *m);
double imle_log_outlier_input(const struct imle *m);

/* imle_priors.c ---------------------------------------------------------------------------- */

/* Sigma_bar and Psi_bar from all experts. */
void imle_priors_update(struct imle *m);

/* imle_learn.c ----------------------------------------------------------------------------- */
enum learner_update_result imle_learn(struct imle *m, const double *z, const double *x);

/* imle_predict.c --------------------------------------------------------------------------- */
int imle_predict(struct imle *m, const double *z, struct learner_prediction *prediction);
int imle_predict_single(struct imle *m, const double *z, struct learner_solution *solution);

/* imle_split.c, imle_leader.c -------------------------------------------------------------- */

/* Give each of m->answers its cluster; return how many there are (1 or more; none is empty). They
 * use m->order, m->log_h, m->log_t and m->q as scratch. */
int imle_cluster_by_splitting(struct imle *m);
int imle_cluster_by_leaders(struct imle *m);

/* Sorts the first n indices in m->order by m->log_h[index], smallest first; equals by index. */
void imle_sort_order(struct imle *m, int n);

/* imle_fuse.c ------------------------------------------------------------------------------ */

/* The solution that the answers of one cluster give together, with its Jacobian; log_outlier is
 * log p_out(z). m->phi and m->dphi must be those of the query. */
void imle_fuse(struct imle *m, const double *z, int cluster, double log_outlier,
               struct learner_solution *solution);

/* imle_inverse.c --------------------------------------------------------------------------- */
int imle_predict_inverse(struct imle *m, const double *x, struct learner_inverse *inverse);

/* imle_store.c ----------------------------------------------------------------------------- */
size_t imle_state_size(const void *self, int n_experts);
void imle_save(const void *self, unsigned char *buffer);
int imle_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);

#ifdef __cplusplus
}
#endif
#endif
