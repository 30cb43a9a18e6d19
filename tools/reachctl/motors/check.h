/* reachctl check-motors: has the daemon move each joint a little, listens to commands and states,
 * and says what each joint made of it. */
#ifndef REACHCTL_MOTORS_CHECK_H
#define REACHCTL_MOTORS_CHECK_H

#include "tools/reachctl/client.h"

/* Prints a table. Returns 0 when all joints are well, else -1 with one line in `error`. */
int motors_check(struct client *client, reach_request_t *request, double timeout, char *error,
                 size_t error_size);

#endif
