/* The main of a Check program: one suite of one test case. */
#ifndef REACH_TEST_SUITE_H
#define REACH_TEST_SUITE_H

#include <check.h>
#include <stdlib.h>

/* Runs `n` tests, each within `timeout` seconds.
 *   returns the program's exit code */
static inline int suite_run(const char *name, const TTest *const *tests, size_t n, double timeout)
{
    Suite *suite = suite_create(name);
    TCase *test_case = tcase_create(name);
    SRunner *runner;
    int failed;

    tcase_set_timeout(test_case, timeout);
    for (size_t i = 0; i < n; i++)
        tcase_add_test(test_case, tests[i]);
    suite_add_tcase(suite, test_case);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

#define SUITE_RUN(name, tests) suite_run(name, tests, sizeof(tests) / sizeof(tests)[0], 60)

#endif
