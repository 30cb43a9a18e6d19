/* The tools on one body: each a context, a regression over the whole range of the joints. Which one
 * a sample belongs to, when it is none of them, and which are needed no more.
 *
 * All contexts share one uniform density of inputs: a sample's responsibilities come from how well
 * each context predicts it, and from how much of the newest samples the context had. A sample that
 * no context explains makes a new one at once, on probation: it must be confirmed by others soon.
 * Where there is no room for one more it takes the place of a known one only when it is confirmed,
 * so that a gross error costs none. */
#ifndef REACH_LEARNER_BODY_CONTEXTS_H
#define REACH_LEARNER_BODY_CONTEXTS_H

#include <stdint.h>

#include "common/base/arena.h"
#include "learner/body/kept.h"
#include "learner/body/tied.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    CONTEXTS_MAX = LEARNER_MAX_SOLUTIONS,
    CONTEXTS_ON_PROBATION = 4,
    CONTEXTS_NUMBERS = 1024,
    /* One on probation beside as many as there may be, and one that is being tried. */
    CONTEXTS_ROOM = CONTEXTS_MAX + 2,
    CONTEXTS_KEPT = 512,
};

struct context {
    double number;  /* stays its own as long as it lives: births before its own, cyclic */
    double support; /* responsibility taken, all told */
    double recent;  /* share of it in the newest samples */
    double age;     /* samples since it was born */
    double scale;   /* variance of its misfits, in units of the body's noise; at least 1 */
    double twin;   /* samples in a row that it would have explained beside the one that took them */
    double strain; /* by how much the newest samples in a row fitted worse than they should */
    bool confirmed; /* more than a mistake */
    double gain;    /* while on probation: how much better it foretold its samples than a tip that
                       could be anywhere, log */
    struct tied tied;
    struct kept kept;
};

struct contexts {
    const struct body *body;
    struct design design;
    const struct kernels *kernels;
    int most;      /* contexts that are confirmed, 1 .. CONTEXTS_MAX */
    int n;         /* 0 .. most + 1 */
    double births; /* of contexts, ever */
    struct context context[CONTEXTS_ROOM];

    /* scratch of one call */
    double *rows;    /* Phi, 3 x size[2], in space */
    double *white;   /* the same in units of the noise */
    double doubt[9]; /* of the body, in units of the noise */
    struct tied_scratch scratch;
    struct tied_fit fit[CONTEXTS_ROOM];
    double log_h[CONTEXTS_ROOM];
    double h[CONTEXTS_ROOM];
    double gain[CONTEXTS_ROOM]; /* of the sample */
};

/* Bytes that contexts_create takes from an arena, for a body of n_joints. */
size_t contexts_memory(int n_joints);

/* No contexts yet, and no body. NULL when the arena is exhausted. */
struct contexts *contexts_create(int n_joints, int most, const struct kernels *kernels,
                                 struct arena *arena);

/* Without contexts and without a body again; no number is given twice. */
void contexts_forget(struct contexts *contexts);

/* From now on on this body, which must stay: every context is learned anew from what it has kept.
 */
void contexts_stand_on(struct contexts *contexts, const struct body *body);

/* Learns z -> x. LEARNER_OUTLIER: it is nothing that an arm with a tool could do. */
enum learner_update_result contexts_learn(struct contexts *contexts, const double *z,
                                          const double *x);

/* Whether others than its first sample have confirmed a context. */
bool contexts_confirmed(const struct context *context);
int contexts_count_confirmed(const struct contexts *contexts);

/* What context j says at z, whose pose is `pose` and whose rows are in contexts->rows: value,
 * variance, Jacobian. false when the eyes cannot look there. */
bool contexts_answer(struct contexts *contexts, int j, const double *z,
                     const struct chain_pose *pose, struct learner_solution *solution);

#ifdef __cplusplus
}
#endif
#endif
