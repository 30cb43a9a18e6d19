/* What the control step wants of whoever keeps its model: a table of calls, so that the step knows
 * neither a disk nor a replay. All calls are the loop thread's; none waits. */
#ifndef REACH_DAEMON_CONTROL_MODEL_PORT_H
#define REACH_DAEMON_CONTROL_MODEL_PORT_H

#include "daemon/config/space.h"
#include "learner/learner.h"

#include <stdbool.h>
#include <stdint.h>

/* What became of a save or a load. Values are those of trace_t.store_result. */
enum model_result { MODEL_NOTHING, MODEL_DONE, MODEL_FAILED };

enum { MODEL_BODY_TAKEN = -1 };

/* What the newest poll has seen, for the trace: nothing else that the keeper does decides anything.
 */
struct model_moment {
    enum model_result result;
    bool ready;             /* a save or load could begin then */
    uint64_t model;         /* hash of what the learner was given whole; 0 = nothing */
    int64_t body;           /* seq of the body_t whose body the learner was given then; 0 = none,
                               MODEL_BODY_TAKEN = its body was taken away */
    uint32_t body_checksum; /* of that body */
};

/* What the newest search for a body has come to; values are those of status_t.body. */
enum model_search {
    MODEL_NO_SEARCH,
    MODEL_SEARCHING,
    MODEL_FOUND,
    MODEL_NO_CHAIN,
    MODEL_NO_FINDER,
};

/* For the status. */
struct model_report {
    int64_t stored; /* samples of the model's life that are safe; 0 = none of this model */
    bool storing;   /* what is learned is kept */
    int64_t waits;  /* times that learning waited for room */
    enum model_search search;
    int64_t searches;                   /* since the start */
    double not_rigid[SPACE_DIMENSIONS]; /* as the newest search found it: learner_not_rigid() */
};

struct model_port_ops {
    /* A sample that is about to be learned. Returns false when there is no room for it, or a body
     * is being given: it must then not be learned yet, so that what is learned and what is kept
     * never differ. */
    bool (*note)(void *context, const double *z, const double *x);
    /* What was noted has been learned. */
    void (*learned)(void *context, const struct learner *learner);
    /* Whether there is no room for a sample. */
    bool (*full)(const void *context);
    /* Whether a save, a load or a body is being worked on. */
    bool (*works)(const void *context);
    /* Start saving or loading. Return false when that could not begin at the newest poll. */
    bool (*begin_save)(void *context, int number);
    bool (*begin_load)(void *context, int number);
    /* Start taking the body away from the learner, which has one; the next result is of that. */
    void (*begin_forgetting)(void *context);
    /* Send the body in use. */
    void (*tell_body)(void *context);
    /* Every tick: what became of it. A model that was read takes the place of *learner here, or
     * *learner gets a body, between two ticks. */
    enum model_result (*poll)(void *context, struct learner **learner);
    struct model_moment (*moment)(const void *context);
    struct model_report (*report)(const void *context);
};

struct model_port {
    const struct model_port_ops *ops;
    void *context; /* the keeper's */
};

/* Of a model that lives in memory alone: there is always room, and nothing to save or load. */
struct model_port model_port_none(void);

#endif
