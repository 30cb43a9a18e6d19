/* The control step's state, for the files that make it up: tick.c (the order of the step),
 * requests.c (what users ask), report.c (samples, status and trace). */
#ifndef REACH_DAEMON_CONTROL_TICK_PRIVATE_H
#define REACH_DAEMON_CONTROL_TICK_PRIVATE_H

#include "daemon/control/behaviours/behaviour.h"
#include "daemon/control/behaviours/gaze.h"
#include "daemon/control/behaviours/table.h"
#include "daemon/control/kinematics/estimate.h"
#include "daemon/control/limits/safety.h"
#include "daemon/control/sample_queue.h"
#include "daemon/control/senses/context.h"
#include "daemon/control/senses/following.h"
#include "daemon/control/senses/joint_history.h"
#include "daemon/control/senses/plausible.h"
#include "daemon/control/senses/refusals.h"
#include "daemon/control/senses/sight.h"
#include "daemon/control/senses/witness.h"
#include "daemon/control/supervisor.h"
#include "daemon/control/tick.h"
#include "learner/health/health.h"

struct tick {
    const struct config *config;
    struct learner *learner;
    struct model_port model;
    const struct behaviour_ops *const *behaviours;
    struct sample_queue queue;
    struct health health; /* of the samples that are learned */
    struct plausible plausible;
    struct following following;
    struct history history;
    struct sight sight;
    struct witness witness;
    struct estimate estimate;
    struct context context;
    struct gaze gaze;
    struct tried tried;
    struct safety safety;
    struct behaviour behaviour;
    struct learner_prediction pair_prediction; /* too large for the stack */
    struct learner_prediction imagined;        /* the same */

    enum supervisor_state state;
    bool state_known;
    bool touched;       /* by anything that matters since it began */
    int8_t fault;       /* constants of status_t */
    int fault_joint;    /* that it is of, from 1; 0 = of none, */
    double fault_value; /* and how much it is */
    bool reset_requested;
    bool emergency_requested;
    bool had_body;        /* experts stood on a body in the tick before */
    double q[MAX_JOINTS]; /* newest good state, rad */
    int64_t seq;          /* ticks so far */
    int64_t time;         /* that durations are measured by, us; 0 = no tick yet */
    int64_t state_seq;    /* newest good state */
    int64_t state_utime;  /* its time, us */
    double state_age;     /* since it came, s */
    int64_t sample_seq;
    int64_t frozen; /* samples that were not learned, since what was seen cannot be true */
    struct refusals refusals;
    int64_t unanswered; /* state of lockstep that was refused in this tick, 0 = none */

    int64_t request_seq;   /* newest looked at */
    int8_t request_result; /* constants of status_t */

    int64_t model_request_seq; /* newest save, load or forgetting that was begun */
    int8_t model_kind;         /* of that request */
    int8_t model_result;       /* a constant of status_t */

    /* This tick's, for the trace. */
    int64_t state_seq_now, marker_seq_now, request_seq_now;
    int32_t learned_now;
    bool has_target;
    double target[SPACE_DIMENSIONS];
};

/* Takes in the robot's state, if it is to be believed, and what was seen. */
void tick_take_inputs(struct tick *tick, const struct tick_inputs *inputs);

/* Looks at the requests that came, and at what became of a save or load. */
void tick_take_requests(struct tick *tick, const struct tick_inputs *inputs,
                        const struct senses *senses, struct wants *wants);

/* The output was measured at the pair's joints: eq. 14 goes on from there. */
void tick_anchor(struct tick *tick, const struct pair *pair);

/* A behaviour gathered a pair: report it with the prediction made before it is learned, queue it
 * for learning unless the model is frozen, and let the context follow it. */
void tick_take_pair(struct tick *tick, const struct pair *pair, struct tick_outputs *outputs);

#endif
