/* What may change while the daemon runs, and what not. */
#include "daemon/config/reloadable.h"

#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <string.h>

static struct config from, to;

START_TEST(test_gains_and_limits_may_change)
{
    static const char *const allowed[] = {
        "motion.arm_velocity=20", "head.gain=5",    "babble.timeout=3", "task.gain=2",
        "fixation.frames=4",      "eyes.stale=0.3", "learner.quota=9"};
    char error[512] = "";
    int changes;

    from = fixture_config(NULL, 0);
    for (size_t i = 0; i < sizeof allowed / sizeof allowed[0]; i++) {
        to = fixture_config(&allowed[i], 1);
        ck_assert_msg(config_reloadable(&from, &to, &changes, error, sizeof error), "%s", error);
        ck_assert_int_eq(changes, 1);
    }
}
END_TEST

START_TEST(test_what_was_built_on_may_not)
{
    static const char *const refused[] = {
        "period=0.01",          "arm.max=[0, -5, 15, -5]", "safety.arm_velocity=70",
        "learner.capacity=32",  "learner.kind=lwpr",       "model.directory=/tmp",
        "task.scale_angle=9",   "head.min=[-30, -10]",     "eyes.pixels_per_radian=1000",
        "safety.state_hold=0.1"};
    char error[512], name[64];
    int changes;

    from = fixture_config(NULL, 0);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(refused[i], "="), refused[i]);
        to = fixture_config(&refused[i], 1);
        ck_assert(!config_reloadable(&from, &to, &changes, error, sizeof error));
        ck_assert_ptr_nonnull(strstr(error, name));
        ck_assert_ptr_nonnull(strstr(error, "restart"));
    }
}
END_TEST

START_TEST(test_the_same_is_no_change)
{
    char error[512];
    int changes;

    from = fixture_config(NULL, 0);
    to = fixture_config(NULL, 0);
    ck_assert(config_reloadable(&from, &to, &changes, error, sizeof error));
    ck_assert_int_eq(changes, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_gains_and_limits_may_change, test_what_was_built_on_may_not,
                                  test_the_same_is_no_change};

    return SUITE_RUN("reloadable", tests);
}
