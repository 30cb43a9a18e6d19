/* A wait-free mailbox from one thread to another: a ring of records of one size.
 *
 * One thread puts, one takes; neither waits for the other, and neither allocates. A record that
 * does not fit is refused and counted: the taker drains the box every period, so a full box means
 * that the taker stands still. */
#ifndef REACH_COMMON_BASE_MAILBOX_H
#define REACH_COMMON_BASE_MAILBOX_H

#include "common/base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct mailbox;

/* Bytes that mailbox_create takes from an arena. */
size_t mailbox_memory(size_t record_size, uint32_t capacity);

/* A mailbox for `capacity` records (a power of two), owned by the arena; NULL when it is full. */
struct mailbox *mailbox_create(struct arena *arena, size_t record_size, uint32_t capacity);

/* Copies a record in. Returns false, and counts it, when the box is full. */
bool mailbox_put(struct mailbox *mailbox, const void *record);

/* Copies the oldest record out. Returns false when the box is empty. */
bool mailbox_take(struct mailbox *mailbox, void *record);

/* Copies the oldest record out and leaves it in. Returns false when the box is empty. */
bool mailbox_peek(const struct mailbox *mailbox, void *record);

/* Whether the putting thread would be refused. */
bool mailbox_full(const struct mailbox *mailbox);

/* Records refused so far. */
uint64_t mailbox_refused(const struct mailbox *mailbox);

#endif
