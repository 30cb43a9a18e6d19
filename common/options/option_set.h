/* One option's value from text into its field: checked, and in the unit that programs reckon in. */
#ifndef REACH_COMMON_OPTIONS_OPTION_SET_H
#define REACH_COMMON_OPTIONS_OPTION_SET_H

#include "common/options/options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The items of a list, or the one of a single value. Returns 0, or -1 with one line in `error`. */
int option_set(const struct option_row *row, void *target, const char *const *items, int n_items,
               bool is_list, char *error, size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
