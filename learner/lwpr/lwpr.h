/* Locally weighted projection regression: its state, and the jobs that work on it, one file each.
 * S. Vijayakumar, A. D'Souza, S. Schaal, "Incremental online learning in high dimensions", Neural
 * Computation 17, 2005; docs/lwpr.md says how it works here and where it departs.
 *
 * Letters: d inputs, D outputs, R projections of a field at most, M receptive fields. Every output
 * is a model of its own, but all fields lie in one list, so that one scan finds those that a query
 * activates; each field knows its output. A field is known to others as a view (lwpr_field_at),
 * since its parts lie in arrays of their own: what the scan reads is apart from what only activated
 * fields need.
 *
 * Inputs are in units of config.scale, outputs in units of config.lwpr.norm_out. Within a field all
 * inputs are differences to its centre, so that an offset of the inputs costs no digits. */
#ifndef REACH_LEARNER_LWPR_LWPR_H
#define REACH_LEARNER_LWPR_LWPR_H

#include "common/base/elementary.h"
#include "learner/kind.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a field keeps of itself beside its vectors. */
struct lwpr_head {
    double output;        /* 0 .. D-1 */
    double n_projections; /* 1 .. R */
    double mean_y;        /* beta_0 */
    double dof;           /* degrees of freedom spent: sum of w^2 s' SS^-1 s */
};

/* What a field keeps of each projection r; sums are over the samples since it was added, each
 * forgotten by lambda. Symbols are the paper's, tables 3 and 4. */
struct lwpr_stage {
    double lambda; /* forgetting factor, on its way to final_lambda */
    double n;      /* samples */
    double W;      /* sum of w */
    double V;      /* the same of those after it has matured, which E is over */
    double SS;     /* sum of w s^2 */
    double SR;     /* sum of w s res */
    double E;      /* sum of w e_cv^2, e_cv the error with projections up to r before learning */
    double H;      /* memory terms a_H and a_G of the metric's gradient */
    double G;
    double beta; /* SR / SS */
};

/* Where the parts of one field lie. */
struct lwpr_field {
    double *centre;           /* d: c */
    double *root;             /* M with D = M' M: its diagonal, or its upper triangle by rows */
    double *rate;             /* learning rate of each number of M */
    double *mean;             /* d: mean input less the centre */
    struct lwpr_head *head;   /* 1 */
    struct lwpr_stage *stage; /* R */
    double *covariance;       /* R x d: u_r before it is normalised */
    double *SZ;               /* R x d: sums of w s z */
    double *direction;        /* R x d: u_r, of length 1 or 0 */
    double *loading;          /* R x d: p_r = SZ / SS */
};

enum { LWPR_PARTS = 10 };

/* The field of one output that a query activates most, and the next; -1 for none. */
struct lwpr_rank {
    int first;
    int second;
};

/* What learning one sample in one field passes from the regression to the metric. */
struct lwpr_step {
    double w;                     /* activation */
    double v[LEARNER_MAX_INPUTS]; /* input less the centre */
    double s[LEARNER_MAX_INPUTS]; /* its projections, after learning */
    double e;                     /* residual after learning */
    double e_cv;                  /* error before learning */
    double leverage;              /* s' SS^-1 s over the mature projections */
    int mature;                   /* how many those are */
};

struct lwpr {
    struct learner_config config;
    struct learner_lwpr_config p; /* config.lwpr */
    int d, D, R;
    int n_root; /* numbers in M: d, or d (d + 1) / 2 */
    int M;
    /* (x - c)' D (x - c) at which the activation is the cutoff, w_gen, w_prune */
    double q_cutoff, q_gen, q_prune;

    void *part[LWPR_PARTS]; /* base of each part, one field after the other */
    size_t width[LWPR_PARTS];

    /* scratch for one call */
    double *u;              /* d: the query in units of scale */
    double *q;              /* M: squared distances */
    struct lwpr_rank *rank; /* D */
};

/* lwpr/layout.c ---------------------------------------------------------------------------- */

/* Takes everything from the arena; with arena NULL only counts. Returns the bytes needed, or 0 when
 * the arena is exhausted. Dimensions must be set. */
size_t lwpr_layout(struct lwpr *m, struct arena *arena);

/* The parts of field j, valid until fields are added or removed. */
struct lwpr_field lwpr_field_at(const struct lwpr *m, int j);

/* The parts that are a field's state, in the order in which they are saved: k = 0, 1, ... Returns
 * NULL after the last. What is derived from them comes from lwpr_pls_refresh(). */
void *lwpr_state_part(const struct lwpr *m, int j, int k, size_t *bytes);

/* lwpr/field.c ----------------------------------------------------------------------------- */

/* Puts the query z into m->u, and into m->q the distances of all fields, into m->rank each output's
 * nearest two. */
void lwpr_activate(struct lwpr *m, const double *z);

/* w of a squared distance: exp(-q / 2). */
static inline double lwpr_weight(double q)
{
    return elementary_exp(-0.5 * q);
}

/* Appends a field of `output` at m->u that knows nothing. M must be under the capacity. Returns its
 * index. */
int lwpr_field_birth(struct lwpr *m, int output);

/* Removes field j; the last one takes its index. */
void lwpr_field_remove(struct lwpr *m, int j);

/* lwpr/pls.c ------------------------------------------------------------------------------- */

/* Learns (m->u, y) with activation w; step->w and step->v must be set, the rest is filled in. Adds
 * a projection when that is due. */
void lwpr_pls_learn(const struct lwpr *m, const struct lwpr_field *f, double y,
                    struct lwpr_step *step);

/* Starts projection r from nothing. */
void lwpr_pls_start(const struct lwpr *m, const struct lwpr_field *f, int r);

/* Recomputes what is derived from the state. */
void lwpr_pls_refresh(const struct lwpr *m, const struct lwpr_field *f);

/* How many projections have seen enough samples to be used; 0: the field is not yet trusted. */
int lwpr_pls_mature(const struct lwpr *m, const struct lwpr_field *f);

/* The field's answer at v = x - c: returns yhat, writes its gradient slope[d] and its variance (of
 * an output, noise included; INFINITY before it can be known). */
double lwpr_pls_answer(const struct lwpr *m, const struct lwpr_field *f, const double *v,
                       double *slope, double *variance);

/* lwpr/metric.c ---------------------------------------------------------------------------- */

/* Bounds of the numbers on M's diagonal; no other number exceeds the upper one. */
#define LWPR_SMALLEST_ROOT 1e-4
#define LWPR_LARGEST_ROOT 1e6

/* (x - c)' D (x - c) of field f at v = x - c; and D v into Dv[d]. */
double lwpr_distance(const struct lwpr *m, const struct lwpr_field *f, const double *v);
void lwpr_metric_times(const struct lwpr *m, const struct lwpr_field *f, const double *v,
                       double *Dv);

/* Index in M of its next diagonal number after `diagonal`, which is the row-th; 0 is the first. */
int lwpr_next_diagonal(const struct lwpr *m, int diagonal, int row);

/* dJ/dM of the stochastic cost at one sample into gradient[n_root]. */
void lwpr_metric_gradient(const struct lwpr *m, const struct lwpr_field *f,
                          const struct lwpr_step *step, double *gradient);

/* One step down that gradient; then the memory terms take the sample in. */
void lwpr_metric_learn(const struct lwpr *m, const struct lwpr_field *f,
                       const struct lwpr_step *step);

/* lwpr/learn.c ----------------------------------------------------------------------------- */
enum learner_update_result lwpr_learn(struct lwpr *m, const double *z, const double *x);

/* lwpr/predict.c --------------------------------------------------------------------------- */

/* 1, or 0 while an output has no field. */
int lwpr_predict(struct lwpr *m, const double *z, struct learner_solution *solution);

/* lwpr/state.c ----------------------------------------------------------------------------- */
size_t lwpr_state_size(const void *self, int n_experts);
void lwpr_save(const void *self, unsigned char *buffer);
int lwpr_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);

#ifdef __cplusplus
}
#endif
#endif
