#include "common/base/duration_histogram.h"

#include <math.h>

static const double least = 0.1;   /* us, end of the first bucket */
static const double growth = 1.05; /* from one bucket's end to the next's */

void timing_add(struct timing *timing, double microseconds)
{
    double place = microseconds > least ? ceil(log(microseconds / least) / log(growth)) : 0;
    int index = place < TIMING_BUCKETS - 1 ? (int)place : TIMING_BUCKETS - 1;

    timing->bucket[index]++;
    timing->count++;
    timing->last = microseconds;
    timing->sum += microseconds;
    timing->max = fmax(timing->max, microseconds);
}

double timing_quantile(const struct timing *timing, double quantile)
{
    double wanted = quantile * (double)timing->count;
    uint64_t below = 0;

    for (int i = 0; i < TIMING_BUCKETS; i++) {
        below += timing->bucket[i];
        if ((double)below >= wanted && below > 0)
            return fmin(least * pow(growth, i), timing->max);
    }
    return timing->max;
}

double timing_mean(const struct timing *timing)
{
    return timing->count > 0 ? timing->sum / (double)timing->count : 0;
}
