#include "learner/base/ranges.h"

#include <stdio.h>

int learner_check_ranges(const struct learner_range *ranges, size_t n, char *err, size_t err_size)
{
    for (size_t i = 0; i < n; i++) {
        const struct learner_range *r = &ranges[i];
        /* Written so that NaN is refused. */
        if (r->value >= r->minimum && r->value <= r->maximum)
            continue;
        snprintf(err, err_size, "%s is %g: must be between %g and %g", r->name, r->value,
                 r->minimum, r->maximum);
        return -1;
    }
    return 0;
}
