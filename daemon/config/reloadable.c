#include "daemon/config/reloadable.h"

#include "daemon/config/table.h"

#include <stdio.h>
#include <string.h>

/* What may change; a name that ends in '.' stands for all that begin so. */
static const char *const live[] = {
    "eyes.doubt",
    "eyes.stale",
    "motion.",
    "head.gain",
    "head.smoothing",
    "head.search_velocity",
    "fixation.",
    "babble.",
    "practice.",
    "explore.",
    "head.search_dwell",
    "task.gain",
    "task.smoothing",
    "task.follow_gain",
    "task.secondary_gain",
    "task.singular_threshold",
    "task.damping_max",
    "learner.quota",
};

static bool may_change(const char *name)
{
    for (size_t i = 0; i < sizeof live / sizeof live[0]; i++) {
        size_t length = strlen(live[i]);
        if (strncmp(name, live[i], length) == 0 &&
            (live[i][length - 1] == '.' || name[length] == '\0'))
            return true;
    }
    return false;
}

bool config_reloadable(const struct config *from, const struct config *to, int *changes,
                       char *error, size_t error_size)
{
    char before[OPTION_TEXT_SIZE], after[OPTION_TEXT_SIZE];

    *changes = 0;
    for (const struct option_row *row = config_table(); row->name; row++) {
        option_text(row, from, before);
        option_text(row, to, after);
        if (strcmp(before, after) == 0)
            continue;
        ++*changes;
        if (may_change(row->name))
            continue;
        snprintf(error, error_size,
                 "%s cannot change from %.60s to %.60s while the daemon runs; restart it",
                 row->name, before, after);
        return false;
    }
    return true;
}
