/* `reachctl echo`: the messages of a channel as text. */
#ifndef REACHCTL_VIEW_ECHO_H
#define REACHCTL_VIEW_ECHO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Writes a message as one line of JSON: its channel, its type, and every field. One that is not
 * ours or cannot be decoded is told by its size. */
void echo_message(const char *channel, const void *data, size_t size, FILE *out);

/* Prints what comes on channels whose whole name matches the pattern, until the program is ended,
 * or `once` one message. Returns 0, or -1 with one line in `error`: none came within `timeout`
 * seconds. */
int echo_run(const char *url, const char *pattern, bool once, double timeout, char *error,
             size_t error_size);

#endif
