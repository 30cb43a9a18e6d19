#include "common/base/thread.h"

#include <errno.h>
#include <malloc.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

void thread_limit_memory(void)
{
    pthread_attr_t attributes;

    mallopt(M_ARENA_MAX, 1);
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, THREAD_STACK);
    pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
}

int thread_lock_memory(char *error, size_t error_size)
{
    if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
        return 0;
    snprintf(error, error_size,
             "cannot lock memory: %s; raise LimitMEMLOCK (ulimit -l), or use --no-rt",
             strerror(errno));
    return -1;
}

static int policy_of(int priority)
{
    return priority > 0 ? SCHED_FIFO : SCHED_OTHER;
}

static int refused(int priority, int failed, char *error, size_t error_size)
{
    if (priority > 0)
        snprintf(error, error_size,
                 "cannot run at real-time priority %d: %s; grant CAP_SYS_NICE or LimitRTPRIO, or "
                 "use --no-rt",
                 priority, failed ? strerror(failed) : "the system kept another policy");
    else
        snprintf(error, error_size, "cannot start a thread: %s", strerror(failed));
    return -1;
}

int thread_enter(int priority, char *error, size_t error_size)
{
    struct sched_param parameters = {.sched_priority = priority};
    int policy = 0;
    int failed = pthread_setschedparam(pthread_self(), policy_of(priority), &parameters);

    if (!failed)
        failed = pthread_getschedparam(pthread_self(), &policy, &parameters);
    if (failed || policy != policy_of(priority) || parameters.sched_priority != priority)
        return refused(priority, failed, error, error_size);
    return 0;
}

int thread_start(pthread_t *thread, int priority, void *(*start)(void *), void *user, char *error,
                 size_t error_size)
{
    struct sched_param parameters = {.sched_priority = priority};
    /* An ordinary thread of an ordinary one needs no call that a service may have been denied. */
    bool inherits = priority == 0 && sched_getscheduler(0) == SCHED_OTHER;
    pthread_attr_t attributes;
    int failed;

    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, THREAD_STACK);
    pthread_attr_setinheritsched(&attributes,
                                 inherits ? PTHREAD_INHERIT_SCHED : PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attributes, policy_of(priority));
    pthread_attr_setschedparam(&attributes, &parameters);
    failed = pthread_create(thread, &attributes, start, user);
    pthread_attr_destroy(&attributes);
    return failed ? refused(priority, failed, error, error_size) : 0;
}

void thread_touch_stack(void)
{
    unsigned char pages[THREAD_STACK_TOUCHED];

    explicit_bzero(pages, sizeof pages);
}

int64_t thread_page_faults(void)
{
    struct rusage usage;

    if (getrusage(RUSAGE_THREAD, &usage))
        return 0;
    return usage.ru_minflt + usage.ru_majflt;
}

void sleep_until(int64_t ns)
{
    const struct timespec due = {.tv_sec = ns / 1000000000, .tv_nsec = ns % 1000000000};

    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL) == EINTR)
        ;
}
