/* After creation a learner neither allocates nor locks: the loop may call it at any time. */
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_prediction prediction;
static struct learner_inverse inverse;

static volatile long allocations;
static volatile long locks;

/* glibc's allocator and lock, counted; the sanitizers bring their own, which must stay. */
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t n, size_t bytes);
void *__libc_realloc(void *block, size_t bytes);
void *malloc(size_t bytes)
{
    allocations++;
    return __libc_malloc(bytes);
}

void *calloc(size_t n, size_t bytes)
{
    allocations++;
    return __libc_calloc(n, bytes);
}

void *realloc(void *block, size_t bytes)
{
    allocations++;
    return __libc_realloc(block, bytes);
}

int pthread_mutex_lock(pthread_mutex_t *mutex)
{
    static int (*real)(pthread_mutex_t *);

    locks++;
    if (!real) {
        void *found = dlsym(RTLD_NEXT, "pthread_mutex_lock");
        memcpy(&real, &found, sizeof real);
    }
    return real(mutex);
}

START_TEST(the_counted_lock_counts)
{
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    long before = locks;
    int result = pthread_mutex_lock(&mutex);
    long counted = locks - before; /* finding the real one may take locks, too */

    ck_assert_int_eq(result, 0);
    ck_assert_int_ge(counted, 1);
    ck_assert_int_eq(pthread_mutex_unlock(&mutex), 0);
}
END_TEST
#endif

static void expect_no_allocation_or_lock(const struct learner_config *config)
{
    struct learner *learner = bed_create(config);
    struct learner_solution single;
    long before = allocations;
    long locks_before = locks;

    for (int n = 0; n < 500; n++) {
        double z[2] = {bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0)};
        double x[2] = {sin(3.0 * z[0]) + n % 2, cos(3.0 * z[1])};
        learner_update(learner, z, x);
        learner_predict(learner, z, &prediction);
        learner_predict_single(learner, z, &single);
        learner_predict_inverse(learner, x, &inverse);
    }
    long allocated = allocations - before;
    long locked = locks - locks_before; /* before Check takes locks of its own */
    ck_assert_int_eq(allocated, 0);
    ck_assert_int_eq(locked, 0);
    ck_assert_int_gt(learner_get_statistics(learner).experts, 1);
    bed_clean();
}

START_TEST(nothing_is_allocated_or_locked_after_creation)
{
    struct learner_config config = learner_config_default(2, 2);

    config.psi0[0] = config.psi0[1] = 0.01;
    config.sigma0[0] = config.sigma0[1] = 0.1;
    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++) {
        config.features = (enum learner_features)features;
        expect_no_allocation_or_lock(&config);
    }
    config.kind = LEARNER_LWPR;
    expect_no_allocation_or_lock(&config);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        nothing_is_allocated_or_locked_after_creation,
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        the_counted_lock_counts,
#endif
    };

    return SUITE_RUN("learner keeps still", tests);
}
