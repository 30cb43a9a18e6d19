#include "realtime.h"

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>

#define STACK_TO_TOUCH (256 * 1024)

int realtime_lock_memory(char *error, size_t error_size)
{
    if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
        return 0;
    snprintf(error, error_size,
             "cannot lock memory: %s; raise LimitMEMLOCK (ulimit -l), or use --no-rt",
             strerror(errno));
    return -1;
}

static void touch_stack(void)
{
    unsigned char pages[STACK_TO_TOUCH];

    explicit_bzero(pages, sizeof pages);
}

int realtime_enter(char *error, size_t error_size)
{
    struct sched_param parameters = {.sched_priority = REALTIME_PRIORITY};
    int policy = 0;
    int failed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);

    if (!failed)
        failed = pthread_getschedparam(pthread_self(), &policy, &parameters);
    if (failed || policy != SCHED_FIFO || parameters.sched_priority != REALTIME_PRIORITY) {
        snprintf(error, error_size,
                 "cannot run at real-time priority %d: %s; grant CAP_SYS_NICE or LimitRTPRIO, or "
                 "use --no-rt",
                 REALTIME_PRIORITY, failed ? strerror(failed) : "the system kept another policy");
        return -1;
    }
    touch_stack();
    return 0;
}
