/* Models saved by number, model-N.imle: one file each, the format of a snapshot. Housekeeping only.
 */
#ifndef REACH_LEARNER_STORE_SAVED_H
#define REACH_LEARNER_STORE_SAVED_H

#include "learner/store/files.h"
#include "learner/store/model_file.h"

/* DIRECTORY/model-N.imle; `path` has room for MODEL_PATH_MOST. */
void saved_path(const char *directory, int number, char *path);

/* Writes it, and then removes the oldest so that `most` are left (0: as many as there are). What
 * has the name already and is damaged, or is another robot's, is set aside first. Returns 0, or -1
 * with errno; says in the log what else it did. */
int saved_write(const struct files *files, const char *directory, int number, int most,
                const struct model_bytes *model);

#endif
