/* The learner with `experts: body`: a mixture of polynomial experts until a body is found, contexts
 * on that body from then on. */
#ifndef REACH_LEARNER_BODY_BODY_LEARNER_H
#define REACH_LEARNER_BODY_BODY_LEARNER_H

#include "learner/body/contexts.h"
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
    struct kept waiting; /* samples of before there was a body */
};

/* inverse.c: as learner_predict_inverse(). */
int body_predict_inverse(void *self, const double *x, struct learner_inverse *inverse);

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
