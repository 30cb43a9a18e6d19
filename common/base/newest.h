/* The newest record from one thread to another: what is put replaces what was not taken.
 *
 * One thread puts, one takes; neither waits for the other, and neither allocates. */
#ifndef REACH_COMMON_BASE_NEWEST_H
#define REACH_COMMON_BASE_NEWEST_H

#include "common/base/arena.h"

#include <stdbool.h>
#include <stddef.h>

struct newest;

/* Bytes that newest_create takes from an arena. */
size_t newest_memory(size_t record_size);

/* Room for records of this size, owned by the arena; NULL when it is full. */
struct newest *newest_create(struct arena *arena, size_t record_size);

/* Copies a record in. */
void newest_put(struct newest *newest, const void *record);

/* Copies the newest record out. Returns false when none was put since it was last taken. */
bool newest_take(struct newest *newest, void *record);

#endif
