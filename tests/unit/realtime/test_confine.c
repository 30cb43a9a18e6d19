/* A confined thread computes, sleeps and posts; another system call does not happen, and is told.
 */
#include "common/base/thread.h"
#include "daemon/realtime/confine.h"
#include "tests/unit/suite.h"

#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const struct timespec moment = {.tv_nsec = 1000000};

static int ends[2];
static sem_t posted;

static void *behave(void *user)
{
    char error[200];
    struct timespec now;

    *(int *)user = confine_thread(error, sizeof error);
    clock_nanosleep(CLOCK_MONOTONIC, 0, &moment, NULL);
    clock_gettime(CLOCK_MONOTONIC, &now);
    thread_page_faults();
    sem_post(&posted);
    return NULL;
}

START_TEST(what_the_loop_needs_is_allowed)
{
    pthread_t thread;
    int result = -1;

    sem_init(&posted, 0, 0);
    ck_assert_int_eq(pthread_create(&thread, NULL, behave, &result), 0);
    sem_wait(&posted);
    pthread_join(thread, NULL);
    ck_assert_int_eq(result, 0);
    ck_assert_int_eq(confine_violation(), -1);
}
END_TEST

static void *misbehave(void *user)
{
    char error[200];

    (void)user;
    if (confine_thread(error, sizeof error) == 0 && write(ends[1], "x", 1) == 1)
        sem_post(&posted);
    return NULL;
}

START_TEST(a_write_does_not_happen_and_is_told)
{
    char byte;
    pthread_t thread;

    sem_init(&posted, 0, 0);
    ck_assert_int_eq(pipe2(ends, O_NONBLOCK), 0);
    ck_assert_int_eq(pthread_create(&thread, NULL, misbehave, NULL), 0);
    for (int i = 0; i < 2000 && confine_violation() < 0; i++)
        clock_nanosleep(CLOCK_MONOTONIC, 0, &moment, NULL);
    ck_assert_int_eq(confine_violation(), SYS_write);
    ck_assert_int_eq(read(ends[0], &byte, 1), -1);
    ck_assert_int_eq(sem_trywait(&posted), -1);
    /* The rest of the process is free: this thread has read and will write its verdict. */
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_the_loop_needs_is_allowed,
                                  a_write_does_not_happen_and_is_told};

    return SUITE_RUN("confine", tests);
}
