/* What the control path of one tick costs: from the newest state to the command that leaves, on a
 * robot without bodies that reaches with a mixture of many linear experts. */
#ifndef REACH_BENCH_TICK_H
#define REACH_BENCH_TICK_H

#include <stddef.h>

#include "tools/measure/durations.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Teaches a daemon of the shipped configuration until its learner has `experts`, then adds the
 * times of `calls` ticks in which it reaches for targets. returns 0, or -1 with one line in `error`
 */
int tick_bench(int experts, int calls, struct durations *times, char *error, size_t error_size);

/* Leaves in `directory` the model of such a daemon with `experts`, from which a reachd with the
 * same options starts. returns 0, or -1 with one line in `error` */
int tick_prime(const char *directory, int experts, char *error, size_t error_size);

#ifdef __cplusplus
}
#endif
#endif
