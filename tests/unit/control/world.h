/* A robot without bodies and the control step that moves it, from nothing: what the tests of
 * behaviours share. There is one. */
#ifndef TESTS_UNIT_CONTROL_WORLD_H
#define TESTS_UNIT_CONTROL_WORLD_H

#include "daemon/config/config.h"
#include "daemon/control/tick.h"
#include "tools/bench/fake_robot.h"

#include <stdbool.h>
#include <stdint.h>

struct world {
    struct config config;
    struct arena *arena;
    struct tick *tick;
    struct fake_robot robot;
    struct tick_inputs inputs;
    struct tick_outputs outputs;
    int64_t request_seq;
    void (*watch)(void); /* looks at each decision before the robot obeys it; NULL = nobody */
};

extern struct world world;

/* `noise` of what is seen, px or m. No state has come yet. */
void world_begin(struct config config, double noise);
void world_end(void);

/* A tick, and the period after it. */
void world_step(void);

/* A tick on what world.inputs holds, and its report: nothing is learned, and nobody obeys. */
void world_decide(void);

/* The same with a state of now, or with the last one, and then the robot obeys. */
void world_tick(bool with_state);

/* A request for the next tick, under a number of its own. */
void world_prepare(reach_request_t request);

/* A step with a request. Returns its result, request_result of status_t. */
int world_ask(reach_request_t request);

/* Steps until the behaviour is over; ends the test when that takes more than so many ticks. */
void world_finish(int most_ticks);

/* Asks for it, which must be accepted, and goes on until it has ended, 20,000 ticks at most. */
void world_run(reach_request_t request);

/* The same of babbling that is learned. */
void world_babble(int count, int64_t seed);

#endif
