/* What the two behaviours with a list of targets share: getting the marker into fixation first,
 * then one target after another, each for its time. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_TARGETS_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_TARGETS_H

#include "daemon/control/behaviours/behaviour.h"

struct targets {
    int n;
    double target[MAX_TARGETS][SPACE_DIMENSIONS]; /* px or m */
    int64_t period;                               /* us */
    int64_t deadline;                             /* us */
    double start[MAX_JOINTS]; /* where the arm was fixated, or goes to for that; rad */
    /* Where the arm that reaches is to be by now (px or m), or the head that turns (rad). */
    double setpoint[SPACE_DIMENSIONS];
};

/* Whether a request's targets make sense in the task space, and its period. */
bool targets_accept(const struct config *config, const reach_request_t *request);

/* Copies the request's targets and enters the first phase. */
void targets_begin(struct targets *targets, struct progress *progress,
                   const reach_request_t *request, const struct config *config);

/* What a tick of such a behaviour has to do. */
enum targets_work {
    TARGETS_PREPARE, /* nothing: the arm still goes to where it starts, or the marker is not fixated
                      */
    TARGETS_PRESENT, /* `target` was just presented */
    TARGETS_PURSUE,  /* `target` is still the one */
    TARGETS_DONE,    /* all had their time */
};

/* One tick. First the arm goes to the middle of the babbled range when that was asked for, then
 * the marker is fixated, from where equation 14 starts, and the pair is gathered. Then one target
 * after another: *target is it, in px, one of `targets`. */
enum targets_work targets_step(struct targets *targets, struct progress *progress,
                               const struct senses *senses, struct wants *wants,
                               const double **target);

/* The set-point slides from one target to the next instead of jumping, by a first-order filter,
 * because a step of the wanted velocity swings a flexible tool and is more than the arm can follow.
 * It slides on the straight line between the two, and the loop about it stays as it was. One
 * period, n entries. */
void targets_slide(double period, double smoothing, const double *target, double *setpoint, int n);

/* The marker was lost for too long: back to fixation, then on with the present target. */
void targets_refixate(struct targets *targets, struct progress *progress);

/* Back to where the marker was fixated before, which brings the head to where it was, and from
 * there on with the present target. */
void targets_restart(struct targets *targets, struct progress *progress);

#endif
