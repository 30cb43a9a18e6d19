/* One bump arena: memory that is taken once, at start, and never given back.
 *
 * The control loop may not allocate. Whoever needs memory takes it from an
 * arena while the daemon starts; the arena's size is known and can be printed
 * and locked as a whole.
 */
#ifndef REACH_COMMON_BASE_ARENA_H
#define REACH_COMMON_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every block begins at a multiple of this (a cache line, and the widest
 * vector register). */
#define ARENA_ALIGNMENT 64

struct arena;

/* Takes `bytes` (rounded up to the alignment) from the system and sets them
 * to zero, which also touches every page. Returns NULL when the system
 * refuses. The caller owns the arena. */
struct arena *arena_create(size_t bytes);

/* Gives everything back; NULL is allowed. All blocks die with the arena. */
void arena_destroy(struct arena *arena);

/* The next block of `bytes`, aligned, zeroed, owned by the arena. Returns
 * NULL when the arena is exhausted, and then leaves it as it was. */
void *arena_alloc(struct arena *arena, size_t bytes);

/* What a block of `bytes` takes from an arena; SIZE_MAX when that cannot be
 * represented. Sums of this predict the size that arena_create() needs. */
size_t arena_footprint(size_t bytes);

/* Locks the arena's whole pages into memory, or lets them go again. Returns 0, or -1 with errno. */
int arena_lock(struct arena *arena, bool locked);

/* Bytes taken so far. */
size_t arena_used(const struct arena *arena);

#ifdef __cplusplus
}
#endif
#endif
