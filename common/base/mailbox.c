#include "common/base/mailbox.h"

#include <stdatomic.h>
#include <string.h>

/* Writer's and reader's counters lie on cache lines of their own. */
struct mailbox {
    size_t record_size;
    uint32_t capacity;
    unsigned char *records;
    _Alignas(ARENA_ALIGNMENT) _Atomic uint32_t written;
    _Atomic uint64_t refused;
    _Alignas(ARENA_ALIGNMENT) _Atomic uint32_t taken;
};

size_t mailbox_memory(size_t record_size, uint32_t capacity)
{
    return arena_footprint(sizeof(struct mailbox)) + arena_footprint(record_size * capacity);
}

struct mailbox *mailbox_create(struct arena *arena, size_t record_size, uint32_t capacity)
{
    struct mailbox *mailbox = arena_alloc(arena, sizeof *mailbox);
    unsigned char *records = arena_alloc(arena, record_size * capacity);

    if (!mailbox || !records || (capacity & (capacity - 1)) != 0)
        return NULL;
    mailbox->record_size = record_size;
    mailbox->capacity = capacity;
    mailbox->records = records;
    return mailbox;
}

static unsigned char *slot(const struct mailbox *mailbox, uint32_t index)
{
    return mailbox->records + (size_t)(index & (mailbox->capacity - 1)) * mailbox->record_size;
}

bool mailbox_full(const struct mailbox *mailbox)
{
    return atomic_load_explicit(&mailbox->written, memory_order_relaxed) -
               atomic_load_explicit(&mailbox->taken, memory_order_acquire) ==
           mailbox->capacity;
}

bool mailbox_put(struct mailbox *mailbox, const void *record)
{
    uint32_t written = atomic_load_explicit(&mailbox->written, memory_order_relaxed);

    if (mailbox_full(mailbox)) {
        atomic_fetch_add_explicit(&mailbox->refused, 1, memory_order_relaxed);
        return false;
    }
    memcpy(slot(mailbox, written), record, mailbox->record_size);
    atomic_store_explicit(&mailbox->written, written + 1, memory_order_release);
    return true;
}

bool mailbox_peek(const struct mailbox *mailbox, void *record)
{
    uint32_t taken = atomic_load_explicit(&mailbox->taken, memory_order_relaxed);

    if (atomic_load_explicit(&mailbox->written, memory_order_acquire) == taken)
        return false;
    memcpy(record, slot(mailbox, taken), mailbox->record_size);
    return true;
}

bool mailbox_take(struct mailbox *mailbox, void *record)
{
    if (!mailbox_peek(mailbox, record))
        return false;
    atomic_fetch_add_explicit(&mailbox->taken, 1, memory_order_release);
    return true;
}

uint64_t mailbox_refused(const struct mailbox *mailbox)
{
    return atomic_load_explicit(&mailbox->refused, memory_order_relaxed);
}
