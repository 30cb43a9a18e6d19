/* The learner with `experts: body`: a mixture of polynomial experts until a body is found, contexts
 * on that body from then on. */
#ifndef REACH_LEARNER_BODY_BODY_LEARNER_H
#define REACH_LEARNER_BODY_BODY_LEARNER_H

#include "learner/body/change/contest.h"
#include "learner/body/contexts/contexts.h"
#include "learner/imle/imle.h"
#include "learner/kind.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples kept for the finder while there is no body. */
enum { BODY_WAITING = 512 };

struct body_learner {
    struct learner_config config;
    struct imle *meanwhile; /* what answers until there is a body */
    bool found;
    struct body body;
    struct contexts *contexts;
    struct kept waiting; /* samples of before there was a body, or since one is doubtful */
    bool doubtful;       /* the body may be none: the mixture learns on */
    struct contest contest;
    struct learner_prediction scratch;
    double given_up; /* what a body's squared error must be under, in units of the noise told, since
                        polynomials have beaten one; 0: none was given up */
};

/* trial.c: a sample for the mixture that learns beside a doubtful body; gives the body up where the
 * mixture foretells better. To be called before the contexts learn the sample (joints in the order
 * of the inputs). True when neither is to learn it: it serves to compare them. */
bool body_try(struct body_learner *learner, const double *z, const double *x);

/* A body is about to come; the mixture of one that explains its samples is not needed any more. */
void body_begin_trial(struct body_learner *learner, const struct body *body);

/* inverse.c: as learner_predict_inverse(). */
int body_predict_inverse(void *self, const double *x, struct learner_inverse *inverse);

/* rigid.c: as learner_not_rigid(). */
int body_not_rigid(void *self, double *share);

/* state.c: the state as bytes, and back. */
size_t body_state_size(const void *self, int n_experts);
void body_save(const void *self, unsigned char *buffer);
int body_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);

/* Experts of the mixture that answers meanwhile, in the configuration of ours. */
struct learner_config body_meanwhile_config(const struct learner_config *config);

#ifdef __cplusplus
}
#endif
#endif
