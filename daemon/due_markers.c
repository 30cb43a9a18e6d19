#include "due_markers.h"

#include <string.h>

void due_markers_init(struct due_markers *markers)
{
    memset(markers, 0, sizeof *markers);
}

static int find(const struct due_markers *markers, int64_t utime)
{
    for (int i = 0; i < markers->n; i++)
        if (markers->waiting[i].utime == utime)
            return i;
    return -1;
}

static int latest(const struct due_markers *markers)
{
    int index = 0;

    for (int i = 1; i < markers->n; i++)
        if (markers->waiting[i].utime > markers->waiting[index].utime)
            index = i;
    return index;
}

void due_markers_add(struct due_markers *markers, const reach_marker_t *marker)
{
    int last;

    if (marker->utime <= markers->newest || find(markers, marker->utime) >= 0)
        return;
    if (markers->n < TICK_MAX_MARKERS) {
        markers->waiting[markers->n++] = *marker;
        return;
    }
    last = latest(markers);
    if (marker->utime < markers->waiting[last].utime)
        markers->waiting[last] = *marker;
}

bool due_markers_ready(const struct due_markers *markers, int64_t due)
{
    return due <= markers->newest || find(markers, due) >= 0;
}

bool due_markers_take(struct due_markers *markers, int64_t due, reach_marker_t *marker)
{
    int oldest = -1;

    for (int i = 0; i < markers->n; i++)
        if (markers->waiting[i].utime <= due &&
            (oldest < 0 || markers->waiting[i].utime < markers->waiting[oldest].utime))
            oldest = i;
    if (oldest < 0)
        return false;
    *marker = markers->waiting[oldest];
    markers->newest = marker->utime;
    markers->waiting[oldest] = markers->waiting[--markers->n];
    return true;
}
