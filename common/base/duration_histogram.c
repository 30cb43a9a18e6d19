#include "common/base/duration_histogram.h"

#include <math.h>

static const double least = 0.1;   /* us, end of the first bucket */
static const double growth = 1.05; /* from one bucket's end to the next's */

void duration_histogram_add(struct duration_histogram *histogram, double microseconds)
{
    double place = microseconds > least ? ceil(log(microseconds / least) / log(growth)) : 0;
    int index =
        place < DURATION_HISTOGRAM_BUCKETS - 1 ? (int)place : DURATION_HISTOGRAM_BUCKETS - 1;

    histogram->bucket[index]++;
    histogram->count++;
    histogram->last = microseconds;
    histogram->sum += microseconds;
    histogram->max = fmax(histogram->max, microseconds);
}

double duration_histogram_quantile(const struct duration_histogram *histogram, double quantile)
{
    double wanted = quantile * (double)histogram->count;
    uint64_t below = 0;

    for (int i = 0; i < DURATION_HISTOGRAM_BUCKETS; i++) {
        below += histogram->bucket[i];
        if ((double)below >= wanted && below > 0)
            return fmin(least * pow(growth, i), histogram->max);
    }
    return histogram->max;
}

double duration_histogram_mean(const struct duration_histogram *histogram)
{
    return histogram->count > 0 ? histogram->sum / (double)histogram->count : 0;
}
