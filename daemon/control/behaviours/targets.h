/* What the two behaviours with a list of targets share: getting the marker into fixation first,
 * then one target after another, each for its time. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_TARGETS_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_TARGETS_H

#include "daemon/control/behaviours/behaviour.h"

/* Copies the request's targets and enters the first phase. */
void targets_start(struct behaviour *behaviour, const reach_request_t *request,
                   struct control *control);

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
 * after another: *target is it, in px, owned by the behaviour. */
enum targets_work targets_step(struct behaviour *behaviour, struct control *control,
                               const double **target);

/* The set-point slides from one target to the next instead of jumping, by a first-order filter,
 * because a step of the wanted velocity swings a flexible tool and is more than the arm can follow.
 * It slides on the straight line between the two, and the loop about it stays as it was. One
 * period, n entries. */
void targets_slide(double period, double smoothing, const double *target, double *setpoint, int n);

/* The marker was lost for too long: back to fixation, then on with the present target. */
void targets_refixate(struct behaviour *behaviour);

/* Back to where the marker was fixated before, which brings the head to where it was, and from
 * there on with the present target. */
void targets_restart(struct behaviour *behaviour);

#endif
