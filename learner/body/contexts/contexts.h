/* The tools on one body: each a context, a regression over the whole range of the joints. Which one
 * a sample belongs to, when it is none of them, and which are needed no more.
 *
 * All contexts share one uniform density of inputs: a sample's responsibilities come from how well
 * each context predicts it, and from how much of the newest samples the context had. A sample that
 * no context explains makes a new one at once, on probation: it must be confirmed by others soon.
 * Where there is no room for one more it takes the place of a known one only when it is confirmed,
 * so that a gross error costs none. */
#ifndef REACH_LEARNER_BODY_CONTEXTS_CONTEXTS_H
#define REACH_LEARNER_BODY_CONTEXTS_CONTEXTS_H

#include <stdint.h>

#include "common/base/arena.h"
#include "learner/body/change/change.h"
#include "learner/body/tool/kept.h"
#include "learner/body/tool/tied.h"

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

/* A tip as it was when it was last well known, and what samples of later make of it (follow.h). */
struct anchor {
    bool known;
    bool slips;  /* the tip moves in the hand */
    int size;    /* coefficients of theta that count */
    double next; /* samples of the context with which it is taken anew, if nothing has changed */
    double *theta;
    struct change_sums own;    /* the context's own samples */
    struct change_sums astray; /* the newest of all, since one of them was not understood */
};

/* Of the last change that was noticed and followed. */
struct body_news {
    double changes; /* all told */
    int cause;      /* a joint, counted from 0; the number of joints: the view; -1: none yet */
    double by[CHANGE_VIEW]; /* since another cause was: rad; of the view m, or of eyes tilt, tilt,
                               px */
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
    double slip;    /* how far its tip has moved since, of late; 0 while that is not sure */
    struct tied tied;
    struct kept kept;
    struct anchor anchor;
};

struct contexts {
    struct body *body;
    struct design design;
    const struct kernels *kernels;
    int most;           /* contexts that are confirmed, 1 .. CONTEXTS_MAX */
    int n;              /* 0 .. most + 1 */
    double births;      /* of contexts, ever */
    bool firm;          /* the body explains its samples: what it does not is a change of it */
    double looked;      /* samples since it was last asked whether something has changed */
    double streak;      /* samples since one was not understood, while that is not settled */
    double streak_left; /* samples until it is */
    struct body_news news;
    struct context context[CONTEXTS_ROOM];

    /* scratch of one call */
    double *rows;    /* Phi, 3 x size[2], in space */
    double *white;   /* the same in units of the noise */
    double doubt[9]; /* of the body, in units of the noise */
    struct chain_pose pose;
    double place[3];    /* where the sample was seen */
    double by_noise[9]; /* body_place()'s matrix there */
    struct tied_scratch scratch;
    struct tied_fit fit[CONTEXTS_ROOM];
    double log_h[CONTEXTS_ROOM];
    double h[CONTEXTS_ROOM];
    double gain[CONTEXTS_ROOM]; /* of the sample */
};

/* Bytes that contexts_create takes from an arena, for a body of n_joints. */
size_t contexts_memory(int n_joints);

/* Doubles of an anchor, which lie behind each other from its theta on. */
size_t contexts_anchor_numbers(const struct design *design);

/* No contexts yet, and nothing in `body`, which must stay: it is theirs. NULL when the arena is
 * exhausted. */
struct contexts *contexts_create(struct body *body, int n_joints, int most,
                                 const struct kernels *kernels, struct arena *arena);

/* Without contexts and without a body again; no number is given twice. */
void contexts_forget(struct contexts *contexts);

/* From now on on a copy of this body, which is corrected where it changes: every context is learned
 * anew from what it has kept. */
void contexts_stand_on(struct contexts *contexts, const struct body *body);

/* Learns z -> x. LEARNER_OUTLIER: it is nothing that an arm with a tool could do. */
enum learner_update_result contexts_learn(struct contexts *contexts, const double *z,
                                          const double *x);

/* The sample as the regressions want it: y, and in contexts->white the rows, in units of the noise,
 * which is that of the sensor and of what is not yet known of the body. false where the eyes see
 * nothing. */
bool contexts_whiten(struct contexts *contexts, const double *z, const double *x, double *y);

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
