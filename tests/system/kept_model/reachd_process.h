/* A real reachd as a child process, and its --check-model. */
#ifndef REACH_TEST_REACHD_PROCESS_H
#define REACH_TEST_REACHD_PROCESS_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

/* Options that every call gets: --config, --set. Kept, not copied; ends with NULL. */
struct reachd_process {
    const char *program;
    const char *const *options;
    const char *log; /* file that its stderr is appended to */
    pid_t pid;
};

void reachd_process_start(struct reachd_process *process);

/* Sends a signal and waits for the end. Returns what waitpid said. */
int reachd_process_end(struct reachd_process *process, int signal);

/* Whether it has ended by itself. */
bool reachd_process_ended(const struct reachd_process *process);

/* Returns false when it refuses; says why on stderr. */
bool reachd_process_check(const struct reachd_process *process, uint64_t *samples, uint64_t *hash);

#endif
