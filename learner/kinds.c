/* Which learners there are. */
#include "learner/kind.h"

const struct learner_ops *learner_ops_of(enum learner_kind kind)
{
    switch (kind) {
    case LEARNER_IMLE:
        return &learner_imle_ops;
    case LEARNER_LWPR:
        return &learner_lwpr_ops;
    }
    return NULL;
}
