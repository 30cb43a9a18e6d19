#include "common/base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

struct arena {
    unsigned char *base;
    size_t size;
    size_t used;
};

size_t arena_footprint(size_t bytes)
{
    if (bytes > SIZE_MAX - (ARENA_ALIGNMENT - 1)) {
        return SIZE_MAX;
    }
    return (bytes + ARENA_ALIGNMENT - 1) / ARENA_ALIGNMENT * ARENA_ALIGNMENT;
}

struct arena *arena_create(size_t bytes)
{
    size_t size = arena_footprint(bytes > 0 ? bytes : 1);
    if (size == SIZE_MAX) {
        return NULL;
    }
    struct arena *arena = malloc(sizeof *arena);
    if (!arena) {
        return NULL;
    }
    arena->base = aligned_alloc(ARENA_ALIGNMENT, size);
    arena->size = size;
    arena->used = 0;
    if (!arena->base) {
        free(arena);
        return NULL;
    }
    memset(arena->base, 0, size);
    return arena;
}

void arena_destroy(struct arena *arena)
{
    if (arena) {
        free(arena->base);
        free(arena);
    }
}

void *arena_alloc(struct arena *arena, size_t bytes)
{
    size_t need = arena_footprint(bytes);
    if (need > arena->size - arena->used) {
        return NULL;
    }
    void *block = arena->base + arena->used;
    arena->used += need;
    return block;
}

int arena_lock(struct arena *arena, bool locked)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    size_t before = (page - (uintptr_t)arena->base % page) % page;
    size_t whole = arena->size > before ? (arena->size - before) / page * page : 0;

    return locked ? mlock(arena->base + before, whole) : munlock(arena->base + before, whole);
}

size_t arena_used(const struct arena *arena)
{
    return arena->used;
}
