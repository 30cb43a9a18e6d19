/* What real-time threads need of the system. */
#ifndef REACH_COMMON_BASE_THREAD_H
#define REACH_COMMON_BASE_THREAD_H

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* SCHED_FIFO priorities: over everything ordinary, under the kernel's own. The watchdog looks even
 * when the loop never sleeps; the bus must not wait behind ordinary load, but never delays the
 * loop. */
#define THREAD_PRIORITY_WATCHDOG 41
#define THREAD_PRIORITY_LOOP 40
#define THREAD_PRIORITY_BUS 39

/* Of every thread of the daemon; all of it is locked memory in real time. */
#define THREAD_STACK (512 * 1024)
/* What the loop may use of it; tools/dev/loop_stack.py shows at compile time that it uses less. */
#define THREAD_STACK_TOUCHED (256 * 1024)

/* Bounds what will be locked beside the arena: THREAD_STACK for threads that libraries will
 * start, one heap for all threads instead of 64 MB of addresses for each. Before any thread starts.
 */
void thread_limit_memory(void);

/* Locks all memory, present and future. Returns 0, or -1 with one line that names the remedy. */
int thread_lock_memory(char *error, size_t error_size);

/* The calling thread from now on, and threads that libraries start from it: SCHED_FIFO at
 * `priority`, or ordinary when that is 0; reads back what the system made of it. Returns 0, or -1
 * with one line that names the remedy. */
int thread_enter(int priority, char *error, size_t error_size);

/* Starts a thread at `priority`, as above. Returns 0, or -1 with one line that names the remedy. */
int thread_start(pthread_t *thread, int priority, void *(*start)(void *), void *user, char *error,
                 size_t error_size);

/* Touches the calling thread's stack, so that no page fault comes later. */
void thread_touch_stack(void);

/* Page faults of the calling thread so far, with and without a disk. */
int64_t thread_page_faults(void);

/* Until CLOCK_MONOTONIC says `ns`; signals do not end it. */
void sleep_until(int64_t ns);

#ifdef __cplusplus
}
#endif

#endif
