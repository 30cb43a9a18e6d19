/* Whether a reach came to its targets, by the statuses that came meanwhile. */
#ifndef REACHCTL_OUTCOME_H
#define REACHCTL_OUTCOME_H

#include <reach_request_t.h>
#include <reach_status_t.h>
#include <stdbool.h>
#include <stddef.h>

struct outcome {
    int32_t progress;    /* targets that were over before the present one */
    bool heard;          /* anything of the present one */
    double last;         /* newest distance to it, px or m */
    double nearest;      /* smallest */
    int missed;          /* targets that were not reached */
    double missed_last;  /* of the newest of them */
    double missed_least; /* likewise */
};

/* Takes a status of the behaviour at work; one without a target says nothing. */
void outcome_take(struct outcome *outcome, const reach_status_t *status);

/* The behaviour has ended: `at_work` is its last status.
 *   returns 0 when all targets were reached, else -1 with one line in `error` */
int outcome_end(struct outcome *outcome, const reach_status_t *at_work, char *error,
                size_t error_size);

/* Whether somebody may have meant something else by a target: it is far from all that the robot can
 * know of. One line in `why`. */
bool outcome_doubtful(const reach_status_t *status, const reach_request_t *request, char *why,
                      size_t why_size);

#endif
