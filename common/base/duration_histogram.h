/* Running statistics of durations, in constant memory: last, mean, maximum, quantiles. */
#ifndef REACH_COMMON_BASE_DURATION_HISTOGRAM_H
#define REACH_COMMON_BASE_DURATION_HISTOGRAM_H

#include <stdint.h>

#define TIMING_BUCKETS 512

/* Buckets grow by 5 % each, from 0.1 us to some hours. */
struct timing {
    double last, sum, max; /* us */
    uint64_t count;
    uint32_t bucket[TIMING_BUCKETS];
};

void timing_add(struct timing *timing, double microseconds);

/* Upper end of the bucket in which the quantile (0 .. 1) lies, at most the maximum; us. */
double timing_quantile(const struct timing *timing, double quantile);

double timing_mean(const struct timing *timing);

#endif
