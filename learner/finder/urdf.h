/* A URDF as a start for the search of a body: only a start, samples correct it. */
#ifndef REACH_LEARNER_FINDER_URDF_H
#define REACH_LEARNER_FINDER_URDF_H

#include "learner/body/chain/body.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The chain of the n_joints joints nearest to the tip of the file's longest chain of moving joints,
 * or of the one that ends at link `tip`; lengths in m. Everything but the chain is left as it is.
 * Returns 0, or -1 with one line in `error` that names the file. */
int finder_read_urdf(const char *path, const char *tip, int n_joints, struct chain *chain,
                     char *error, size_t error_size);

#ifdef __cplusplus
}
#endif
#endif
