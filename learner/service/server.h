/* The service at work: requests in, answers out, the model to disk, until a signal ends it.
 *
 * Three threads: this one does what is asked, the bus's receives, the disk's
 * (learner/store/disk_thread.h) waits for the disk. */
#ifndef REACH_LEARNER_SERVICE_SERVER_H
#define REACH_LEARNER_SERVICE_SERVER_H

#include "learner/service/settings.h"

#include <lcm/lcm.h>

/* Takes the model from disk, serves on `lcm`, which stays the caller's, and when SIGINT or SIGTERM
 * comes stores what is left. Returns 0, or -1 with one line in `error`. */
int server_run(const struct settings *settings, lcm_t *lcm, char *error, size_t error_size);

#endif
