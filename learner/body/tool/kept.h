/* Samples that are kept, spread over the joints: no two are nearer to each other than `spacing` in
 * every joint. A sample near a kept one is left out, or takes its place when that one is old, so
 * that what is kept follows the robot; when the room is full, any of them makes
 * room, and the spacing grows a little. */
#ifndef REACH_LEARNER_BODY_TOOL_KEPT_H
#define REACH_LEARNER_BODY_TOOL_KEPT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct kept {
    int n;
    int capacity;
    int n_inputs, n_outputs;
    double spacing; /* rad */
    double *z;      /* n rows of n_inputs */
    double *x;      /* n rows of n_outputs */
    double *at;     /* n: how many had been offered before */
    double offered;
};

/* Doubles that `capacity` samples take. */
size_t kept_numbers(int capacity, int n_inputs, int n_outputs);

/* Keeps nothing, in that many numbers. */
void kept_place(struct kept *kept, int capacity, int n_inputs, int n_outputs, double *numbers);

void kept_clear(struct kept *kept);

/* Keeps z -> x. Time O(capacity). */
void kept_add(struct kept *kept, const double *z, const double *x);

/* The kept sample whose joints are nearest to z; -1 when there is none. */
int kept_nearest(const struct kept *kept, const double *z);

/* The one whose output is nearest to x, in units of `unit`. */
int kept_nearest_output(const struct kept *kept, const double *x, const double *unit);

#ifdef __cplusplus
}
#endif
#endif
