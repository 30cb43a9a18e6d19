/* Kills a process at an instant that nothing else in the test knows of: after some time, or, from
 * then on, in the midst of the next file that is written aside in a directory. */
#ifndef REACH_TEST_KILLER_H
#define REACH_TEST_KILLER_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

struct killer {
    pid_t pid;
    int64_t after_us;
    const char *directory; /* NULL: right then */
    int64_t into_us;       /* so long after the file was made */
    pthread_t thread;
};

void killer_start(struct killer *killer);
void killer_join(struct killer *killer);

/* Whether a file *.new is in the directory: its writer did not come to its end. */
bool killer_left_a_file(const char *directory);

#endif
