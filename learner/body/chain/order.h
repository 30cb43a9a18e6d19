/* The joints from the base to the tip: a robot may tell of them in another order. All of
 * learner/body but body_learner.c and inverse.c goes by the chain's order. */
#ifndef REACH_LEARNER_BODY_CHAIN_ORDER_H
#define REACH_LEARNER_BODY_CHAIN_ORDER_H

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether body.order names each input once. */
bool order_is_whole(const struct learner_config *config);

/* From the inputs' order to the chain's: n_inputs numbers. */
void order_to_chain(const struct learner_config *config, const double *inputs, double *joints);

/* Back, for `rows` rows of n_inputs numbers, in place. */
void order_to_inputs(const struct learner_config *config, int rows, double *numbers);

#ifdef __cplusplus
}
#endif
#endif
