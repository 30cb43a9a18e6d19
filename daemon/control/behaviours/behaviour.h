/* What the robot wants now. Each behaviour is one small file behind one ops table, and one row of
 * table.c.
 *
 * A behaviour reads the senses and writes what it wants; it reads no clock, does no input or
 * output, and knows nothing of motors' limits (motion.h, safety.h). */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_BEHAVIOUR_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_BEHAVIOUR_H

#include "daemon/config/config.h"
#include "daemon/control/behaviours/gaze.h"
#include "daemon/control/behaviours/tried.h"
#include "daemon/control/kinematics/estimate.h"
#include "daemon/control/senses/sight.h"

#include <assert.h>
#include <reach_request_t.h>
#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One training pair that a behaviour has gathered. */
struct pair {
    int64_t utime;         /* us */
    double q[MAX_JOINTS];  /* arm joints, rad */
    double x[MAX_OUTPUTS]; /* task position */
};

/* What comes into one tick. */
struct senses {
    const struct config *config;
    int64_t now;            /* of stamps, us: may be set back or forth */
    int64_t time;           /* of durations, us: goes on by a period a period */
    const double *q;        /* all joints, arm first, rad */
    const double *previous; /* velocities commanded in the tick before, rad/s */
    const struct sight *sight;
    const struct estimate *estimate;

    /* For what a behaviour imagines (imagine.h): the model, and room for what it says. */
    struct learner *learner;
    struct learner_prediction *imagined;
};

/* What goes out of it; all of it is rest and nothing at first. */
struct wants {
    double velocity[MAX_JOINTS];     /* wanted, all joints, rad/s */
    bool has_target;                 /* `target` holds */
    double target[SPACE_DIMENSIONS]; /* where it is to be, in what is seen: px or m */
    bool has_pair;                   /* `pair` was gathered in this tick */
    struct pair pair;

    /* What is remembered from one behaviour to the next. */
    struct gaze *gaze;
    struct tried *tried;
};

/* How far a behaviour is; phases are those of status_t. */
struct progress {
    int8_t phase;
    int done, total, skipped;
};

struct behaviour;

struct behaviour_ops {
    const char *name;  /* the word for `code` (status_words.h) */
    int8_t kind;       /* of the request that starts it: request_t.kind */
    int8_t code;       /* status_t.behaviour */
    size_t state_size; /* of its own state, bytes; zeros at start */
    /* Whether the values of a request of this kind make sense. */
    bool (*accepts)(const struct config *config, const reach_request_t *request);
    /* Starts on a request that was accepted. */
    void (*start)(struct behaviour *behaviour, const reach_request_t *request,
                  const struct senses *senses, struct wants *wants);
    /* One tick. Returns false when the work is done. */
    bool (*step)(struct behaviour *behaviour, const struct senses *senses, struct wants *wants);
};

#define BEHAVIOUR_STATE_MOST 4096

/* Each behaviour says this of its state, whose size is fixed so that nothing is allocated. */
#define BEHAVIOUR_STATE_FITS(type)                                                                 \
    static_assert(sizeof(type) <= BEHAVIOUR_STATE_MOST && alignof(type) <= alignof(max_align_t),   \
                  "the behaviour that runs has room for its state")

/* The behaviour that runs. ops NULL = none. */
struct behaviour {
    const struct behaviour_ops *ops;
    int64_t request_seq;
    bool learn;
    struct progress progress;
    alignas(max_align_t) unsigned char state[BEHAVIOUR_STATE_MOST]; /* of the type that it chose */
};

static inline void *behaviour_state(struct behaviour *behaviour)
{
    return behaviour->state;
}

#endif
