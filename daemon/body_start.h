/* The robot's URDF as what searches for its body begin with: learner.body.start. */
#ifndef REACH_DAEMON_BODY_START_H
#define REACH_DAEMON_BODY_START_H

#include "daemon/config/config.h"
#include "learner/body/chain/body.h"

/* *start is `body`, filled, or NULL where the option is empty. Returns 0, or -1 with one line in
 * `error` that names the file. */
int body_start_read(const struct config *config, struct body *body, const struct body **start,
                    char *error, size_t error_size);

#endif
