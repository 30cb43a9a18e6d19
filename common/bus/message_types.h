/* The types of messages that this version knows, by fingerprint and by channel. */
#ifndef REACH_COMMON_BUS_MESSAGE_TYPES_H
#define REACH_COMMON_BUS_MESSAGE_TYPES_H

#include <lcm/lcm_coretypes.h>
#include <stdbool.h>
#include <stdint.h>

struct message_type {
    const char *name;    /* "reach.status_t" */
    const char *channel; /* where it is sent; a type of two channels has two entries */
    int64_t (*fingerprint)(void);
    const lcm_type_info_t *(*info)(void);
};

/* The type of the messages of a channel; NULL: none of ours. */
const struct message_type *message_type_of_channel(const char *channel);

/* Whether two entries are of one type. */
bool message_type_same(const struct message_type *a, const struct message_type *b);

/* The type of a message, by the fingerprint that it begins with; NULL: none of ours. */
const struct message_type *message_type_of(const void *data, size_t size);

#endif
