/* The daemon's side of the bus when the clock is set, a thread cannot be had, or a robot sends more
 * states than the loop takes. In its own network namespace. */
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

static void send_states(int64_t first, int64_t last)
{
    reach_robot_state_t state = {.n_joints = 6};

    for (state.seq = first; state.seq <= last; state.seq++) {
        state.utime = 1000000 + 250 * state.seq;
        ck_assert_int_eq(reach_robot_state_t_publish(lcm, "ROBOT_STATE", &state), 0);
        if (state.seq % 20 == 0) /* so that the bus loses none */
            while (lcm_handle_timeout(lcm, 20) > 0)
                continue;
    }
    while (lcm_handle_timeout(lcm, 50) > 0)
        continue;
}

/* Takes what there is. Returns how many, in their order. */
static int take_states(struct daemon_bus *bus, int64_t *newest)
{
    struct received_state received;
    int taken = 0;

    while (daemon_bus_take_state(bus, &received)) {
        ck_assert_int_gt(received.state.seq, *newest);
        *newest = received.state.seq;
        taken++;
    }
    return taken;
}

/* 4 kHz against a loop of 50 Hz, and a loop that misses periods. */
START_TEST(of_more_states_than_there_is_room_for_the_newest_is_taken)
{
    struct daemon_bus *bus = begin();
    int64_t refused[REFUSALS_CHANNELS][REFUSALS_REASONS], newest = 0, first = 1;
    const int64_t last[] = {80, 160, 165, 485, 485};

    for (size_t i = 0; i < sizeof last / sizeof last[0]; i++) {
        send_states(first, last[i]);
        ck_assert_int_le(take_states(bus, &newest), last[i] - first + 1);
        ck_assert_int_eq(newest, last[i]);
        first = last[i] + 1;
    }
    daemon_bus_refused(bus, refused);
    for (int reason = 0; reason < REFUSALS_REASONS; reason++)
        ck_assert_int_eq(refused[REACH_STATUS_T_CHANNEL_STATE][reason], 0);
    end();
}
END_TEST

/* Some come while the loop takes: those that found no room are older than those that did. */
START_TEST(a_state_that_found_no_room_is_not_taken_after_a_newer_one)
{
    struct daemon_bus *bus = begin();
    struct received_state received;
    int64_t newest = 10;

    send_states(1, 80);
    for (int i = 0; i < 10; i++)
        ck_assert(daemon_bus_take_state(bus, &received));
    send_states(81, 85);
    ck_assert_int_eq(take_states(bus, &newest), 54 + 5);
    ck_assert_int_eq(newest, 85);
    end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_wait_takes_as_long_as_ever_when_the_clock_is_set,
        a_start_that_fails_leaves_no_thread,
        of_more_states_than_there_is_room_for_the_newest_is_taken,
        a_state_that_found_no_room_is_not_taken_after_a_newer_one,
    };

    return SUITE_RUN("daemon_bus", tests);
}
