/* Numbers and the ranges that they must be in: what every kind of learner checks its parameters
 * with. */
#ifndef REACH_LEARNER_BASE_RANGES_H
#define REACH_LEARNER_BASE_RANGES_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A row and the range that its number must be in. */
struct learner_range {
    const char *name;
    double value;
    double minimum;
    double maximum;
};

/* 0, or -1 and a line in err for the first that is out of range or NaN. */
int learner_check_ranges(const struct learner_range *ranges, size_t n, char *err, size_t err_size);

/* The same of a whole array of them. */
#define LEARNER_CHECK_RANGES(ranges, err, err_size)                                                \
    learner_check_ranges(ranges, sizeof(ranges) / sizeof((ranges)[0]), err, err_size)

#ifdef __cplusplus
}
#endif
#endif
