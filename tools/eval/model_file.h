/* A learner's state in a file: the bytes of learner_save(). */
#ifndef REACH_EVAL_MODEL_FILE_H
#define REACH_EVAL_MODEL_FILE_H

#include <stddef.h>

#include "learner/learner.h"

/* Both return 0, or -1 with "path: reason" in `error`; a load that fails leaves the learner as it
 * was, a save that fails leaves the file as it was. */
int model_file_save(const char *path, const struct learner *learner, char *error,
                    size_t error_size);
int model_file_load(const char *path, struct learner *learner, char *error, size_t error_size);

#endif
