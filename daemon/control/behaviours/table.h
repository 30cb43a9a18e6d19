/* All behaviours that there are. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_TABLE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_TABLE_H

#include "daemon/control/behaviours/behaviour.h"

/* Ends with NULL, as each such table. */
extern const struct behaviour_ops *const behaviour_table[];

/* The behaviour that a request of this kind starts, NULL when it starts none. */
const struct behaviour_ops *behaviour_find(const struct behaviour_ops *const *table, int8_t kind);

#endif
