/* One control step: what, not when. A function of (state, inputs, now) that reads no clock, does no
 * input or output and allocates nothing.
 *
 * A tick has three calls, in this order: tick_decide makes the command, which can leave at once;
 * tick_learn spends what is left of the period; tick_report says what happened. */
#ifndef REACH_DAEMON_CONTROL_TICK_H
#define REACH_DAEMON_CONTROL_TICK_H

#include "common/base/arena.h"
#include "daemon/config/config.h"
#include "daemon/control/model_port.h"
#include "daemon/control/senses/observation.h"

#include <reach_request_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_sample_t.h>
#include <reach_status_t.h>
#include <reach_trace_t.h>
#include <stdbool.h>

#define TICK_MAX_OBSERVATIONS 8
#define TICK_MAX_REQUESTS 8

/* What has come since the tick before, in order of arrival. */
struct tick_inputs {
    const struct config *config; /* works with this one from now on; NULL = with the one it has */
    bool has_state;
    reach_robot_state_t state;
    uint32_t state_checksum; /* of the message, for the trace */
    double state_age; /* of the newest state ever received, good or bad, s; INFINITY = none yet */
    int n_observations;
    struct observation observation[TICK_MAX_OBSERVATIONS];
    int n_requests;
    reach_request_t request[TICK_MAX_REQUESTS];
    uint32_t request_checksum[TICK_MAX_REQUESTS];
    bool overrunning; /* the loop was late too often */
    bool emergency;   /* somebody wants the arm stopped at once */
    int crossed;      /* states since the last tick, good ones, that crossed (senses/senders.h) */
    int braked;       /* braking commands that the watchdog sent since the last tick */
    int64_t slipped;  /* periods that went by without a tick since the last one */
    bool robot_rests; /* no command went out for so long that the robot stopped by itself */
    int64_t unseen;   /* ticks before this one that a replay lost; their numbers are skipped */
};

struct tick_outputs {
    bool has_command;
    reach_robot_command_t command;
    bool has_sample;
    reach_sample_t sample;
    reach_status_t status; /* fields of time (compute, wake-up, overruns) are the loop's to fill */
    reach_trace_t trace;   /* `refused` is the loop's to fill, checksums are the sender's */
};

struct tick;
struct behaviour_ops;

struct tick_settings {
    const struct config *config; /* kept, not copied */
    struct model_port model;     /* who keeps what is learned; stays the caller's */
    /* What can be asked for; ends with NULL. NULL = behaviour_table (behaviours/table.h). */
    const struct behaviour_ops *const *behaviours;
};

/* Bytes that tick_create takes from an arena. */
size_t tick_memory(const struct config *config);

/* Everything of the control step, owned by the arena. `settings` is copied.
 * Returns NULL with one line in `error`. */
struct tick *tick_create(const struct tick_settings *settings, struct arena *arena, char *error,
                         size_t error_size);

/* Between two ticks: the learner, for whoever has a model for it or wants its state. */
struct learner *tick_learner(struct tick *tick);

/* Senses, supervises, decides. Fills command and sample. `now` is the time of stamps, us since the
 * epoch; durations are counted in periods, so that a clock that is set changes none. */
void tick_decide(struct tick *tick, const struct tick_inputs *inputs, int64_t now,
                 struct tick_outputs *outputs);

/* Learns one sample of those that wait. Returns false when none does, or when there is no room to
 * keep it: learning then waits, control does not. */
bool tick_learn(struct tick *tick);

/* Whether a sample waits for room to be kept, or a request for a model that is saved or loaded. */
bool tick_awaits_store(const struct tick *tick);

/* Fills status and trace of the tick just decided. */
void tick_report(struct tick *tick, int64_t now, struct tick_outputs *outputs);

#endif
