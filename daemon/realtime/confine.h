/* Which system calls the loop thread may make: a short list in confine.c, and no other.
 *
 * The promise "no memory from the system, no file, no socket in the loop" is kept by the kernel
 * (seccomp): a call that is not on the list does not happen. The thread then stands still for good,
 * the watchdog (watchdog.h) stops the arm, says which call it was and ends the process, so that a
 * supervisor can start a healthy one. In real time a futex may
 * wake another thread and not wait, so that a lock which is held by somebody ends the loop, too. In
 * lockstep the loop waits for messages; that it takes no lock then is shown by
 * tools/dev/loop_stack.py. */
#ifndef REACH_DAEMON_REALTIME_CONFINE_H
#define REACH_DAEMON_REALTIME_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

/* Confines the calling thread until it ends. `waits`: it may wait for another thread (lockstep).
 * Returns 0, or -1 with one line in `error`. Does nothing under the sanitizers, whose runtime makes
 * calls of its own. */
int confine_thread(bool waits, char *error, size_t error_size);

/* The number of the forbidden system call that a confined thread made, -1 = none. From any thread.
 */
int confine_violation(void);

#endif
