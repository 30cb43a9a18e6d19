/* The queue of samples that wait for the slack of a tick. */
#include "daemon/control/sample_queue.h"
#include "tests/unit/suite.h"

START_TEST(a_full_queue_drops_and_counts)
{
    struct learner_config config = learner_config_default(1, 1);
    struct sample_queue queue;
    struct learner *learner;
    struct arena *arena;
    char error[128];

    config.psi0[0] = config.sigma0[0] = 1;
    arena = arena_create(sample_queue_memory(3) + learner_memory(&config));
    learner = learner_create(&config, arena, error, sizeof error);
    ck_assert_msg(learner != NULL, "%s", error);
    ck_assert_int_eq(sample_queue_init(&queue, 3, arena), 0);
    for (int i = 0; i < 5; i++)
        sample_queue_add(&queue, (double[]){i}, 1, (double[]){2.0 * i}, 1);
    ck_assert_int_eq(queue.count, 3);
    ck_assert_int_eq(queue.dropped, 2);
    ck_assert_double_eq(queue.samples[queue.oldest].z[0], 0);
    for (int i = 0; i < 3; i++)
        ck_assert_int_le(sample_queue_learn_one(&queue, learner), LEARNER_OUTLIER);
    ck_assert_ptr_null(sample_queue_oldest(&queue));
    ck_assert_int_eq(queue.learned, 3);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_full_queue_drops_and_counts};

    return SUITE_RUN("sample_queue", tests);
}
