#include "daemon/realtime/due_observations.h"

#include <string.h>

void due_observations_init(struct due_observations *observations)
{
    memset(observations, 0, sizeof *observations);
}

static int find_waiting(const struct due_observations *observations, int64_t utime)
{
    for (int i = 0; i < observations->n; i++)
        if (observations->waiting[i].utime == utime)
            return i;
    return -1;
}

static int latest_waiting(const struct due_observations *observations)
{
    int index = 0;

    for (int i = 1; i < observations->n; i++)
        if (observations->waiting[i].utime > observations->waiting[index].utime)
            index = i;
    return index;
}

void due_observations_add(struct due_observations *observations,
                          const struct observation *observation)
{
    int last;

    if (observation->utime <= observations->newest ||
        find_waiting(observations, observation->utime) >= 0)
        return;
    if (observations->n < TICK_MAX_OBSERVATIONS) {
        observations->waiting[observations->n++] = *observation;
        return;
    }
    last = latest_waiting(observations);
    if (observation->utime < observations->waiting[last].utime)
        observations->waiting[last] = *observation;
}

bool due_observations_ready(const struct due_observations *observations, int64_t due)
{
    return due <= observations->newest || find_waiting(observations, due) >= 0;
}

bool due_observations_take(struct due_observations *observations, int64_t due,
                           struct observation *observation)
{
    int oldest = -1;

    for (int i = 0; i < observations->n; i++)
        if (observations->waiting[i].utime <= due &&
            (oldest < 0 || observations->waiting[i].utime < observations->waiting[oldest].utime))
            oldest = i;
    if (oldest < 0)
        return false;
    *observation = observations->waiting[oldest];
    observations->newest = observation->utime;
    observations->waiting[oldest] = observations->waiting[--observations->n];
    return true;
}
