/* Quantiles of numbers. */
#ifndef REACH_TOOLS_MEASURE_QUANTILES_H
#define REACH_TOOLS_MEASURE_QUANTILES_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Ascending, in place. */
void quantiles_sort(double *numbers, size_t n);

/* The smallest of the sorted numbers that `share` (0 .. 1) of them do not exceed; NaN of none. */
double quantile(const double *sorted, size_t n, double share);

#ifdef __cplusplus
}
#endif
#endif
