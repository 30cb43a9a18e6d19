#include "daemon/control/behaviours/table.h"

/* A row for each: the name of its ops. */
#define BEHAVIOURS(ROW)                                                                            \
    ROW(behaviour_babble)                                                                          \
    ROW(behaviour_check_motors)                                                                    \
    ROW(behaviour_coordinate)                                                                      \
    ROW(behaviour_explore)                                                                         \
    ROW(behaviour_reach)

#define DECLARE(ops) extern const struct behaviour_ops ops;
#define POINT_TO(ops) &(ops),

BEHAVIOURS(DECLARE)

const struct behaviour_ops *const behaviour_table[] = {BEHAVIOURS(POINT_TO) NULL};

const struct behaviour_ops *behaviour_find(const struct behaviour_ops *const *table, int8_t kind)
{
    for (; *table; table++)
        if ((*table)->kind == kind)
            return *table;
    return NULL;
}
