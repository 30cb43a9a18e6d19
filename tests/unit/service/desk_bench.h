/* A desk with a small learner, on a disk in memory or on none, for tests of what it answers. */
#ifndef TESTS_UNIT_SERVICE_DESK_BENCH_H
#define TESTS_UNIT_SERVICE_DESK_BENCH_H

#include "learner/service/desk.h"
#include "tests/unit/store/store_bench.h"

#include <stdbool.h>
#include <stdint.h>

#define REPLY(name) REACH_LEARNER_REPLY_T_##name
#define REQUEST(name) REACH_LEARNER_REQUEST_T_##name

enum { CLIENT = 77, NOW = 5000000 /* us */ };

/* There is one of them at a time. */
struct desk_bench {
    struct store_bench bench;
    struct model_store_settings settings;
    struct desk *desk;
    struct desk_output output; /* of the newest answer */
};
extern struct desk_bench on;

/* Opens the desk, and makes CLIENT known to it; with the first snapshot made where there is a
 * directory. */
void desk_bench_open(struct model_store_settings settings);
/* One that keeps nothing. */
void desk_bench_forgetful(void);
/* One on a disk that is healthy and empty. */
void desk_bench_keeping(void);

/* The client's next request, about numbers that differ from those before. */
reach_learner_request_t desk_bench_request(int8_t kind);

/* Takes a request at NOW. */
enum desk_answer desk_bench_take(const reach_learner_request_t *request);

/* Takes a request that must be answered at once; its status. */
int desk_bench_status(const reach_learner_request_t *request);

/* Updates that must be done at once. */
void desk_bench_learn(int samples);

#endif
