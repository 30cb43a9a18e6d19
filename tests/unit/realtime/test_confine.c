/* A confined thread computes, sleeps and posts; another system call does not happen, and is told.
 */
#include "common/base/thread.h"
#include "daemon/realtime/confine.h"
#include "tests/unit/suite.h"

#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdbool.h>
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

    *(int *)user = confine_thread(false, error, sizeof error);
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
    if (confine_thread(false, error, sizeof error) == 0 && write(ends[1], "x", 1) == 1)
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

static pthread_mutex_t held = PTHREAD_MUTEX_INITIALIZER;

/* Takes a lock that another thread holds. */
static void *lock(void *user)
{
    char error[200];

    if (confine_thread(*(bool *)user, error, sizeof error) == 0 && pthread_mutex_lock(&held) == 0)
        sem_post(&posted);
    return NULL;
}

static void lock_what_is_held(bool waits)
{
    pthread_t thread;

    sem_init(&posted, 0, 0);
    ck_assert_int_eq(pthread_mutex_lock(&held), 0);
    ck_assert_int_eq(pthread_create(&thread, NULL, lock, &waits), 0);
    for (int i = 0; i < (waits ? 50 : 2000) && confine_violation() < 0; i++)
        clock_nanosleep(CLOCK_MONOTONIC, 0, &moment, NULL);
    ck_assert_int_eq(sem_trywait(&posted), -1);
}

START_TEST(a_lock_that_waits_does_not_happen_in_real_time)
{
    lock_what_is_held(false);
    ck_assert_int_eq(confine_violation(), SYS_futex);
}
END_TEST

START_TEST(what_waits_in_lockstep_is_allowed)
{
    lock_what_is_held(true);
    ck_assert_int_eq(confine_violation(), -1);
    pthread_mutex_unlock(&held);
    ck_assert_int_eq(sem_wait(&posted), 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        what_the_loop_needs_is_allowed, a_write_does_not_happen_and_is_told,
        a_lock_that_waits_does_not_happen_in_real_time, what_waits_in_lockstep_is_allowed};

    return SUITE_RUN("confine", tests);
}
