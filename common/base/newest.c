#include "common/base/newest.h"

#include <stdatomic.h>
#include <string.h>

enum { SLOTS = 3, FRESH = 4 /* added to the slot between the two while it is not taken */ };

/* Each of three slots is the writer's, the reader's, or between them; both only ever exchange
 * theirs for the one between, so that nobody meets another in a slot. */
struct newest {
    size_t record_size;
    unsigned char *slots;
    unsigned written, read; /* the writer's slot, the reader's */
    _Atomic unsigned between;
};

size_t newest_memory(size_t record_size)
{
    return arena_footprint(sizeof(struct newest)) + arena_footprint(SLOTS * record_size);
}

struct newest *newest_create(struct arena *arena, size_t record_size)
{
    struct newest *newest = arena_alloc(arena, sizeof *newest);
    unsigned char *slots = arena_alloc(arena, SLOTS * record_size);

    if (!newest || !slots)
        return NULL;
    newest->record_size = record_size;
    newest->slots = slots;
    newest->written = 1;
    newest->read = 2;
    return newest;
}

void newest_put(struct newest *newest, const void *record)
{
    memcpy(newest->slots + newest->written * newest->record_size, record, newest->record_size);
    newest->written =
        atomic_exchange_explicit(&newest->between, newest->written | FRESH, memory_order_acq_rel) &
        ~(unsigned)FRESH;
}

bool newest_take(struct newest *newest, void *record)
{
    if (!(atomic_load_explicit(&newest->between, memory_order_relaxed) & FRESH))
        return false;
    newest->read = atomic_exchange_explicit(&newest->between, newest->read, memory_order_acq_rel) &
                   ~(unsigned)FRESH;
    memcpy(record, newest->slots + newest->read * newest->record_size, newest->record_size);
    return true;
}
