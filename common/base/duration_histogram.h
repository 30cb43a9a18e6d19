/* Running statistics of durations, in constant memory: last, mean, maximum, quantiles. */
#ifndef REACH_COMMON_BASE_DURATION_HISTOGRAM_H
#define REACH_COMMON_BASE_DURATION_HISTOGRAM_H

#include <stdint.h>

#define DURATION_HISTOGRAM_BUCKETS 512

/* Buckets grow by 5 % each, from 0.1 us to some hours. */
struct duration_histogram {
    double last, sum, max; /* us */
    uint64_t count;
    uint32_t bucket[DURATION_HISTOGRAM_BUCKETS];
};

void duration_histogram_add(struct duration_histogram *histogram, double microseconds);

/* Upper end of the bucket in which the quantile (0 .. 1) lies, at most the maximum; us. */
double duration_histogram_quantile(const struct duration_histogram *histogram, double quantile);

double duration_histogram_mean(const struct duration_histogram *histogram);

#endif
