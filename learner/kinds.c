/* Which learners there are. */
#include "learner/kind.h"

const struct learner_ops *learner_ops_of(const struct learner_config *config)
{
    switch (config->kind) {
    case LEARNER_IMLE:
        return config->features == LEARNER_BODY ? &learner_body_ops : &learner_imle_ops;
    case LEARNER_LWPR:
        return &learner_lwpr_ops;
    }
    return NULL;
}
