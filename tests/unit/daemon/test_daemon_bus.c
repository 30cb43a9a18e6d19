/* The daemon's side of the bus when the clock is set, or a thread cannot be had. In its own network
 * namespace. */
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "daemon/bus/bus.h"
#include "tests/unit/suite.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static int64_t ahead; /* of the true wall clock, s */
static int threads_left = 1000;

/* In the place of the C library's: a wall clock that can be set, */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    long result = syscall(SYS_clock_gettime, clock, now);

    if (clock == CLOCK_REALTIME)
        now->tv_sec += ahead;
    return (int)result;
}

/* and threads that run out. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *),
                   void *user)
{
    static int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

    if (!real)
        *(void **)&real = dlsym(RTLD_NEXT, "pthread_create");
    return threads_left-- > 0 ? real(thread, attributes, start, user) : EAGAIN;
}

static struct arena *arena;
static lcm_t *lcm;

static struct daemon_bus *begin(void)
{
    char error[512] = "";
    struct daemon_bus *bus;

    lcm = bus_open(NULL, error, sizeof error);
    ck_assert_msg(lcm != NULL, "%s", error);
    arena = arena_create(daemon_bus_memory());
    bus = daemon_bus_create(lcm, SPACE_VISUAL, arena, error, sizeof error);
    ck_assert_msg(bus != NULL, "%s", error);
    return bus;
}

static void end(void)
{
    lcm_destroy(lcm);
    arena_destroy(arena);
}

START_TEST(a_wait_takes_as_long_as_ever_when_the_clock_is_set)
{
    struct daemon_bus *bus = begin();
    const int64_t steps[] = {0, 3600, -3600};

    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        int64_t start = bus_monotonic_us(), took;
        ahead = steps[i];
        ck_assert(!daemon_bus_wait(bus, 100));
        took = bus_monotonic_us() - start;
        ck_assert_int_ge(took, 99000);
        ck_assert_int_lt(took, 5000000);
    }
    end();
}
END_TEST

static int threads(void)
{
    DIR *tasks = opendir("/proc/self/task");
    int n = 0;

    while (readdir(tasks) != NULL)
        n++;
    closedir(tasks);
    return n;
}

START_TEST(a_start_that_fails_leaves_no_thread)
{
    struct daemon_bus *bus = begin();
    char error[512] = "";
    int before = threads();

    threads_left = 1; /* for receiving; none for sending */
    ck_assert_int_eq(daemon_bus_start(bus, false, error, sizeof error), -1);
    ck_assert_ptr_nonnull(strstr(error, "cannot start a thread"));
    for (int i = 0; threads() != before && i < 1000; i++) /* one that was joined is gone soon */
        sleep_until((bus_monotonic_us() + 1000) * 1000);
    ck_assert_int_eq(threads(), before);
    threads_left = 1000;
    ck_assert_int_eq(daemon_bus_start(bus, false, error, sizeof error), 0);
    daemon_bus_stop(bus);
    end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_wait_takes_as_long_as_ever_when_the_clock_is_set,
        a_start_that_fails_leaves_no_thread,
    };

    return SUITE_RUN("daemon_bus", tests);
}
