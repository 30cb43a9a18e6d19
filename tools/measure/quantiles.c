#include "tools/measure/quantiles.h"

#include <math.h>
#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    double left = *(const double *)a;
    double right = *(const double *)b;

    return (left > right) - (left < right);
}

void quantiles_sort(double *numbers, size_t n)
{
    if (n > 0)
        qsort(numbers, n, sizeof *numbers, compare);
}

double quantile(const double *sorted, size_t n, double share)
{
    double rank = ceil(share * (double)n);

    if (n == 0)
        return NAN;
    return sorted[rank < 1 ? 0 : (size_t)rank - 1];
}
