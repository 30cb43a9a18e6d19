/* What a real-time thread needs of the system. */
#ifndef REACH_REALTIME_H
#define REACH_REALTIME_H

#include <stddef.h>

#define REALTIME_PRIORITY 40 /* of the loop: over everything ordinary, under the kernel's own */

/* Locks all memory, present and future. Returns 0, or -1 with one line that names the remedy. */
int realtime_lock_memory(char *error, size_t error_size);

/* Makes the calling thread SCHED_FIFO, reads that back, and touches its stack so that no page
 * fault comes later. Returns 0, or -1 with one line that names the remedy. */
int realtime_enter(char *error, size_t error_size);

#endif
