/* Times that a call took, on the clock of the thread: what other programs do meanwhile does not
 * count. */
#ifndef REACH_TOOLS_MEASURE_DURATIONS_H
#define REACH_TOOLS_MEASURE_DURATIONS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct durations {
    size_t n;
    size_t room;
    double *us;
};

/* Of all that was added; NaN without any. A quantile is the smallest time that so great a share of
 * the calls did not exceed. */
struct durations_summary {
    size_t n;
    double mean, p50, p99, p999, max; /* us */
};

/* CLOCK_THREAD_CPUTIME_ID in nanoseconds. */
int64_t durations_clock(void);

/* Adds the time since `start`, a reading of durations_clock(). Ends the program when memory is out.
 */
void durations_add(struct durations *durations, int64_t start);

/* Sorts the times in place. */
struct durations_summary durations_summarise(struct durations *durations);

/* Forgets the times, keeps the memory. */
void durations_clear(struct durations *durations);

void durations_free(struct durations *durations);

#ifdef __cplusplus
}
#endif
#endif
